#pragma once

#include <optional>

#include "passes/light_shape/shadow_match.h"

namespace kagefude {

/// Follows shadows from mask to mask: finds how far they shift on the picture when the light moves,
/// and moves the masks along.
///
/// A blocker's shadow shifts on the receiver's tangent plane by -τ(δ - d (N·δ)/(N·d)) when the
/// light moves by δ, with d the way the light travels and τ one number: the ratio of the blocker's
/// distances from receiver and light (for a sun, its distance from the receiver). So on the picture
/// all shifts at a pixel are known up to one length (shadow_shift.h), the shift R in pixels for the
/// light's radius, which is found by matching (shadow_match.h). A place between three masks takes
/// each with its barycentric weight, so where the match is poor the result is no worse than a
/// weighted mean of masks.
///
/// Deterministic; no state between pixels but the tiles' sums, which are made in a fixed order.
class ShadowFollow {
 public:
  static constexpr size_t mostMasks = ShadowTaps::mostMasks;

  /// masks: at most mostMasks, a disc's. distances: of the masks, at `edges`, where they disagree.
  /// All must outlive this.
  ShadowFollow(std::span<const View<const uint8_t>> masks, std::span<const V2f> places,
               const Distances& distances, const PixelSet& edges, View<const uint32_t> labels,
               Vec3View position, Vec3View normal, const LightGeometry& geometry, float radius);
  ShadowFollow(const ShadowFollow&) = delete;
  ShadowFollow& operator=(const ShadowFollow&) = delete;

  /// Pixels of a row that, from a multiple of it on, may all have answers or none.
  static constexpr int run = ShadowMatch::smallestTile;

  struct Answer {
    float visibility = 1;
    float trust = 0;  ///< 0: use distances, 1: use this
    float shift = 0;  ///< pixels, for the light's radius
  };

  /// Answers in a band of rows. In large frames those of every other pixel in every other row are
  /// made first, where shifts are wide those of every fourth, and the rest interpolated.
  class Band {
   public:
    /// Rows [y0, y1); y0 a multiple of 4, y1 too or the frame's end.
    Band(const ShadowFollow& follow, int y0, int y1);

    /// False when no pixel of the row's run that holds x can have an answer.
    bool mayAnswer(int x, int y) const { return follow_.match_.mayFind(x, y); }
    /// For pixels at or near the edge of a shadow that distances do not explain; elsewhere trust is
    /// 0.
    Answer at(int x, int y) const {
      return sparse_.empty() ? follow_.measured(x, y) : between(x, y);
    }

   private:
    /// For column i and row j of the sparse answers: interpolated among those at even ones where
    /// all of them are trusted and shift far, else measured.
    Answer betweenWide(int i, int j) const;
    /// Interpolated among those of the same label, but measured where shifts are so short that this
    /// would blur.
    Answer between(int x, int y) const;

    const ShadowFollow& follow_;
    int firstRow_;  ///< of the sparse answers
    Plane<Answer> sparse_;
  };

 private:
  Answer measured(int x, int y) const;

  ShadowTaps taps_;
  ShadowNeed need_;
  ShadowMatch match_;
  ShadowPlaces places_;
  Vec3View position_, normal_;
  const LightGeometry& geometry_;
};

}  // namespace kagefude
