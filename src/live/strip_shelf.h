#pragma once

#include <deque>

#include "compositor/strip_set.h"
#include "live/stage.h"

namespace kagefude {

/// A look's colour configuration and strips. Each is kept while the look names it and its file lies
/// unchanged on disk; strips that it names no more stay for a while, so that going back to one, as
/// a comparison of two does, loads nothing.
class StripShelf {
 public:
  /// spare: bytes of strips that no style has any more, the last ones first.
  explicit StripShelf(size_t spare = size_t{96} << 20) : mostSpare_(spare) {}

  const Made<Colour>& colourOf(const Look& look, StageRun& run);
  /// The strips in the colours of `colour`, until the next call: strips that stay go over from one
  /// set to the next, so nobody else may hold the set. Throws as StripSet does, and Superseded.
  Made<StripSet> stripsOf(const Look& look, const Made<Colour>& colour, StageRun& run);

 private:
  struct Spare {
    std::string name;
    StageKey stamp;
    Strip strip;
  };
  StripSet::Loaded loadMissing(Look look, const Colour& colour,
                               const std::map<std::string, StageKey>& stamps) const;
  void putAside();
  StripSet::Loaded takeSpare(const std::map<std::string, StageKey>& stamps);
  void letGo();

  size_t mostSpare_;
  Stage<Colour> colour_;
  std::shared_ptr<const Colour> colourOfSet_;  ///< which the set refers to
  std::shared_ptr<StripSet> set_;
  uint64_t version_ = 0;
  StageKey key_;
  std::map<std::string, StageKey> stamps_;  ///< of each strip in the set
  std::deque<Spare> spare_;                 ///< what was used last comes first
};

}  // namespace kagefude
