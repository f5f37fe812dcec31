// Strokes held to surfaces that deform, by places at rest.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "passes/brush/brush_map.h"
#include "passes/brush/brush_pixel.h"
#include "passes/brush/rest_scene.h"

namespace kagefude {
namespace {

using test::BrushScene;
using test::everyMapping;
using test::largestDifference;
using test::mappingOf;
using test::meanDifference;
using test::oneStrip;
using test::restAnchor;
using test::RestScene;
using test::sameBits;
using test::sheet;

// The sheet as it rests, and the same sheet deformed: the same picture, for every pixel shows the
// same point of the skin.
template <class Deform>
void expectSameStrokes(const Deform& deform, double worst) {
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  const BrushAnchor anchor = restAnchor(0.25f);
  const RestScene still = sheet(96, 1.0f, [](const V3f& p) { return p; });
  const RestScene bent = sheet(96, 1.0f, deform);
  for (const auto grain : {BrushParams::Grain::object, BrushParams::Grain::tone}) {
    BrushParams params;
    params.grain = grain;
    const BrushResult a = still.paint(std::span(&anchor, 1), strips, params);
    const BrushResult b = bent.paint(std::span(&anchor, 1), strips, params);
    EXPECT_LT(largestDifference(a.r, b.r), worst);
    // Along the tone strokes run along X alone, which a twist keeps.
    if (grain == BrushParams::Grain::tone) continue;
    // Held to positions the strokes swim: what is expected above would fail.
    BrushAnchor byPosition = anchor;
    byPosition.atRest = false;
    const BrushResult c = bent.paint(std::span(&byPosition, 1), strips, params);
    EXPECT_GT(meanDifference(a.r, c.r), 0.02);
  }
}

TEST(BrushRest, StrokesStayOnABentSheet) {
  expectSameStrokes(
      [](const V3f& p) { return V3f(2 * std::sin(0.5f * p.x), p.y, 2 - 2 * std::cos(0.5f * p.x)); },
      2e-3);
}

TEST(BrushRest, StrokesStayOnATwistedSheet) {
  expectSameStrokes(
      [](const V3f& p) {
        const float turn = 0.35f * p.x;
        return V3f(p.x, p.y * std::cos(turn), 0.3f + p.y * std::sin(turn));
      },
      2e-3);
}

TEST(BrushRest, StrokesStayOnAScaledSheet) {
  expectSameStrokes([](const V3f& p) { return V3f(1.6f * p.x, 0.7f * p.y, 0.1f); }, 2e-3);
}

TEST(BrushRest, StrokesStayOnAShapeKey) {
  expectSameStrokes(
      [](const V3f& p) {
        const float bump = 0.2f * std::exp(-4 * (p.x * p.x + p.y * p.y));
        return V3f(p.x + 0.5f * bump, p.y - bump, 1.5f * bump);
      },
      2e-2);
}

BrushResult paintSheet(float scale, const BrushAnchor& anchor, const BrushParams& params) {
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  return sheet(96, 1.0f, [&](const V3f& p) { return p * scale; })
      .paint(std::span(&anchor, 1), strips, params);
}

// Twice as large, the skin shows twice the strokes, each of half its size on the skin.
TEST(BrushRest, StrokesThatKeepTheirSizeInTheWorldChangeOctaveWithTheSkin) {
  const BrushAnchor anchor = restAnchor(0.25f);
  for (const auto grain : {BrushParams::Grain::object, BrushParams::Grain::tone}) {
    BrushParams skin, world;
    skin.grain = world.grain = grain;
    world.stretch = BrushParams::Stretch::world;
    BrushAnchor finer = anchor;
    finer.mappingDistance *= 0.5f;
    finer.shift = 1.0f - 0.618034f;
    const BrushResult kept = paintSheet(2.0f, anchor, world);
    EXPECT_LT(largestDifference(kept.r, paintSheet(2.0f, finer, skin).r), 1e-4);
    EXPECT_GT(meanDifference(kept.r, paintSheet(2.0f, anchor, skin).r), 0.02);
    // Within a quarter of an octave nothing changes.
    for (const float scale : {0.87f, 1.0f, 1.15f})
      EXPECT_LT(
          largestDifference(paintSheet(scale, anchor, world).r, paintSheet(scale, anchor, skin).r),
          1e-4)
          << scale;
  }
}

/// A place of the world under a turn about a slanted axis and a move.
struct Rigid {
  V3f x{0.8f, 0.0f, 0.6f}, y{0.36f, 0.8f, -0.48f}, z{-0.48f, 0.6f, 0.64f}, move{3, -2, 1};
  V3f turned(const V3f& v) const { return x * v.x + y * v.y + z * v.z; }
  V3f operator()(const V3f& p) const { return turned(p) + move; }
};

/// The same skin twice: turned and moved, with places at rest, and as it rests.
struct RigidPair {
  std::vector<BrushAnchor> anchors{test::straightAnchor(0.2f), test::straightAnchor(0.09f)};
  RestScene scene{150, 60};

  explicit RigidPair(uint32_t seed) {
    const Rigid rigid;
    scene.seen = test::randomScene(150, 60, seed);
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 150; ++x) {
        scene.rest.set(x, y, scene.seen.position.view()(x, y));
        scene.seen.position.set(x, y, rigid(scene.seen.position.view()(x, y)));
        scene.seen.normal.set(x, y, rigid.turned(scene.seen.normal.view()(x, y)));
      }
    for (BrushAnchor& anchor : anchors) {
      anchor.object = {rigid.move, rigid.x, rigid.y, rigid.z};
      anchor.points[0].position = rigid({1, 0, 3});
      anchor.points[0].frame = turningFrame(rigid.turned({0, 0, -1}), anchor.object);
    }
    anchors[0].coarser = 0.3f;
  }

  /// Differences between strokes at rest and held to the object, in ascending order.
  std::vector<double> differences(const BrushParams& params, const std::vector<Strip>& strips) {
    for (BrushAnchor& anchor : anchors) anchor.atRest = false;
    const BrushResult a = scene.paint(anchors, strips, params);
    for (BrushAnchor& anchor : anchors) anchor.atRest = true;
    const BrushResult b = scene.paint(anchors, strips, params);
    std::vector<double> all;
    for (size_t i = 0; i < a.r.view().pixels(); ++i)
      all.push_back(std::fabs(double(a.r.row(0)[i]) - double(b.r.row(0)[i])));
    std::sort(all.begin(), all.end());
    return all;
  }
};

// At every pixel, those at creases and borders too, within roundings of positions three units out.
// With more than one lookup a pixel their number steps where the footprint's length passes a whole
// number of its widths: there, and there alone, a rounding shows (one pixel of 30,000).
TEST(BrushRest, RigidEqualsTheObjectsOwnSpace) {
  const auto strips = oneStrip(test::noiseStrip(96, 80));
  for (uint32_t seed = 0; seed < 4; ++seed) {
    RigidPair pair(20 * seed);
    for (const auto mapping : everyMapping)
      for (const auto grain : {BrushParams::Grain::object, BrushParams::Grain::tone}) {
        BrushParams params = mappingOf(mapping);
        params.grain = grain;
        // The seed's rings jump.
        const size_t steps = mapping == BrushParams::Mapping::seed ? 20 : 1;
        const std::vector<double> several = pair.differences(params, strips);
        EXPECT_LT(several[several.size() - 1 - steps], 5e-4);
        params.maxProbes = 1;
        const std::vector<double> single = pair.differences(params, strips);
        EXPECT_LT(single[single.size() - (mapping == BrushParams::Mapping::seed ? steps : 1)],
                  5e-4);
      }
  }
}

TEST(BrushRest, RowsEqualThePlainPass) {
  const auto strips = oneStrip(test::noiseStrip(96, 80));
  for (uint32_t seed = 0; seed < 6; ++seed) {
    RestScene scene(301, 45);
    scene.seen = test::randomScene(301, 45, 10 * seed);
    const BrushScene other = test::randomScene(301, 45, 10 * seed + 5);
    for (int y = 0; y < 45; ++y)
      for (int x = 0; x < 301; ++x) {
        const V3f p = scene.seen.position.view()(x, y), q = other.position.view()(x, y);
        scene.rest.set(x, y, p + V3f(0.3f * q.z, 0.2f * p.x, p.y * q.z));
      }
    BrushAnchor anchors[] = {test::straightAnchor(0.2f), test::straightAnchor(0.05f)};
    for (BrushAnchor& anchor : anchors) anchor.atRest = true;
    anchors[0].coarser = seed % 2 == 0 ? 0.0f : 0.3f;
    anchors[1].points[0].frame.axis = V3f(0.6f, 0.0f, -0.8f);
    if (seed == 5) {
      anchors[0].points.push_back(anchors[0].points[0]);
      anchors[0].points[0].along = 1;
      anchors[0].points[1].along = 3;
      anchors[0].points[1].frame.axis = V3f(0.0f, 0.6f, -0.8f);
    }
    using Mapping = BrushParams::Mapping;
    using Grain = BrushParams::Grain;
    for (const auto& [mapping, grain] : {std::pair(Mapping::held, Grain::object),
                                         std::pair(Mapping::held, Grain::tone),
                                         std::pair(Mapping::polar, Grain::tone)}) {
      BrushParams params;
      params.mapping = mapping;
      params.grain = grain;
      const Vec3View normal = seed == 4 ? Vec3View{} : scene.seen.normal.view();
      BrushResult fast;
      applyBrush(scene.seen.position, normal, scene.seen.tone, scene.seen.index, anchors, strips,
                 params, fast, false, scene.rest);
      const BrushInput in{
          scene.seen.position, normal, scene.seen.tone, scene.seen.index, anchors, strips, params,
          scene.rest};
      const float bound = mapping == Mapping::held && grain == Grain::tone ? 4e-6f : 5e-5f;
      for (int y = 0; y < 45; ++y)
        for (int x = 0; x < 301; ++x) {
          if (scene.seen.index(x, y) == 0) continue;
          const Rgba plain =
              brushColourAt(in, anchors[scene.seen.index(x, y) - 1], x, y, in.position(x, y));
          ASSERT_NEAR(fast.r(x, y), plain[0], bound) << seed << ": " << x << "," << y;
        }
    }
  }
}

TEST(BrushRest, ThreadsAndMirroringDoNotMatter) {
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  const BrushAnchor anchor = restAnchor(0.2f);
  const auto twisted = [](const V3f& p) {
    return V3f(p.x, p.y * std::cos(p.x), 0.3f + p.y * std::sin(p.x));
  };
  const RestScene scene = sheet(80, 1.0f, twisted);
  RestScene other(80, 80);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x) {
      other.rest.set(x, y, scene.rest.view()(79 - x, y));
      other.seen.position.set(x, y, scene.seen.position.view()(79 - x, y));
      other.seen.normal.set(x, y, scene.seen.normal.view()(79 - x, y));
    }
  const BrushResult many = scene.paint(std::span(&anchor, 1), strips, {});
  const BrushResult mirrored = other.paint(std::span(&anchor, 1), strips, {});
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x) ASSERT_EQ(many.r(x, y), mirrored.r(79 - x, y)) << x << "," << y;
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(sameBits(scene.paint(std::span(&anchor, 1), strips, {}).r, many.r));
}

// A part of the picture is painted as the whole is, but for its border, whose footprints end there.
TEST(BrushRest, ACropIsPaintedAsTheWhole) {
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  const BrushAnchor anchor = restAnchor(0.2f);
  const RestScene scene =
      sheet(80, 1.0f, [](const V3f& p) { return V3f(p.x, p.y + 0.3f * p.x * p.x, p.x * p.y); });
  RestScene part(40, 50);
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 40; ++x) {
      part.rest.set(x, y, scene.rest.view()(x + 17, y + 9));
      part.seen.position.set(x, y, scene.seen.position.view()(x + 17, y + 9));
      part.seen.normal.set(x, y, scene.seen.normal.view()(x + 17, y + 9));
    }
  const BrushResult whole = scene.paint(std::span(&anchor, 1), strips, {});
  const BrushResult cropped = part.paint(std::span(&anchor, 1), strips, {});
  for (int y = 1; y < 49; ++y)
    for (int x = 1; x < 39; ++x)
      ASSERT_EQ(cropped.r(x, y), whole.r(x + 17, y + 9)) << x << "," << y;
}

TEST(BrushRest, AnAnchorThatIsNotAtRestIsPaintedAsBefore) {
  RestScene scene(64, 40);
  scene.seen = test::randomScene(64, 40, 8);
  for (Floats* plane : {&scene.rest.x, &scene.rest.y, &scene.rest.z})
    *plane = Floats(64, 40, std::numeric_limits<float>::quiet_NaN());
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  const BrushAnchor anchors[] = {test::straightAnchor(0.2f), test::straightAnchor(0.07f)};
  for (const auto mapping : everyMapping) {
    const BrushResult a = scene.paint(anchors, strips, mappingOf(mapping));
    const BrushResult b = scene.seen.paint(anchors, strips, mappingOf(mapping));
    EXPECT_TRUE(sameBits(a.r, b.r) && sameBits(a.a, b.a));
  }
}

}  // namespace
}  // namespace kagefude
