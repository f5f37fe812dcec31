#include "passes/brush/brush_anchor.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kagefude {
namespace {

/// Share of an octave over which a ground's strokes change to the next size of the scene.
constexpr float sceneFade = 0.2f;

struct Box {
  V3f center;                     // world
  std::array<V3f, 3> side;        // unit, world
  std::array<float, 3> halfSize;  // world units
  int longest = 0, thinnest = 0;
};

Box worldBox(const BrushSubject& subject) {
  Box box;
  const V3f middle = (subject.boundsMin + subject.boundsMax) * 0.5f;
  box.center = V3f(subject.worldFromObject.point(V3d(subject.hasBounds ? middle : V3f(0.0f))));
  const ObjectAxes axes = objectAxes(subject.worldFromObject);
  box.side = {axes.x, axes.y, axes.z};
  for (int i = 0; i < 3; ++i) {
    V3d extent(0.0);
    extent[i] = 0.5 * (subject.boundsMax[i] - subject.boundsMin[i]);
    const V3d d = subject.worldFromObject.direction(extent);
    box.halfSize[i] = subject.hasBounds ? static_cast<float>(std::sqrt(d.dot(d))) : 0.0f;
    if (box.halfSize[i] > box.halfSize[box.longest]) box.longest = i;
    if (box.halfSize[i] < box.halfSize[box.thinnest]) box.thinnest = i;
  }
  return box;
}

// The plane's normal on the light's side.
V3f litNormal(const Box& box, const Light& light) {
  const V3f normal = box.side[box.thinnest];
  const V3f towards =
      light.type == Light::Type::sun ? -light.direction : light.position - box.center;
  return normal.dot(towards) < 0 ? -normal : normal;
}

int automaticCount(const Box& box) {
  const float length = box.halfSize[box.longest];
  const int other = 3 - box.longest - box.thinnest;
  const float width = box.longest == box.thinnest ? length : box.halfSize[other];
  if (!(width > 0.0f) || length < 2.0f * width) return 1;
  // Held to 5 as a float: a needle's count is beyond any int.
  return static_cast<int>(std::min(5.0f, std::floor(length / width + 0.5f)));
}

std::vector<V3f> spacedPoints(const Box& box, int count) {
  std::vector<V3f> points;
  for (int i = 0; i < count; ++i) {
    const float place = (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(count) - 1.0f;
    points.push_back(box.center + box.side[box.longest] * (place * box.halfSize[box.longest]));
  }
  return points;
}

// Direction in which the given points spread most, so that they can be put in order.
V3f longSideOf(const std::vector<V3f>& points, const V3f& otherwise) {
  V3f best = otherwise;
  float farthest = 0;
  for (size_t i = 1; i < points.size(); ++i) {
    const V3f d = points[i] - points[0];
    const float length = std::sqrt(d.dot(d));
    if (length > farthest) {
      farthest = length;
      best = d / length;
    }
  }
  return best;
}

// By the octave's number alone, so that an octave keeps its place while others come and go.
float octaveShift(float octave) {
  const float turns = 0.618034f * octave;
  return turns - std::floor(turns);
}

float coarserShare(float beyond, float fade) {
  const float share = (beyond - 0.5f) / fade + 0.5f;
  return share > 0.0f ? (share < 1.0f ? share : 1.0f) : 0.0f;
}

// Md near `wanted`, in octaves of what it is: the finer one, with `fade` of the gap to the next one
// in the middle over which the two change places.
void fitOctave(BrushAnchor& anchor, float wanted, float fade) {
  const float octaves = log2Of(wanted / anchor.mappingDistance);
  if (!std::isfinite(octaves)) return;
  const float whole = std::floor(octaves);
  anchor.mappingDistance *= exp2Of(whole);
  anchor.octaves = octaves;
  anchor.octaveFade = fade;
  anchor.coarser = coarserShare(octaves - whole, fade);
  anchor.shift = octaveShift(whole);
  anchor.coarserShift = octaveShift(whole + 1.0f);
}

// A ground that reaches far beyond all else gets strokes that fit the scene. The scene's size may
// change from frame to frame, so in octaves of the ground's own, or strokes would slide.
void fitScene(BrushAnchor& anchor, const BrushSubject& subject, bool seed) {
  const float wanted = 0.25f * subject.sceneRadius;
  if (!subject.flat || !(wanted > 0.0f) || wanted >= anchor.mappingDistance) return;
  fitOctave(anchor, wanted, sceneFade);
  if (!seed) return;
  if (anchor.coarser > 0.5f) anchor.mappingDistance *= 2.0f;
  anchor.coarser = 0;
}

}  // namespace

StrokeOctave strokeOctave(const BrushAnchor& anchor, float stretched) {
  const float octaves = anchor.octaves - stretched;
  const float whole = std::floor(octaves);
  return {anchor.mappingDistance * exp2Of(whole - std::floor(anchor.octaves)),
          coarserShare(octaves - whole, anchor.octaveFade), octaveShift(whole),
          octaveShift(whole + 1.0f)};
}

std::vector<V3f> referencePoints(const BrushSubject& subject, const Light& light,
                                 const BrushParams& params) {
  if (!subject.referencePoints.empty()) return subject.referencePoints;
  const Box box = worldBox(subject);
  if (subject.flat) {
    if (light.type == Light::Type::sun) return {box.center};
    const V3f normal = box.side[box.thinnest];
    return {light.position - normal * normal.dot(light.position - box.center)};
  }
  return spacedPoints(box, params.points > 0 ? params.points : automaticCount(box));
}

float automaticMappingDistance(const BrushSubject& subject) {
  if (!subject.hasBounds) return 1.0f;
  const Box box = worldBox(subject);
  float sum = box.halfSize[0] + box.halfSize[1] + box.halfSize[2];
  float size = sum / 3.0f;
  if (subject.flat) {
    size = (sum - box.halfSize[box.thinnest]) / 2.0f;
  }
  return size > 0.0f && std::isfinite(size) ? size / 4.0f : 1.0f;
}

BrushAnchor makeBrushAnchor(const BrushSubject& subject, const Light& light,
                            const BrushParams& params) {
  BrushAnchor anchor;
  const Box box = worldBox(subject);
  const bool seed = params.mapping == BrushParams::Mapping::seed;
  const bool automaticGround = subject.flat && subject.referencePoints.empty();
  anchor.object = objectAxes(subject.worldFromObject);
  anchor.strip = subject.strip;
  const std::vector<V3f> points = referencePoints(subject, light, params);
  anchor.longSide = longSideOf(points, box.side[box.longest]);
  for (const V3f& point : points) {
    const V3f axis = automaticGround ? -litNormal(box, light) : lightAxis(light, point);
    anchor.points.push_back({point, seed ? seedFrame(axis) : turningFrame(axis, anchor.object),
                             anchor.longSide.dot(point - anchor.object.origin)});
  }
  std::stable_sort(anchor.points.begin(), anchor.points.end(),
                   [](const auto& a, const auto& b) { return a.along < b.along; });
  const float given =
      subject.mappingDistance > 0.0f ? subject.mappingDistance : params.mappingDistance;
  anchor.mappingDistance = given > 0.0f ? given : automaticMappingDistance(subject);
  if (params.size == BrushParams::Size::screen && subject.worldPerPixel > 0.0f && !seed)
    fitOctave(anchor, params.stripPixels * subject.worldPerPixel / (2.0f * pi), 1.0f);
  else if (!(given > 0.0f))
    fitScene(anchor, subject, seed);
  return anchor;
}

}  // namespace kagefude
