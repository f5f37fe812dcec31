#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "frame/rebuild_positions.h"
#include "frame/seen_places.h"

namespace kagefude {
namespace {

using namespace detail;

// 1 - cos between the given normal and the one that the positions span.
double deviationAt(const SmoothPlace& place) {
  return 1 - place.given.dot(place.spanned) / place.given.length();
}

// How the places that both have deviate: means, and how far from chance their difference is.
struct Comparison {
  size_t count = 0;
  double taken = 0, other = 0, difference = 0, error = 0;
};

bool isBefore(const SmoothPlace& a, const SmoothPlace& b) {
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}

Comparison compare(const std::vector<SmoothPlace>& taken, const std::vector<SmoothPlace>& other) {
  Comparison sum;
  double squares = 0;
  for (auto a = taken.begin(), b = other.begin(); a != taken.end() && b != other.end();) {
    if (isBefore(*a, *b)) {
      ++a;
    } else if (isBefore(*b, *a)) {
      ++b;
    } else {
      const double own = deviationAt(*a++), others = deviationAt(*b++);
      ++sum.count;
      sum.taken += own;
      sum.other += others;
      squares += (own - others) * (own - others);
    }
  }
  const auto n = static_cast<double>(std::max<size_t>(sum.count, 1));
  sum.taken /= n;
  sum.other /= n;
  sum.difference = sum.taken - sum.other;
  sum.error = std::sqrt(std::max(0.0, squares / n - sum.difference * sum.difference) / n);
  return sum;
}

// Better beyond chance, by more than rounding, and so well that it may be what is true: 20 degrees
// leave room for strong bumps.
bool decides(const Comparison& found) {
  constexpr size_t fewestPlaces = 64;
  constexpr double beyondChance = 6, better = 0.9, noise = 1e-5, explained = 0.06;
  return found.count >= fewestPlaces && found.difference > noise &&
         found.difference > beyondChance * found.error && found.other < better * found.taken &&
         found.other < explained;
}

double degreesOf(double deviation) {
  return std::acos(std::clamp(1 - deviation, -1.0, 1.0)) * 180 / M_PI;
}

SpaceDoubt doubtKind(const VectorSpaces& spaces, const Comparison& found) {
  if (!decides(found)) return {};
  const bool ray = spaces.measuredAlong() == DepthKind::ray;
  const std::string compared =
      fmt::format("{:.1f} degrees off the normals, {:.1f} if it is {}", degreesOf(found.taken),
                  degreesOf(found.other), ray ? "planar" : "ray depth");
  if (spaces.depthKind != DepthKind::automatic)
    return {false, fmt::format("frame.depth_kind = \"{}\" sets the rebuilt positions {}",
                               ray ? "ray" : "planar", compared)};
  return {true, fmt::format("positions rebuilt from the depth, taken as planar, stand {}; set "
                            "frame.depth_kind = \"ray\" (or \"planar\" to take it so)",
                            compared)};
}

// The places, had the camera seen `wider` times as much: what lies at one planar depth moves away
// from the axis, so slopes across it become flatter.
std::vector<SmoothPlace> seenWider(std::vector<SmoothPlace> places,
                                   const Transform& cameraFromWorld, double wider) {
  const Transform worldFromCamera = cameraFromWorld.inverse();
  for (SmoothPlace& place : places) {
    V3d n = cameraFromWorld.direction(V3d(place.spanned));
    n.x /= wider;
    n.y /= wider;
    place.spanned = V3f(worldFromCamera.direction(n)).normalized();
  }
  return places;
}

// The angle of view that would fit best, where that is another one than the camera's.
SpaceDoubt doubtView(const VectorSpaces& spaces, const std::vector<SmoothPlace>& places) {
  constexpr double widths[] = {0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 1.05, 1.1, 1.25, 1.5, 1.75, 2};
  double best = 1;
  Comparison found;
  for (const double wider : widths) {
    const Comparison tried =
        compare(places, seenWider(places, spaces.camera->cameraFromWorld, wider));
    if (!decides(tried) || (best != 1 && tried.other >= found.other)) continue;
    best = wider;
    found = tried;
  }
  if (best == 1) return {};
  return {false,
          fmt::format("rebuilt positions stand {:.1f} degrees off the normals, {:.1f} if "
                      "the camera had seen {} times as wide as {} says; check its "
                      "projection (frame.clip_from_camera)",
                      degreesOf(found.taken), degreesOf(found.other), best, spaces.camera->source)};
}

}  // namespace

SpaceDoubt doubtDepth(const VectorSpaces& spaces, Vec3View position, Vec3View normal,
                      View<const uint32_t> ids) {
  if (!spaces.rebuilt || spaces.camera->clipFromCamera->m[3][2] == 0) return {};
  const std::vector<SmoothPlace> places = smoothPlaces(position, normal, ids);
  const Vec3Plane other = rebuiltOtherwise(position, spaces);
  SpaceDoubt doubt = doubtKind(spaces, compare(places, smoothPlaces(other, normal, ids)));
  if (doubt.sentence.empty() && spaces.measuredAlong() == DepthKind::planar)
    doubt = doubtView(spaces, places);
  return doubt;
}

}  // namespace kagefude
