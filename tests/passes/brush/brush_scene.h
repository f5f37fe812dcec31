#pragma once

#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "passes/brush/brush_map.h"
#include "passes/strip/stroke_noise.h"

// Small scenes for the brush pass's tests.
namespace kagefude::test {

struct BrushScene {
  Vec3Plane position, normal;
  Floats tone;
  Plane<uint16_t> index;

  BrushScene(int width, int height)
      : position(width, height),
        normal(width, height),
        tone(width, height, 0.5f),
        index(width, height, uint16_t{1}) {}
  BrushResult paint(std::span<const BrushAnchor> anchors, std::span<const Strip> strips,
                    const BrushParams& params) const {
    return applyBrush(position, normal, tone, index, anchors, strips, params);
  }
};

/// The plane z = 0 seen from above, `halfSize` world units to each side, +Y up.
inline BrushScene ground(int side, float halfSize) {
  BrushScene scene(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const float perPixel = 2.0f * halfSize / static_cast<float>(side);
      scene.position.set(x, y,
                         {(static_cast<float>(x) + 0.5f) * perPixel - halfSize,
                          halfSize - (static_cast<float>(y) + 0.5f) * perPixel, 0});
      scene.normal.set(x, y, {0, 0, 1});
    }
  return scene;
}

/// Random tones on a bumpy ground with two anchors and some background.
inline BrushScene randomScene(int width, int height, uint32_t seed) {
  BrushScene scene(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float fx = static_cast<float>(x), fy = static_cast<float>(y);
      scene.position.set(x, y,
                         {0.021f * fx + 0.01f * strokeNoise(seed, fx * 0.7f, fy * 0.7f),
                          0.013f * fy + 0.01f * strokeNoise(seed + 1, fx * 0.6f, fy * 0.6f),
                          strokeNoise(seed + 2, fx * 0.05f, fy * 0.05f)});
      scene.normal.set(x, y,
                       {strokeNoise(seed + 3, fx * 0.1f, fy * 0.1f) - 0.5f,
                        strokeNoise(seed + 4, fx * 0.1f, fy * 0.1f) - 0.5f, 1});
      scene.tone(x, y) = strokeNoise(seed + 5, fx * 0.13f, fy * 0.11f);
      const float place = strokeNoise(seed + 6, fx * 0.09f, fy * 0.09f);
      scene.index(x, y) = place < 0.25f ? uint16_t{0} : place < 0.6f ? uint16_t{1} : uint16_t{2};
    }
  return scene;
}

/// A strip whose colour depends on u alone: 0.5 + 0.25 cos 2πu in red, sin in green.
inline Strip waveStrip(int width, int height) {
  Floats r(width, height), g(width, height), b(width, height, 0.5f);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double t = 2 * M_PI * (x + 0.5) / width;
      r(x, y) = static_cast<float>(0.5 + 0.25 * std::cos(t));
      g(x, y) = static_cast<float>(0.5 + 0.25 * std::sin(t));
    }
  return makeStrip(r, g, b);
}

/// White noise of mean 0.5.
inline Strip noiseStrip(int width, int height) {
  Floats values(width, height);
  StrokeNoise noise(3, 4);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) values(x, y) = noise.next();
  return makeStrip(values, values, values);
}

/// One reference point at the origin, light straight above, l1 = X, l2 = -Y.
inline BrushAnchor straightAnchor(float mappingDistance) {
  BrushAnchor anchor;
  anchor.mappingDistance = mappingDistance;
  anchor.points.push_back({{0, 0, 0}, turningFrame({0, 0, -1}, {}), 0});
  return anchor;
}

inline BrushParams mappingOf(BrushParams::Mapping mapping) {
  BrushParams params;
  params.mapping = mapping;
  return params;
}

inline constexpr BrushParams::Mapping everyMapping[] = {
    BrushParams::Mapping::held, BrushParams::Mapping::polar, BrushParams::Mapping::seed};

inline bool sameBits(const Floats& a, const Floats& b) {
  return std::memcmp(a.row(0), b.row(0), a.view().pixels() * sizeof(float)) == 0;
}

inline std::vector<Strip> oneStrip(Strip strip) {
  std::vector<Strip> strips;
  strips.push_back(std::move(strip));
  return strips;
}

}  // namespace kagefude::test
