#include "live/pack_pixels.h"

#include <fmt/ranges.h>

#include <cstdint>
#include <vector>

#include "image/parallel.h"

namespace kagefude {
namespace {

// The first bits of each chunk, and how many pixels a run has at most (62 and 63 would be spelled
// like QOI_OP_RGB and QOI_OP_RGBA).
constexpr unsigned char rgbTag = 0xfe, diffTag = 0x40, lumaTag = 0x80, runTag = 0xc0;
constexpr int longestRun = 62;

struct Rgb {
  uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

/// The difference of two bytes, modulo 256.
int difference(uint8_t a, uint8_t b) { return static_cast<int8_t>(static_cast<uint8_t>(a - b)); }

class Packer {
 public:
  /// `last` is the pixel before the first.
  Packer(size_t pixels, Rgb last) : bytes_(4 * pixels, '\0'), last_(last) {}

  void add(Rgb pixel) {
    if (pixel == last_) {
      if (++run_ == longestRun) endRun();
      return;
    }
    endRun();
    addOther(pixel);
    last_ = pixel;
  }

  std::string taken() {
    endRun();
    bytes_.resize(size_);
    return std::move(bytes_);
  }

 private:
  void put(int byte) { bytes_[size_++] = static_cast<char>(static_cast<unsigned char>(byte)); }

  void endRun() {
    if (run_ > 0) put(runTag | (run_ - 1));
    run_ = 0;
  }

  void addOther(Rgb pixel) {
    const auto fits = [](int value, int half) { return value >= -half && value < half; };
    const int r = difference(pixel.r, last_.r), g = difference(pixel.g, last_.g),
              b = difference(pixel.b, last_.b);
    const int redBeside = static_cast<int8_t>(r - g), blueBeside = static_cast<int8_t>(b - g);
    if (fits(r, 2) && fits(g, 2) && fits(b, 2)) {
      put(diffTag | (r + 2) << 4 | (g + 2) << 2 | (b + 2));
    } else if (fits(g, 32) && fits(redBeside, 8) && fits(blueBeside, 8)) {
      put(lumaTag | (g + 32));
      put((redBeside + 8) << 4 | (blueBeside + 8));
    } else {
      for (const int byte : {int{rgbTag}, int{pixel.r}, int{pixel.g}, int{pixel.b}}) put(byte);
    }
  }

  std::string bytes_;  // four a pixel are the most that there can be
  size_t size_ = 0;
  Rgb last_;
  int run_ = 0;
};

}  // namespace

std::string packPixels(const ShownPixels& pixels) {
  const auto at = [&](size_t i) {
    const auto byte = [&](size_t k) { return static_cast<uint8_t>(pixels.bytes[4 * i + k]); };
    return Rgb{byte(0), byte(1), byte(2)};
  };
  // Bands of rows, each of which needs of the one before its last pixel alone.
  constexpr int rows = 32;
  std::vector<std::string> bands(static_cast<size_t>((pixels.height + rows - 1) / rows));
  parallelRows(pixels.height, rows, [&](int first, int end) {
    const auto width = static_cast<size_t>(pixels.width);
    const size_t begin = static_cast<size_t>(first) * width,
                 last = static_cast<size_t>(end) * width;
    Packer packer(last - begin, begin > 0 ? at(begin - 1) : Rgb{});
    for (size_t i = begin; i < last; ++i) packer.add(at(i));
    bands[static_cast<size_t>(first / rows)] = packer.taken();
  });
  return fmt::format("{}", fmt::join(bands, ""));
}

}  // namespace kagefude
