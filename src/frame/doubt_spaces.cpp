#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "frame/normal_reading.h"
#include "frame/seen_places.h"
#include "frame/vector_spaces.h"

namespace kagefude {
namespace {

using namespace detail;

constexpr size_t fewestPlaces = 64;
// Deviations are 1 - cos: 5 degrees pass; what is named must lie within 26, and fit four times
// better; 45 degrees are worth a word even where nothing explains them.
constexpr float passes = 0.004f, namedWithin = 0.1f, muchBetter = 0.25f, hopeless = 0.3f;

float deviationAt(const SmoothPlace& place, const NormalReading& reading) {
  const V3f n = reading(place.given);
  const float length = n.length();
  return length > 0 ? 1 - n.dot(place.spanned) / length : 2.0f;
}

float meanDeviation(const std::vector<SmoothPlace>& places, const NormalReading& reading) {
  double sum = 0;
  for (const SmoothPlace& place : places) sum += deviationAt(place, reading);
  return static_cast<float>(sum / static_cast<double>(places.size()));
}

// Half of the places deviate less than this.
float middleDeviation(const std::vector<SmoothPlace>& places, const NormalReading& reading) {
  std::vector<float> deviations;
  deviations.reserve(places.size());
  for (const SmoothPlace& place : places) deviations.push_back(deviationAt(place, reading));
  const auto middle = deviations.begin() + static_cast<ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  return *middle;
}

bool holdsUnitRange(const std::vector<SmoothPlace>& places) {
  return std::all_of(places.begin(), places.end(), [](const SmoothPlace& place) {
    return std::min({place.given.x, place.given.y, place.given.z}) >= 0 &&
           std::max({place.given.x, place.given.y, place.given.z}) <= 1.001f;
  });
}

// The simplest of the readings that fit about as well as the best. Where a flat ground fills half
// of the picture many readings fit in the middle; the mean over all places tells them apart.
std::optional<NormalReading> explain(const std::vector<SmoothPlace>& places,
                                     const std::optional<Transform>& camera, float plain) {
  std::vector<std::pair<float, NormalReading>> tried;
  float best = 2;
  for (NormalReading reading : allAxes())
    for (const bool unit : {false, true})
      for (const bool turned : {false, true}) {
        if ((unit && !holdsUnitRange(places)) || (turned && !camera)) continue;
        reading.unit = unit;
        reading.worldFromCamera = turned ? std::optional(camera->inverse()) : std::nullopt;
        tried.emplace_back(middleDeviation(places, reading), reading);
        best = std::min(best, tried.back().first);
      }
  if (best > namedWithin || best > muchBetter * plain) return std::nullopt;
  std::erase_if(tried, [&](const auto& one) { return one.first > 1.5f * best + 0.002f; });
  float bestMean = 2;
  for (auto& [deviation, reading] : tried) {
    deviation = meanDeviation(places, reading);
    bestMean = std::min(bestMean, deviation);
  }
  const NormalReading* simplest = nullptr;
  for (const auto& [deviation, reading] : tried)
    if (deviation <= 1.5f * bestMean + 0.002f &&
        (!simplest || reading.departures() < simplest->departures()))
      simplest = &reading;
  return *simplest;
}

double degreesOf(float deviation) {
  return std::acos(std::clamp(1 - deviation, -1.0f, 1.0f)) * 180 / M_PI;
}

bool isIdentity(const Transform& t, double tolerance) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      if (std::abs(t.m[row][column] - (row == column)) > tolerance) return false;
  return true;
}

double placeOf(const Transform& cameraFromWorld) {
  return V3d(cameraFromWorld.m[0][3], cameraFromWorld.m[1][3], cameraFromWorld.m[2][3]).length();
}

// Positions of the camera's space are seen by a camera that stands at 0 and looks along -z.
SpaceDoubt doubtPositions(const VectorSpaces& spaces, const std::optional<Transform>& fitted,
                          const std::vector<SeenPoint>& points) {
  if (!fitted || spaces.position != VectorSpace::automatic) return {};
  double distance = 0;
  for (const SeenPoint& point : points)
    distance += point.world.length() / static_cast<double>(points.size());
  if (!isIdentity(*fitted, 1e-3) || placeOf(*fitted) > 1e-3 * distance) return {};
  const bool known = spaces.cameraFromWorld.has_value();
  if (known && isIdentity(*spaces.cameraFromWorld, 1e-3) &&
      placeOf(*spaces.cameraFromWorld) <= 1e-3 * distance)
    return {};
  return {known,
          "the positions are seen from 0 along -z, so they are in the camera's space; set "
          "frame.position_space = \"camera\" (or \"world\", if the camera does stand so)"};
}

}  // namespace

SpaceDoubt doubtSpaces(const VectorSpaces& spaces, const ImageFile& file, Vec3View position,
                       Vec3View normal, View<const uint32_t> ids) {
  const std::vector<SeenPoint> points = seenPoints(file, position);
  const std::optional<Transform> fitted = fitCamera(points);
  const SpaceDoubt doubt = doubtPositions(spaces, fitted, points);
  if (!doubt.sentence.empty()) return doubt;
  const std::vector<SmoothPlace> places = smoothPlaces(position, normal, ids);
  if (places.size() < fewestPlaces) return {};
  const float plain = middleDeviation(places, {});
  if (plain <= passes) return {};
  const auto found =
      explain(places, spaces.cameraFromWorld ? spaces.cameraFromWorld : fitted, plain);
  const bool asked = spaces.normal != VectorSpace::automatic ||
                     spaces.range != NormalRange::automatic || !spaces.axes.empty();
  if (found && !asked)
    return {true, fmt::format("the normals {}: as they are they stand {:.0f} degrees off the "
                              "positions' slopes; set {} (or frame.normal_space = \"world\" to "
                              "take them as they are)",
                              found->sentence(), degreesOf(plain), found->settings())};
  if (plain <= hopeless) return {};
  return {false,
          fmt::format("the normals stand {:.0f} degrees off the positions' slopes in half of "
                      "the picture; say with frame.normal_space, normal_range and "
                      "normal_axes what they are, or render world-space normals",
                      degreesOf(plain))};
}

}  // namespace kagefude
