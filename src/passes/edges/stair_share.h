#pragma once

namespace kagefude {

/// How a run of edges between two rows of pixels ends on one side of a pixel.
struct RunEnd {
  int pixels = 0;  ///< of the run beyond the pixel itself
  int turn = 0;    ///< 1: on into the pixel's own row, -1: into the other row, 0: neither
};

/// **[ours]**, after Reshetov 2009 ("Morphological antialiasing") and Jimenez 2012 ("SMAA"): the
/// share of a pixel that lies beyond an edge of which only the staircase is known. The edge is
/// taken as a line through the middles of the steps at the run's two ends: straight from one to the
/// other where they turn to different sides, bent in the run's middle where they turn to the same
/// one, and along the row from there where one end does not turn. `before` and `after` tell of the
/// run on the pixel's two sides. 0 where the line runs on the other side of the edge, where that
/// row's pixel loses instead. At most 1/2.
double stairShare(const RunEnd& before, const RunEnd& after);

}  // namespace kagefude
