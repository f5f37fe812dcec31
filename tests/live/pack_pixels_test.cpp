#include "live/pack_pixels.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace kagefude {
namespace {

/// The chunks undone as the specification of QOI says, one line of it each.
std::vector<uint8_t> unpacked(const std::string& text) {
  std::vector<uint8_t> out;
  uint8_t r = 0, g = 0, b = 0;
  for (size_t at = 0; at < text.size();) {
    const auto next = [&] { return static_cast<uint8_t>(text.at(at++)); };
    const int tag = next();
    int pixels = 1;
    if (tag == 0xfe) {
      r = next(), g = next(), b = next();
    } else if (tag >> 6 == 3) {
      pixels = (tag & 63) + 1;
    } else if (tag >> 6 == 2) {
      const int second = next(), green = (tag & 63) - 32;
      r = static_cast<uint8_t>(r + green - 8 + (second >> 4));
      g = static_cast<uint8_t>(g + green);
      b = static_cast<uint8_t>(b + green - 8 + (second & 15));
    } else if (tag >> 6 == 1) {
      r = static_cast<uint8_t>(r + (tag >> 4 & 3) - 2);
      g = static_cast<uint8_t>(g + (tag >> 2 & 3) - 2);
      b = static_cast<uint8_t>(b + (tag & 3) - 2);
    } else {
      ADD_FAILURE() << "QOI_OP_INDEX is not used";
    }
    for (; pixels > 0; --pixels)
      for (const uint8_t byte : {r, g, b, uint8_t{255}}) out.push_back(byte);
  }
  return out;
}

/// A row of pixels that differ by at most `step` a channel.
ShownPixels randomWalk(int step, unsigned seed) {
  std::mt19937 random(seed);
  const int count = 5000;
  ShownPixels pixels{count, 1, {}};
  int channels[3] = {10, 128, 250};
  for (int i = 0; i < count; ++i) {
    for (int& channel : channels) {
      channel =
          (channel + static_cast<int>(random() % static_cast<unsigned>(2 * step + 1)) - step) & 255;
      pixels.bytes.push_back(static_cast<char>(channel));
    }
    pixels.bytes.push_back(static_cast<char>(255));
  }
  return pixels;
}

void expectSame(const ShownPixels& pixels) {
  const std::vector<uint8_t> bytes(pixels.bytes.begin(), pixels.bytes.end());
  EXPECT_EQ(unpacked(packPixels(pixels)), bytes);
}

TEST(PackPixels, NothingIsLostWhateverTheStep) {
  for (const int step : {0, 1, 2, 5, 12, 40, 127})
    for (const unsigned seed : {1u, 2u}) expectSame(randomWalk(step, seed));
}

TEST(PackPixels, RunsOfEveryLength) {
  for (const size_t length : {1, 61, 62, 63, 124, 125, 1000}) {
    ShownPixels pixels{static_cast<int>(length), 1, {}};
    for (size_t i = 0; i < length; ++i) pixels.bytes += "\x64\x65\x66\xff";
    expectSame(pixels);
    EXPECT_LE(packPixels(pixels).size(), 4 + (length + 61) / 62);
  }
}

TEST(PackPixels, RowsThatArePackedApartJoin) {
  for (const int step : {0, 1, 12, 127}) {
    ShownPixels pixels = randomWalk(step, 4);
    pixels.width = 50;  // 100 rows
    pixels.height = 100;
    expectSame(pixels);
  }
}

TEST(PackPixels, ByHand) {
  // From black: nothing, one more of each, green by 10 with red 7 more and blue 8 less, a far
  // colour.
  const ShownPixels pixels{4, 1,
                           std::string("\0\0\0\xff\1\1\1\xff\x12\x0b\x03\xff\xc8\0\x64\xff", 16)};
  EXPECT_EQ(packPixels(pixels), std::string("\xc0\x7f\xaa\xf0\xfe\xc8\0\x64", 8));
}

TEST(PackPixels, NoiseTakesNoMoreThanItsPixels) {
  const ShownPixels noise = randomWalk(127, 3);
  EXPECT_LE(packPixels(noise).size(), noise.bytes.size());
}

TEST(PackPixels, NoPixelsAreNoBytes) { EXPECT_EQ(packPixels({}), ""); }

}  // namespace
}  // namespace kagefude
