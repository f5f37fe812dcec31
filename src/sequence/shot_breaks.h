#pragma once

#include <string>
#include <vector>

#include "frame/sidecar.h"

namespace kagefude {

/// One way in which frames of a shot are described by what each of them happens to see.
struct ShotBreak {
  std::string kind;         ///< what changes, such as "the radius of what light Key lights"
  std::string change;       ///< how, at the first of the frames
  std::string remedy;       ///< what to do
  std::vector<int> frames;  ///< at which it changes against the frame before

  /// "frame 7 (and 2 more): ..."
  std::string sentence() const;
};

/// Adds to `breaks` what `now` (frame `frame`) says otherwise than `before` though it should hold
/// for the whole shot: the subject of a light, the masks' offset on a light of unchanged size, and
/// the shot itself. Sizes count as other from one in a thousand on. Of each kind one break.
void noteShotBreaks(const Sidecar& before, const Sidecar& now, int frame,
                    std::vector<ShotBreak>& breaks);

}  // namespace kagefude
