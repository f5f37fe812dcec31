#include "passes/light_shape/horizon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "passes/light_shape/disc_places.h"
#include "passes/light_shape/light_shape.h"
#include "passes/light_shape/light_share.h"

namespace kagefude {
namespace {

/// One pixel at the origin whose normal leans by `angle` from +z, and masks of a light that faces
/// it from +x at a distance of 10, of radius 1: seen where they stand above the horizon.
struct Terminator {
  Vec3Plane position{1, 1}, normal{1, 1};
  Labels labels{1, 1, 1u};
  std::vector<V2f> places = discPlaces(9);
  std::vector<Bytes> masks;
  LightGeometry geometry;

  explicit Terminator(double angle) {
    position.set(0, 0, {0, 0, 0});
    normal.set(0, 0, {static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))});
    geometry.position = V3f(10, 0, 0);
    geometry.u = V3f(0, 1, 0);
    geometry.v = V3f(0, 0, 1);
    seeByHorizon();
  }
  float height(const V2f& place) const {
    return normal.view()(0, 0).dot(geometry.position + geometry.u * place.x + geometry.v * place.y);
  }
  void seeByHorizon() {
    masks.clear();
    for (const V2f& place : places) masks.emplace_back(1, 1, height(place) > 0);
  }
  std::vector<View<const uint8_t>> views() const { return {masks.begin(), masks.end()}; }
  float visibility() const {
    return lightShapeVisibility(views(), places, labels, position, normal, geometry, {})
        .visibility(0, 0);
  }
};

/// Share of a sphere's outline, seen from the origin, above the plane through it, by counting.
double sphereShare(const V3f& n, const V3f& centre, double radius) {
  const V3f towards = centre.normalized();
  const V3f u = V3f(0, 1, 0), v = towards.cross(u);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(-1, 1);
  int above = 0, all = 0;
  while (all < 200000) {
    const double x = along(random), y = along(random);
    if (x * x + y * y > 1) continue;
    ++all;
    above +=
        n.dot(centre + u * static_cast<float>(radius * x) + v * static_cast<float>(radius * y)) > 0;
  }
  return static_cast<double>(above) / all;
}

TEST(Horizon, ShareAboveItIsTheDiscs) {
  for (const double angle : {-0.06, -0.02, 0.0, 0.03, 0.07}) {
    const Terminator t(angle);
    EXPECT_NEAR(t.visibility(), sphereShare(t.normal.view()(0, 0), t.geometry.position, 1), 0.01)
        << angle;
  }
}

TEST(Horizon, SphereTurnsItsDiscToEveryReceiver) {
  // The masks' disc faces elsewhere, so it stands only half as high over this receiver; a sphere
  // shows a full disc from every side.
  for (const double angle : {-0.02, 0.0, 0.03}) {
    Terminator t(angle);
    t.geometry.u = V3f(0.8660254f, 0, 0.5f);
    t.geometry.v = V3f(0, 1, 0);
    t.seeByHorizon();
    const V3f n = t.normal.view()(0, 0);
    t.geometry.sphere = false;
    const float flat = t.visibility();
    t.geometry.sphere = true;
    const float round = t.visibility();
    const double exact = sphereShare(n, t.geometry.position, 1);
    EXPECT_NEAR(round, exact, 0.01) << angle;
    if (angle != 0) {
      EXPECT_GT(std::fabs(flat - exact), 0.05) << angle;
    }
  }
}

TEST(Horizon, MasksThatSayOtherwiseAreNotExplained) {
  Terminator t(0.03);
  const Horizon horizon(t.geometry, t.places, t.position, t.normal);
  float height[9];
  EXPECT_TRUE(horizon.explains(t.views(), 0, 0, height));
  t.masks[0](0, 0) ^= 1;
  EXPECT_FALSE(horizon.explains(t.views(), 0, 0, height));
  const Terminator high(0.5);
  const Horizon above(high.geometry, high.places, high.position, high.normal);
  EXPECT_FALSE(above.explains(high.views(), 0, 0, height)) << "all seen: the horizon hides nothing";
}

// A place's light travels along direction - (u, v) · place, as the exporter writes it.
TEST(Horizon, OfASunGoesByItsDirection) {
  Terminator t(0.03);
  t.geometry.sun = true;
  t.geometry.direction = V3f(-1, 0, 0);
  t.geometry.u = V3f(0, 0.1f, 0);
  t.geometry.v = V3f(0, 0, 0.1f);
  const V3f n = t.normal.view()(0, 0);
  t.masks.clear();
  for (const V2f& p : t.places)
    t.masks.emplace_back(
        1, 1, n.dot(-t.geometry.direction + t.geometry.u * p.x + t.geometry.v * p.y) > 0);
  const double d = n.x / (0.1 * n.z);
  EXPECT_NEAR(t.visibility(), 0.5 + (d * std::sqrt(1 - d * d) + std::asin(d)) / M_PI, 1e-3);
}

struct PairAtHorizon {
  Terminator t;
  PairLight light{V3f(10, 0, 0), V3f(0, 0, 0.5f), 1.0f};
  Bytes farMask{1, 1, uint8_t{0}}, nearMask{1, 1, uint8_t{0}};
  Floats visibility{1, 1, -1.0f};

  explicit PairAtHorizon(double angle) : t(angle) {
    const V3f n = t.normal.view()(0, 0);
    farMask(0, 0) = n.dot(light.position + light.towardsFar) > 0;
    nearMask(0, 0) = n.dot(light.position - light.towardsFar) > 0;
  }
  float settled() {
    settleAtHorizon(farMask, nearMask, t.labels, t.position, t.normal, light, visibility);
    return visibility(0, 0);
  }
};

TEST(Horizon, PairTakesTheShareOfTheLightAboveIt) {
  for (const double angle : {-0.04, 0.0, 0.02}) {
    PairAtHorizon pair(angle);
    EXPECT_NEAR(pair.settled(), sphereShare(pair.t.normal.view()(0, 0), {10, 0, 0}, 1), 0.01);
  }
}

TEST(Horizon, PairIsLeftAloneWhereTheHorizonDoesNotPartIt) {
  PairAtHorizon agree(0.2);
  EXPECT_EQ(agree.settled(), -1.0f) << "both see the light";
  PairAtHorizon other(0.02);
  std::swap(other.farMask, other.nearMask);
  EXPECT_EQ(other.settled(), -1.0f) << "a blocker parts them";
  PairAtHorizon hard(0.02);
  hard.light.radius = 0;
  EXPECT_EQ(hard.settled(), -1.0f) << "a light without size";
  PairAtHorizon background(0.02);
  background.t.labels(0, 0) = 0;
  EXPECT_EQ(background.settled(), -1.0f);
}

TEST(Horizon, PairRefusesPassesOfOtherSizes) {
  PairAtHorizon pair(0.0);
  pair.t.normal = Vec3Plane(2, 1);
  EXPECT_THROW(pair.settled(), InputError);
}

}  // namespace
}  // namespace kagefude
