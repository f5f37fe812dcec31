#include <gtest/gtest.h>

#include "compositor/light_visibility.h"

namespace kagefude {
namespace {

TEST(SlopeShadow, IsTheNormalsShareUpward) {
  FramePlanes frame;
  frame.width = 2;
  frame.height = 1;
  frame.normal = Vec3Plane(2, 1);
  frame.normal.set(0, 0, {0.8f, 0, 0.6f});
  frame.normal.set(1, 0, {0, 0, -1});
  frame.objectId = Labels(2, 1, 5u);
  FrameLight light;
  light.method = ShadowMethod::slope;
  const LightVisibility result =
      lightVisibility(light, FramePlan(), LightPlanes(), frame, frame.objectId, nullptr);
  EXPECT_EQ(result.visibility(0, 0), 0.6f);
  EXPECT_EQ(result.visibility(1, 0), 0.0f);
}

}  // namespace
}  // namespace kagefude
