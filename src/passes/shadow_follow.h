#pragma once

#include <span>
#include <vector>

#include "image/plane.h"
#include "passes/light_shape.h"

namespace kagefude {

/// Follows shadows from mask to mask: finds how far they shift on the picture when the light moves,
/// and moves the masks along.
///
/// A blocker's shadow shifts on the receiver's tangent plane by -τ(δ - d (N·δ)/(N·d)) when the
/// light moves by δ, with d the way the light travels and τ one number: the ratio of the blocker's
/// distances from receiver and light (for a sun, its distance from the receiver). So on the picture
/// all shifts at a pixel are known up to one length, the shift R in pixels for the light's radius.
/// It is found by matching: at the right R all masks, moved to one place of the light, agree. Their
/// disagreement is summed over tiles, and over windows that grow with R, for lengths √2 apart.
/// A place between three masks takes each with its barycentric weight, so where the
/// match is poor the result is no worse than a weighted mean of masks.
///
/// Taps count on pixels of the same id and about the same normal only. Deterministic; no state
/// between pixels but the tiles' sums, which are made in a fixed order.
class ShadowFollow {
 public:
  /// masks: at most 16, a disc's. wanted: where masks disagree (1), background 0 elsewhere 2.
  ShadowFollow(std::span<const View<const uint8_t>> masks, std::span<const V2f> places,
               View<const uint32_t> labels, Vec3View position, Vec3View normal,
               const LightGeometry& geometry, float radius);

  struct Answer {
    float visibility = 1;
    float trust = 0;  ///< 0: use distances, 1: use this
  };
  /// For pixels at or near a shadow's edge; elsewhere trust is 0.
  Answer at(int x, int y) const;

 private:
  struct Basis {
    float ux, uy, vx, vy;  ///< pixels of the places' u and v, the longest shift being 1
    float trust;           ///< less where light grazes the surface, which may bend away
    bool valid;
  };
  struct Place {
    V2f offset[3];  ///< to the three masks, in units of place
    float weight[3];
    uint8_t mask[3];
  };
  static constexpr int mostShifts = 16;
  /// Disagreements of one label in one tile.
  struct Sums {
    uint32_t label = 0;
    float count = 0;
    float cost[mostShifts] = {};
  };
  struct Choice {
    uint32_t label = 0;
    float level = 0;  ///< place among the shifts, fractional
    float cost = 1;
  };
  struct Tile {
    Sums sums[2];
  };

  void pack(std::span<const View<const uint8_t>> masks, Vec3View normal);
  void measure();
  void measureTile(int tx, int ty);
  void choose();
  Choice chooseFor(int tx, int ty, uint32_t label) const;
  Basis basisAt(int x, int y) const;
  std::vector<Place> placesOf(std::span<const V2f> masks, int count, float radius) const;
  struct Mean {
    float visibility, cost;
    bool valid;
  };
  Mean meanAt(const std::vector<Place>& places, int x, int y, const Basis& b, float shift) const;

  /// Share of masks that, moved by the shift, do not foretell what another sees here. Without it a
  /// shift that carries every tap past the shadow would agree with itself.
  float mismatchAt(int x, int y, const Basis& b, float shift) const;

  View<const uint32_t> labels_;
  Vec3View position_, normal_;
  LightGeometry geometry_;
  size_t maskCount_;
  std::vector<V2f> masks_;  ///< their places
  int tile_, tilesX_, tilesY_;
  int shifts_ = 0;
  float length_[mostShifts];
  std::vector<Place> coarse_, fine_;
  Plane<uint64_t> pixels_;  ///< label, normal, mask bits
  std::vector<Tile> tiles_;
  struct Choices {
    Choice of[2];
  };
  std::vector<Choices> choices_;
};

}  // namespace kagefude
