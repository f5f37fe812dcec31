// Every seed and every input that once crashed goes through its harness again, without a fuzzer.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "fuzz/harness.h"
#include "source_folder.h"

namespace kagefude::fuzz {
namespace {

std::vector<std::filesystem::path> seedsOf(std::string_view harness) {
  const auto folder = testing::sourceFolder() / "tests/fuzz/corpus" / harness;
  std::vector<std::filesystem::path> seeds;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    seeds.push_back(entry.path());
  std::sort(seeds.begin(), seeds.end());
  return seeds;
}

std::string contentOf(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Replay : public ::testing::TestWithParam<Harness> {};

TEST_P(Replay, SeedsAndFormerCrashes) {
  const auto seeds = seedsOf(GetParam().name);
  EXPECT_FALSE(seeds.empty());
  for (const auto& seed : seeds) {
    SCOPED_TRACE(seed.string());
    EXPECT_NO_THROW(GetParam().run(contentOf(seed)));
  }
}

TEST_P(Replay, SeedsWithFlippedAndMissingBytes) {
  std::mt19937 random(5);
  for (const auto& seed : seedsOf(GetParam().name)) {
    const std::string good = contentOf(seed);
    for (int round = 0; round < 40 && !good.empty(); ++round) {
      std::string bad = good;
      for (int flips = 0; flips < 3; ++flips)
        bad[random() % bad.size()] = static_cast<char>(random());
      if (round % 4 == 0) bad.resize(random() % bad.size());
      SCOPED_TRACE(seed.string() + ", round " + std::to_string(round));
      EXPECT_NO_THROW(GetParam().run(bad));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Replay, ::testing::ValuesIn(harnesses().begin(), harnesses().end()),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace kagefude::fuzz
