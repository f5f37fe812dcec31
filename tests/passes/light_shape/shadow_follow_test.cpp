#include "passes/light_shape/shadow_follow.h"

#include <gtest/gtest.h>

#include <cmath>

#include "passes/light_shape/disc_places.h"
#include "passes/random_image.h"

namespace kagefude {
namespace {

/// A floor of one unit a pixel under a light straight above its middle.
struct Floor {
  int width, height;
  Labels labels;
  Vec3Plane position, normal;
  std::vector<V2f> places;
  std::vector<Bytes> masks;
  LightGeometry geometry;

  Floor(int w, int h, int count = 9)
      : width(w),
        height(h),
        labels(w, h, 1u),
        position(w, h),
        normal(w, h),
        places(discPlaces(count)) {
    geometry.position = V3f(static_cast<float>(w) / 2, static_cast<float>(h) / 2, 1000);
    geometry.u = V3f(1, 0, 0);
    geometry.v = V3f(0, 1, 0);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        position.set(x, y, V3f(static_cast<float>(x), static_cast<float>(y), 0));
        normal.set(x, y, V3f(0, 0, 1));
      }
  }
  template <class Lit>
  void draw(float shift, const Lit& lit) {
    for (const V2f& p : places) {
      Bytes& mask = masks.emplace_back(width, height);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          mask(x, y) =
              lit(static_cast<float>(x) + shift * p.x, static_cast<float>(y) + shift * p.y);
    }
  }
  std::vector<View<const uint8_t>> views() const { return {masks.begin(), masks.end()}; }
  ShadowTaps taps() const { return {views(), places, labels, normal}; }
};

/// ShadowTaps::mean by its definition.
ShadowTaps::Mean naiveMean(const Floor& f, const ShadowPlaces& places, int x, int y,
                           const ShadowShift& s, float shift) {
  double visibility = 0, cost = 0, count = 0;
  for (int i = 0; i < places.count; ++i) {
    double weight = 0, lit = 0;
    for (int t = 0; t < 3; ++t) {
      const double dx = s.ux * places.x[t][i] + s.vx * places.y[t][i];
      const double dy = s.uy * places.x[t][i] + s.vy * places.y[t][i];
      const int qx = static_cast<int>(std::floor(x + 0.5 - shift * dx));
      const int qy = static_cast<int>(std::floor(y + 0.5 - shift * dy));
      if (!f.labels.view().contains(qx, qy) || f.labels(qx, qy) != f.labels(x, y)) continue;
      if ((f.normal.view()(qx, qy) - f.normal.view()(x, y)).length() > 0.1f) continue;
      weight += places.weight[t][i];
      if (f.masks[static_cast<size_t>(places.mask[t][i])](qx, qy)) lit += places.weight[t][i];
    }
    if (weight <= 0.05) continue;
    visibility += lit / weight;
    cost += lit / weight * (1 - lit / weight);
    count += 1;
  }
  const bool valid = count > 0.85 * places.count;
  return {static_cast<float>(visibility / count), static_cast<float>(cost / count), valid};
}

void expectDefinition(int masks) {
  Floor floor(153, 113, masks);
  floor.draw(0, [](float x, float y) { return std::fmod(x * 7 + y * 13, 11.0f) > 4; });
  for (int y = 0; y < 113; ++y)
    for (int x = 90; x < 153; ++x) {
      if (y < 50) floor.labels(x, y) = 2;
      if (y > 80) floor.normal.set(x, y, V3f(0.6f, 0, 0.8f));
    }
  const ShadowTaps taps = floor.taps();
  const ShadowPlaces places = placesBetween(floor.places, 24, 1.0f);
  ShadowShift along;
  along.ux = 0.95f, along.uy = 0.1f, along.vx = -0.1f, along.vy = 0.95f;
  int valid = 0, refused = 0;
  for (int y = 0; y < 113; y += 2)
    for (int x = 0; x < 153; x += 3)
      for (const float shift : {1.0f, 6.5f, 15.0f, 23.0f, 31.0f}) {
        const ShadowTaps::Mean found = taps.mean(places, x, y, along, shift);
        const ShadowTaps::Mean naive = naiveMean(floor, places, x, y, along, shift);
        ASSERT_EQ(found.valid, naive.valid) << x << " " << y << " " << shift;
        (found.valid ? valid : refused) += 1;
        if (!found.valid) continue;
        EXPECT_NEAR(found.visibility, naive.visibility, 1e-4) << x << " " << y << " " << shift;
        EXPECT_NEAR(found.cost, naive.cost, 1e-4);
      }
  EXPECT_GT(valid, 500);
  EXPECT_TRUE(refused > 0 || masks > 9);
}

TEST(ShadowTaps, MeanEqualsItsDefinitionInsideAndAcrossLabelsAndFrameEdges) { expectDefinition(9); }

TEST(ShadowTaps, MeanOfMoreMasksThanTheLowerBitsHoldEqualsItsDefinition) {
  for (const int masks : {16, 17, 33, 65}) expectDefinition(masks);
}

TEST(ShadowTaps, SeenByNoneSomeOrAllMasks) {
  using Seen = ShadowTaps::Seen;
  for (const int count : {5, 9, 16, 17, 65}) {
    Floor floor(8, 4, count);
    floor.draw(0, [](float, float) { return false; });
    for (Bytes& mask : floor.masks) mask(2, 0) = 1;
    for (size_t k = 0; k < floor.masks.size(); ++k) {
      floor.masks[k](3, 1) = 1;
      const ShadowTaps taps = floor.taps();
      EXPECT_EQ(taps.seen(1, 0), Seen::none);
      EXPECT_EQ(taps.seen(2, 0), Seen::all);
      EXPECT_EQ(taps.seen(3, 1), Seen::some) << count << " " << k;
      floor.masks[k](3, 1) = 0;
    }
  }
}

TEST(ShadowTaps, MismatchOfManyMasksIsLowAtTheirShiftOnly) {
  Floor floor(96, 48, 33);
  floor.draw(8, [](float x, float) { return x > 47.5f; });
  const ShadowTaps taps = floor.taps();
  ShadowShift along;
  along.ux = along.vy = -1;
  EXPECT_LT(taps.mismatch(48, 24, along, 8), 0.05f);
  along.ux = along.vy = 1;
  EXPECT_GT(taps.mismatch(48, 24, along, 8), 0.5f);
}

TEST(ShadowTaps, MismatchByHand) {
  // An edge that shifts by 8: moved by 8 every mask foretells the others, by -8 none at the edge.
  Floor floor(96, 48);
  floor.draw(8, [](float x, float) { return x > 47.5f; });
  const ShadowTaps taps = floor.taps();
  ShadowShift along;
  along.ux = along.vy = -1;
  EXPECT_EQ(taps.mismatch(48, 24, along, 8), 0.0f);
  along.ux = along.vy = 1;
  EXPECT_GT(taps.mismatch(48, 24, along, 8), 0.5f);
  floor.labels(48, 24) = 9;
  EXPECT_EQ(floor.taps().mismatch(48, 24, along, 8), 1.0f) << "no tap counts";
}

TEST(ShadowShift, UnderALightStraightAboveGoesAgainstTheLight) {
  const Floor floor(32, 32);
  const ShadowShift s =
      shadowShiftAt(16, 16, floor.labels, floor.position, floor.normal, floor.geometry);
  ASSERT_TRUE(s.valid);
  EXPECT_NEAR(s.ux, -1, 1e-5);
  EXPECT_NEAR(s.uy, 0, 1e-5);
  EXPECT_NEAR(s.vy, -1, 1e-5);
  EXPECT_EQ(s.trust, 1.0f);
}

TEST(ShadowShift, NothingWhereLightGrazesOrNoNeighbourTellsThePlace) {
  Floor floor(32, 32);
  floor.labels(16, 16) = 5;
  EXPECT_FALSE(
      shadowShiftAt(16, 16, floor.labels, floor.position, floor.normal, floor.geometry).valid);
  floor.geometry.position = V3f(100000, 16, 10);
  EXPECT_FALSE(
      shadowShiftAt(8, 8, floor.labels, floor.position, floor.normal, floor.geometry).valid);
}

float needOf(const Floor& floor, int x, int y) {
  Bytes kinds(floor.width, floor.height, uint8_t{0});
  for (int v = 0; v < floor.height; ++v)
    for (int u = 0; u < floor.width; ++u)
      for (const Bytes& mask : floor.masks) kinds(u, v) |= mask(u, v) ? 2 : 1;
  const PixelSet edges(kinds, 3, 3);
  const ShadowTaps taps = floor.taps();
  const Distances distances = maskDistances(floor.views(), edges, floor.labels);
  return ShadowNeed(taps, distances, edges, floor.places).at(x, y);
}

TEST(ShadowNeed, NoneForAStraightEdge) {
  Floor floor(96, 64);
  floor.draw(9, [](float x, float) { return x > 47.5f; });
  for (int x = 40; x < 56; ++x) EXPECT_EQ(needOf(floor, x, 32), 0.0f) << x;
}

TEST(ShadowNeed, AllForAStripThinnerThanItsShift) {
  Floor floor(96, 64);
  floor.draw(14, [](float x, float) { return std::fabs(x - 47.5f) > 1.6f; });
  EXPECT_EQ(needOf(floor, 47, 32), 1.0f);
}

TEST(ShadowNeed, NoneBesideAnEdgeThatAllMasksShow) {
  // Two pixels into the umbra of an edge that hardly moves: besides it lies what all masks see.
  Floor floor(96, 64);
  floor.draw(0.2f, [](float x, float) { return x > 47.5f; });
  EXPECT_EQ(needOf(floor, 44, 32), 0.0f);
  EXPECT_EQ(needOf(floor, 51, 32), 0.0f);
  EXPECT_EQ(needOf(floor, 20, 32), 1.0f) << "far from it a thin shadow may have been missed";
  for (int y = 0; y < 64; ++y)
    for (int x = 48; x < 96; ++x) floor.labels(x, y) = 2;
  EXPECT_EQ(needOf(floor, 44, 32), 1.0f) << "another label's pixels say nothing";
}

TEST(ShadowNeed, AllWhereAMaskHasNoEdge) {
  Floor floor(32, 32);
  floor.draw(0, [](float, float) { return true; });
  floor.masks[4](16, 16) = 0;
  EXPECT_EQ(needOf(floor, 16, 16), 1.0f);
}

TEST(ShadowFollow, LargeFramesInterpolateToWhatSmallOnesMeasure) {
  // A strip under a wide light, in a frame of more rows than are measured pixel by pixel.
  const auto strip = [](float x, float) { return std::fabs(x - 59.5f) > 3.0f; };
  Floor small(120, 96), large(120, 1296);
  small.draw(20, strip);
  large.draw(20, strip);
  const auto resolve = [](const Floor& f) {
    return lightShapeVisibility(f.views(), f.places, f.labels, f.position, f.normal, f.geometry,
                                {});
  };
  // Only the perspective of the light differs, and that is slight.
  large.geometry.position = V3f(60, 648, 1000);
  const LightShapeResult a = resolve(small), b = resolve(large);
  double sum = 0;
  for (int x = 36; x < 84; ++x) sum += std::pow(a.visibility(x, 48) - b.visibility(x, 648), 2);
  EXPECT_LT(std::sqrt(sum / 48), 0.03);
}

}  // namespace
}  // namespace kagefude
