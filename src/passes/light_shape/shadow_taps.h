#pragma once

#include <span>
#include <vector>

#include "image/plane.h"
#include "image/vec.h"
#include "passes/light_shape/light_share.h"
#include "passes/light_shape/shadow_places.h"
#include "passes/light_shape/shadow_shift.h"
#include "passes/search/uniform_blocks.h"

namespace kagefude {

/// Looks up what masks show along the shifts of a shadow. Taps count on pixels of the same label
/// and about the same normal only.
class ShadowTaps {
 public:
  static constexpr size_t mostMasks = kagefude::mostMasks;

  /// places: of the masks. Cost: one read of all planes; 4 bytes a pixel, with more than 16 masks
  /// 12 bytes and slower taps.
  ShadowTaps(std::span<const View<const uint8_t>> masks, std::span<const V2f> places,
             View<const uint32_t> labels, Vec3View normal);

  View<const uint32_t> labels() const { return labels_; }
  uint32_t label(int x, int y) const { return labels_(x, y); }
  /// Which masks see the light at a pixel.
  enum class Seen { none, some, all };
  Seen seen(int x, int y) const {
    const uint32_t lower = pixels_(x, y) & lower_;
    const uint64_t upper = upper_ ? upperPixels_(x, y) : 0;
    if (lower == 0 && upper == 0) return Seen::none;
    return lower == lower_ && upper == upper_ ? Seen::all : Seen::some;
  }

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
    const uint64_t* upperPixels;  ///< null with 16 masks or fewer
    uint32_t label, pixel;        ///< of the pixel looked from
    uint64_t upper;
    float x, y;            ///< its centre
    float ux, uy, vx, vy;  ///< pixels that a unit of place moves a tap
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

  View<const uint32_t> labels_;
  Ring ring_;
  uint32_t lower_;               ///< bits of the first 16 masks
  uint64_t upper_;               ///< and of the rest
  Plane<uint32_t> pixels_;       ///< normal in the upper half, bits of 16 masks in the lower
  Plane<uint64_t> upperPixels_;  ///< bits of the rest; empty when there is none
  UniformBlocks uniform_;
};

}  // namespace kagefude
