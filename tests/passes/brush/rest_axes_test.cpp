#include "passes/brush/rest_axes.h"

#include <gtest/gtest.h>

#include "image/vec.h"

namespace kagefude {
namespace {

/// A turn about a slanted axis.
struct Turn {
  V3f x{0.8f, 0.0f, 0.6f}, y{0.36f, 0.8f, -0.48f}, z{-0.48f, 0.6f, 0.64f};
  V3f turned(const V3f& v) const { return x * v.x + y * v.y + z * v.z; }
};

TEST(RestAxes, AreTheExactRotationOfARigidThing) {
  const Turn rigid;
  const V3f p(0.3f, -0.1f, 0.2f), q(0.05f, 0.4f, 0.1f);  // of a crease: no right angle
  const V3f d = rigid.turned(p), e = rigid.turned(q);
  float x[3] = {}, y[3] = {}, z[3] = {};
  ASSERT_TRUE(restAxes({d.x, d.y, d.z, e.x, e.y, e.z, {p.x, p.y, p.z}, {q.x, q.y, q.z}}, x, y, z));
  for (int k = 0; k < 3; ++k) {
    const V3f axis = k == 0 ? rigid.x : k == 1 ? rigid.y : rigid.z;
    EXPECT_NEAR(x[k], axis.x, 1e-6f);
    EXPECT_NEAR(y[k], axis.y, 1e-6f);
    EXPECT_NEAR(z[k], axis.z, 1e-6f);
  }
}

TEST(RestAxes, AreLeftAloneWhereNothingIsSpanned) {
  float x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
  EXPECT_FALSE(restAxes({1, 0, 0, 2, 0, 0, {1, 0, 0}, {0, 1, 0}}, x, y, z));
  EXPECT_FALSE(restAxes({1, 0, 0, 0, 1, 0, {0, 0, 0}, {0, 0, 0}}, x, y, z));
  EXPECT_FALSE(restAxes({0, 0, 0, 0, 0, 0, {1, 0, 0}, {0, 1, 0}}, x, y, z));
  EXPECT_EQ(x[0] + y[1] + z[2], 3.0f);
}

TEST(RestStretch, IsHalfTheLogarithmOfTheAreasRatio) {
  EXPECT_NEAR(restStretch({2, 0, 0, 0, 8, 0, {1, 0, 0}, {0, 1, 0}}), 2.0f, 1e-6f);
  EXPECT_NEAR(restStretch({1, 0, 0, 5, 0.5f, 0, {0, 1, 0}, {0, 0, 1}}), -0.5f, 1e-6f) << "sheared";
  EXPECT_EQ(restStretch({1e6f, 0, 0, 0, 1e6f, 0, {1, 0, 0}, {0, 1, 0}}), 4.0f);
  EXPECT_EQ(restStretch({1, 0, 0, 2, 0, 0, {1, 0, 0}, {0, 1, 0}}), 0.0f);
  EXPECT_EQ(restStretch({1, 0, 0, 0, 1, 0, {0, 0, 0}, {0, 0, 0}}), 0.0f);
}

}  // namespace
}  // namespace kagefude
