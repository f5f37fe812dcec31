#include "passes/light_shape/disc_error.h"

#include <algorithm>
#include <cmath>

#include "passes/light_shape/disc_places.h"

namespace kagefude {
namespace {

constexpr int largestDisc = 65;
constexpr float darkest = 0.02f, lightest = 0.98f;

struct Disc {
  std::vector<View<const uint8_t>> masks;
  std::vector<V2f> places;
};

bool samePlace(const V2f& a, const V2f& b) { return (a - b).length() < 1e-3f; }

/// The masks that make the next smaller disc; empty where there is none.
Disc smallerDisc(std::span<const View<const uint8_t>> masks, std::span<const V2f> places) {
  const int count = static_cast<int>(places.size());
  if (count < 9 || count > largestDisc || (count - 1) % 8 != 0) return {};
  Disc smaller;
  for (const V2f& place : discPlaces((count + 1) / 2)) {
    const auto found = std::find_if(places.begin(), places.end(),
                                    [&](const V2f& p) { return samePlace(p, place); });
    if (found == places.end()) return {};
    smaller.places.push_back(*found);
    smaller.masks.push_back(masks[static_cast<size_t>(found - places.begin())]);
  }
  return smaller;
}

bool isPenumbra(float visibility) { return visibility > darkest && visibility < lightest; }

}  // namespace

std::optional<float> estimateDiscError(std::span<const View<const uint8_t>> masks,
                                       std::span<const V2f> places, View<const uint32_t> labels,
                                       Vec3View position, Vec3View normal,
                                       const std::optional<LightGeometry>& geometry,
                                       const LightShapeParams& params) {
  const Disc smaller = smallerDisc(masks, places);
  if (smaller.places.empty()) return {};
  const Floats all =
      lightShapeVisibility(masks, places, labels, position, normal, geometry, params).visibility;
  const Floats half = lightShapeVisibility(smaller.masks, smaller.places, labels, position, normal,
                                           geometry, params)
                          .visibility;
  double sum = 0;
  size_t count = 0;
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      if (labels(x, y) == 0 || !(isPenumbra(all(x, y)) || isPenumbra(half(x, y)))) continue;
      const double change = double(all(x, y)) - half(x, y);
      sum += change * change;
      ++count;
    }
  if (count == 0) return {};
  return static_cast<float>(std::sqrt(sum / static_cast<double>(count)));
}

int masksFor(float wanted, int count, float error) {
  constexpr float perDisc = 0.7f;
  while (error > wanted && count < largestDisc) {
    error *= perDisc;
    count = 2 * count - 1;
  }
  return error > wanted ? 0 : count;
}

}  // namespace kagefude
