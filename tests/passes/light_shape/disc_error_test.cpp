#include "passes/light_shape/disc_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "passes/light_shape/disc_places.h"

namespace kagefude {
namespace {

/// A floor seen from above under a round lamp, and bars that hang at several heights: each one's
/// shadow shifts by another length from place to place.
struct BarredFloor {
  static constexpr int width = 160, height = 96;
  float halfBar;  ///< pixels
  Labels labels{width, height, 1u};

  bool lit(int x, int y, const V2f& place) const {
    for (int bar = 0; bar < 3; ++bar) {
      const float shift = 10.0f + 7.0f * static_cast<float>(bar);
      const float along = bar == 1 ? static_cast<float>(y) + 0.7f * static_cast<float>(x) - 110
                                   : static_cast<float>(x) - 50 - 30 * static_cast<float>(bar);
      const float moved = shift * (bar == 1 ? place.y + 0.7f * place.x : place.x);
      if (std::fabs(along + moved) < halfBar) return false;
    }
    return true;
  }

  std::vector<Bytes> masks(const std::vector<V2f>& places) const {
    std::vector<Bytes> masks;
    for (const V2f& place : places) {
      Bytes& mask = masks.emplace_back(width, height);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) mask(x, y) = lit(x, y, place);
    }
    return masks;
  }

  std::optional<float> estimate(const std::vector<V2f>& places) const {
    const std::vector<Bytes> planes = masks(places);
    const std::vector<View<const uint8_t>> views(planes.begin(), planes.end());
    return estimateDiscError(views, places, labels, {}, {}, {}, {});
  }

  /// Against the share of 1,300 places.
  float error(const std::vector<V2f>& places) const {
    const std::vector<Bytes> planes = masks(places);
    const std::vector<View<const uint8_t>> views(planes.begin(), planes.end());
    const Floats found = lightShapeVisibility(views, places, labels, {}, {}, {}, {}).visibility;
    double sum = 0, count = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        double seen = 0, all = 0;
        for (float v = -0.975f; v < 1; v += 0.05f)
          for (float u = -0.975f; u < 1; u += 0.05f)
            if (u * u + v * v < 1) {
              ++all;
              seen += lit(x, y, {u, v});
            }
        const double truth = seen / all;
        if (truth < 0.02 || truth > 0.98) continue;
        sum += std::pow(found(x, y) - truth, 2);
        ++count;
      }
    return static_cast<float>(std::sqrt(sum / count));
  }
};

TEST(DiscError, IsAboutTheErrorThatIsLeft) {
  for (const float halfBar : {1.5f, 4.0f, 14.0f}) {
    const BarredFloor floor{halfBar};
    for (const int count : {9, 17, 33}) {
      const std::vector<V2f> places = discPlaces(count);
      const float left = floor.error(places), told = floor.estimate(places).value_or(-1);
      EXPECT_GT(told, 0.5f * left) << halfBar << " " << count << " " << told;
      EXPECT_LT(told, 2.0f * left) << halfBar << " " << count << " " << left;
    }
  }
}

TEST(DiscError, IsNotToldOfOtherMasks) {
  const BarredFloor floor{4};
  EXPECT_FALSE(floor.estimate(discPlaces(5))) << "no smaller disc";
  EXPECT_FALSE(floor.estimate(discPlaces(12))) << "its group is spread evenly";
  std::vector<V2f> turned = discPlaces(9);
  for (V2f& place : turned)
    place = V2f(place.x * 0.8f - place.y * 0.6f, place.x * 0.6f + place.y * 0.8f);
  EXPECT_FALSE(floor.estimate(turned));
  EXPECT_FALSE((BarredFloor{0}.estimate(discPlaces(9)))) << "no penumbra";
}

TEST(DiscError, MasksThatWouldDo) {
  EXPECT_EQ(masksFor(0.04f, 9, 0.03f), 9);
  EXPECT_EQ(masksFor(0.04f, 9, 0.05f), 17);
  EXPECT_EQ(masksFor(0.04f, 9, 0.07f), 33);
  EXPECT_EQ(masksFor(0.04f, 33, 0.05f), 65);
  EXPECT_EQ(masksFor(0.04f, 9, 0.2f), 0);
}

}  // namespace
}  // namespace kagefude
