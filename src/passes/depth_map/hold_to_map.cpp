#include "passes/depth_map/hold_to_map.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"
#include "passes/tone/smooth.h"

namespace kagefude {
namespace {

constexpr int margin = 4;     ///< pixels round unsure ones
constexpr float bias = 0.5f;  ///< texel widths at the receiver
constexpr int window = 3;     ///< half of the square over which contradictions are averaged, pixels
constexpr float refuted = 1.0f / 3.0f;  ///< share of contradicting masks from which the map is out

// The masks' error falls as one over their number, the map's does not: weighted by their squares,
// the map counts as so many masks. It does so where both say about the same, and where the light
// grazes, where a texel's depth tells less than a mask; elsewhere what masks do not contradict is a
// thin shadow between their places, and the map's alone.
constexpr float worth = 20;        ///< masks, where both say the same
constexpr float worthGrazing = 5;  ///< masks
constexpr float apart = 0.25f;     ///< visibilities that far apart are not the same
constexpr float grazes = 0.4f;     ///< cosine between the normal and the way to the light
constexpr float faces = 0.7f;      ///< from here on it does not

constexpr float alone = 1.3f;         ///< of a pixel by itself: a tenth of its masks may contradict
constexpr float mostInUmbra = 0.08f;  ///< of a light that no mask sees, between the masks' places

void addMarks(const uint8_t* from, int count, uint8_t* to) {
  for (int i = 0; i < count; ++i) to[i] |= from[i];
}

/// Pixels within `margin` rows and columns of a marked one.
Bytes grown(View<const uint8_t> marked) {
  const int width = marked.width, height = marked.height;
  Bytes across(width, height, uint8_t{0}), result(width, height);
  parallelRows(height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0, done = 0; x < width; ++x) {
        if (!marked(x, y)) continue;
        const int end = std::min(width, x + margin + 1);
        std::fill(across.row(y) + std::max(done, x - margin), across.row(y) + end, uint8_t{1});
        done = end;
      }
  });
  parallelRows(height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y) {
      const uint8_t* rows[2 * margin + 1];
      for (int k = 0; k <= 2 * margin; ++k)
        rows[k] = across.row(std::clamp(y + k - margin, 0, height - 1));
      std::copy_n(rows[0], width, result.row(y));
      for (int k = 1; k <= 2 * margin; ++k) addMarks(rows[k], width, result.row(y));
    }
  });
  return result;
}

Floats sharesOf(View<const uint8_t> contradicted, size_t masks) {
  Floats shares(contradicted.width, contradicted.height);
  parallelRows(contradicted.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < contradicted.width; ++x)
        shares(x, y) = static_cast<float>(contradicted(x, y)) / static_cast<float>(masks);
  });
  return shares;
}

/// Of the map, by the share of contradicting masks at a pixel and their mean around it. A mask's
/// edge that lies a little beside the map's makes a line of pixels that one mask contradicts; the
/// mean keeps such lines out of the picture.
float weightOf(float here, float around) {
  const float bySurroundings = 1 - around / refuted;
  const float byItself = alone - here / refuted;
  return std::clamp(std::min(bySurroundings, byItself), 0.0f, 1.0f);
}

/// What masks have of a mean with a map that counts as `worth` masks.
float shareOf(size_t masks, float worth) {
  const float squared = static_cast<float>(masks * masks);
  return squared / (squared + worth * worth);
}

/// Cosine between a normal and the way to the light.
float facing(const ShadowMap& map, const V3f& position, const V3f& normal) {
  const bool perspective = map.clipFromLight.m[3][2] != 0;
  const V3d way = perspective ? -map.lightFromWorld.point(V3d(position)) : V3d(0, 0, 1);
  const V3d turned = map.lightFromWorld.direction(V3d(normal));
  return static_cast<float>(turned.dot(way) / way.length());
}

}  // namespace

void holdToMap(std::span<const PlacedMask> masks, Vec3View position, Vec3View normal,
               View<const uint32_t> surfaces, const ShadowMap& map, float lightRadius,
               LightShapeResult& shape) {
  const Bytes wanted = grown(shape.unsure);
  const BackProjection back =
      backProject(position, normal, surfaces, map, lightRadius, bias, masks, wanted);
  const Floats doubt = sharesOf(back.contradicted, masks.size());
  const Floats around = smoothWithinSurfaces(doubt, surfaces, SmoothParams{window});
  const bool told = !shape.confidence.empty();
  const float ofAlike = shareOf(masks.size(), worth);
  const float ofGrazing = shareOf(masks.size(), worthGrazing);
  parallelRows(surfaces.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < surfaces.width; ++x) {
        if (!wanted(x, y) || surfaces(x, y) == 0) continue;
        float& visibility = shape.visibility(x, y);
        // Most of the margin: both agree, and nothing is in doubt.
        const bool sure = !told || shape.confidence(x, y) == 1.0f;
        if (sure && back.visibility(x, y) == visibility) continue;
        const float borneOut = weightOf(doubt(x, y), around(x, y));
        if (borneOut == 0.0f) continue;
        const float grazing =
            (faces - facing(map, position(x, y), normal(x, y))) / (faces - grazes);
        const float alike = 1 - std::fabs(back.visibility(x, y) - visibility) / apart;
        const float byMasks =
            std::max(ofGrazing * std::clamp(grazing, 0.0f, 1.0f), ofAlike * std::max(alike, 0.0f));
        const float weight = borneOut * (1 - byMasks);
        const bool umbra = visibility == 0.0f && shape.unsure(x, y) == 0;
        const float brightest = umbra ? mostInUmbra : 1.0f;
        visibility += weight * (std::min(back.visibility(x, y), brightest) - visibility);
        if (told) shape.confidence(x, y) += weight * (1 - shape.confidence(x, y));
      }
  });
}

}  // namespace kagefude
