#pragma once

#include <span>
#include <utility>

#include "passes/edges/coverage_blend.h"

namespace kagefude {

/// Colours of some pixels of a row.
struct ColourRun {
  static constexpr int most = 256;
  float r[most], g[most], b[most], a[most];
};

/// What lies under paint. It is asked where paint leaves something open, so that it need not be
/// made, or kept, for the whole picture.
class PaintGround {
 public:
  virtual ~PaintGround() = default;
  /// Associated colours of the `count` pixels from (x, y) to the right, at most ColourRun::most.
  virtual void read(int x, int y, int count, ColourRun& run) const = 0;
};

/// A ground that is there as a picture.
class PictureGround : public PaintGround {
 public:
  explicit PictureGround(ColourPlanes picture) : picture_(std::move(picture)) {}
  void read(int x, int y, int count, ColourRun& run) const override;

 private:
  const ColourPlanes picture_;
};

/// Associated "over": paint + (1 - alpha) x ground, in place.
void layOver(const PaintViews& paint, const PaintGround& ground);

/// **[ours]** Lays paint over a rendered picture, so that each thing is seen once.
///
/// paint: scene-linear with associated alpha, its things met by coverage (blendByCoverage); becomes
/// the finished picture. picture: the render, associated; its alpha may be empty, which is 1.
/// ranks: coverage by the things that are painted alone (id 0 for all others), as was blended.
///
/// Where one painted thing covers a pixel wholly, or none does, this is "over": paint +
/// (1 - alpha) x picture. At a silhouette however the render holds the thing as well, by its
/// coverage c: "over" would show it twice, as a rim of its rendered colour, and make an alpha of
/// 2c - c². There the share 1 - c shows what lies beside the thing: the mean of the picture's
/// pixels in the 3x3, else the 5x5, that no painted thing covers. Where there are none, as between
/// two fingers, the picture is unmixed: of the 5x5 the two colours, of the things and of what is
/// behind, whose mixture by coverage is nearest (least squares), the latter never more than would
/// leave the things of any of these pixels less than no light. Where coverage does not tell them
/// apart, as inside a half-transparent thing, the picture stands for both. Of what is found so no
/// more is shown than the picture's alpha leaves beside the things. What the paint itself
/// leaves open within a thing, c - alpha, shows the picture as it is, and so does a pixel of a
/// thing that found no paint.
///
/// Cost: a pass over the picture, and 9 to 50 reads at each pixel of an edge.
void layOverPicture(const PaintViews& paint, const ColourViews& picture,
                    std::span<const CoverageRank> ranks);

}  // namespace kagefude
