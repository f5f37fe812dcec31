#pragma once

#include <span>
#include <vector>

#include "image/plane.h"
#include "image/vec.h"
#include "passes/shadow_places.h"
#include "passes/shadow_shift.h"

namespace kagefude {

/// Looks up what masks show along the shifts of a shadow. Taps count on pixels of the same label
/// and about the same normal only.
class ShadowTaps {
 public:
  static constexpr size_t mostMasks = 16;

  /// Cost: one read of all planes; 4 bytes a pixel.
  ShadowTaps(std::span<const View<const uint8_t>> masks, View<const uint32_t> labels,
             Vec3View normal);

  View<const uint32_t> labels() const { return labels_; }
  uint32_t label(int x, int y) const { return labels_(x, y); }
  /// Bit k: whether the pixel is lit in mask k.
  uint32_t bits(int x, int y) const { return pixels_(x, y) & all_; }
  uint32_t allBits() const { return all_; }

  struct Mean {
    float visibility;  ///< mean over the places
    float cost;        ///< their masks' disagreement, 0 to 1/4
    bool valid;        ///< enough taps count
  };
  /// Every place takes its three masks moved along the shift, with their weights. shift: pixels.
  Mean mean(const ShadowPlaces& places, int x, int y, const ShadowShift& along, float shift) const;

  /// Share of masks that, moved by the shift, do not foretell what another sees here; 1 when no tap
  /// counts. places: of the masks.
  float mismatch(std::span<const V2f> places, int x, int y, const ShadowShift& along,
                 float shift) const;

 private:
  void pack(std::span<const View<const uint8_t>> masks, Vec3View normal, int y0, int y1);
  void findUniform();

  View<const uint32_t> labels_;
  uint32_t all_;
  Plane<uint32_t> pixels_;  ///< normal in the upper half, mask bits in the lower
  int blocksX_, blocksY_;
  /// For blocks of 8x8 pixels: how many blocks to every side, less one, are of one label with it;
  /// 0: not even its own pixels are.
  std::vector<uint8_t> uniform_;
};

}  // namespace kagefude
