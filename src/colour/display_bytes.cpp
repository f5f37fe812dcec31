#include "colour/display_bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <vector>

#include "image/parallel.h"
#include "image/vec.h"

namespace kagefude {
namespace {

using Channels = std::array<View<const float>, 3>;

/// The names of a view.
struct Through {
  const Colour& colour;
  std::string_view display, view;
};

int byteOf(float value) {
  // NaN is black.
  return value > 0.0f ? static_cast<int>(std::min(value, 1.0f) * 255.0f + 0.5f) : 0;
}

void put(char* pixel, int channel, int byte) {
  pixel[channel] = static_cast<char>(static_cast<unsigned char>(byte));
}

/// Which byte each value becomes. A cell holds the floats that differ in their last 11 bits alone.
class ByteTable {
 public:
  static constexpr int several = 256;  ///< not known from the cell
  // From 2^-14 to 2.
  static constexpr int dropped = 11;
  static constexpr uint32_t firstCell = (127u - 14u) << (23 - dropped);
  static constexpr uint32_t cells = 15u << (23 - dropped);

  explicit ByteTable(const Through& through) {
    constexpr int width = 512, height = static_cast<int>(cells) / width + 1;
    std::array<Floats, 3> ends;  // of the cells, and 0 behind them
    for (Floats& channel : ends) {
      channel = Floats(width, height, 0.0f);
      for (uint32_t i = 0; i <= cells; ++i)
        channel.row(0)[i] = std::bit_cast<float>((firstCell + i) << dropped);
    }
    through.colour.toDisplay(ends[0], ends[1], ends[2], through.display, through.view);
    for (size_t k = 0; k < 3; ++k) {
      const float* const end = ends[k].row(0);
      bytes_[k].resize(cells);
      for (uint32_t i = 0; i < cells; ++i) {
        const int low = byteOf(end[i]), high = byteOf(end[i + 1]);
        bytes_[k][i] = static_cast<uint16_t>(low == high ? low : several);
      }
      zero_[k] = byteOf(end[cells + 1]);
    }
  }

  int at(size_t channel, float value) const {
    const uint32_t cell = (std::bit_cast<uint32_t>(value) >> dropped) - firstCell;
    if (cell < cells) return bytes_[channel][cell];
    return value == 0.0f ? zero_[channel] : several;
  }

 private:
  std::array<std::vector<uint16_t>, 3> bytes_;
  std::array<int, 3> zero_;
};

/// Pixels that are transformed themselves, of some rows.
class Exact {
 public:
  void add(const V3f& colour, char* pixel) {
    for (int k = 0; k < 3; ++k) channels_[static_cast<size_t>(k)].push_back(colour[k]);
    pixels_.push_back(pixel);
  }

  void show(const Through& through) {
    if (pixels_.empty()) return;
    const auto view = [&](size_t k) {
      return View<float>(channels_[k].data(), static_cast<int>(pixels_.size()), 1);
    };
    through.colour.toDisplay(view(0), view(1), view(2), through.display, through.view);
    for (size_t i = 0; i < pixels_.size(); ++i)
      for (size_t k = 0; k < 3; ++k) put(pixels_[i], static_cast<int>(k), byteOf(channels_[k][i]));
  }

 private:
  std::array<std::vector<float>, 3> channels_;
  std::vector<char*> pixels_;
};

/// All of them where `table` is null.
void showRows(const Channels& channels, float gain, int first, int end, const Through& through,
              const ByteTable* table, char* out) {
  Exact exact;
  for (int y = first; y < end; ++y)
    for (int x = 0; x < channels[0].width; ++x, out += 4) {
      const V3f colour = V3f(channels[0](x, y), channels[1](x, y), channels[2](x, y)) * gain;
      put(out, 3, 255);
      bool known = table != nullptr;
      for (size_t k = 0; known && k < 3; ++k) {
        const int byte = table->at(k, colour[static_cast<int>(k)]);
        known = byte != ByteTable::several;
        put(out, static_cast<int>(k), byte);
      }
      if (!known) exact.add(colour, out);
    }
  exact.show(through);
}

}  // namespace

void displayBytes(const Colour& colour, View<const float> red, View<const float> green,
                  View<const float> blue, float exposure, std::string_view display,
                  std::string_view view, char* bytes) {
  const Through through{colour, display, view};
  // To make the table takes as long as that many pixels.
  const bool pays = red.pixels() > 2 * ByteTable::cells && !colour.mixesChannels(display, view);
  const std::optional<ByteTable> table = pays ? std::optional<ByteTable>(through) : std::nullopt;
  const float gain = std::exp2(exposure);
  parallelRows(red.height, [&](int first, int end) {
    const size_t before = static_cast<size_t>(first) * static_cast<size_t>(red.width);
    showRows({red, green, blue}, gain, first, end, through, table ? &*table : nullptr,
             bytes + 4 * before);
  });
}

}  // namespace kagefude
