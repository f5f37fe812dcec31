#include "exr/fast_deflate.h"

#include <gtest/gtest.h>

#include <random>

namespace kagefude {
namespace {

std::vector<uint8_t> softNoise(size_t n) {
  std::mt19937 generator(9);
  std::vector<uint8_t> bytes(n);
  for (uint8_t& b : bytes) b = static_cast<uint8_t>(126 + generator() % 5);
  return bytes;
}

TEST(ExrDeflate, EveryEffortInflatesToWhatWentIn) {
  for (const ExrEffort effort : {ExrEffort::fast, ExrEffort::balanced, ExrEffort::small}) {
    Deflater deflater(effort);
    Inflater inflater;
    for (const size_t n : {size_t{100}, size_t{5000}, size_t{300000}}) {
      const std::vector<uint8_t> in = softNoise(n);
      std::vector<uint8_t> packed(n), out(n);
      const size_t size = deflater.deflate(in.data(), n, packed.data());
      ASSERT_GT(size, 0u);
      ASSERT_LT(size, n);
      EXPECT_TRUE(inflater.inflate(packed.data(), size, out.data(), n));
      EXPECT_EQ(in, out);
      EXPECT_FALSE(inflater.inflate(packed.data(), size - 5, out.data(), n));
      EXPECT_FALSE(inflater.inflate(packed.data(), size, out.data(), n - 1));
      out.resize(n + 1);
      EXPECT_FALSE(inflater.inflate(packed.data(), size, out.data(), n + 1));
      packed[size - 1] ^= 1;  // the checksum
      EXPECT_FALSE(inflater.inflate(packed.data(), size, out.data(), n));
    }
  }
}

TEST(ExrDeflate, GivesUpOnWhatDoesNotShrink) {
  std::mt19937 generator(1);
  std::vector<uint8_t> in(4000), out(4000);
  for (uint8_t& b : in) b = static_cast<uint8_t>(generator());
  for (const ExrEffort effort : {ExrEffort::fast, ExrEffort::balanced, ExrEffort::small}) {
    Deflater deflater(effort);
    EXPECT_EQ(deflater.deflate(in.data(), in.size(), out.data()), 0u);
    EXPECT_EQ(deflater.deflate(in.data(), 1, out.data()), 0u);
    EXPECT_EQ(deflater.deflate(in.data(), 0, out.data()), 0u);
  }
}

bool unpacks(const std::vector<uint8_t>& packed, std::vector<uint8_t>& out) {
  return unpackRunLengths(packed.data(), packed.size(), out.data(), out.size());
}

TEST(ExrDeflate, RunLengthsByHand) {
  std::vector<uint8_t> out(6);
  ASSERT_TRUE(unpacks({2, 7, 0xfd, 1, 2, 3}, out));  // 7 three times, then -3: three as they are
  EXPECT_EQ(out, (std::vector<uint8_t>{7, 7, 7, 1, 2, 3}));
}

TEST(ExrDeflate, BrokenRunLengthsStayInsideTheBuffer) {
  std::vector<uint8_t> out(6);
  EXPECT_FALSE(unpacks({6, 7}, out));           // seven bytes
  EXPECT_FALSE(unpacks({4, 7}, out));           // five bytes
  EXPECT_FALSE(unpacks({5}, out));              // no byte to repeat
  EXPECT_FALSE(unpacks({0xfa, 1, 2, 3}, out));  // three of six bytes
  EXPECT_FALSE(unpacks({5, 7, 0, 1}, out));     // one byte too many
  EXPECT_FALSE(unpacks({0x80, 1}, out));        // 128 bytes
}

}  // namespace
}  // namespace kagefude
