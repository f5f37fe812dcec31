#include "passes/tone/light_reach.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kagefude {
namespace {

Light lightOf(Light::Type type) {
  Light light;
  light.type = type;
  light.position = V3f(0, 0, 5);
  light.direction = V3f(0, 0, -1);
  return light;
}

// As measured in Cycles: 100 W at 5 m, radiance of a white plane times pi.
TEST(LightReach, IrradiancesAreCycles) {
  const V3f below(0, 0, 0);
  const LightPower watts{100, true};
  EXPECT_NEAR(irradianceOnAxis(lightOf(Light::Type::point), watts, below), 0.3183f, 1e-4f);
  EXPECT_NEAR(irradianceOnAxis(lightOf(Light::Type::spot), watts, below), 0.3183f, 1e-4f);
  EXPECT_NEAR(irradianceOnAxis(lightOf(Light::Type::area), watts, below), 1.0f, 1e-6f);
  EXPECT_EQ(irradianceOnAxis(lightOf(Light::Type::sun), {2, true}, below), 2.0f);
  EXPECT_EQ(irradianceOnAxis(lightOf(Light::Type::point), {2, false}, V3f(9, 9, 9)), 2.0f);
}

TEST(LightReach, AtTheLightItIsFinite) {
  for (const Light::Type type : {Light::Type::point, Light::Type::area}) {
    Light light = lightOf(type);
    EXPECT_TRUE(std::isfinite(irradianceOnAxis(light, {100, true}, light.position)));
    EXPECT_EQ(emissionCosine(light, light.position), 1.0f);
    light.radius = 0.5f;  // nearer than the radius nothing grows
    EXPECT_EQ(irradianceOnAxis(light, {100, true}, light.position),
              irradianceOnAxis(light, {100, true}, V3f(0, 0, 4.5f)));
  }
}

TEST(LightReach, AreaLightsShineForwardByTheirCosine) {
  const Light area = lightOf(Light::Type::area), point = lightOf(Light::Type::point);
  EXPECT_NEAR(emissionCosine(area, V3f(5, 0, 0)), std::sqrt(0.5f), 1e-6f);
  EXPECT_EQ(emissionCosine(area, V3f(1, 0, 5)), 0.0f);
  EXPECT_EQ(emissionCosine(area, V3f(0, 0, 6)), 0.0f);
  EXPECT_EQ(emissionCosine(point, V3f(0, 0, 6)), 1.0f);
}

TEST(LightReach, BackgroundGetsNothingAndTheSubjectsShareIsTheMost) {
  Vec3Plane position(3, 1);
  position.set(0, 0, V3f(0, 0, 0));
  position.set(1, 0, V3f(0, 0, 0));
  position.set(2, 0, V3f(5, 0, 0));
  Labels labels(3, 1, 1u);
  labels(0, 0) = 0;
  const Floats reach =
      lightReach(position, labels, lightOf(Light::Type::area), {100, true}, false, 0.8f);
  EXPECT_EQ(reach.view()(0, 0), 0.0f);
  EXPECT_EQ(reach.view()(1, 0), 0.8f);
  EXPECT_NEAR(reach.view()(2, 0), std::sqrt(0.5f), 1e-6f);
}

}  // namespace
}  // namespace kagefude
