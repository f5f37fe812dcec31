#include <algorithm>

#include "image/parallel.h"
#include "passes/casters/coverage.h"
#include "passes/casters/subpixel_points.h"
#include "passes/casters/tile_shader.h"

namespace kagefude {
namespace {

class MaskShader : TileShader {
 public:
  MaskShader(const SeenSurface& surface, const ShadowWedges& wedges, const CoverageParams& params,
             View<uint8_t> result)
      : TileShader(surface, wedges, params), result_(result) {}

  void tile(int x0, int y0) {
    const PixelBoxes boxes(surface_, x0, y0, true);
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
      const V3f p = present ? lifted(x0 + x, y0 + y) - wedges_.apex() : V3f(0.0f);
      points_.x[k] = p.x;
      points_.y[k] = p.y;
      points_.z[k] = p.z;
      points_.id[k] = present ? surface_.ids(x0 + x, y0 + y) : 0;
    }
  }

  /// P, off its surface to the side that the camera sees.
  V3f lifted(int x, int y) const {
    const V3f p = surface_.relative(x, y), n = surface_.normal(x, y);
    const V3f direction(surface_.rays.direction(x + 0.5, y + 0.5));
    const float lift = biasOf(surface_.pixelSize(x, y), p.length(), params_);
    return p + n * (n.dot(direction) > 0 ? -lift : lift);
  }

  uint64_t cut(const WedgeList& list, uint64_t rect) const {
    uint64_t shaded = 0;
    for (int i = 0; i < list.count && (shaded & rect) != rect; ++i) {
      uint64_t mask = wedgeMask(list.wedge(i), points_.x, points_.y, points_.z) & rect;
      if (!params_.selfShadow)
        for (int k = 0; k < 64; ++k)
          if (!counts(list.id[i], points_.id[k])) mask &= ~(uint64_t{1} << k);
      shaded |= mask;
    }
    return shaded;
  }

  View<uint8_t> result_;
  SubpixelPoints points_;
};

}  // namespace

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

}  // namespace kagefude
