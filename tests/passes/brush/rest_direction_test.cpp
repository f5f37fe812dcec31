// Which way strokes run on surfaces that deform.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "passes/brush/brush_map.h"
#include "passes/brush/brush_pixel.h"
#include "passes/brush/rest_scene.h"

namespace kagefude {
namespace {

using test::largestDifference;
using test::meanDifference;
using test::oneStrip;
using test::RestScene;
using test::sheet;

constexpr BrushParams::Grain everyGrain[] = {BrushParams::Grain::object, BrushParams::Grain::tone};

/// Strokes in squares round a slanted axis that passes through the sheet.
BrushAnchor slantedAnchor() {
  BrushAnchor anchor = test::straightAnchor(0.25f);
  anchor.atRest = true;
  anchor.object = {{0.2f, -0.1f, 0.3f}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  anchor.points[0].position = {0.3f, -0.2f, 0.1f};
  anchor.points[0].frame.axis = {0.48f, 0.6f, -0.64f};
  return anchor;
}

V3f bent(const V3f& p) { return {2 * std::sin(0.8f * p.x), p.y, 2 - 2 * std::cos(0.8f * p.x)}; }
V3f twisted(const V3f& p) {
  return {p.x, p.y * std::cos(0.9f * p.x), 0.3f + p.y * std::sin(0.9f * p.x)};
}
V3f scaled(const V3f& p) { return {1.8f * p.x, 0.6f * p.y, 0.1f}; }
V3f keyed(const V3f& p) {
  const float bump = 0.2f * std::exp(-4 * (p.x * p.x + p.y * p.y));
  return {p.x + 0.5f * bump, p.y - bump, 1.5f * bump};
}

// Held to the deformed surface's own direction, strokes of the same skin run another way where it
// bends towards the light.
TEST(RestDirection, IsTheSameHoweverTheSkinDeforms) {
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  const BrushAnchor anchor = slantedAnchor();
  const RestScene still = sheet(96, 1.0f, [](const V3f& p) { return p; });
  for (const auto deform : {bent, twisted, scaled, keyed})
    for (const auto grain : everyGrain) {
      BrushParams params;
      params.grain = grain;
      const BrushResult a = still.paint(std::span(&anchor, 1), strips, params);
      const BrushResult b = sheet(96, 1.0f, deform).paint(std::span(&anchor, 1), strips, params);
      EXPECT_LT(meanDifference(a.r, b.r), 2e-3);
    }
}

using Matrix = std::array<std::array<double, 3>, 3>;

double determinant(const Matrix& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

V3d solved(const Matrix& m, const V3d& right) {
  V3d result(0.0);
  for (size_t column = 0; column < 3; ++column) {
    Matrix replaced = m;
    for (size_t row = 0; row < 3; ++row) replaced[row][column] = right[static_cast<int>(row)];
    result[static_cast<int>(column)] = determinant(replaced) / determinant(m);
  }
  return result;
}

V3d unit(const V3d& v) { return v / std::sqrt(v.dot(v)); }

// A normal as a sum of the seen pair of changes and its unit normal; the same sum at rest.
V3f carried(const RestScene& scene, int x, int y) {
  const auto change = [&](const Vec3Plane& plane, int dx, int dy) {
    return V3d(plane.view()(x + dx, y + dy)) - V3d(plane.view()(x, y));
  };
  const V3d d = change(scene.seen.position, 1, 0), e = change(scene.seen.position, 0, 1);
  const V3d p = change(scene.rest, 1, 0), q = change(scene.rest, 0, 1);
  const V3d m = unit(d.cross(e)), r = unit(p.cross(q));
  const V3d share = solved({{{d.x, e.x, m.x}, {d.y, e.y, m.y}, {d.z, e.z, m.z}}},
                           V3d(scene.seen.normal.view()(x, y)));
  return V3f(unit(p * share.x + q * share.y + r * share.z));
}

/// A row of one sheet whose neighbour behind is always the nearer one, with slanted normals.
RestScene crowded() {
  RestScene scene(24, 24);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x) {
      const float u = 1.0f - std::exp(-0.04f * static_cast<float>(x)),
                  v = 1.0f - std::exp(-0.04f * static_cast<float>(y));
      scene.rest.set(x, y, {1.3f * u, -v, 0.4f * u * v});
      scene.seen.position.set(x, y, {u + 0.3f * v, 0.5f * u - 1.2f * v, 0.6f * std::sin(2 * u)});
      scene.seen.normal.set(x, y, V3f(u - 0.4f, 0.5f * v, 0.8f).normalized());
    }
  return scene;
}

// The oracle: the same strokes as on a rigid thing that is what the skin is at rest, with the
// normals carried there, under the light's axis turned as the object is.
TEST(RestDirection, IsThatOfARigidThingWithTheCarriedNormals) {
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  const RestScene skin = crowded();
  RestScene rigid = crowded();
  const BrushAnchor anchor = slantedAnchor();
  BrushAnchor still = anchor;
  still.atRest = false;
  still.object = {};
  const auto turned = [&](const V3f& d) {
    return V3f(d.dot(anchor.object.x), d.dot(anchor.object.y), d.dot(anchor.object.z));
  };
  still.points[0].position = turned(anchor.points[0].position - anchor.object.origin);
  still.points[0].frame.axis = turned(anchor.points[0].frame.axis);
  for (int y = 0; y < 23; ++y)
    for (int x = 0; x < 23; ++x) {
      rigid.seen.position.set(x, y, skin.rest.view()(x, y));
      rigid.seen.normal.set(x, y, carried(skin, x, y));
    }
  for (const auto grain : everyGrain)
    for (const auto filter : {BrushParams::Filter::bilinear, BrushParams::Filter::anisotropic}) {
      BrushParams params;
      params.grain = grain;
      params.filter = filter;
      params.maxProbes = 1;
      const BrushResult a = skin.paint(std::span(&anchor, 1), strips, params);
      const BrushResult b = rigid.seen.paint(std::span(&still, 1), strips, params);
      for (int y = 0; y < 22; ++y)
        for (int x = 0; x < 22; ++x) ASSERT_NEAR(a.r(x, y), b.r(x, y), 1e-3f) << x << "," << y;
    }
}

// Instances far off by whole steps run as the first does.
TEST(RestDirection, IsTheSameOnInstances) {
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  BrushAnchor anchor = slantedAnchor();
  const float period = 2 * pi * anchor.mappingDistance;
  anchor.instanceStep = 4 * period;  // whole periods: the same strokes
  RestScene scene = sheet(96, 1.0f, bent), other = sheet(96, 1.0f, bent);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x)
      other.rest.set(x, y, scene.rest.view()(x, y) + V3f(2, 9, 13) * anchor.instanceStep);
  for (const auto grain : everyGrain) {
    BrushParams params;
    params.grain = grain;
    const BrushResult a = scene.paint(std::span(&anchor, 1), strips, params);
    const BrushResult b = other.paint(std::span(&anchor, 1), strips, params);
    EXPECT_LT(meanDifference(a.r, b.r), 2e-3);
  }
}

// UVs need not lie as the object does: strokes run on the surface as they do without them.
TEST(RestDirection, OfTurnedPlacesIsThatOfTheSurface) {
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  BrushAnchor anchor = slantedAnchor();
  anchor.object = {};
  RestScene scene = sheet(96, 1.0f, [](const V3f& p) { return p; });
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      const V3f p = scene.rest.view()(x, y);
      scene.rest.set(x, y, V3f(-p.y, p.x, p.z));
    }
  BrushAnchor turned = anchor;
  turned.atRest = false;
  turned.object = {{0, 0, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
  anchor.placesTurned = true;
  for (const auto grain : everyGrain) {
    BrushParams params;
    params.grain = grain;
    const BrushResult a = scene.paint(std::span(&anchor, 1), strips, params);
    const BrushResult b = scene.paint(std::span(&turned, 1), strips, params);
    EXPECT_LT(largestDifference(a.r, b.r), 1e-3);
  }
}

// Without normals the surface faces where its places do.
TEST(RestDirection, WithoutNormalsGoesByThePlaces) {
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  const BrushAnchor anchor = slantedAnchor();
  const auto painted = [&](const RestScene& scene) {
    BrushResult result;
    applyBrush(scene.seen.position, {}, scene.seen.tone, scene.seen.index, std::span(&anchor, 1),
               strips, {}, result, false, scene.rest);
    return result;
  };
  const BrushResult a = painted(sheet(96, 1.0f, [](const V3f& p) { return p; }));
  EXPECT_LT(largestDifference(a.r, painted(sheet(96, 1.0f, bent)).r), 2e-3);
}

}  // namespace
}  // namespace kagefude
