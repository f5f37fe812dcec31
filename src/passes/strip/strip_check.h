#pragma once

#include <string>
#include <vector>

#include "image/plane.h"

namespace kagefude {

/// What a strip is like; `problems` has one sentence for each thing an artist should mend.
struct StripReport {
  int width = 0, height = 0;
  float seamError = 0;         ///< mean difference over the join, 0..1
  float interiorError = 0;     ///< the same between neighbouring columns inside
  float seamRatio = 0;         ///< seamError / interiorError; about 1 when the edges join
  float bottomBrightness = 0;  ///< mean of the lowest and of the highest eighth, 0..1
  float topBrightness = 0;
  float disorder = 0;  ///< sum of the falls on the way up, as a share of the whole rise
  std::vector<std::string> problems;
};

/// Looks at a strip (display-encoded planes of equal size, row 0 on top): do left and right edges
/// join (ratio above 3 and error above 1/255 is a seam), does brightness (Rec. 709 weights) rise
/// from bottom to top (rows' means, smoothed over 1/32 of the height; disorder above 0.1 is
/// reported), is the size usable (at least 16 x 16). Non-finite texels are a problem and count as
/// 0. An empty picture gives a report with that problem alone.
StripReport checkStrip(View<const float> r, View<const float> g, View<const float> b);

}  // namespace kagefude
