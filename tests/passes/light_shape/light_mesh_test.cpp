#include "passes/light_shape/light_mesh.h"

#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>
#include <random>

#include "passes/light_shape/disc_places.h"
#include "passes/light_shape/light_share.h"

namespace kagefude {
namespace {

TEST(DiscPlaces, LargerDiscsContainSmallerOnesAndStayOnTheLight) {
  const std::vector<V2f> largest = discPlaces(65);
  for (const int count : {5, 9, 17, 33, 65}) {
    const std::vector<V2f> places = discPlaces(count);
    ASSERT_EQ(places.size(), static_cast<size_t>(count));
    for (size_t i = 0; i < places.size(); ++i) {
      if (count >= 9) {
        EXPECT_EQ(places[i], largest[i]) << count << " " << i;
        EXPECT_LE(places[i].length(), 1.000001f);
      }
      for (size_t j = 0; j < i; ++j) EXPECT_GT((places[i] - places[j]).length(), 0.15f);
    }
  }
  EXPECT_EQ(discPlaces(12).size(), 12u);
}

TEST(LightMesh, TrianglesCoverTheHullOnce) {
  for (const int count : {5, 9, 12, 17, 33, 65}) {
    const std::vector<V2f> places = discPlaces(count);
    const LightMesh mesh(places);
    // Euler: 2 n - 2 - hull triangles; the hull is what lies on the rim.
    int rim = 0;
    for (const V2f& p : places) rim += p.length() > 0.999f;
    EXPECT_EQ(static_cast<int>(mesh.triangles().size()), 2 * count - 2 - rim) << count;
    if (count == 12) continue;
    EXPECT_NEAR(mesh.area(), rim / 2.0 * std::sin(2 * M_PI / rim), 1e-5) << count;
  }
}

TEST(LightMesh, PlacesOnOneLineGiveNoTriangle) {
  const V2f places[] = {{-1, 0}, {0, 0}, {1, 0}};
  EXPECT_TRUE(LightMesh(places).triangles().empty());
}

TEST(LightMesh, BlendsGiveBackThePlace) {
  const std::vector<V2f> places = discPlaces(17);
  const LightMesh mesh(places);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> along(-1.2f, 1.2f);
  for (int i = 0; i < 200; ++i) {
    const V2f p(along(random), along(random));
    const LightMesh::Blend blend = mesh.blendAt(p);
    V2f back(0, 0);
    for (int t = 0; t < 3; ++t) back += places[blend.mask[t]] * blend.weight[t];
    EXPECT_NEAR((back - p).length(), 0, 1e-5);
  }
}

TEST(LightShare, DiscsOfManyMasksGiveTheCircleSegment) {
  for (const int count : {17, 33, 65})
    for (const float d : {-0.9f, -0.4f, 0.0f, 0.3f, 0.8f})
      for (const float radius : {1.0f, 0.5f}) {
        const std::vector<V2f> places = discPlaces(count);
        std::vector<float> s;
        for (const V2f& p : places) s.push_back(2 * (d + 0.6f * p.x + 0.8f * p.y));
        const float e = std::clamp(d / radius, -1.0f, 1.0f);
        const double exact = 0.5 + (e * std::sqrt(1 - e * e) + std::asin(e)) / M_PI;
        EXPECT_NEAR(LightShare(places, false, radius).of(s.data()), exact, 0.015);
        EXPECT_NEAR(LightShare(places, true, radius).of(s.data()), exact, 1e-4);
      }
}

TEST(LightShare, ManyMasksEqualCountingPointsOfTheirMesh) {
  const std::vector<V2f> places = discPlaces(33);
  const LightMesh mesh(places);
  std::mt19937 random(9);
  std::uniform_real_distribution<float> value(-1, 1);
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<float> s(33);
    for (float& v : s) v = value(random);
    int positive = 0, all = 0;
    for (float y = -0.995f; y < 1; y += 0.01f)
      for (float x = -0.995f; x < 1; x += 0.01f) {
        if (x * x + y * y > 0.96f) continue;
        const LightMesh::Blend b = mesh.blendAt({x, y});
        positive +=
            b.weight[0] * s[b.mask[0]] + b.weight[1] * s[b.mask[1]] + b.weight[2] * s[b.mask[2]] >
            0;
        ++all;
      }
    EXPECT_NEAR(LightShare(places, false, 1).of(s.data()), static_cast<double>(positive) / all,
                0.03);
  }
}

TEST(LightShare, ManyMasksShrinkToTheHardCentreMask) {
  const std::vector<V2f> places = discPlaces(17);
  std::vector<float> s(17, -2.0f);
  s[0] = 0.5f;
  EXPECT_EQ(LightShare(places, false, 0).of(s.data()), 1.0f);
  s.assign(17, 2.0f);
  s[0] = -0.5f;
  EXPECT_EQ(LightShare(places, false, 0).of(s.data()), 0.0f);
}

}  // namespace
}  // namespace kagefude
