#pragma once

#include <cstdlib>
#include <span>
#include <string_view>

namespace kagefude::fuzz {

/// Feeds bytes that nobody vouches for to one reader. Errors of the library are the right answer
/// and are swallowed; whatever else is thrown, and every finding of a sanitizer, is a bug.
struct Harness {
  std::string_view name;  ///< also the folder of its seeds in tests/fuzz/corpus
  void (*run)(std::string_view input);
};

/// Ends the process: what the library says of itself does not hold.
inline void require(bool holds) {
  if (!holds) std::abort();
}

/// All harnesses; a new one is a row here.
std::span<const Harness> harnesses();

void fuzzLook(std::string_view input);
void fuzzOverride(std::string_view input);
void fuzzFrameRange(std::string_view input);
void fuzzSave(std::string_view input);
void fuzzPageGuard(std::string_view input);
void fuzzManifest(std::string_view input);
void fuzzSidecar(std::string_view input);
void fuzzCasters(std::string_view input);
void fuzzExrHeader(std::string_view input);
void fuzzExrChunks(std::string_view input);
void fuzzPng(std::string_view input);

}  // namespace kagefude::fuzz
