// What must not change the brush's picture: rows or single pixels, threads, mirroring.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>

#include "passes/brush/brush_map.h"
#include "passes/brush/brush_pixel.h"
#include "passes/brush/brush_scene.h"

namespace kagefude {
namespace {

using test::BrushScene;
using test::everyMapping;
using test::mappingOf;
using test::oneStrip;
using test::sameBits;

void rowsEqualThePlainPass(BrushParams::Mapping mapping, BrushParams::Grain grain, float bound) {
  const auto strips = oneStrip(test::noiseStrip(96, 80));
  for (uint32_t seed = 0; seed < 6; ++seed) {
    const BrushScene scene = test::randomScene(301, 45, 10 * seed);
    BrushAnchor anchors[] = {test::straightAnchor(0.2f), test::straightAnchor(0.02f)};
    anchors[0].coarser = seed % 2 == 0 ? 0.0f : 0.3f;
    anchors[1].points[0].frame.axis = V3f(0.6f, 0.0f, -0.8f);
    if (seed == 5) {  // several reference points
      anchors[0].points.push_back(anchors[0].points[0]);
      anchors[0].points[0].along = 1;
      anchors[0].points[1].along = 3;
      anchors[0].points[1].frame.axis = V3f(0.0f, 0.6f, -0.8f);
    }
    BrushParams params;
    params.mapping = mapping;
    params.grain = grain;
    if (seed == 1) params.poleFade = 0.0f;
    if (seed == 2) params.blendWidth = 0.0f;
    params.contrast = seed % 3 == 0 ? 1.0f : 1.7f;
    params.crossFade =
        seed % 4 == 3 ? BrushParams::CrossFade::linear : BrushParams::CrossFade::variance;
    const Vec3View normal = seed == 4 ? Vec3View{} : scene.normal.view();
    const BrushResult fast =
        applyBrush(scene.position, normal, scene.tone, scene.index, anchors, strips, params);
    const BrushInput in{scene.position, normal, scene.tone, scene.index, anchors, strips, params};
    for (int y = 0; y < 45; ++y)
      for (int x = 0; x < 301; ++x) {
        if (scene.index(x, y) == 0) continue;
        const Rgba plain =
            brushColourAt(in, anchors[scene.index(x, y) - 1], x, y, in.position(x, y));
        ASSERT_NEAR(fast.r(x, y), plain[0], bound) << seed << ": " << x << "," << y;
        ASSERT_NEAR(fast.a(x, y), plain[3], bound);
      }
  }
}

// The same sums in another order: a few roundings of numbers near 1; with object grain of places up
// to 50 turns away, times the slope of the colours
// over the grain; with polar strokes of up to 100 repeats round the axis.
TEST(BrushMap, RowsEqualThePlainPass) {
  rowsEqualThePlainPass(BrushParams::Mapping::held, BrushParams::Grain::tone, 2e-6f);
  rowsEqualThePlainPass(BrushParams::Mapping::held, BrushParams::Grain::object, 5e-5f);
  rowsEqualThePlainPass(BrushParams::Mapping::polar, BrushParams::Grain::tone, 5e-5f);
}

TEST(BrushMap, SeedRowsAreThePlainPassToTheBit) {
  const auto strips = oneStrip(test::noiseStrip(96, 80));
  BrushScene scene = test::randomScene(301, 45, 7);
  scene.position.set(100, 3, {std::numeric_limits<float>::quiet_NaN(), 0, 0});
  scene.tone(90, 3) = std::numeric_limits<float>::quiet_NaN();
  const BrushAnchor anchors[] = {test::straightAnchor(0.2f), test::straightAnchor(0.02f)};
  for (const float blendWidth : {0.0f, 0.3f, 1.0f}) {
    BrushParams params = mappingOf(BrushParams::Mapping::seed);
    params.blendWidth = blendWidth;
    const BrushResult fast = scene.paint(anchors, strips, params);
    const BrushInput in{scene.position, scene.normal, scene.tone, scene.index,
                        anchors,        strips,       params};
    for (int y = 0; y < 45; ++y)
      for (int x = 0; x < 301; ++x) {
        const V3f p = in.position(x, y);
        if (scene.index(x, y) == 0 || !isFinite(p)) continue;
        const Rgba plain = brushColourAt(in, anchors[scene.index(x, y) - 1], x, y, p);
        ASSERT_EQ(fast.r(x, y), plain[0]) << x << "," << y;
        ASSERT_EQ(fast.a(x, y), plain[3]);
      }
  }
}

TEST(BrushMap, ThreadsDoNotMatter) {
  const BrushScene scene = test::randomScene(83, 71, 3);
  const auto strips = oneStrip(test::noiseStrip(96, 80));
  const BrushAnchor anchors[] = {test::straightAnchor(0.2f), test::straightAnchor(0.07f)};
  for (const auto mapping : everyMapping) {
    BrushResult one, many;
    {
      tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
      one = scene.paint(anchors, strips, mappingOf(mapping));
    }
    {
      tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 7);
      many = scene.paint(anchors, strips, mappingOf(mapping));
    }
    EXPECT_TRUE(sameBits(one.r, many.r) && sameBits(one.a, many.a));
  }
}

BrushScene mirrored(const BrushScene& scene) {
  const int width = scene.tone.width();
  BrushScene result(width, scene.tone.height());
  for (int y = 0; y < scene.tone.height(); ++y)
    for (int x = 0; x < width; ++x) {
      result.position.set(x, y, Vec3View(scene.position)(width - 1 - x, y));
      result.normal.set(x, y, Vec3View(scene.normal)(width - 1 - x, y));
      result.tone(x, y) = scene.tone(width - 1 - x, y);
      result.index(x, y) = scene.index(width - 1 - x, y);
    }
  return result;
}

TEST(BrushMap, MirroredInputGivesTheMirroredPicture) {
  const BrushScene scene = test::randomScene(64, 40, 8);
  const BrushScene other = mirrored(scene);
  const auto strips = oneStrip(test::noiseStrip(64, 64));
  const BrushAnchor anchors[] = {test::straightAnchor(0.2f), test::straightAnchor(0.07f)};
  for (const auto mapping : everyMapping) {
    const BrushResult a = scene.paint(anchors, strips, mappingOf(mapping));
    const BrushResult b = other.paint(anchors, strips, mappingOf(mapping));
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 64; ++x) ASSERT_EQ(a.r(x, y), b.r(63 - x, y)) << x << "," << y;
  }
}

}  // namespace
}  // namespace kagefude
