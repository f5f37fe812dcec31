#include "passes/edges/outline.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>

#include "passes/strip/stroke_noise.h"

namespace kagefude {
namespace {

struct OutlineScene {
  Labels ids;
  Vec3Plane normal, position;
  Floats depth;

  OutlineScene(int width, int height)
      : ids(width, height, 1u),
        normal(width, height),
        position(width, height),
        depth(width, height, 5.0f) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        normal.set(x, y, {0, 0, 1});
        position.set(x, y, {0.01f * static_cast<float>(x), 0.01f * static_cast<float>(y), 0});
      }
  }
  OutlineResult draw(const OutlineParams& params = {}) const {
    return drawOutlines(ids, normal, position, depth, params);
  }
};

float total(const Floats& plane) {
  double sum = 0;
  for (int y = 0; y < plane.height(); ++y)
    for (int x = 0; x < plane.width(); ++x) sum += plane(x, y);
  return static_cast<float>(sum);
}

TEST(Outline, StraightEdgeHasTheAskedWidth) {
  OutlineScene scene(40, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 20; x < 40; ++x) scene.ids(x, y) = 2;
  for (const float width : {0.5f, 1.0f, 2.0f, 5.0f}) {
    OutlineParams params;
    params.width = width;
    EXPECT_NEAR(total(scene.draw(params).coverage) / 40, width, 0.08f) << width;
  }
}

TEST(Outline, ALipHitNowAndThenAddsNoDashesToTheLineBesideIt) {
  // Below row 10 another thing stands before the first; its upper rim, one pixel high, faces up,
  // but pixels' centres hit it in three columns of six only. Or in rows 10 and 11.
  OutlineScene plain(60, 40);
  for (int y = 10; y < 40; ++y)
    for (int x = 0; x < 60; ++x) plain.ids(x, y) = 2;
  const OutlineResult wanted = plain.draw();
  for (const int high : {1, 2}) {
    OutlineScene scene(60, 40);
    for (int y = 10; y < 40; ++y)
      for (int x = 0; x < 60; ++x) {
        scene.ids(x, y) = 2;
        if (y < 10 + high && x % 6 < 3) scene.normal.set(x, y, {0, 1, 0});
      }
    const OutlineResult result = scene.draw();
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 60; ++x)
        ASSERT_EQ(result.coverage(x, y), wanted.coverage(x, y)) << high << ": " << x << " " << y;
  }
  // What is wider has its own line, and so has a rim where lines between objects are not drawn.
  OutlineScene wide(60, 40), alone(60, 40);
  for (int y = 10; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      wide.ids(x, y) = alone.ids(x, y) = 2;
      if (y < 16) wide.normal.set(x, y, {0, 1, 0});
      if (y < 12) alone.normal.set(x, y, {0, 1, 0});
    }
  EXPECT_GT(wide.draw().coverage(30, 15), 0.7f);
  OutlineParams inside;
  inside.objects = false;
  EXPECT_GT(alone.draw(inside).coverage(30, 11), 0.7f);
}

TEST(Outline, LineLiesOnTheBorderBetweenThePixels) {
  OutlineScene scene(40, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 20; x < 40; ++x) scene.ids(x, y) = 2;
  const OutlineResult result = scene.draw();
  EXPECT_NEAR(result.coverage(19, 20), result.coverage(20, 20), 1e-4);
  EXPECT_EQ(result.coverage(16, 20), 0.0f);
  EXPECT_EQ(result.coverage(23, 20), 0.0f);
}

TEST(Outline, SlantingEdgeIsSmooth) {
  // A step every four pixels: the line's darkness along it may hardly waver.
  OutlineScene scene(120, 60);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 120; ++x)
      scene.ids(x, y) = static_cast<float>(y) > 15 + 0.25f * static_cast<float>(x) ? 2 : 1;
  const OutlineResult result = scene.draw();
  float least = 99, most = 0;
  for (int x = 20; x < 100; ++x) {
    float column = 0;
    for (int y = 0; y < 60; ++y) column += result.coverage(x, y);
    least = std::min(least, column);
    most = std::max(most, column);
  }
  // The pieces of the two sides do not coincide quite: slanting lines are a little wider.
  EXPECT_NEAR(0.5f * (least + most), 1.5f * std::sqrt(1.0625f), 0.2f);
  EXPECT_LT(most - least, 0.35f);
}

TEST(Outline, CreaseAndStepInsideAnObject) {
  OutlineScene crease(40, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 20; x < 40; ++x) crease.normal.set(x, y, {0.9f, 0, 0.436f});
  EXPECT_GT(total(crease.draw().coverage), 40.0f);
  OutlineParams noCrease;
  noCrease.creaseAngle = 180;
  EXPECT_EQ(total(crease.draw(noCrease).coverage), 0.0f);

  OutlineScene step(40, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 20; x < 40; ++x)
      step.position.set(x, y, {0.01f * static_cast<float>(x), 0.01f * static_cast<float>(y), 1});
  EXPECT_GT(total(step.draw().coverage), 40.0f);
  OutlineParams noStep;
  noStep.depthStep = 0;
  EXPECT_EQ(total(step.draw(noStep).coverage), 0.0f);
}

TEST(Outline, SteepPlaneIsNoStep) {
  OutlineScene plane(40, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      plane.normal.set(x, y, {-0.995f, 0, 0.0995f});
      plane.position.set(x, y, {0.1f * static_cast<float>(x), 0, static_cast<float>(x)});
    }
  EXPECT_EQ(total(plane.draw().coverage), 0.0f);
}

TEST(Outline, NearestSurfaceOwnsTheLine) {
  OutlineScene scene(40, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      scene.ids(x, y) = x < 20 ? 7 : 3;
      scene.depth(x, y) = x < 20 ? 2.0f : 9.0f;
    }
  const OutlineResult result = scene.draw();
  EXPECT_EQ(result.owner(19, 20), 7u);
  EXPECT_EQ(result.owner(20, 20), 7u);
  EXPECT_EQ(result.owner(5, 20), 0u);
}

TEST(Outline, NoEdgesOnAnEmptyOrUniformPicture) {
  EXPECT_EQ(total(OutlineScene(16, 16).draw().coverage), 0.0f);
  OutlineScene background(16, 16);
  background.ids.fill(0);
  EXPECT_EQ(total(background.draw().coverage), 0.0f);
}

TEST(Outline, ThreadsDoNotMatter) {
  OutlineScene scene(120, 90);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x)
      scene.ids(x, y) = static_cast<uint32_t>(
          4 * strokeNoise(2, static_cast<float>(x) * 0.1f, static_cast<float>(y) * 0.1f));
  OutlineParams params;
  params.width = 9;
  OutlineResult one, many;
  {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    one = scene.draw(params);
  }
  {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 7);
    many = scene.draw(params);
  }
  EXPECT_EQ(std::memcmp(one.coverage.row(0), many.coverage.row(0), 120 * 90 * 4), 0);
  EXPECT_EQ(std::memcmp(one.owner.row(0), many.owner.row(0), 120 * 90 * 4), 0);
}

}  // namespace
}  // namespace kagefude
