#include "passes/coverage.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "image/parallel.h"
#include "passes/pixel_boxes.h"
#include "passes/surface_sampler.h"

namespace kagefude {
namespace {

/// Lists up to this length are tested pixel by pixel at once rather than cut down further.
constexpr int shortList = 48;
constexpr float roundingBias = 4e-6f;

float biasOf(float pixelSize, float reach, const CoverageParams& params) {
  return params.bias * pixelSize + roundingBias * reach;
}

PointBox fromApex(PointBox box, const V3f& apex) {
  box.centre -= apex;
  return box;
}

struct Rect {
  int x0, y0, x1, y1;

  int width() const { return x1 - x0; }
  Rect quarter(int k) const {
    const int half = width() / 2, x = x0 + (k % 2) * half, y = y0 + (k / 2) * half;
    return {x, y, x + half, y + half};
  }
};

/// Descends the tree for a tile and cuts it in four, with ever shorter lists, until a rectangle is
/// uniform or its list is short.
class TileShader {
 public:
  TileShader(const SeenSurface& surface, const ShadowWedges& wedges, const CoverageParams& params)
      : surface_(surface), wedges_(wedges), params_(params) {}

 protected:
  /// `settle(rect, shaded)` takes uniform rectangles, `leaf(rect, list)` the others.
  template <class Settle, class Leaf>
  void shade(const PixelBoxes& boxes, const Rect& rect, const Settle& settle, const Leaf& leaf) {
    PointBox box;
    bool stretched;
    if (!boxes.around(rect.x0, rect.y0, rect.x1, rect.y1, box, stretched)) return;
    if (stretched && rect.width() > 1) {
      for (int k = 0; k < 4; ++k) shade(boxes, rect.quarter(k), settle, leaf);
      return;
    }
    const BoxState state = wedges_.gather(box, verdictBias(boxes), list_);
    if (state == BoxState::touching)
      refine(boxes, rect, list_, 0, settle, leaf);
    else
      settle(rect, state == BoxState::inside);
  }

  /// With the receiver left out, whether a wedge counts depends on the sub-pixel's object, so that
  /// nothing larger can be judged.
  float verdictBias(const PixelBoxes& boxes) const {
    return params_.selfShadow ? biasOf(boxes.pixelSize(), boxes.reach(), params_) : undecided;
  }
  bool counts(uint32_t casterId, uint32_t receiverId) const {
    return params_.selfShadow || casterId == 0 || casterId != receiverId;
  }

  const SeenSurface& surface_;
  const ShadowWedges& wedges_;
  const CoverageParams& params_;

 private:
  template <class Settle, class Leaf>
  void refine(const PixelBoxes& boxes, const Rect& rect, const WedgeList& list, int level,
              const Settle& settle, const Leaf& leaf) {
    if (rect.width() == 1 || list.count <= shortList) {
      leaf(rect, list);
      return;
    }
    for (int k = 0; k < 4; ++k) {
      const Rect part = rect.quarter(k);
      PointBox box;
      bool stretched;
      if (!boxes.around(part.x0, part.y0, part.x1, part.y1, box, stretched)) continue;
      WedgeList& kept = levels_[level];
      const BoxState state =
          filterWedges(list, fromApex(box, wedges_.apex()), verdictBias(boxes), kept);
      if (state == BoxState::touching)
        refine(boxes, part, kept, level + 1, settle, leaf);
      else
        settle(part, state == BoxState::inside);
    }
  }

  WedgeList list_;
  std::array<WedgeList, 4> levels_;
};

class CoverageShader : TileShader {
 public:
  CoverageShader(const SeenSurface& surface, const ShadowWedges& wedges, const ShadowWedges& sight,
                 const CoverageParams& params, View<float> result)
      : TileShader(surface, wedges, params), sampler_(surface, sight), result_(result) {}

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
    if (state == BoxState::touching && sampler_.locate(x, y, flat)) state = judge(flat, list, bias);
    if (state != BoxState::touching) {
      result_(x, y) = state == BoxState::inside ? 1.0f : 0.0f;
      return;
    }
    sampler_.sample(points_);
    if (points_.present != 0 && expected.contains(points_.box(points_.present)))
      result_(x, y) = shareOf(cut(list, points_.present, bias));
    else
      result_(x, y) = gatherAndCut(bias);
  }

  /// A pixel where P alone does not bound what is seen: the sub-pixels are found first.
  void edgePixel(const PixelBoxes& boxes, int x, int y) {
    const float bias = biasOf(surface_.pixelSize(x, y), boxes.reach(), params_);
    FlatPixel flat;
    sampler_.locate(x, y, flat);
    sampler_.sample(points_);
    result_(x, y) = gatherAndCut(bias);
  }

  /// Settles a flat pixel by its corners, and drops the wedges that it lies apart from.
  BoxState judge(const FlatPixel& flat, const WedgeList& list, float bias) {
    std::array<V3f, 4> corners = flat.corners;
    for (V3f& corner : corners) corner -= wedges_.apex();
    size_t kept = 0;
    for (int i : indices_) {
      if (!counts(list.id[i], flat.id)) continue;
      const BoxState state = patchState(list.wedge(i), corners, bias);
      if (state == BoxState::inside) return state;
      if (state == BoxState::touching) indices_[kept++] = i;
    }
    indices_.resize(kept);
    return kept == 0 ? BoxState::apart : BoxState::touching;
  }

  /// Cuts the sampled sub-pixels in up to two groups, before and behind a gap, so that each has a
  /// small box.
  float gatherAndCut(float bias) {
    const uint64_t before = points_.beforeGap();
    uint64_t shaded = 0;
    for (uint64_t group : {before, points_.present & ~before}) {
      if (group == 0) continue;
      wedges_.gather(points_.box(group), undecided, near_);
      indices_.resize(static_cast<size_t>(near_.count));
      std::iota(indices_.begin(), indices_.end(), 0);
      shaded |= cut(near_, group, bias);
    }
    return shareOf(shaded);
  }

  /// The sub-pixels of the group inside any of the wedges that indices_ names.
  uint64_t cut(const WedgeList& list, uint64_t group, float bias) const {
    const V3f apex = wedges_.apex();
    alignas(64) float x[64], y[64], z[64];
    for (int k = 0; k < 64; ++k) {
      x[k] = points_.x[k] - apex.x;
      y[k] = points_.y[k] - apex.y;
      z[k] = points_.z[k] - apex.z;
    }
    uint64_t shaded = 0;
    for (int i : indices_) {
      uint64_t mask = wedgeMask(list.wedge(i), x, y, z, bias) & group;
      if (!params_.selfShadow && mask != 0) mask &= ~own(list.id[i]);
      shaded |= mask;
      if (shaded == group) break;
    }
    return shaded;
  }

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

class MaskShader : TileShader {
 public:
  MaskShader(const SeenSurface& surface, const ShadowWedges& wedges, const CoverageParams& params,
             View<uint8_t> result)
      : TileShader(surface, wedges, params), result_(result) {}

  void tile(int x0, int y0) {
    const PixelBoxes boxes(surface_, x0, y0, true);
    bias_ = biasOf(boxes.pixelSize(), boxes.reach(), params_);
    uint64_t shaded = 0;
    bool loaded = false;
    shade(
        boxes, {0, 0, coverageTile, coverageTile},
        [&](const Rect& rect, bool full) { shaded |= full ? bitsIn(rect) : 0; },
        [&](const Rect& rect, const WedgeList& list) {
          if (!loaded) load(boxes, x0, y0);
          loaded = true;
          shaded |= cut(list, bitsIn(rect));
        });
    for (int y = 0; y < boxes.height(); ++y)
      for (int x = 0; x < boxes.width(); ++x)
        if (boxes.smooth(x, y) && (shaded >> (y * coverageTile + x) & 1))
          result_(x0 + x, y0 + y) = 0;
  }

 private:
  static uint64_t bitsIn(const Rect& rect) {
    uint64_t mask = 0;
    for (int y = rect.y0; y < rect.y1; ++y)
      mask |= ((uint64_t{1} << (rect.width() - 1)) * 2 - 1) << (y * coverageTile + rect.x0);
    return mask;
  }

  void load(const PixelBoxes& boxes, int x0, int y0) {
    for (int k = 0; k < 64; ++k) {
      const int x = k % coverageTile, y = k / coverageTile;
      const bool present = x < boxes.width() && y < boxes.height() && boxes.smooth(x, y);
      const V3f p = present ? surface_.relative(x0 + x, y0 + y) - wedges_.apex() : V3f(0.0f);
      points_.x[k] = p.x;
      points_.y[k] = p.y;
      points_.z[k] = p.z;
      points_.id[k] = present ? surface_.ids(x0 + x, y0 + y) : 0;
    }
  }

  uint64_t cut(const WedgeList& list, uint64_t rect) const {
    uint64_t shaded = 0;
    for (int i = 0; i < list.count && (shaded & rect) != rect; ++i) {
      uint64_t mask = wedgeMask(list.wedge(i), points_.x, points_.y, points_.z, bias_) & rect;
      if (!params_.selfShadow)
        for (int k = 0; k < 64; ++k)
          if (!counts(list.id[i], points_.id[k])) mask &= ~(uint64_t{1} << k);
      shaded |= mask;
    }
    return shaded;
  }

  View<uint8_t> result_;
  float bias_ = 0;
  SubpixelPoints points_;
};

int tiles(int pixels) { return (pixels + coverageTile - 1) / coverageTile; }

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
    CoverageShader shader(surface, wedges, sight, params, result);
    for (int row = first; row < end; ++row)
      for (int column = 0; column < tiles(surface.ids.width); ++column)
        shader.tile(column * coverageTile, row * coverageTile);
  });
  return result;
}

Bytes hardShadowMask(const SeenSurface& surface, const CasterSet& casters, const LightPlace& light,
                     const CoverageParams& params) {
  surface.check();
  Bytes result(surface.ids.width, surface.ids.height, uint8_t{1});
  if (casters.empty()) return result;
  const ShadowWedges wedges(casters, light, surface.rays.eye);
  parallelRows(tiles(surface.ids.height), 2, [&](int first, int end) {
    MaskShader shader(surface, wedges, params, result);
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
