#pragma once

#include <vector>

#include "passes/depth_map/depth_pyramid.h"
#include "passes/depth_map/map_receiver.h"

namespace kagefude {

/// n points of equal areas in the unit disc, on a golden-angle spiral.
std::vector<V2f> spiralPoints(int n);

/// How the stored depths round each receiver are compared with it (see pcf.h for the test).
struct TapTest {
  float slopeBias = 1;                   ///< how far the test follows the receiver's plane
  float spreadBias = 0;                  ///< further bias per unit of distance from the pixel
  float radius[MapReceivers::capacity];  ///< of the disc of taps, texels
  float bias[MapReceivers::capacity];    ///< world units

  /// `texels` texel widths at each receiver, and what rounding of its depth may take.
  void setBias(const MapReceivers& receivers, float texels);
};

/// Lets the pyramid decide where all taps of the disc agree for certain: known lanes get their
/// visibility, the same that the taps would give. `hidden`: decide also what is hidden. Taps
/// outside the map are lit. Cost: eight reads a lane.
void settleByPyramid(const DepthPyramid& pyramid, View<const float> depth, const TapTest& test,
                     bool hidden, MapReceivers& receivers);

/// The turn of each receiver's disc of taps: an integer hash (Wellons' lowbias32) of its place and
/// a seed, the same in every frame.
struct TapTurns {
  float sin[MapReceivers::capacity], cos[MapReceivers::capacity];

  TapTurns(const MapReceivers& receivers, int y, int seed);
};

struct TapCounts {
  int blocked[MapReceivers::capacity];
  float blockerDepth[MapReceivers::capacity];  ///< sum over the blocked taps, world units
};

/// Reads the map at the points, scaled to the radius and turned, round each receiver. A tap outside
/// the map and a NaN depth do not block.
void countTaps(View<const float> depth, const MapReceivers& receivers,
               const std::vector<V2f>& points, const TapTurns& turns, const TapTest& test,
               TapCounts& counts);

}  // namespace kagefude
