// What artists type: looks, --set, frame ranges.
#include "base/error.h"
#include "fuzz/fuzz_file.h"
#include "fuzz/harness.h"
#include "look/look.h"
#include "sequence/frame_range.h"

namespace kagefude::fuzz {

/// A look that is taken can be printed, and the print is a look that prints the same.
void fuzzLook(std::string_view input) {
  const FuzzFile file(input, ".toml");
  std::string text;
  try {
    text = resolvedText(readLook(file.path(), {}));
  } catch (const Error&) {
    return;
  }
  const FuzzFile printed(text, ".toml");
  require(resolvedText(readLook(printed.path(), {})) == text);
}

/// A line each: one --set after the other over an empty look.
void fuzzOverride(std::string_view input) {
  std::vector<std::string> overrides;
  while (!input.empty()) {
    const size_t end = std::min(input.find('\n'), input.size());
    overrides.emplace_back(input.substr(0, end));
    input.remove_prefix(std::min(end + 1, input.size()));
  }
  try {
    resolvedText(readLook({}, overrides));
  } catch (const Error&) {
  }
}

/// Frames print to a range that names the same frames.
void fuzzFrameRange(std::string_view input) {
  std::vector<int> frames;
  try {
    frames = parseFrames(input);
  } catch (const Error&) {
  }
  if (!frames.empty() && frames.size() < 10000) {
    const std::string text = formatFrames(frames);
    require(formatFrames(parseFrames(text)) == text);
    describeFrames(frames);
  }
  try {
    const Chunk chunk = parseChunk(input);
    const ChunkSpan span = chunkSpan(frames.size(), chunk);
    require(span.first <= span.last && span.last <= frames.size());
  } catch (const Error&) {
  }
}

}  // namespace kagefude::fuzz
