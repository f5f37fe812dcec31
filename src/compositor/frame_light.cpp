#include "compositor/frame_light.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "base/frame_pattern.h"
#include "base/glob.h"
#include "base/nearest_name.h"
#include "compositor/automatic_method.h"
#include "compositor/output_layers.h"
#include "frame/frame_camera.h"

namespace kagefude {
namespace {

V3f toFloat(const V3d& v) { return V3f(v); }

LightType kindOf(LightKind kind) {
  if (kind == LightKind::automatic) return LightType::point;
  return static_cast<LightType>(static_cast<int>(kind) - static_cast<int>(LightKind::point));
}

/// The settings of the last [[light]] that matches, or the look's own.
const LightLook* settingsOf(const Look& look, const std::string& name) {
  const LightLook* found = nullptr;
  for (const LightLook& light : look.lights)
    if (matchesGlob(name, light.light.name)) found = &light;
  return found;
}

/// A key of a [[light]], as --set names it.
std::string lightKey(const Look& look, const LightLook& settings, std::string_view key) {
  return fmt::format("light[{}].{}", &settings - look.lights.data(), key);
}

/// Where a key of a [[light]] stands, as messages begin: "look.toml:12: ".
std::string leadOf(const Look& look, const LightLook& settings, std::string_view key) {
  const std::string place = look.placeOf(lightKey(look, settings, key));
  return place.empty() ? "" : place + ": ";
}

/// A light's own key of [shadow], else the look's.
std::string shadowKey(const Look& look, const LightLook* settings, const std::string& key) {
  const std::string own = settings ? lightKey(look, *settings, "shadow." + key) : "";
  return look.keyWithPlace(look.placeOf(own).empty() ? "shadow." + key : own);
}

void applySettings(const Look& look, const LightLook* settings, FrameLight& light) {
  const ShadowParams& shadow = settings ? settings->shadow : look.shadow;
  light.castPlaces = shadow.places;
  light.receiver = shadow.receiver;
  if (!shadow.blob.empty()) {
    light.blob = look.resolve(shadow.blob);
    light.blobNamed = shadowKey(look, settings, "blob");
  }
  light.method = shadow.method;
  light.automatic = shadow.method == ShadowMethod::automatic;
  light.strength = shadow.strength;
  light.passes = settings ? settings->passes : look.passes;
}

/// World vectors of one unit of place; nothing for a pair, which lies along the light's axis.
std::optional<LightGeometry> geometryOf(const SidecarLight& source) {
  if (!source.masks || source.masks->arrangement == MaskArrangement::pair ||
      source.axisU == V3d(0, 0, 0))
    return std::nullopt;
  const double offset = source.masks->offset;
  const bool round = source.type == LightType::point || source.type == LightType::spot;
  return LightGeometry{source.type == LightType::sun,
                       toFloat(source.position),
                       toFloat(source.direction),
                       toFloat(source.axisU * offset),
                       toFloat(source.axisV * source.masks->offsetV),
                       round && source.masks->arrangement == MaskArrangement::disc};
}

/// From a round light's centre to the farther mask of a pair; nothing for other lights.
V3f towardsFarMask(const SidecarLight& source) {
  const bool round = source.type == LightType::point || source.type == LightType::spot;
  if (!round || !source.masks || source.masks->arrangement != MaskArrangement::pair)
    return V3f(0, 0, 0);
  return toFloat(source.axisU * source.masks->offset);
}

/// What only describes a light of the look's own would do nothing on one that the JSON describes.
void refuseOwnDescription(const Look& look, const LightLook* settings, const SidecarLight& source) {
  if (!settings) return;
  const LightParams& params = settings->light;
  const auto refuse = [&](bool given, const char* key) {
    if (given)
      throw LookError(fmt::format(
          "{}light.{} does nothing on light {}, which the JSON describes; leave it out, or give "
          "the light another name",
          leadOf(look, *settings, key), key, source.name));
  };
  refuse(!params.masks.empty(), "masks");
  refuse(!params.places.empty(), "places");
  refuse(!params.depthMap.empty(), "depth_map");
  refuse(!params.lightFromWorld.empty(), "light_from_world");
  refuse(!params.clipFromLight.empty(), "clip_from_light");
  refuse(params.type != LightKind::automatic && kindOf(params.type) != source.type, "type");
}

/// Lays down what the look or the JSON says of the light's brightness.
void weigh(const SidecarLight& source, const WholeShot* shot, const LightLook* settings,
           FrameLight& light) {
  const bool moved =
      settings && !(settings->light.position.empty() && settings->light.direction.empty());
  light.weight =
      weighLight(source, shot, light.light, moved, settings ? settings->light.weight : -1.0f);
}

bool needsMasks(ShadowMethod method) { return entryOf(method).needs.masks.fewest > 0; }

V3f vectorFrom(const std::vector<float>& numbers, const V3f& otherwise) {
  return numbers.empty() ? otherwise : V3f(numbers[0], numbers[1], numbers[2]);
}

/// Lays the look's own place and size over a light; then masks and depth map no longer fit it.
bool moveLight(const LightLook* settings, FrameLight& light) {
  if (!settings) return false;
  const LightParams& params = settings->light;
  if (params.position.empty() && params.direction.empty() && params.radius == 0.0f) return false;
  light.light.position = vectorFrom(params.position, light.light.position);
  light.light.direction = vectorFrom(params.direction, light.light.direction).normalized();
  if (params.radius > 0.0f) light.light.radius = params.radius;
  return true;
}

DepthMapSource depthMapOf(const LightDepthMap& map) {
  return {map.file,          map.channel, map.lightFromWorld,
          map.clipFromLight, "",          SaidOfDepthMap{map.width, map.height, map.perspective}};
}

FrameLight fromSidecar(const Look& look, const SidecarLight& source, const WholeShot* shot,
                       bool hasCasters) {
  FrameLight light;
  light.name = source.name;
  light.light = {source.type,
                 toFloat(source.position),
                 toFloat(source.direction),
                 static_cast<float>(source.radius),
                 static_cast<float>(source.coneAngle),
                 static_cast<float>(source.coneBlend)};
  light.subjectCentre = toFloat(source.subjectCenter);
  light.subjectRadius = static_cast<float>(source.subjectRadius);
  const LightLook* const settings = settingsOf(look, source.name);
  refuseOwnDescription(look, settings, source);
  applySettings(look, settings, light);
  const bool moved = moveLight(settings, light);
  weigh(source, shot, settings, light);
  // Without shadow there are no masks and no depth map either.
  if (!source.castsShadow) light.method = ShadowMethod::none;
  if (moved) {
    if (light.method == ShadowMethod::automatic) light.method = casterMethod(light.light.radius);
    return light;
  }
  if (light.method == ShadowMethod::automatic)
    light.method =
        automaticMethod(source, light.passes.lightShape.depthMap, hasCasters, light.light.radius);
  if (entryOf(light.method).needs.traced) light.tracedChannel = source.tracedLayer;
  if (source.depthMap) light.depthMap = depthMapOf(*source.depthMap);
  light.geometry = geometryOf(source);
  light.towardsFar = towardsFarMask(source);
  if (needsMasks(light.method) && source.masks)
    for (const MaskSample& sample : source.masks->samples) {
      light.maskChannels.push_back(sample.layer);
      light.places.emplace_back(static_cast<float>(sample.u), static_cast<float>(sample.v));
    }
  return light;
}

/// Places of masks that the look names without saying where they stand on the light: two are a
/// pair on the axis; more are a centre and a ring.
std::vector<V2f> defaultPlaces(size_t count) {
  if (count == 2) return {{1, 0}, {-1, 0}};
  std::vector<V2f> places{{0, 0}};
  for (size_t i = 1; i < count; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(i - 1) / static_cast<double>(count - 1);
    places.emplace_back(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
  }
  return places;
}

std::vector<V2f> placesFrom(const Look& look, const LightLook& settings) {
  const LightParams& params = settings.light;
  if (params.places.empty()) return defaultPlaces(params.masks.size());
  if (params.places.size() != 2 * params.masks.size())
    throw LookError(fmt::format("{}light {} has {} masks, so light.places wants {} numbers, not {}",
                                leadOf(look, settings, "places"), params.name, params.masks.size(),
                                2 * params.masks.size(), params.places.size()));
  std::vector<V2f> places;
  for (size_t i = 0; i < params.masks.size(); ++i)
    places.emplace_back(params.places[2 * i], params.places[2 * i + 1]);
  return places;
}

FrameLight fromLook(const Look& look, const LightLook& settings, int frame, bool hasCasters) {
  const LightParams& params = settings.light;
  FrameLight light;
  light.name = params.name;
  light.light.type = kindOf(params.type);
  light.light.position = vectorFrom(params.position, {0, 0, 0});
  light.light.direction = vectorFrom(params.direction, {0, 0, -1}).normalized();
  light.light.radius = params.radius;
  light.weight = weighOwnLight(params.weight);
  applySettings(look, &settings, light);
  if (light.method == ShadowMethod::automatic)
    light.method = automaticMethod(params, light.passes.lightShape.depthMap, hasCasters);
  if (needsMasks(light.method)) {
    light.maskChannels = params.masks;
    light.places = placesFrom(look, settings);
  }
  if (!params.depthMap.empty()) {
    if (params.lightFromWorld.empty() || params.clipFromLight.empty())
      throw LookError(fmt::format(
          "{}light {} has a depth_map, so it wants light_from_world and clip_from_light too",
          leadOf(look, settings, "depth_map"), params.name));
    light.depthMap = {look.resolve(FramePattern(params.depthMap).path(frame).string()), "",
                      matrixFrom(params.lightFromWorld), matrixFrom(params.clipFromLight),
                      look.keyWithPlace(lightKey(look, settings, "depth_map"))};
  }
  return light;
}

bool isGlob(const std::string& name) { return name.find_first_of("*?") != std::string::npos; }

bool describesLight(const LightParams& params) {
  return !params.position.empty() || (!params.direction.empty() && params.type == LightKind::sun);
}

std::vector<FrameLight> allLights(const Look& look, const Sidecar* sidecar, int frame,
                                  bool hasCasters) {
  std::vector<FrameLight> lights;
  if (sidecar)
    for (const SidecarLight& light : sidecar->lights)
      lights.push_back(
          fromSidecar(look, light, sidecar->shot ? &*sidecar->shot : nullptr, hasCasters));
  for (const LightLook& settings : look.lights) {
    const std::string& name = settings.light.name;
    if (isGlob(name) || (sidecar && sidecar->findLight(name))) continue;
    if (!describesLight(settings.light)) {
      std::vector<std::string> names;
      for (const FrameLight& light : lights) names.push_back(light.name);
      throw InputError(fmt::format(
          "the look's light {} is not in the frame's sidecar (lights: {}){}; name one of them, or "
          "give the light's position (or a sun's direction) in the look",
          name, listNames(names), didYouMean(name, names)));
    }
    lights.push_back(fromLook(look, settings, frame, hasCasters));
  }
  return lights;
}

void checkMasks(const FrameLight& light, const ShadowMethodEntry& method) {
  const size_t count = light.maskChannels.size();
  const MaskNeed& need = method.needs.masks;
  if (count < need.fewest)
    throw InputError(fmt::format(
        "light {} has {} masks, but shadow.method = \"{}\" needs {} or more; export it with "
        "--masks {}",
        light.name, count, method.name, need.fewest, need.exportAs));
  if (need.most && count > need.most)
    throw InputError(
        fmt::format("light {} has {} masks, but shadow.method = \"{}\" needs the {} of --masks {}",
                    light.name, count, method.name, need.most, need.exportAs));
}

void checkMethod(const Look& look, const FrameLight& light, bool hasCasters) {
  const ShadowMethodEntry& method = entryOf(light.method);
  if (method.needs.casters && !hasCasters)
    throw InputError(fmt::format(
        "light {} takes its shadow from the casters (shadow.method = \"{}\"), but the frame brings "
        "none; export it with --casters",
        light.name, method.name));
  if (method.needs.receiver && light.receiver.empty())
    throw LookError(
        fmt::format("{} = \"{}\" wants shadow.receiver, the name of the flat object that the "
                    "shadow falls on",
                    shadowKey(look, settingsOf(look, light.name), "method"), method.name));
  if (method.needs.depthMap && !light.depthMap)
    throw InputError(fmt::format(
        "light {} has no depth map, which shadow.method = \"{}\" needs; export it again with the "
        "exporter, which writes one for each light",
        light.name, method.name));
  if (method.needs.traced && light.tracedChannel.empty())
    throw InputError(fmt::format(
        "light {} has no traced visibility, which shadow.method = \"{}\" needs; export it with "
        "--masks trace:64",
        light.name, method.name));
  checkMasks(light, method);
}

/// Whether the light is a sphere, or a sun, whose masks a depth map can be held against.
bool isRound(const FrameLight& light) {
  const std::optional<LightGeometry>& geometry = light.geometry;
  if (!geometry) return false;
  const float u = geometry->u.length(), v = geometry->v.length();
  return (geometry->sphere || geometry->sun) && std::fabs(u - v) <= 0.01f * u;
}

bool readsDepthMap(const FrameLight& light) {
  const ShadowNeeds& needs = entryOf(light.method).needs;
  return needs.depthMap || (needs.depthMapHelps && light.depthMap && isRound(light) &&
                            light.passes.lightShape.depthMap);
}

/// The look's own scene, the same in every frame, over what the sidecar says.
void sizeByScene(const SceneParams& scene, FrameLight& light) {
  light.subjectCentre = vectorFrom(scene.centre, light.subjectCentre);
  if (scene.radius > 0.0f) light.subjectRadius = scene.radius;
}

}  // namespace

std::vector<FrameLight> gatherLights(const Look& look, const Sidecar* sidecar,
                                     const ImageFile& image, int frame, bool hasCasters) {
  std::vector<FrameLight> chosen;
  std::vector<std::string> names;
  for (FrameLight& light : allLights(look, sidecar, frame, hasCasters)) {
    names.push_back(light.name);
    const LightLook* const settings = settingsOf(look, light.name);
    if (!matchesAny(light.name, look.shadow.lights) || (settings && !settings->light.on)) continue;
    checkMethod(look, light, hasCasters);
    sizeByScene(look.scene, light);
    light.readsDepthMap = readsDepthMap(light);
    light.tellsConfidence = asksFor(look, "confidence." + light.name);
    for (std::string& mask : light.maskChannels) mask = requireMaskChannel(image, mask);
    if (!light.tracedChannel.empty())
      light.tracedChannel = requireMaskChannel(image, light.tracedChannel);
    chosen.push_back(std::move(light));
  }
  if (chosen.empty())
    throw InputError(fmt::format(
        "no light takes part in {}: shadow.lights asks for {}, the frame has {}{}",
        image.path.filename().string(), listNames(look.shadow.lights), listNames(names),
        names.empty() ? "; export a light with the frame, or describe one in the look" : ""));
  std::vector<LightWeight*> weights;
  for (FrameLight& light : chosen) weights.push_back(&light.weight);
  weighUnknown(weights);
  return chosen;
}

}  // namespace kagefude
