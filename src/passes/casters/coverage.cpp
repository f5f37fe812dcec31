#include "passes/casters/coverage.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "image/parallel.h"
#include "passes/casters/surface_sampler.h"
#include "passes/casters/tile_shader.h"

namespace kagefude {
namespace {

class CoverageShader : TileShader {
 public:
  CoverageShader(const SeenSurface& surface, const ShadowWedges& wedges, const ShadowWedges& sight,
                 const LightPlace& light, const CoverageParams& params, View<float> result)
      : TileShader(surface, wedges, params), sampler_(surface, sight, light), result_(result) {}

  void tile(int x0, int y0) {
    const PixelBoxes boxes(surface_, x0, y0, false);
    sampler_.startTile(x0, y0, x0 + boxes.width(), y0 + boxes.height());
    shade(
        boxes, {0, 0, coverageTile, coverageTile},
        [&](const Rect& rect, bool shaded) {
          eachSmooth(boxes, rect,
                     [&](int x, int y) { result_(x0 + x, y0 + y) = shaded ? 1.0f : 0.0f; });
        },
        [&](const Rect& rect, const WedgeList& list) {
          eachSmooth(boxes, rect, [&](int x, int y) { smoothPixel(boxes, x, y, x0, y0, list); });
        });
    for (int y = 0; y < boxes.height(); ++y)
      for (int x = 0; x < boxes.width(); ++x)
        if (boxes.edge(x, y)) edgePixel(boxes, x0 + x, y0 + y);
  }

 private:
  template <class Body>
  static void eachSmooth(const PixelBoxes& boxes, const Rect& rect, const Body& body) {
    for (int y = rect.y0; y < std::min(rect.y1, boxes.height()); ++y)
      for (int x = rect.x0; x < std::min(rect.x1, boxes.width()); ++x)
        if (boxes.smooth(x, y)) body(x, y);
  }

  void smoothPixel(const PixelBoxes& boxes, int tileX, int tileY, int x0, int y0,
                   const WedgeList& list) {
    const int x = x0 + tileX, y = y0 + tileY;
    PointBox expected;
    bool stretched;
    boxes.around(tileX, tileY, tileX + 1, tileY + 1, expected, stretched);
    const float bias = biasOf(surface_.pixelSize(x, y), boxes.reach(), params_);
    BoxState state = filterIndices(list, fromApex(expected, wedges_.apex()),
                                   params_.selfShadow ? bias : undecided, indices_);
    FlatPixel flat;
    if (state == BoxState::touching && sampler_.locate(x, y, bias, flat)) state = judge(flat, list);
    if (state != BoxState::touching) {
      result_(x, y) = state == BoxState::inside ? 1.0f : 0.0f;
      return;
    }
    sampler_.sample(points_);
    const uint64_t open = points_.present & ~ownDark();
    if (open != 0 && expected.contains(points_.box(open)))
      result_(x, y) = shareOf(cut(list, open) | ownDark());
    else
      result_(x, y) = gatherAndCut();
  }

  /// A pixel where P alone does not bound what is seen: the sub-pixels are found first.
  void edgePixel(const PixelBoxes& boxes, int x, int y) {
    const float bias = biasOf(surface_.pixelSize(x, y), boxes.reach(), params_);
    FlatPixel flat;
    sampler_.locate(x, y, bias, flat);
    sampler_.sample(points_);
    result_(x, y) = gatherAndCut();
  }

  /// Settles a flat pixel by its corners, and drops the wedges that it lies apart from.
  BoxState judge(const FlatPixel& flat, const WedgeList& list) {
    if (flat.facesAway && params_.selfShadow) return BoxState::inside;
    std::array<V3f, 4> corners = flat.corners;
    for (V3f& corner : corners) corner -= wedges_.apex();
    size_t kept = 0;
    for (int i : indices_) {
      if (!counts(list.id[i], flat.id)) continue;
      const BoxState state = patchState(list.wedge(i), corners);
      if (state == BoxState::inside) return state;
      if (state == BoxState::touching) indices_[kept++] = i;
    }
    indices_.resize(kept);
    return kept == 0 ? BoxState::apart : BoxState::touching;
  }

  /// Cuts the sampled sub-pixels in up to two groups, before and behind a gap, so that each has a
  /// small box.
  float gatherAndCut() {
    const uint64_t before = points_.beforeGap();
    uint64_t shaded = ownDark();
    const uint64_t open = points_.present & ~shaded;
    for (uint64_t group : {before & open, open & ~before}) {
      if (group == 0) continue;
      wedges_.gather(points_.box(group), undecided, near_);
      indices_.resize(static_cast<size_t>(near_.count));
      std::iota(indices_.begin(), indices_.end(), 0);
      shaded |= cut(near_, group);
    }
    return shareOf(shaded);
  }

  /// The sub-pixels of the group inside any of the wedges that indices_ names.
  uint64_t cut(const WedgeList& list, uint64_t group) const {
    const V3f apex = wedges_.apex();
    alignas(64) float x[64], y[64], z[64];
    for (int k = 0; k < 64; ++k) {
      x[k] = points_.x[k] - apex.x;
      y[k] = points_.y[k] - apex.y;
      z[k] = points_.z[k] - apex.z;
    }
    uint64_t shaded = 0;
    for (int i : indices_) {
      uint64_t mask = wedgeMask(list.wedge(i), x, y, z) & group;
      if (!params_.selfShadow && mask != 0) mask &= ~own(list.id[i]);
      shaded |= mask;
      if (shaded == group) break;
    }
    return shaded;
  }

  /// Sub-pixels whose own triangle hides the light from them, wherever lifting would put them.
  uint64_t ownDark() const { return params_.selfShadow ? points_.facingAway : 0; }

  float shareOf(uint64_t shaded) const {
    if (points_.present == 0) return 0.0f;
    return static_cast<float>(std::popcount(shaded)) /
           static_cast<float>(std::popcount(points_.present));
  }

  uint64_t own(uint32_t id) const {
    uint64_t mask = 0;
    for (int k = 0; k < 64; ++k)
      if (!counts(id, points_.id[k])) mask |= uint64_t{1} << k;
    return mask;
  }

  SurfaceSampler sampler_;
  View<float> result_;
  SubpixelPoints points_;
  WedgeList near_;
  std::vector<int> indices_;
};

LightPlace sightOf(const CameraRays& rays) {
  return {rays.orthographic, rays.eye, rays.direction0};
}

}  // namespace

Floats shadowCoverage(const SeenSurface& surface, const CasterSet& casters, const LightPlace& light,
                      const CoverageParams& params) {
  surface.check();
  Floats result(surface.ids.width, surface.ids.height, 0.0f);
  if (casters.empty()) return result;
  const ShadowWedges wedges(casters, light, surface.rays.eye);
  const ShadowWedges sight(casters, sightOf(surface.rays), surface.rays.eye);
  parallelRows(tiles(surface.ids.height), 2, [&](int first, int end) {
    CoverageShader shader(surface, wedges, sight, light, params, result);
    for (int row = first; row < end; ++row)
      for (int column = 0; column < tiles(surface.ids.width); ++column)
        shader.tile(column * coverageTile, row * coverageTile);
  });
  return result;
}

void coverageToVisibility(View<float> coverage, const CoverageParams& params) {
  for (int y = 0; y < coverage.height; ++y)
    for (int x = 0; x < coverage.width; ++x)
      coverage(x, y) = 1.0f - params.strength * coverage(x, y);
}

}  // namespace kagefude
