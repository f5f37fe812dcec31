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

  /// places: of the masks. Cost: one read of all planes; 4 bytes a pixel.
  ShadowTaps(std::span<const View<const uint8_t>> masks, std::span<const V2f> places,
             View<const uint32_t> labels, Vec3View normal);

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
  /// counts.
  float mismatch(int x, int y, const ShadowShift& along, float shift) const;

  /// Where a pixel's taps are looked up.
  struct Source {
    View<const uint32_t> labels, pixels;
    uint32_t label, pixel;  ///< of the pixel looked from
    float x, y;             ///< its centre
    float ux, uy, vx, vy;   ///< pixels that a unit of place moves a tap
  };
  /// The centre's mask moved to every other mask's place, and every other to the centre's.
  struct Ring {
    int count = 0;
    float x[2 * mostMasks], y[2 * mostMasks];
    int32_t from[2 * mostMasks], to[2 * mostMasks];
  };

 private:
  Source sourceAt(int x, int y, const ShadowShift& along, float shift) const;
  void pack(std::span<const View<const uint8_t>> masks, Vec3View normal, int y0, int y1);
  void findUniform();

  View<const uint32_t> labels_;
  Ring ring_;
  uint32_t all_;
  Plane<uint32_t> pixels_;  ///< normal in the upper half, mask bits in the lower
  int blocksX_, blocksY_;
  /// For blocks of 8x8 pixels: how many blocks to every side, less one, are of one label with it;
  /// 0: not even its own pixels are.
  std::vector<uint8_t> uniform_;
};

}  // namespace kagefude
