#include "live/stage_keys.h"

#include <sys/stat.h>

#include "compositor/frame_files.h"

namespace kagefude {
namespace {

void addNames(StageKey& key, const std::vector<std::string>& names) {
  key.add(names.size());
  for (const std::string& name : names) key.add(name);
}

void addNames(StageKey& key, const std::map<uint32_t, std::string>& names) {
  key.add(names.size());
  for (const auto& [id, name] : names) key.add(id).add(name);
}

void addAov(StageKey& key, const std::optional<Aov>& aov) {
  key.add(aov.has_value());
  if (!aov) return;
  key.add(aov->name);
  addNames(key, aov->channels);
}

void addLightReading(StageKey& key, const FrameLight& light) {
  const ShadowNeeds& needs = entryOf(light.method).needs;
  addNames(key, light.maskChannels);
  key.add(light.tracedChannel).add(needs.camera).add(light.readsDepthMap);
  if (!light.readsDepthMap) return;
  key.add(light.depthMap->file.native()).add(light.depthMap->channel);
  key.add(light.automatic || !needs.depthMap);  // whether a map that is doubted is set aside
}

bool wantsScene(const FramePlan& plan) {
  for (const FrameLight& light : plan.lights)
    if (entryOf(light.method).needs.camera) return true;
  return false;
}

/// The sections that a light may have and its shadow depends on.
bool isOfShadow(const LookSection& section) {
  if (!section.inLight) return false;
  const std::string_view name = section.table->pass;
  return name != shadowTable.pass && name != smoothTable.pass && name != shadeTable.pass &&
         name != mergeTable.pass;
}

bool isOfStrokes(const LookSection& section) {
  return section.inStyle && section.table->pass == brushTable.pass;
}

/// The style sections that `which` chooses, of every style and of what has none.
template <class Which>
void addStyleSections(StageKey& key, const Look& look, const Which& which) {
  StyleLook without{{}, look.passes};
  for (const LookSection& section : lookSections)
    if (section.inStyle && which(section)) key.add(*section.table, section.inStyle(without));
  key.add(look.styles.size());
  for (StyleLook style : look.styles)
    for (const LookSection& section : lookSections)
      if (section.inStyle && which(section)) key.add(*section.table, section.inStyle(style));
}

}  // namespace

void addFile(StageKey& key, const std::filesystem::path& file) {
  struct stat status {};
  const bool there = ::stat(file.c_str(), &status) == 0;
  key.add(file.native()).add(there);
  if (there)
    key.add(status.st_mtim.tv_sec)
        .add(status.st_mtim.tv_nsec)
        .add(status.st_size)
        .add(status.st_ino);
}

void addReading(StageKey& key, const Look& look, const FramePlan& plan) {
  addFile(key, plan.image.path);
  if (plan.sidecar) addFile(key, plan.sidecar->path);
  for (const std::filesystem::path& file : filesBeside(plan)) addFile(key, file);
  key.add(aovNamesTable, &look.frame).add(plan.image.view).add(plan.frame);
  for (const std::optional<Aov>& aov :
       {std::optional(plan.position), std::optional(plan.normal), plan.albedo, plan.beauty,
        plan.rest, plan.uv, plan.instanceRandom, plan.emission, plan.depth, plan.coverage,
        std::optional(plan.objectId), plan.materialId})
    addAov(key, aov);
  addNames(key, plan.lines);
  key.add(plan.idSource).add(plan.materialSource).add(plan.restInWorld);
  key.add(plan.lights.size());
  for (const FrameLight& light : plan.lights) addLightReading(key, light);
  if (wantsScene(plan)) addNames(key, plan.objectNames);
}

void addLight(StageKey& key, const FrameLight& light) {
  const Light& own = light.light;
  key.add(light.name).add(own.type).add(own.position).add(own.direction).add(own.radius);
  key.add(own.spotAngle).add(own.spotBlend).add(light.subjectCentre).add(light.subjectRadius);
}

void addShadow(StageKey& key, const FramePlan& plan, const FrameLight& light) {
  addLight(key, light);
  key.add(light.method).add(light.castPlaces).add(light.receiver).add(light.towardsFar);
  if (!light.receiver.empty()) addNames(key, plan.objectNames);
  addFile(key, light.blob);
  key.add(light.places.size());
  for (const V2f& place : light.places) key.add(place.x).add(place.y);
  key.add(light.geometry.has_value());
  if (light.geometry) {
    const LightGeometry& geometry = *light.geometry;
    key.add(geometry.sun).add(geometry.sphere).add(geometry.position).add(geometry.direction);
    key.add(geometry.u).add(geometry.v);
  }
  key.add(light.depthMap.has_value());
  if (light.depthMap) key.add(light.depthMap->lightFromWorld).add(light.depthMap->clipFromLight);
  LightLook settings{{}, {}, light.passes};
  for (const LookSection& section : lookSections)
    if (isOfShadow(section)) key.add(*section.table, section.inLight(settings));
}

void addWeight(StageKey& key, const FrameLight& light) {
  const LightWeight& weight = light.weight;
  key.add(weight.subject).add(weight.axis).add(weight.dimming);
  key.add(weight.power.watts).add(weight.power.falls);
}

void addStrokes(StageKey& key, const Look& look, const FramePlan& plan) {
  key.add(sceneTable, &look.scene);
  key.add(plan.lights.size());
  for (const FrameLight& light : plan.lights) {
    addLight(key, light);
    key.add(light.weight.lead);
  }
  // Names that only the look has name objects as well, a receiver's among them.
  addNames(key, plan.objectNames);
  addNames(key, plan.materialNames);
  for (const StyleLook& style : look.styles)
    key.add(styleTable, &style.style, {"colour", "outline_colour"});
  for (const LightLook& light : look.lights) key.add(light.light.name).add(light.light.strip);
  addStyleSections(key, look, isOfStrokes);
}

void addStyleColours(StageKey& key, const Look& look) {
  for (const StyleLook& style : look.styles) key.add(styleTable, &style.style);
  addStyleSections(key, look, [](const LookSection& section) { return !isOfStrokes(section); });
}

}  // namespace kagefude
