#include "picture/palette_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/plain_file.h"
#include "image/oklab.h"

namespace kagefude {
namespace {

constexpr uint64_t mostBytes = 1 << 20;
constexpr size_t mostColours = 4096;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("palette {} {}", path.string(), why));
}

std::vector<V3f> readGimp(const std::filesystem::path& path, const std::string& bytes) {
  std::vector<V3f> colours;
  std::istringstream lines(bytes);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const size_t first = line.find_first_not_of(" \t\r");
    if (number == 1 || first == std::string::npos || line[first] == '#') continue;
    if (line[first] < '0' || line[first] > '9') {
      if (line.find(':') != std::string::npos) continue;  // Name: and Columns:
      refuse(path, fmt::format("has no colour in line {}", number));
    }
    std::istringstream words(line);
    V3f colour;
    for (int c = 0; c < 3; ++c) {
      int value = -1;
      if (!(words >> value) || value < 0 || value > 255)
        refuse(path, fmt::format("has no red, green and blue of 0 to 255 in line {}", number));
      colour[c] = static_cast<float>(value) / 255.0f;
    }
    colours.push_back(colour);
    if (colours.size() > mostColours) break;
  }
  return colours;
}

/// CIE L*a*b* under D50 to sRGB: CIE 15, 8.2.1, then Bradford's matrix from D50 with that of sRGB
/// (IEC 61966-2-1) multiplied in.
V3f srgbOfLab(float lightness, float a, float b) {
  const auto linear = [](float f) {
    return f > 6.0f / 29.0f ? f * f * f : (f - 4.0f / 29.0f) * 3.0f * 36.0f / 841.0f;
  };
  const float fy = (lightness + 16.0f) / 116.0f;
  const float x = 0.96422f * linear(fy + a / 500.0f), y = linear(fy),
              z = 0.82521f * linear(fy - b / 200.0f);
  const V3f rgb(3.1338561f * x - 1.6168667f * y - 0.4906146f * z,
                -0.9787684f * x + 1.9161415f * y + 0.0334540f * z,
                0.0719453f * x - 0.2289914f * y + 1.4052427f * z);
  V3f encoded;
  for (int c = 0; c < 3; ++c) encoded[c] = srgbOfLinear(std::clamp(rgb[c], 0.0f, 1.0f));
  return encoded;
}

/// Reads big-endian numbers, and refuses to read beyond the end.
class SwatchReader {
 public:
  SwatchReader(const std::filesystem::path& path, std::string_view bytes)
      : path_(path), bytes_(bytes) {}

  uint32_t number(size_t size) {
    uint32_t value = 0;
    for (const char c : text(size)) value = value << 8 | static_cast<uint8_t>(c);
    return value;
  }
  float real() {
    const float value = std::bit_cast<float>(number(4));
    if (!std::isfinite(value)) refuse(path_, "holds a number that is not finite");
    return value;
  }
  std::string_view text(size_t size) {
    if (size > bytes_.size() - at_) refuse(path_, "is cut: a swatch goes beyond its end");
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  bool atEnd() const { return at_ == bytes_.size(); }

 private:
  const std::filesystem::path& path_;
  std::string_view bytes_;
  size_t at_ = 0;
};

V3f readSwatch(const std::filesystem::path& path, std::string_view block) {
  SwatchReader in(path, block);
  in.text(2 * static_cast<size_t>(in.number(2)));  // its name, UTF-16
  const std::string model(in.text(4));
  const auto unit = [&] { return std::clamp(in.real(), 0.0f, 1.0f); };
  if (model == "RGB ") {
    V3f colour;
    for (int c = 0; c < 3; ++c) colour[c] = unit();
    return colour;
  }
  if (model == "Gray") return V3f(unit());
  if (model == "LAB ") {
    const float lightness = 100.0f * unit(), a = in.real(), b = in.real();
    return srgbOfLab(lightness, std::clamp(a, -128.0f, 127.0f), std::clamp(b, -128.0f, 127.0f));
  }
  if (model == "CMYK")
    refuse(path,
           "holds colours in CMYK, which look like none in particular without their "
           "profile; export it in RGB");
  refuse(path, fmt::format("holds colours of an unknown model; expected RGB, Gray or LAB"));
}

std::vector<V3f> readSwatches(const std::filesystem::path& path, std::string_view bytes) {
  constexpr uint32_t colourBlock = 1;
  SwatchReader in(path, bytes.substr(4));
  in.number(4);  // version
  const uint32_t blocks = in.number(4);
  std::vector<V3f> colours;
  for (uint32_t i = 0; i < blocks && !in.atEnd(); ++i) {
    const uint32_t type = in.number(2);
    const std::string_view block = in.text(in.number(4));
    if (type == colourBlock) colours.push_back(readSwatch(path, block));
    if (colours.size() > mostColours) break;
  }
  return colours;
}

std::optional<V3f> colourOfHex(std::string_view word) {
  if (word.starts_with('#')) word.remove_prefix(1);
  if (word.size() != 6 && word.size() != 3) return {};
  uint32_t bits = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), bits, 16);
  if (error != std::errc() || end != word.data() + word.size()) return {};
  V3f colour;
  for (int c = 0; c < 3; ++c) {
    const uint32_t value =
        word.size() == 6 ? bits >> (16 - 8 * c) & 255 : (bits >> (8 - 4 * c) & 15) * 17;
    colour[c] = static_cast<float>(value) / 255.0f;
  }
  return colour;
}

/// What stands between commas, or between spaces; nothing between two commas is an empty word.
std::vector<std::string> listedWords(const std::string& text) {
  std::vector<std::string> words;
  for (size_t at = 0; at <= text.size();) {
    const size_t end = std::min(text.find(',', at), text.size());
    std::istringstream between(text.substr(at, end - at));
    const size_t before = words.size();
    for (std::string word; between >> word;) words.push_back(word);
    if (words.size() == before && text.find(',') != std::string::npos) words.emplace_back();
    at = end + 1;
  }
  return words;
}

}  // namespace

std::vector<V3f> readPalette(const std::filesystem::path& path) {
  const std::string bytes = readPlainFile(path, mostBytes);
  std::vector<V3f> colours;
  if (bytes.starts_with("GIMP Palette"))
    colours = readGimp(path, bytes);
  else if (bytes.starts_with("ASEF"))
    colours = readSwatches(path, bytes);
  else
    refuse(path, "is neither GIMP's (.gpl) nor Adobe's Swatch Exchange (.ase)");
  if (colours.empty()) refuse(path, "holds no colour");
  if (colours.size() > mostColours)
    refuse(path, fmt::format("holds more than {} colours", mostColours));
  return colours;
}

std::vector<V3f> paletteFromText(const std::string& text) {
  std::vector<V3f> colours;
  for (const std::string& word : listedWords(text)) {
    const auto colour = colourOfHex(word);
    if (!colour)
      throw UsageError(fmt::format(
          "--palette: {} is no colour; expected such as #8a3324, or a file .gpl or .ase",
          word.empty() ? "nothing between two commas, or beside one," : word));
    colours.push_back(*colour);
    if (colours.size() > mostColours)
      throw UsageError(fmt::format("--palette: more than {} colours", mostColours));
  }
  if (colours.empty()) throw UsageError("--palette: there is no colour in it");
  return colours;
}

}  // namespace kagefude
