#pragma once

#include <algorithm>
#include <cmath>

#include "passes/brush/brush_scene.h"

// Scenes whose surfaces deform, for the brush pass's tests.
namespace kagefude::test {

/// A scene with places at rest.
struct RestScene {
  BrushScene seen;
  Vec3Plane rest;

  RestScene(int width, int height) : seen(width, height), rest(width, height) {}
  BrushResult paint(std::span<const BrushAnchor> anchors, std::span<const Strip> strips,
                    const BrushParams& params) const {
    BrushResult result;
    applyBrush(seen.position, seen.normal, seen.tone, seen.index, anchors, strips, params, result,
               false, rest);
    return result;
  }
};

/// A sheet at rest in the plane z = 0, seen with `halfSize` world units to each side, and bent by
/// `deform`, whose normals come from the deformation's own slopes.
template <class Deform>
RestScene sheet(int side, float halfSize, const Deform& deform) {
  RestScene scene(side, side);
  const BrushScene flat = ground(side, halfSize);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const V3f p = flat.position.view()(x, y);
      const float step = 0.01f;
      const V3f across = deform(p + V3f(step, 0, 0)) - deform(p - V3f(step, 0, 0));
      const V3f down = deform(p + V3f(0, step, 0)) - deform(p - V3f(0, step, 0));
      scene.rest.set(x, y, p);
      scene.seen.position.set(x, y, deform(p));
      scene.seen.normal.set(x, y, across.cross(down).normalized());
    }
  return scene;
}

inline BrushAnchor restAnchor(float mappingDistance) {
  BrushAnchor anchor = straightAnchor(mappingDistance);
  anchor.atRest = true;
  // Far away, so that the strokes run along X wherever the sheet bends to.
  anchor.points[0].position = {0, 1e4f, 0};
  return anchor;
}

inline double largestDifference(const Floats& a, const Floats& b) {
  double largest = 0;
  for (int y = 1; y + 1 < a.height(); ++y)
    for (int x = 1; x + 1 < a.width(); ++x)
      largest = std::max(largest, std::fabs(double(a(x, y)) - double(b(x, y))));
  return largest;
}

inline double meanDifference(const Floats& a, const Floats& b) {
  double sum = 0;
  for (size_t i = 0; i < a.view().pixels(); ++i)
    sum += std::fabs(double(a.row(0)[i]) - double(b.row(0)[i]));
  return sum / static_cast<double>(a.view().pixels());
}

}  // namespace kagefude::test
