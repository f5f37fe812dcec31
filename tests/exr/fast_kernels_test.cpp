#include "exr/fast_kernels.h"

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <random>

namespace kagefude {
namespace {

std::vector<uint8_t> randomBytes(size_t n, uint32_t seed) {
  std::mt19937 generator(seed);
  std::vector<uint8_t> bytes(n);
  for (uint8_t& b : bytes) b = static_cast<uint8_t>(generator());
  return bytes;
}

/// The codec's inverse as the file format words it: first all differences, then the interleaving.
std::vector<uint8_t> naiveUnpack(std::vector<uint8_t> block) {
  for (size_t i = 1; i < block.size(); ++i) {
    block[i] = static_cast<uint8_t>(block[i - 1] + block[i] - 128);
  }
  std::vector<uint8_t> out(block.size());
  for (size_t i = 0; i < block.size() / 2; ++i) {
    out[2 * i] = block[i];
    out[2 * i + 1] = block[block.size() / 2 + i];
  }
  return out;
}

const size_t lengths[] = {0, 1, 2, 7, 8, 9, 31, 32, 33, 63, 64, 65, 95, 100, 257, 1000};

TEST(ExrKernels, PlainUnpackInTwoRunsEqualsTheWordedCodec) {
  for (const size_t half : lengths) {
    const std::vector<uint8_t> block = randomBytes(2 * half, static_cast<uint32_t>(half));
    const ExrKernels& k = plainExrKernels();
    ExrCarry carry;
    carry.high = static_cast<uint8_t>(128 + k.sumBytes(block.data(), half) + (half % 2 ? 128 : 0));
    std::vector<uint8_t> out(2 * half);
    const size_t cut = half / 3;
    k.unpack(block.data(), block.data() + half, cut, carry, out.data());
    k.unpack(block.data() + cut, block.data() + half + cut, half - cut, carry,
             out.data() + 2 * cut);
    EXPECT_EQ(out, naiveUnpack(block)) << half;
  }
}

TEST(ExrKernels, SplitAndPredictAreTheInverseOfUnpack) {
  for (const size_t half : lengths) {
    const std::vector<uint8_t> pairs = randomBytes(2 * half, 5);
    std::vector<uint8_t> halves(2 * half), block(2 * half);
    plainExrKernels().split(pairs.data(), half, halves.data(), halves.data() + half);
    plainExrKernels().predict(halves.data(), 2 * half, block.data());
    EXPECT_EQ(naiveUnpack(block), pairs) << half;
  }
}

TEST(ExrKernels, EveryLevelGivesTheBytesOfThePlainOne) {
  for (const ExrKernels* level : exrKernelLevels()) {
    SCOPED_TRACE(level->name);
    for (const size_t n : lengths) {
      const std::vector<uint8_t> in = randomBytes(2 * n + 1, static_cast<uint32_t>(7 + n));
      const uint8_t* odd = in.data() + 1;  // an address without alignment
      EXPECT_EQ(level->sumBytes(odd, n), plainExrKernels().sumBytes(odd, n));
      ExrCarry carries[2] = {{17, 201}, {17, 201}};
      std::vector<uint8_t> out[2] = {std::vector<uint8_t>(2 * n), std::vector<uint8_t>(2 * n)};
      plainExrKernels().unpack(odd, odd + n, n, carries[0], out[0].data());
      level->unpack(odd, odd + n, n, carries[1], out[1].data());
      EXPECT_EQ(out[0], out[1]) << n;
      EXPECT_EQ(carries[0].low, carries[1].low);
      EXPECT_EQ(carries[0].high, carries[1].high);
      plainExrKernels().split(odd, n, out[0].data(), out[0].data() + n);
      level->split(odd, n, out[1].data(), out[1].data() + n);
      EXPECT_EQ(out[0], out[1]) << n;
      plainExrKernels().predict(odd, 2 * n, out[0].data());
      level->predict(odd, 2 * n, out[1].data());
      EXPECT_EQ(out[0], out[1]) << n;
    }
  }
}

TEST(ExrKernels, EveryHalfBecomesTheFloatThatImathMakes) {
  std::vector<uint16_t> halves(65536);
  for (size_t i = 0; i < halves.size(); ++i) halves[i] = static_cast<uint16_t>(i);
  for (const ExrKernels* level : exrKernelLevels()) {
    std::vector<float> floats(halves.size());
    level->halfToFloat(halves.data(), halves.size(), floats.data());
    for (size_t i = 0; i < halves.size(); ++i) {
      const float expected = imath_half_to_float(halves[i]);
      ASSERT_EQ(std::memcmp(&floats[i], &expected, sizeof expected), 0) << level->name << " " << i;
    }
  }
}

/// Every half, its neighbours in float, and the ties between neighbouring halves; then any bits.
std::vector<float> floatsToRound() {
  std::vector<float> floats;
  for (uint32_t h = 0; h < 65536; ++h) {
    const auto bits = std::bit_cast<uint32_t>(imath_half_to_float(static_cast<uint16_t>(h)));
    for (const uint32_t step : {0u, 1u, 0xfffu, 0x1000u, 0x1001u, 0x1fffu}) {
      floats.push_back(std::bit_cast<float>(bits + step));
      floats.push_back(std::bit_cast<float>(bits - step));
    }
  }
  for (int exponent = 95; exponent < 115; ++exponent) {
    for (uint32_t m = 0; m < 4096; ++m) {
      floats.push_back(std::bit_cast<float>(static_cast<uint32_t>(exponent) << 23 | m << 11));
      floats.push_back(std::bit_cast<float>(static_cast<uint32_t>(exponent) << 23 | m << 11 | 1u));
    }
  }
  std::mt19937 generator(3);
  for (int i = 0; i < 500000; ++i)
    floats.push_back(std::bit_cast<float>(static_cast<uint32_t>(generator())));
  return floats;
}

TEST(ExrKernels, MasksAreOneFromOneHalfOnAndWhereNothingIsKnown) {
  std::vector<float> floats = {
      0.5f, std::nextafter(0.5f, 0.0f), 1.0f, 0.0f, -1.0f, -0.0f, NAN, -NAN, INFINITY, -INFINITY};
  std::mt19937 generator(4);
  while (floats.size() < 1000)
    floats.push_back(std::bit_cast<float>(static_cast<uint32_t>(generator())));
  std::vector<uint8_t> odd(4 * floats.size() + 1);
  std::memcpy(odd.data() + 1, floats.data(), 4 * floats.size());
  for (const ExrKernels* level : exrKernelLevels())
    for (const size_t n : lengths) {
      std::vector<uint8_t> mask(n + 1, 7);
      const size_t unknown = level->floatToMask(odd.data() + 1, n, mask.data());
      size_t expected = 0;
      for (size_t i = 0; i < n; ++i) {
        const bool known = std::isfinite(floats[i]);
        ASSERT_EQ(mask[i], !known || floats[i] >= 0.5f ? 1 : 0) << level->name << " " << floats[i];
        expected += !known;
      }
      EXPECT_EQ(unknown, expected) << level->name << " " << n;
      EXPECT_EQ(mask[n], 7) << n;
    }
}

TEST(ExrKernels, OneValueOfWhichNothingIsKnownIsFoundWhereverItStands) {
  for (const ExrKernels* level : exrKernelLevels())
    for (const float bad : {NAN, -NAN, INFINITY, -INFINITY})
      for (size_t at = 0; at < 70; ++at) {
        std::vector<float> floats(70, 0.0f);
        floats[(at + 1) % 70] = 3e38f;
        floats[at] = bad;
        std::vector<uint8_t> mask(70, 7);
        EXPECT_EQ(
            level->floatToMask(reinterpret_cast<const uint8_t*>(floats.data()), 70, mask.data()),
            1u)
            << level->name << " " << at;
        EXPECT_EQ(mask[at], 1) << level->name << " " << at;
      }
}

TEST(ExrKernels, LargeValuesAreKnown) {
  const std::vector<float> floats(64, 3e38f);
  for (const ExrKernels* level : exrKernelLevels()) {
    std::vector<uint8_t> mask(64, 7);
    EXPECT_EQ(level->floatToMask(reinterpret_cast<const uint8_t*>(floats.data()), 64, mask.data()),
              0u)
        << level->name;
  }
}

TEST(ExrKernels, FloatsRoundToTheHalfThatImathMakes) {
  const std::vector<float> floats = floatsToRound();
  for (const ExrKernels* level : exrKernelLevels()) {
    std::vector<uint16_t> halves(floats.size());
    level->floatToHalf(floats.data(), floats.size(), halves.data());
    for (size_t i = 0; i < floats.size(); ++i) {
      ASSERT_EQ(halves[i], imath_float_to_half(floats[i]))
          << level->name << " " << std::hex << std::bit_cast<uint32_t>(floats[i]);
    }
  }
}

}  // namespace
}  // namespace kagefude
