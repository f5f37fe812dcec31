#include "sequence/frame_range.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "base/error.h"
#include "test_folder.h"

namespace kagefude {
namespace {

using Frames = std::vector<int>;

TEST(FrameRange, ReadsEveryForm) {
  EXPECT_EQ(parseFrames("7"), (Frames{7}));
  EXPECT_EQ(parseFrames("-3"), (Frames{-3}));
  EXPECT_EQ(parseFrames("0012"), (Frames{12}));
  EXPECT_EQ(parseFrames("1-4"), (Frames{1, 2, 3, 4}));
  EXPECT_EQ(parseFrames("1..4"), (Frames{1, 2, 3, 4}));
  EXPECT_EQ(parseFrames("4-1"), (Frames{4, 3, 2, 1}));
  EXPECT_EQ(parseFrames("1-10x3"), (Frames{1, 4, 7, 10}));
  EXPECT_EQ(parseFrames("1-10:4"), (Frames{1, 5, 9}));
  EXPECT_EQ(parseFrames("10-1x4"), (Frames{10, 6, 2}));
  EXPECT_EQ(parseFrames("10-1:-4"), (Frames{10, 6, 2}));
  EXPECT_EQ(parseFrames("-5--3"), (Frames{-5, -4, -3}));
  EXPECT_EQ(parseFrames("-1..1"), (Frames{-1, 0, 1}));
  EXPECT_EQ(parseFrames("1--1"), (Frames{1, 0, -1}));
  EXPECT_EQ(parseFrames("5-5"), (Frames{5}));
}

TEST(FrameRange, ReadsListsInTheOrderWrittenEachFrameOnce) {
  EXPECT_EQ(parseFrames("1,3,5"), (Frames{1, 3, 5}));
  EXPECT_EQ(parseFrames(" 1, 3  5 "), (Frames{1, 3, 5}));
  EXPECT_EQ(parseFrames("9 1-3"), (Frames{9, 1, 2, 3}));
  EXPECT_EQ(parseFrames("3-1,1-4,2"), (Frames{3, 2, 1, 4}));
}

TEST(FrameRange, RefusesEverythingElse) {
  for (const char* text :
       {"",        " ",   ",",           "1,",    ",1",     "1,,2",   "abc",     "1-",
        "-",       "--1", "1-2-3",       "1-10x", "1-10x0", "1-10:0", "1-10:-2", "1-10x2x2",
        "1-5:2:1", "x2",  "1x2",         "1:2",   "1.5",    "1...4",  "1-4y2",   "1-4z2",
        "1 - 4",   "+1",  "99999999999", "1;2",   "1-3;",   "١",      "1\n2"}) {
    EXPECT_THROW(parseFrames(text), UsageError) << text;
  }
}

TEST(FrameRange, NamesTheItemThatIsWrong) {
  const std::string message = messageOf<UsageError>([] { parseFrames("1-5,7-9y2"); });
  EXPECT_NE(message.find("'7-9y2' in '1-5,7-9y2'"), std::string::npos) << message;
  EXPECT_NE(message.find("'y2' is not understood"), std::string::npos) << message;
}

TEST(FrameRange, BoundsTheCount) {
  EXPECT_EQ(parseFrames("1-10000000").size(), kMostFrames);
  EXPECT_THROW(parseFrames("0-10000000"), UsageError);
  EXPECT_THROW(parseFrames("-2147483648-2147483647"), UsageError);
  EXPECT_THROW(parseFrames("1-9999999,1-9999999"), UsageError);
  EXPECT_EQ(parseFrames("-2147483648-2147483647x1000000000").size(), 5u);
}

TEST(FrameRange, FormatsCompactly) {
  EXPECT_EQ(formatFrames({}), "");
  EXPECT_EQ(formatFrames({3}), "3");
  EXPECT_EQ(formatFrames({4, 3, 2, 1, 7}), "1-4,7");
  EXPECT_EQ(formatFrames({1, 2}), "1-2");
  EXPECT_EQ(formatFrames({1, 3}), "1,3");
  EXPECT_EQ(formatFrames({1, 3, 5, 5, 9}), "1-5x2,9");
  EXPECT_EQ(formatFrames({-3, -2, -1}), "-3--1");
}

TEST(FrameRange, FormatReadsBackAsTheSameSet) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    std::set<int> frames;
    const int count = 1 + static_cast<int>(random() % 30);
    for (int i = 0; i < count; ++i) frames.insert(static_cast<int>(random() % 40) - 20);
    const Frames sorted(frames.begin(), frames.end());
    EXPECT_EQ(parseFrames(formatFrames(sorted)), sorted) << formatFrames(sorted);
  }
}

TEST(FrameRange, DescribesManyItemsByCount) {
  EXPECT_EQ(describeFrames({1, 2, 3, 10, 20, 31, 32}, 2), "1-3,10 and 3 more");
  EXPECT_EQ(describeFrames({1, 2, 3, 10}, 2), "1-3,10");
}

TEST(Chunk, ReadsPartOfWhole) {
  EXPECT_EQ(parseChunk("2/4").index, 2u);
  EXPECT_EQ(parseChunk("2/4").count, 4u);
  for (const char* text : {"", "2", "/", "0/4", "5/4", "2/", "/4", "-1/4", "1/0", "1/2/3", "1 /2",
                           "1/1000001", "a/b", "1.0/2"})
    EXPECT_THROW(parseChunk(text), UsageError) << text;
}

TEST(Chunk, PartsAreContiguousBalancedAndComplete) {
  for (const size_t total : {0u, 1u, 7u, 24u, 200u})
    for (size_t count = 1; count <= 30; ++count) {
      size_t next = 0;
      for (size_t index = 1; index <= count; ++index) {
        const ChunkSpan span = chunkSpan(total, {index, count});
        EXPECT_EQ(span.first, next);
        const size_t length = span.last - span.first;
        EXPECT_TRUE(length == total / count || length == total / count + 1);
        next = span.last;
      }
      EXPECT_EQ(next, total);
    }
}

}  // namespace
}  // namespace kagefude
