#include "frame/sidecar.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/error.h"
#include "frame/cryptomatte.h"
#include "frame/json_reader.h"

namespace kagefude {
namespace {

using detail::JsonPlace;

constexpr int formatVersion = 1;
constexpr double large = 1e30;
constexpr int longestSide = 1 << 17;
constexpr int mostFrames = 100'000'000;
constexpr int largestScale = 64;
constexpr size_t mostLights = 1024, mostSamples = 256;

template <class Named>
void checkNames(const JsonPlace& list, const std::vector<Named>& items) {
  std::set<std::string_view> names;
  for (const Named& item : items) {
    if (!names.insert(item.name).second) {
      list.refuse(fmt::format("a list of different names (\"{}\" comes twice)", item.name));
    }
  }
}

Camera readCamera(const JsonPlace& json) {
  Camera camera;
  camera.perspective = json["type"].choice({"perspective", "orthographic"}) == 0;
  camera.position = json["position"].vector();
  camera.direction = json["direction"].unitVector();
  camera.cameraFromWorld = json["camera_from_world"].matrix();
  camera.clipFromCamera = json["clip_from_camera"].matrix();
  return camera;
}

MaskSample readSample(const JsonPlace& json) {
  MaskSample sample;
  sample.layer = json["layer"].name();
  if (json.has("direction")) sample.direction = json["direction"].unitVector();
  // A sun's samples may be given by direction alone.
  if (!sample.direction || json.has("position")) sample.position = json["position"].vector();
  const auto uv = json["uv"].list(2, 2);
  sample.u = uv[0].number(-1.001, 1.001);
  sample.v = uv[1].number(-1.001, 1.001);
  return sample;
}

LightMasks readMasks(const JsonPlace& json) {
  LightMasks masks;
  masks.arrangement = static_cast<MaskArrangement>(
      json["arrangement"].choice({"pair", "line", "disc", "hard", "grid"}));
  masks.offset = json["offset"].number(0, large);
  masks.offsetV = json.has("offset_v") ? json["offset_v"].number(0, large) : masks.offset;
  const bool pair = masks.arrangement == MaskArrangement::pair;
  const bool hard = masks.arrangement == MaskArrangement::hard;
  const bool grid = masks.arrangement == MaskArrangement::grid;
  const size_t fewest = masks.arrangement == MaskArrangement::disc ? 4 : grid ? 5 : hard ? 1 : 2;
  const size_t most = pair ? 2 : hard ? 1 : mostSamples;
  for (const JsonPlace& sample : json["samples"].list(fewest, most)) {
    masks.samples.push_back(readSample(sample));
  }
  return masks;
}

LightDepthMap readDepthMap(const JsonPlace& json) {
  LightDepthMap map;
  map.file = json["file"].fileBeside();
  map.channel = json["channel"].name();
  const auto resolution = json["resolution"].list(2, 2);
  map.width = resolution[0].integer(1, longestSide);
  map.height = resolution[1].integer(1, longestSide);
  map.perspective = json["projection"].choice({"perspective", "orthographic"}) == 0;
  map.lightFromWorld = json["light_from_world"].matrix();
  map.clipFromLight = json["clip_from_light"].matrix();
  return map;
}

void readSubject(const JsonPlace& json, SidecarLight& light) {
  light.subjectCenter = json["center"].vector();
  light.subjectRadius = json["radius"].number(0, large);
}

AreaShape readArea(const JsonPlace& json) {
  return {json["shape"].choice({"rectangle", "ellipse"}) == 1, json["half_u"].number(0, large),
          json["half_v"].number(0, large)};
}

ShotLight readShotLight(const JsonPlace& json) {
  ShotLight light{json["name"].name(),
                  json["irradiance"].number(0, large),
                  json["largest_irradiance"].number(0, large),
                  {},
                  {}};
  if (json.has("largest_power")) light.largestPower = json["largest_power"].number(0, large);
  if (json.has("largest_on_axis")) light.largestOnAxis = json["largest_on_axis"].number(0, large);
  return light;
}

WholeShot readShot(const JsonPlace& json) {
  WholeShot shot;
  shot.first = json["first"].integer(-mostFrames, mostFrames);
  shot.last = json["last"].integer(-mostFrames, mostFrames);
  shot.subjectCenter = json["subject"]["center"].vector();
  shot.subjectRadius = json["subject"]["radius"].number(0, large);
  shot.distance = json["distance"].number(0, large);
  for (const JsonPlace& light : json["lights"].list(0, mostLights))
    shot.lights.push_back(readShotLight(light));
  checkNames(json["lights"], shot.lights);
  return shot;
}

// What a light may leave out.
void readOptions(const JsonPlace& json, SidecarLight& light) {
  if (json.has("color")) {
    const auto color = json["color"].list(3, 3);
    for (size_t i = 0; i < 3; ++i) light.color[i] = color[i].number(0, large);
  }
  if (json.has("energy")) light.energy = json["energy"].number();
  if (json.has("shadow")) light.castsShadow = json["shadow"].boolean();
  if (json.has("area")) light.area = readArea(json["area"]);
  if (json.has("subject")) readSubject(json["subject"], light);
  if (json.has("axes")) {
    light.axisU = json["axes"]["u"].unitVector();
    light.axisV = json["axes"]["v"].unitVector();
  }
  if (json.has("masks")) light.masks = readMasks(json["masks"]);
  if (json.has("depth_map")) light.depthMap = readDepthMap(json["depth_map"]);
  if (json.has("traced")) light.tracedLayer = json["traced"]["layer"].name();
  if (json.has("truth_layer")) light.truthLayer = json["truth_layer"].text();
  if (json.has("truth_samples")) {
    light.truthSamples = json["truth_samples"].integer(0, 1 << 24);
  }
}

SidecarLight readLight(const JsonPlace& json) {
  SidecarLight light;
  light.name = json["name"].name();
  light.type = static_cast<LightType>(
      json["type"].choice({std::begin(lightTypeNames), std::end(lightTypeNames)}));
  light.position = json["position"].vector();
  light.direction = json["direction"].unitVector();
  light.radius = json["radius"].number(0, large);
  if (light.type == LightType::spot) {
    light.coneAngle = json["cone"]["angle"].number(0, 6.2831854);
    light.coneBlend = json["cone"]["blend"].number(0, 1);
  }
  readOptions(json, light);
  return light;
}

SidecarObject readObject(const JsonPlace& json) {
  SidecarObject object;
  object.name = json["name"].name();
  object.index = json.has("index") ? json["index"].index() : 0;
  object.cryptoId = json.has("crypto") ? json["crypto"].hexadecimal() : cryptomatteId(object.name);
  object.worldFromObject = json["world_from_object"].matrix();
  object.boundsMin = json["bounds"]["min"].vector();
  object.boundsMax = json["bounds"]["max"].vector();
  if (json.has("rest_bounds"))
    object.restBounds = {json["rest_bounds"]["min"].vector(), json["rest_bounds"]["max"].vector()};
  if (json.has("instanced")) object.instanced = json["instanced"].boolean();
  object.referencePoint = json["reference_point"].vector();
  if (json.has("reference_points")) {
    for (const JsonPlace& point : json["reference_points"].list()) {
      object.referencePoints.push_back(point.vector());
    }
  }
  if (json.has("materials")) {
    for (const JsonPlace& name : json["materials"].list()) object.materials.push_back(name.text());
  }
  if (json.has("painted")) object.painted = json["painted"].boolean();
  if (json.has("flat")) object.flat = json["flat"].boolean();
  return object;
}

SidecarMaterial readMaterial(const JsonPlace& json) {
  SidecarMaterial material;
  material.name = json["name"].name();
  material.index = json.has("index") ? json["index"].index() : 0;
  material.cryptoId =
      json.has("crypto") ? json["crypto"].hexadecimal() : cryptomatteId(material.name);
  return material;
}

SidecarCaster readCaster(const JsonPlace& json) {
  return {json["object"].text(), json["file"].fileBeside(), json["world_from_object"].matrix()};
}

void checkVersion(const JsonPlace& json, const std::filesystem::path& path) {
  const int version = json["kagefude"].integer(0, 1 << 20);
  if (version != formatVersion) {
    throw InputError(
        fmt::format("{} has format version {}, but this program reads version {}; {}",
                    path.string(), version, formatVersion,
                    version > formatVersion ? "use a newer kagefude" : "export the frame again"));
  }
}

void readFrame(const JsonPlace& json, Sidecar& sidecar) {
  sidecar.frame = json["frame"].integer(-mostFrames, mostFrames);
  sidecar.fps = json["fps"].number(1e-3, 1e6);
  if (json.has("image")) sidecar.image = json["image"].text();
  const auto resolution = json["resolution"].list(2, 2);
  sidecar.width = resolution[0].integer(1, longestSide);
  sidecar.height = resolution[1].integer(1, longestSide);
  if (json.has("pixel_aspect")) sidecar.pixelAspect = json["pixel_aspect"].number(1e-3, 1e3);
  if (json.has("scale")) sidecar.scale = json["scale"].integer(1, largestScale);
  if (json.has("shot")) sidecar.shot = readShot(json["shot"]);
  if (json.has("world")) {
    const JsonPlace radiance = json["world"]["radiance"];
    for (const JsonPlace& share : radiance.list(3, 3)) share.number(0, large);
    sidecar.worldRadiance = radiance.vector();
  }
  if (!json.has("layers")) return;
  const JsonPlace layers = json["layers"];
  if (layers.has("data")) sidecar.dataLayer = layers["data"].text();
  if (layers.has("beauty")) sidecar.beautyLayer = layers["beauty"].text();
  if (layers.has("lines")) sidecar.linesLayer = layers["lines"].text();
}

void readLists(const JsonPlace& json, Sidecar& sidecar) {
  for (const JsonPlace& light : json["lights"].list(0, mostLights)) {
    sidecar.lights.push_back(readLight(light));
  }
  checkNames(json["lights"], sidecar.lights);
  if (json.has("objects")) {
    for (const JsonPlace& object : json["objects"].list()) {
      sidecar.objects.push_back(readObject(object));
    }
    checkNames(json["objects"], sidecar.objects);
  }
  if (json.has("materials")) {
    for (const JsonPlace& material : json["materials"].list()) {
      sidecar.materials.push_back(readMaterial(material));
    }
    checkNames(json["materials"], sidecar.materials);
  }
  if (json.has("casters"))
    for (const JsonPlace& caster : json["casters"].list())
      sidecar.casters.push_back(readCaster(caster));
}

}  // namespace

namespace {

Sidecar sidecarFrom(const nlohmann::json& parsed, const std::filesystem::path& path) {
  const JsonPlace json(path, parsed, "");
  checkVersion(json, path);
  Sidecar sidecar;
  sidecar.path = path;
  readFrame(json, sidecar);
  sidecar.camera = readCamera(json["camera"]);
  readLists(json, sidecar);
  return sidecar;
}

}  // namespace

Sidecar readSidecar(const std::filesystem::path& path) {
  return sidecarFrom(JsonPlace::parseFile(path), path);
}

std::optional<Sidecar> findSidecar(const std::filesystem::path& imagePath) {
  std::filesystem::path path = imagePath;
  path.replace_extension(".json");
  std::error_code problem;
  if (!std::filesystem::exists(path, problem)) return std::nullopt;
  const nlohmann::json parsed = JsonPlace::parseFile(path);
  // Asset managers and other tools write JSONs beside frames as well.
  if (!parsed.is_object() || !parsed.contains("kagefude")) return std::nullopt;
  return sidecarFrom(parsed, path);
}

const SidecarLight* Sidecar::findLight(std::string_view name) const {
  const auto found = std::find_if(lights.begin(), lights.end(),
                                  [&](const SidecarLight& light) { return light.name == name; });
  return found == lights.end() ? nullptr : &*found;
}

const SidecarObject* Sidecar::findObject(std::string_view name) const {
  const auto found = std::find_if(objects.begin(), objects.end(),
                                  [&](const SidecarObject& o) { return o.name == name; });
  return found == objects.end() ? nullptr : &*found;
}

const SidecarObject* Sidecar::findObject(uint32_t index) const {
  const auto found = std::find_if(objects.begin(), objects.end(),
                                  [&](const SidecarObject& o) { return o.index == index; });
  return found == objects.end() ? nullptr : &*found;
}

}  // namespace kagefude
