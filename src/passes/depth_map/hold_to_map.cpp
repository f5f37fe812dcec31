#include "passes/depth_map/hold_to_map.h"

#include <algorithm>

#include "image/parallel.h"

namespace kagefude {
namespace {

constexpr int margin = 4;        ///< pixels round unsure ones
constexpr float bias = 0.5f;     ///< texel widths at the receiver
constexpr float refuted = 3.0f;  ///< one mask in so many contradicts: the map has no weight

/// Pixels within `margin` rows and columns of a marked one.
Bytes grown(View<const uint8_t> marked) {
  const int width = marked.width, height = marked.height;
  Bytes across(width, height, uint8_t{0}), result(width, height, uint8_t{0});
  parallelRows(height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < width; ++x)
        if (marked(x, y))
          std::fill(across.row(y) + std::max(0, x - margin),
                    across.row(y) + std::min(width, x + margin + 1), uint8_t{1});
  });
  parallelRows(height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int row = std::max(0, y - margin); row <= std::min(height - 1, y + margin); ++row)
        for (int x = 0; x < width; ++x) result(x, y) |= across(x, row);
  });
  return result;
}

}  // namespace

void holdToMap(std::span<const PlacedMask> masks, Vec3View position, Vec3View normal,
               View<const uint32_t> surfaces, const ShadowMap& map, float lightRadius,
               LightShapeResult& shape) {
  const Bytes wanted = grown(shape.unsure);
  const BackProjection back =
      backProject(position, normal, surfaces, map, lightRadius, bias, masks, wanted);
  const float perMask = refuted / static_cast<float>(masks.size());
  parallelRows(surfaces.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < surfaces.width; ++x) {
        if (!wanted(x, y) || surfaces(x, y) == 0) continue;
        const float weight =
            std::max(0.0f, 1 - perMask * static_cast<float>(back.contradicted(x, y)));
        float &visibility = shape.visibility(x, y), &confidence = shape.confidence(x, y);
        visibility += weight * (back.visibility(x, y) - visibility);
        confidence += weight * (1 - confidence);
      }
  });
}

}  // namespace kagefude
