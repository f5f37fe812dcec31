#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kagefude {

/// Most frames that one range may name; more is taken for a slip of the keyboard.
constexpr size_t kMostFrames = 10'000'000;

/// The frames that a range names, in the order written, each once (the first mention counts).
/// Items are separated by a comma or by spaces:
///
///     7   -3   1-10   1..10   10-1 (backwards)   1-10x2   1-10:2 (every second)   -5--1
///
/// A step counts from the first number and may leave the last one out; for a backwards range it
/// may be written with or without its minus. UsageError names the item that is not understood, a
/// zero or wrong-way step, a number beyond 32 bits, or more than kMostFrames frames.
std::vector<int> parseFrames(std::string_view text);

/// The frames as a short range, sorted, each once: "1-4,7,10-20x2". parseFrames reads it back.
/// Empty for no frames.
std::string formatFrames(std::vector<int> frames);

/// The same for messages: at most `most` items, then "and N more".
std::string describeFrames(std::vector<int> frames, size_t most = 8);

/// Part `index` (1 … count) of a job that is spread over `count` tasks.
struct Chunk {
  size_t index = 1;
  size_t count = 1;
};

/// "2/4" is the second of four parts. UsageError for anything else than 1 ≤ i ≤ n ≤ 1000000.
Chunk parseChunk(std::string_view text);

/// The half-open range of positions [first, last) that a chunk takes of `total` frames: parts are
/// contiguous, in order, together all of them, and differ by one frame at most, the longer ones
/// first. With more parts than frames the last ones are empty.
struct ChunkSpan {
  size_t first = 0;
  size_t last = 0;
};
ChunkSpan chunkSpan(size_t total, const Chunk& chunk);

}  // namespace kagefude
