#pragma once

#include <vector>

#include "image/real_math.h"
#include "passes/map_receiver.h"

namespace kagefude {

/// n points of equal areas in the unit disc, on a golden-angle spiral.
std::vector<V2f> spiralPoints(int n);

/// Turn of a pixel's taps, in [0, 1): an integer hash (Wellons' lowbias32) of its place and seed,
/// the same in every frame.
float pixelTurn(int x, int y, int seed);

/// How a tap's stored depth is compared with the receiver (see pcf.h for the test).
struct TapTest {
  float radius = 0;      ///< of the disc of taps, texels
  float bias = 0;        ///< world units
  float slopeBias = 1;   ///< how far the test follows the receiver's plane
  float spreadBias = 0;  ///< further bias per unit of distance from the pixel
};

struct TapCount {
  int lit = 0;
  int blocked = 0;
  float blockerDepth = 0;  ///< sum over the blocked taps, world units
};

/// Reads the map at the points, scaled to the radius and turned, round a receiver. A tap outside
/// the map and a NaN depth are lit.
TapCount countTaps(View<const float> depth, const MapReceiver& receiver,
                   const std::vector<V2f>& points, SinCos turn, const TapTest& test);

}  // namespace kagefude
