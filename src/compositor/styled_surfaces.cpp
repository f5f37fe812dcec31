#include "compositor/styled_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/glob.h"
#include "base/nearest_name.h"
#include "compositor/own_lights.h"
#include "compositor/stroke_grounds.h"
#include "compositor/surface_index.h"
#include "image/real_math.h"

namespace kagefude {
namespace {

/// Whether a name fits, whole or without the library that tells it from others: Body [cast.blend].
bool fits(const std::string& name, const std::vector<std::string>& patterns) {
  if (matchesAny(name, patterns)) return true;
  const size_t library = name.rfind(" [");
  return library != std::string::npos && name.back() == ']' &&
         matchesAny(name.substr(0, library), patterns);
}

bool matches(const StyleParams& style, const FramePlan& plan, const Surface& surface) {
  if (style.index != 0 && plan.idSource != IdSource::cryptomatte)
    return surface.object == static_cast<uint32_t>(style.index);
  if (style.index != 0) {
    const SidecarObject* object = plan.findObject(surface.object);
    return object && object->index == static_cast<uint32_t>(style.index);
  }
  if (!style.object.empty() && !fits(plan.objectName(surface.object), style.object)) return false;
  if (!style.material.empty()) {
    const auto name = plan.materialNames.find(surface.material);
    if (name == plan.materialNames.end() || !fits(name->second, style.material)) return false;
  }
  return true;
}

const StyleLook* styleFor(const Look& look, const FramePlan& plan, const Surface& surface) {
  return chooseStyle(look.styles,
                     [&](const StyleParams& style) { return matches(style, plan, surface); });
}

const FrameLight& lightFor(const Look& look, const FramePlan& plan, const StyleLook& styled) {
  const StyleParams& style = styled.style;
  if (style.light.empty())
    return *std::max_element(
        plan.lights.begin(), plan.lights.end(),
        [](const FrameLight& a, const FrameLight& b) { return a.weight.lead < b.weight.lead; });
  std::vector<std::string> names;
  for (const FrameLight& light : plan.lights) {
    if (light.name == style.light) return light;
    names.push_back(light.name);
  }
  throw LookError(
      fmt::format("{} {} is no light of the frame{}; there are {}",
                  look.keyWithPlace(fmt::format("style[{}].light", &styled - look.styles.data())),
                  style.light, didYouMean(style.light, names), listNames(names)));
}

struct VisibleBounds {
  V3f low{1e30f, 1e30f, 1e30f};
  V3f high{-1e30f, -1e30f, -1e30f};
};

/// Bounds of what is seen of every surface, by number - 1, in one look at the frame. Empty where
/// the JSON describes every surface, or the look says how large the scene is.
std::vector<VisibleBounds> visibleBounds(const Look& look, const FramePlan& plan,
                                         const SurfaceIndex& index, Vec3View position) {
  const bool needed =
      !look.scene.sizes() &&
      std::any_of(index.surfaces.begin(), index.surfaces.end(),
                  [&](const Surface& surface) { return !plan.findObject(surface.object); });
  if (!needed) return {};
  std::vector<VisibleBounds> bounds(index.surfaces.size());
  for (int y = 0; y < index.plane.height(); ++y)
    for (int x = 0; x < index.plane.width(); ++x) {
      const uint16_t number = index.plane(x, y);
      if (number == 0) continue;
      VisibleBounds& own = bounds[number - 1u];
      const V3f p = position(x, y);
      for (int k = 0; k < 3; ++k) {
        own.low[k] = std::min(own.low[k], p[k]);
        own.high[k] = std::max(own.high[k], p[k]);
      }
    }
  return bounds;
}

/// How far the scene is from the camera: of the whole shot where it is known, so that no frame
/// depends on what it shows.
double sceneDistance(const SceneParams& scene, const Sidecar& sidecar, const V3f& sceneCentre) {
  if (scene.distance > 0.0f) return scene.distance;
  if (sidecar.shot && sidecar.shot->distance > 0) return sidecar.shot->distance;
  return -sidecar.camera.cameraFromWorld.point(V3d(sceneCentre)).z;
}

/// Width of a pixel at a point in the world; 0 where it is not known. Never less than at a tenth of
/// the scene's distance: a ground's middle may lie beside or behind the camera.
float pixelWidthAt(const SceneParams& scene, const FramePlan& plan, const V3f& point,
                   const V3f& sceneCentre) {
  if (!plan.sidecar || plan.image.displayWindow.width <= 0) return 0;
  const Camera& camera = plan.sidecar->camera;
  const double scale = camera.clipFromCamera.m[0][0] * plan.image.displayWindow.width;
  if (!(scale > 0)) return 0;
  if (!camera.perspective) return static_cast<float>(2 / scale);
  const double depth = -camera.cameraFromWorld.point(V3d(point)).z;
  const double sceneDepth = sceneDistance(scene, *plan.sidecar, sceneCentre);
  return static_cast<float>(std::max(std::max(depth, 0.1 * sceneDepth), 0.0) * 2 / scale);
}

/// Bounds of an object that no sidecar describes: the look's scene, or what is seen of it.
VisibleBounds boundsWithoutSidecar(const SceneParams& scene, const VisibleBounds& seen) {
  const bool placed = !scene.centre.empty(), sized = scene.radius > 0.0f;
  const V3f centre = placed ? V3f(scene.centre[0], scene.centre[1], scene.centre[2])
                            : (seen.low + seen.high) * 0.5f;
  const V3f half = sized ? V3f(scene.radius) : (seen.high - seen.low) * 0.5f;
  return {centre - half, centre + half};
}

/// The axes of an object that no sidecar describes are the world's, had that its Z up: strokes
/// turn about the object's Z.
Transform worldFromUpright(WorldUp up) {
  if (up == WorldUp::z) return {};
  return Transform{{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1}}};
}

VisibleBounds uprightBounds(WorldUp up, const VisibleBounds& world) {
  if (up == WorldUp::z) return world;
  return {{world.low.x, -world.high.z, world.low.y}, {world.high.x, -world.low.z, world.high.y}};
}

/// Whether strokes of an object that no sidecar describes change with what a frame shows of it.
bool movesWithView(const StyleLook& style, const SceneParams& scene) {
  const bool placed = !style.style.reference.empty() || !scene.centre.empty();
  const bool sized = style.passes.brush.mappingDistance > 0.0f || scene.radius > 0.0f;
  return !placed || !sized;
}

/// Bounds of an object as it rests where its strokes lie there, so that no pose moves or sizes
/// them.
void takeBounds(const SidecarObject& object, bool atRest, BrushSubject& subject) {
  const bool rest = atRest && object.restBounds;
  subject.boundsMin = V3f(rest ? (*object.restBounds)[0] : object.boundsMin);
  subject.boundsMax = V3f(rest ? (*object.restBounds)[1] : object.boundsMax);
}

BrushSubject subjectOf(const StyleLook& styled, const Look& look, const FramePlan& plan,
                       const FrameLight& light, const Surface& surface, const VisibleBounds& seen,
                       bool atRest, std::set<std::string>& unbounded) {
  const StyleParams& style = styled.style;
  BrushSubject subject;
  subject.sceneRadius = light.subjectRadius;
  const SidecarObject* const object = plan.findObject(surface.object);
  if (object) {
    subject.worldFromObject = object->worldFromObject;
    takeBounds(*object, atRest, subject);
    subject.hasBounds = true;
    subject.flat = object->flat;
  } else {
    const VisibleBounds bounds =
        uprightBounds(look.frame.up, boundsWithoutSidecar(look.scene, seen));
    subject.worldFromObject = worldFromUpright(look.frame.up);
    subject.boundsMin = bounds.low;
    subject.boundsMax = bounds.high;
    subject.hasBounds = true;
    if (movesWithView(styled, look.scene)) {
      const std::string name = plan.objectName(surface.object);
      unbounded.insert(name.empty() ? fmt::format("{:08x}", surface.object) : name);
    }
  }
  if (object)
    for (const V3d& point : object->referencePoints) subject.referencePoints.push_back(V3f(point));
  const V3d middle = (V3d(subject.boundsMin) + V3d(subject.boundsMax)) * 0.5;
  const V3f centre = subject.flat && light.subjectRadius > 0
                         ? light.subjectCentre
                         : V3f(subject.worldFromObject.point(middle));
  subject.worldPerPixel = pixelWidthAt(look.scene, plan, centre, light.subjectCentre);
  if (!style.reference.empty())
    subject.referencePoints = {V3f(style.reference[0], style.reference[1], style.reference[2])};
  return subject;
}

/// One line for all of them.
void noteUnbounded(const std::set<std::string>& objects, std::vector<std::string>& warnings) {
  if (objects.empty()) return;
  warnings.push_back(fmt::format(
      "objects have no bounds in a sidecar ({}), so their strokes are placed and sized by what a "
      "frame shows of them and will change with the view; give scene.centre and scene.radius, or "
      "style.reference and brush.mapping_distance",
      listNames({objects.begin(), objects.end()})));
}

/// Surfaces without any diffuse colour (glass, metal), of which a strip that multiplies makes
/// black.
void noteBlack(const FramePlan& plan, const FramePlanes& planes, const SurfaceIndex& index,
               const std::vector<bool>& multiplies, std::vector<std::string>& warnings) {
  if (planes.albedo.empty() || std::none_of(multiplies.begin(), multiplies.end(), std::identity()))
    return;
  std::vector<bool> black = multiplies;
  for (int y = 0; y < planes.height; ++y)
    for (int x = 0; x < planes.width; ++x) {
      const uint16_t number = index.plane(x, y);
      if (number != 0 && black[number - 1u] && planes.albedo.view()(x, y) != V3f(0.0f))
        black[number - 1u] = false;
    }
  std::set<std::string> names;
  for (size_t i = 0; i < black.size(); ++i)
    if (const std::string name = plan.objectName(index.surfaces[i].object);
        black[i] && !name.empty())
      names.insert(name);
  if (names.empty()) return;
  warnings.push_back(
      fmt::format("surfaces have no diffuse colour, as glass and metal have none ({}), so a strip "
                  "that multiplies "
                  "the colour is black there; give them a style with colour = \"replace\"",
                  listNames({names.begin(), names.end()})));
}

/// Pixels that the strip's width covers where the subject stands.
float stripPixelsOf(const BrushSubject& subject, const BrushAnchor& anchor) {
  if (!(subject.worldPerPixel > 0.0f)) return 0.0f;
  const float width = anchor.mappingDistance * (1.0f + anchor.coarser);
  return 2.0f * pi * width / subject.worldPerPixel;
}

/// Widths that keep to the object as pixels.
PaintedEdgeParams edgesOf(PaintedEdgeParams edges, float stripPixels, float wantedPixels) {
  if (edges.size == PaintedEdgeParams::Size::screen || !(stripPixels > 0.0f)) return edges;
  const float factor = stripPixels / wantedPixels;
  for (float* width : {&edges.rough, &edges.dryWidth, &edges.rim, &edges.lost}) *width *= factor;
  return edges;
}

/// Of each style of the look: what StyledSurfaces says of fitting and outranked ones.
void noteFitting(const Look& look, const FramePlan& plan, const SurfaceIndex& index,
                 StyledSurfaces& styled) {
  styled.fitting.resize(look.styles.size());
  styled.outranked.resize(look.styles.size());
  for (const Surface& surface : index.surfaces) {
    const StyleLook* const found = styleFor(look, plan, surface);
    if (!found) continue;
    for (size_t i = 0; i < look.styles.size(); ++i) {
      if (styled.fitting[i] && styled.outranked[i]) continue;
      const StyleParams& style = look.styles[i].style;
      if (!matches(style, plan, surface)) continue;
      styled.fitting[i] = true;
      if (found->style.priority > style.priority) styled.outranked[i] = true;
    }
  }
}

}  // namespace

void levelTone(const ToneFloor& floor, const StyledSurfaces& styled, View<float> tone) {
  raiseTone(tone, styled.anchorIndex, styled.tones, floor);
  adjustTone(tone, styled.anchorIndex, styled.tones);
}

bool paintsEdges(const StyledSurfaces& styled) {
  return std::any_of(styled.edges.begin(), styled.edges.end(),
                     [](const PaintedEdgeParams& edges) { return edges.acts(); });
}

StyledSurfaces styleSurfaces(const Look& look, const StripSet& strips, const FramePlan& plan,
                             const FramePlanes& planes, std::vector<std::string>& warnings) {
  SurfaceIndex index = indexSurfaces(planes);
  const std::vector<VisibleBounds> seen = visibleBounds(look, plan, index, planes.position);
  StyledSurfaces result;
  result.objects.push_back(0);
  const StyleLook fallback{{}, look.passes};
  std::set<std::string> unbounded;
  OwnLights ownLights(look, strips, plan);
  StrokeGrounds grounds(plan, planes, index.plane, index.surfaces.size());
  noteFitting(look, plan, index, result);
  for (size_t number = 1; number <= index.surfaces.size(); ++number) {
    const StyleLook* found = styleFor(look, plan, index.surfaces[number - 1]);
    const StyleLook& style = found ? *found : fallback;
    const FrameLight& light = lightFor(look, plan, style);
    const uint32_t object = index.surfaces[number - 1].object;
    result.objects.push_back(object);
    BrushParams brush = style.passes.brush;
    const bool atRest = grounds.choose(number, object, brush);
    BrushSubject subject =
        subjectOf(style, look, plan, light, index.surfaces[number - 1],
                  seen.empty() ? VisibleBounds{} : seen[number - 1], atRest, unbounded);
    subject.strip = strips.indexOf(style.style.strip);
    result.anchors.push_back(makeBrushAnchor(subject, light.light, brush));
    result.anchors.back().atRest = atRest;
    if (atRest) grounds.lay(number, object, subject, result.anchors.back());
    ownLights.add(style.style, subject, result.anchors.back(), brush);
    result.styles.push_back(found ? static_cast<int>(found - look.styles.data()) : -1);
    result.brushes.push_back(style.passes.brush);
    result.tones.push_back(style.passes.tone);
    result.multiplies.push_back(multipliesColour(style.style, style.style.strip));
    const std::vector<float>& line = style.style.outlineColour;
    const auto colour = line.empty() ? std::nullopt : std::optional(V3f(line[0], line[1], line[2]));
    result.outlines.push_back({colour, style.passes.outline});
    result.stripPixels.push_back(stripPixelsOf(subject, result.anchors.back()));
    result.edges.push_back(
        edgesOf(style.passes.edges, result.stripPixels.back(), style.passes.brush.stripPixels));
    result.tints.push_back(style.passes.tint);
  }
  result.ownLights = ownLights.take();
  result.rest = grounds.places(planes, index.plane);
  noteUnbounded(unbounded, warnings);
  noteBlack(plan, planes, index, result.multiplies, warnings);
  grounds.noteMissing(warnings);
  result.anchorIndex = std::move(index.plane);
  return result;
}

}  // namespace kagefude
