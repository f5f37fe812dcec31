#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

#include "image/vec.h"

namespace kagefude {

/// **[ours]** The colour that each object's strokes have on average at each tone, found from
/// finished pictures: what the pictures would be without strokes. An object whose own colour is
/// textured keeps its texture as if it were strokes. Tones are kept at 128 places, linear in
/// between.
class ToneColours {
 public:
  /// Counts a frame in. Background (id 0) and non-finite pixels are left out. Planes of one size.
  void add(View<const uint32_t> ids, View<const float> tone, Vec3View picture);
  /// The picture without strokes; 0 where no pixel of that object and about that tone was counted.
  Vec3Plane plain(View<const uint32_t> ids, View<const float> tone) const;

 private:
  static constexpr int places = 128;
  struct Sum {
    double r = 0, g = 0, b = 0, weight = 0;
  };
  using Colours = std::array<Sum, places>;
  std::unordered_map<uint32_t, Colours> objects_;
};

/// How strong and how coarse strokes are.
struct StrokeMeasure {
  /// Root mean square of their luminance (Rec. 709 weights) over that of the picture without them.
  double contrast = 0;
  /// Their mean wavelength in pixels: 2π over the ratio of the root mean squares of slope and
  /// value.
  double grain = 0;
  int64_t pixels = 0;
};

/// Strokes are the picture less the plain one. Pixels with another object next to them are left
/// out. No strokes give 0 and 0. Sums run in raster order: the same bits for any threads.
StrokeMeasure measureStrokes(View<const uint32_t> ids, Vec3View picture, Vec3View plain);

}  // namespace kagefude
