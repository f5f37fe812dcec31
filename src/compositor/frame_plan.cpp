#include "compositor/frame_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "frame/cryptomatte.h"
#include "frame/read_channels.h"
#include "frame/sanitise.h"

namespace kagefude {
namespace {

AovNames namesFor(const Look& look, const std::optional<Sidecar>& sidecar) {
  AovNames names = look.frame;
  if (!sidecar) return names;
  if (names.layer.empty()) names.layer = sidecar->dataLayer;
  if (names.beautyLayer.empty()) names.beautyLayer = sidecar->beautyLayer;
  return names;
}

bool anyStyleHas(const Look& look, std::vector<std::string> StyleParams::*list) {
  return std::any_of(look.styles.begin(), look.styles.end(),
                     [&](const StyleLook& style) { return !(style.style.*list).empty(); });
}

std::map<uint32_t, std::string> namesOf(const ImageFile& image, const Aov& aov,
                                        std::vector<std::string>& warnings) {
  for (const Cryptomatte& matte : listCryptomattes(image)) {
    if (matte.name != aov.name) continue;
    Manifest manifest = readManifest(image, matte);
    warnings.insert(warnings.end(), manifest.warnings.begin(), manifest.warnings.end());
    return std::move(manifest.names);
  }
  return {};
}

/// Object ids: surfaces made elsewhere first; then the index pass where a sidecar names its
/// numbers, since it is sampled at the same points as position and normal; then Cryptomatte, whose
/// names are in the file; then the index pass without names.
void planObjects(const AovNames& names, FramePlan& plan) {
  if (const auto surface = findAov(plan.image, names, AovKind::surface)) {
    plan.idSource = IdSource::surface;
    plan.objectId = *surface;
    return;
  }
  const bool indexAsked =
      names.cryptoObject.empty() &&
      (!names.objectIndex.empty() || (plan.sidecar && !plan.sidecar->objects.empty()));
  const auto crypto = findAov(plan.image, names, AovKind::cryptoObject);
  const auto index = findAov(plan.image, names, AovKind::objectIndex);
  if (crypto && !(indexAsked && index)) {
    plan.idSource = IdSource::cryptomatte;
    plan.objectId = *crypto;
    plan.objectNames = namesOf(plan.image, *crypto, plan.warnings);
  } else if (index) {
    plan.idSource = IdSource::index;
    plan.objectId = *index;
  } else {
    plan.objectId = requireAov(plan.image, names, AovKind::cryptoObject);
  }
}

void nameObjectsFromSidecar(FramePlan& plan) {
  if (!plan.sidecar) return;
  for (const SidecarObject& object : plan.sidecar->objects)
    plan.objectNames.emplace(plan.idSource == IdSource::index ? object.index : object.cryptoId,
                             object.name);
}

void planMaterials(const AovNames& names, FramePlan& plan) {
  const auto index = findAov(plan.image, names, AovKind::materialIndex);
  const bool named = plan.sidecar && !plan.sidecar->materials.empty();
  if (index && named && names.cryptoMaterial.empty()) {
    plan.materialSource = IdSource::index;
    plan.materialId = *index;
    for (const SidecarMaterial& material : plan.sidecar->materials)
      plan.materialNames.emplace(material.index, material.name);
    return;
  }
  plan.materialSource = IdSource::cryptomatte;
  plan.materialId = requireAov(plan.image, names, AovKind::cryptoMaterial);
  plan.materialNames = namesOf(plan.image, *plan.materialId, plan.warnings);
  if (named)
    for (const SidecarMaterial& material : plan.sidecar->materials)
      plan.materialNames.emplace(material.cryptoId, material.name);
}

void readVector(std::vector<Floats>& planes, size_t& next, Vec3Plane& into) {
  into.x = std::move(planes[next++]);
  into.y = std::move(planes[next++]);
  into.z = std::move(planes[next++]);
}

Labels readIds(const ImageFile& image, const Aov& aov, IdSource source) {
  if (source != IdSource::cryptomatte) return readIndices(image, aov.channels.at(0));
  return dominantIds(readCryptomatte(image, aov.name, 2));
}

Bytes toMask(View<const float> values) {
  Bytes mask(values.width, values.height);
  for (int y = 0; y < values.height; ++y)
    for (int x = 0; x < values.width; ++x) mask(x, y) = values(x, y) >= 0.5f ? 1 : 0;
  return mask;
}

Floats readDepthMap(const DepthMapSource& source) {
  const ImageFile image = openImage(source.file);
  std::string channel = source.channel;
  if (channel.empty() || !image.findChannel(channel))
    channel = requireAov(image, {}, AovKind::depth).channels.at(0);
  return std::move(readFloats(image, std::vector{channel}).at(0));
}

/// Pixels without an id are background; so are those without a position and a normal.
void clearBackground(FramePlanes& planes) {
  for (int y = 0; y < planes.height; ++y)
    for (int x = 0; x < planes.width; ++x) {
      const V3f n(planes.normal.x(x, y), planes.normal.y(x, y), planes.normal.z(x, y));
      if (n.x == 0.0f && n.y == 0.0f && n.z == 0.0f) planes.objectId(x, y) = 0;
    }
}

}  // namespace

std::string FramePlan::objectName(uint32_t id) const {
  const auto found = objectNames.find(id);
  return found == objectNames.end() ? std::string() : found->second;
}

const SidecarObject* FramePlan::findObject(uint32_t id) const {
  if (!sidecar) return nullptr;
  if (idSource == IdSource::index) return sidecar->findObject(id);
  const std::string name = objectName(id);
  return name.empty() ? nullptr : sidecar->findObject(name);
}

FramePlan planFrame(const Look& look, const std::filesystem::path& path, int frame) {
  FramePlan plan;
  plan.frame = frame;
  plan.image = openImage(path);
  plan.sidecar = findSidecar(path);
  const AovNames names = namesFor(look, plan.sidecar);
  plan.position = requireAov(plan.image, names, AovKind::position);
  plan.normal = requireAov(plan.image, names, AovKind::normal);
  plan.albedo = findAov(plan.image, names, AovKind::albedo);
  plan.beauty = findAov(plan.image, names, AovKind::beauty);
  planObjects(names, plan);
  if (anyStyleHas(look, &StyleParams::material)) planMaterials(names, plan);
  nameObjectsFromSidecar(plan);
  plan.lights = gatherLights(look, plan.sidecar ? &*plan.sidecar : nullptr, plan.image, frame);
  return plan;
}

FramePlanes readFramePlanes(const FramePlan& plan) {
  std::vector<std::string> channels;
  const auto want = [&](const Aov& aov, size_t count) {
    channels.insert(channels.end(), aov.channels.begin(),
                    aov.channels.begin() + static_cast<long>(std::min(count, aov.channels.size())));
  };
  want(plan.position, 3);
  want(plan.normal, 3);
  if (plan.albedo) want(*plan.albedo, 3);
  if (plan.beauty) want(*plan.beauty, 4);
  for (const FrameLight& light : plan.lights)
    channels.insert(channels.end(), light.maskChannels.begin(), light.maskChannels.end());
  std::vector<Floats> read = readFloats(plan.image, channels);

  FramePlanes planes;
  planes.width = read.at(0).width();
  planes.height = read.at(0).height();
  size_t next = 0;
  readVector(read, next, planes.position);
  readVector(read, next, planes.normal);
  if (plan.albedo) readVector(read, next, planes.albedo);
  if (plan.beauty) {
    readVector(read, next, planes.beauty);
    if (plan.beauty->channels.size() > 3) planes.alpha = std::move(read[next++]);
  }
  for (const FrameLight& light : plan.lights) {
    LightPlanes& own = planes.lights.emplace_back();
    for (size_t i = 0; i < light.maskChannels.size(); ++i)
      own.masks.push_back(toMask(read[next++]));
    if (light.method == ShadowMethod::pcf) own.depthMap = readDepthMap(*light.depthMap);
  }
  planes.objectId = readIds(plan.image, plan.objectId, plan.idSource);
  if (plan.materialId)
    planes.materialId = readIds(plan.image, *plan.materialId, plan.materialSource);
  planes.badPixels = clearNonFinite(planes.position, planes.normal, planes.objectId.view());
  clearBackground(planes);
  return planes;
}

}  // namespace kagefude
