#pragma once

#include <span>
#include <vector>

#include "image/plane.h"
#include "passes/light_shape.h"
#include "passes/mask_distance.h"

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
  static constexpr size_t mostMasks = 16;

  /// masks: at most mostMasks, a disc's. distances: of the masks, measured where they disagree.
  ShadowFollow(std::span<const View<const uint8_t>> masks, std::span<const V2f> places,
               const std::vector<Distances>& distances, View<const uint32_t> labels,
               Vec3View position, Vec3View normal, const LightGeometry& geometry, float radius);

  /// Places on the light, each between three masks, in arrays for gathering.
  struct Places {
    static constexpr int most = 80;
    int count = 0;
    float x[3][most], y[3][most];  ///< offsets from the three masks, in units of place
    float weight[3][most];
    int32_t mask[3][most];
  };

  struct Answer {
    float visibility = 1;
    float trust = 0;  ///< 0: use distances, 1: use this
    float shift = 0;  ///< pixels, for the light's radius
  };
  /// For pixels at or near the edge of a shadow that distances do not explain; elsewhere trust is
  /// 0.
  Answer at(int x, int y) const { return sparse_.view().empty() ? measured(x, y) : between(x, y); }

 private:
  struct Basis {
    float ux, uy, vx, vy;  ///< pixels of the places' u and v, the longest shift being 1
    float trust;           ///< less where light grazes the surface, which may bend away
    bool valid;
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
  /// 0 where one straight edge, moved over the light, explains all distances of a pixel where masks
  /// disagree, so that wedges are right without following; 1 where it is far from doing so, and
  /// where masks agree and a shadow between them may have been missed.
  /// Whether a pixel of the same label near (x, y) shows `opposite` in all masks.
  bool besideOpposite(int x, int y, uint32_t opposite, uint32_t all) const;
  float needAt(int x, int y) const;
  Answer measured(int x, int y) const;
  /// Large frames: answers of every other pixel in every other row.
  void fillSparse();
  /// Interpolated among those of the same label, but measured where shifts are so short that this
  /// would blur.
  Answer between(int x, int y) const;
  void measure();
  void measureTile(int tx, int ty);
  void choose();
  Choice chooseFor(int tx, int ty, uint32_t label) const;
  Basis basisAt(int x, int y) const;
  Places placesOf(std::span<const V2f> masks, int count, float radius) const;
  struct Mean {
    float visibility, cost;
    bool valid;
  };
  Mean meanAt(const Places& places, int x, int y, const Basis& b, float shift) const;

  /// Share of masks that, moved by the shift, do not foretell what another sees here. Without it a
  /// shift that carries every tap past the shadow would agree with itself.
  float mismatchAt(int x, int y, const Basis& b, float shift) const;

  const std::vector<Distances>& distances_;
  View<const uint32_t> labels_;
  Vec3View position_, normal_;
  LightGeometry geometry_;
  size_t maskCount_;
  std::vector<V2f> masks_;  ///< their places
  int tile_, tilesX_, tilesY_;
  int shifts_ = 0;
  float length_[mostShifts];
  Places coarse_, fine_;
  Plane<uint32_t> pixels_;  ///< normal, mask bits
  std::vector<Tile> tiles_;
  struct Choices {
    Choice of[2];
  };
  std::vector<Choices> choices_;
  Plane<Answer> sparse_;
};

}  // namespace kagefude
