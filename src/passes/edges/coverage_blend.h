#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "image/plane.h"
#include "image/sparse_plane.h"

namespace kagefude {

/// What a rank holds at each pixel, of a plane that is kept wholly or sparsely.
template <class T>
class RankView {
 public:
  RankView(const View<const T>& whole) : whole_(whole) {}
  RankView(const Plane<T>& whole) : whole_(whole) {}
  RankView(const SparsePlane& sparse) : sparse_(&sparse) {}

  T operator()(int x, int y) const {
    return sparse_ ? std::bit_cast<T>((*sparse_)(x, y)) : whole_(x, y);
  }

 private:
  View<const T> whole_;
  const SparsePlane* sparse_ = nullptr;
};

/// One rank of a Cryptomatte: which thing, and how much of the pixel it covers, 0..1.
struct CoverageRank {
  RankView<uint32_t> id;
  RankView<float> coverage;
};

/// Coverage below counts as none.
inline constexpr float smallestShare = 1.0f / 512.0f;
/// Coverage from here on counts as all of the pixel.
inline constexpr float fullShare = 1.0f - smallestShare;

/// Scene-linear colour with associated alpha.
struct ColourViews {
  View<const float> r, g, b, a;
};
struct ColourPlanes {
  Floats r, g, b, a;
};
/// Planes of a picture that is being made, in place.
struct PaintViews {
  View<float> r, g, b, a;
};

/// **[ours]** Clean edges between styles: every pixel's colour was made for the one thing at its
/// centre (`ownId`, in the ranks' ids, 0 = background); here it becomes Σ coverage x colour over
/// all things that the ranks name. A thing that is not the pixel's own lends the mean colour of the
/// pixels of its own in the 3x3 round it, or in the 5x5 where those have none. Things found nowhere
/// near are left out and their share goes to the others; share that belongs to background or is not
/// named stays empty, so the result's alpha is the covered share. Where the first rank covers all,
/// or ranks are absent, colours keep their bits. Coverage below smallestShare and NaN
/// are ignored. Cost: 9 to 25 reads for each foreign rank of an edge pixel.
void blendByCoverage(const PaintViews& paint, View<const uint32_t> ownId,
                     std::span<const CoverageRank> ranks);

}  // namespace kagefude
