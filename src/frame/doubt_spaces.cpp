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
// better in the middle or two and a half times in the mean, which strong bumps raise; 45 degrees
// are worth a word even where nothing explains them.
constexpr float passes = 0.004f, namedWithin = 0.1f, muchBetter = 0.25f, better = 0.4f;
constexpr float hopeless = 0.3f;
// Of rebuilt positions the camera may be wrong as well, and other axes of the normals explain only
// some of that: 14 degrees are more than the bumps of half a picture, for what is taken and for
// what is named.
constexpr float hopelessRebuilt = 0.03f;
// A ground that fills the picture may agree with another reading than all that stands on it: even
// where the middle agrees, so small a share of places beyond `namedWithin` is looked into.
constexpr double fewWrong = 0.02;

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

std::vector<SmoothPlace> placesBeyond(const std::vector<SmoothPlace>& places, float deviation) {
  std::vector<SmoothPlace> far;
  std::copy_if(places.begin(), places.end(), std::back_inserter(far),
               [&](const SmoothPlace& place) { return deviationAt(place, {}) > deviation; });
  return far;
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

struct Trial {
  float middle, mean;
  NormalReading reading;
};

std::vector<Trial> tryAll(const std::vector<SmoothPlace>& places,
                          const std::optional<Transform>& camera) {
  std::vector<Trial> trials;
  for (NormalReading reading : allAxes())
    for (const bool unit : {false, true})
      for (const bool turned : {false, true}) {
        if ((unit && !holdsUnitRange(places)) || (turned && !camera)) continue;
        reading.unit = unit;
        reading.worldFromCamera = turned ? std::optional(camera->inverse()) : std::nullopt;
        trials.push_back(
            {middleDeviation(places, reading), meanDeviation(places, reading), reading});
      }
  return trials;
}

// The simplest of the readings that fit about as well as the best. Where a flat ground fills half
// of the picture many readings fit in the middle, the plain one perhaps; the mean over all places
// tells them apart.
std::optional<NormalReading> explain(const std::vector<SmoothPlace>& places,
                                     const std::optional<Transform>& camera, float within) {
  const float plain = meanDeviation(places, {}), plainMiddle = middleDeviation(places, {});
  std::vector<Trial> trials = tryAll(places, camera);
  std::erase_if(trials, [&](const Trial& trial) { return trial.middle > within; });
  float best = 2, bestMiddle = 2;
  for (const Trial& trial : trials) {
    best = std::min(best, trial.mean);
    bestMiddle = std::min(bestMiddle, trial.middle);
  }
  if (best > better * plain && bestMiddle > muchBetter * plainMiddle) return std::nullopt;
  const NormalReading* simplest = nullptr;
  for (const Trial& trial : trials)
    if (trial.mean <= 1.2f * best + 0.001f &&
        (!simplest || trial.reading.departures() < simplest->departures()))
      simplest = &trial.reading;
  return simplest->isPlain() ? std::nullopt : std::optional(*simplest);
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

std::optional<Transform> cameraOf(const VectorSpaces& spaces) {
  if (!spaces.camera || !spaces.camera->problem.empty()) return std::nullopt;
  return spaces.camera->cameraFromWorld;
}

// Positions of the camera's space are seen by a camera that stands at 0 and looks along -z.
SpaceDoubt doubtPositions(const VectorSpaces& spaces, const std::optional<Transform>& fitted,
                          const std::vector<SeenPoint>& points) {
  if (!fitted || spaces.position != VectorSpace::automatic || spaces.rebuilt) return {};
  double distance = 0;
  for (const SeenPoint& point : points)
    distance += point.world.length() / static_cast<double>(points.size());
  if (!isIdentity(*fitted, 1e-3) || placeOf(*fitted) > 1e-3 * distance) return {};
  const std::optional<Transform> said = cameraOf(spaces);
  const bool known = said.has_value();
  if (known && isIdentity(*said, 1e-3) && placeOf(*said) <= 1e-3 * distance) return {};
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
  const std::vector<SmoothPlace> wrong = placesBeyond(places, namedWithin);
  const bool hidden = plain <= passes;
  if (hidden && static_cast<double>(wrong.size()) < fewWrong * static_cast<double>(places.size()))
    return {};
  const std::optional<Transform> said = cameraOf(spaces);
  const auto found =
      explain(places, said ? said : fitted, spaces.rebuilt ? hopelessRebuilt : namedWithin);
  const bool asked = spaces.normal != VectorSpace::automatic ||
                     spaces.range != NormalRange::automatic || !spaces.axes.empty();
  if (found && !asked)
    return {
        true,
        fmt::format("the normals {}: as they are they stand {:.0f} degrees off the "
                    "positions' slopes{}; set {} (or frame.normal_space = \"world\" to "
                    "take them as they are){}",
                    found->sentence(), degreesOf(hidden ? middleDeviation(wrong, {}) : plain),
                    hidden ? " where these are not flat ground" : "", found->settings(),
                    spaces.rebuilt ? ", or say the depth or the camera that positions are rebuilt "
                                     "from (frame.depth_kind, camera_from_world)"
                                   : "")};
  if (plain <= (spaces.rebuilt ? hopelessRebuilt : hopeless)) return {};
  if (spaces.rebuilt)
    return {false,
            fmt::format("the normals stand {:.0f} degrees off the slopes of the rebuilt positions "
                        "in half of the picture, so the depth or {} is not what it is taken for; "
                        "say them with frame.depth_kind, camera_from_world and clip_from_camera, "
                        "or render a Position pass",
                        degreesOf(plain), spaces.camera ? spaces.camera->source : "the camera")};
  return {false,
          fmt::format("the normals stand {:.0f} degrees off the positions' slopes in half of "
                      "the picture; say with frame.normal_space, normal_range and "
                      "normal_axes what they are, or render world-space normals",
                      degreesOf(plain))};
}

}  // namespace kagefude
