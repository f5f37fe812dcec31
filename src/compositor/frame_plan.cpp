#include "compositor/frame_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "compositor/casting_scene.h"
#include "compositor/output_layers.h"
#include "compositor/own_lights.h"
#include "compositor/plan_coverage.h"
#include "compositor/position_pass.h"
#include "compositor/scale_down.h"
#include "frame/aov_names.h"
#include "frame/cryptomatte.h"
#include "frame/foreign_json.h"
#include "frame/frame_view.h"
#include "frame/lossy_passes.h"

namespace kagefude {
namespace {

AovNames namesFor(const Look& look, const std::optional<Sidecar>& sidecar) {
  AovNames names = look.frame;
  if (!sidecar) return names;
  if (names.layer.empty()) names.layer = sidecar->dataLayer;
  if (names.beautyLayer.empty()) names.beautyLayer = sidecar->beautyLayer;
  return names;
}

template <class List>
bool anyStyleHas(const Look& look, List StyleParams::*list) {
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

bool wantsOutlines(const Look& look) {
  return asksFor(look, "outline") || anyStyleHas(look, &StyleParams::outlineColour);
}

std::string requireLinesChannel(const FramePlan& plan, const char* channel) {
  const std::string name = fmt::format("{}.{}", plan.sidecar->linesLayer, channel);
  if (!plan.image.findChannel(name))
    throw InputError(fmt::format("{} has no channel {} of the lines that its JSON names",
                                 plan.image.path.string(), name));
  return name;
}

void nameObjectsFromSidecar(FramePlan& plan) {
  if (!plan.sidecar) return;
  for (const SidecarObject& object : plan.sidecar->objects)
    plan.objectNames.emplace(plan.idSource == IdSource::index ? object.index : object.cryptoId,
                             object.name);
}

bool isFullName(const std::string& name) {
  return !name.empty() && name.find_first_of("*?") == std::string::npos;
}

void nameByHash(const std::string& name, std::map<uint32_t, std::string>& names) {
  if (isFullName(name)) names.emplace(cryptomatteId(name), name);
}

/// A Cryptomatte's ids are hashes of names, so a name in full is known without a manifest.
void nameObjectsFromLook(const Look& look, FramePlan& plan) {
  plan.listedNames = plan.objectNames;
  plan.listedMaterials = plan.materialNames;
  for (const StyleLook& style : look.styles) {
    if (plan.idSource == IdSource::cryptomatte)
      for (const std::string& name : style.style.object) nameByHash(name, plan.objectNames);
    if (plan.materialId && plan.materialSource == IdSource::cryptomatte)
      for (const std::string& name : style.style.material) nameByHash(name, plan.materialNames);
  }
  if (plan.idSource != IdSource::cryptomatte) return;
  nameByHash(look.shadow.receiver, plan.objectNames);
  for (const LightLook& light : look.lights) nameByHash(light.shadow.receiver, plan.objectNames);
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

bool anyBrushOn(const Look& look, BrushParams::Ground ground) {
  return look.passes.brush.ground == ground ||
         std::any_of(look.styles.begin(), look.styles.end(),
                     [&](const StyleLook& style) { return style.passes.brush.ground == ground; });
}

/// Rest positions are used where there are any; UVs that a style asks for must be there.
void planGrounds(const Look& look, const AovNames& names, FramePlan& plan) {
  if (anyBrushOn(look, BrushParams::Ground::rest))
    plan.rest = findAov(plan.image, names, AovKind::rest);
  if (anyBrushOn(look, BrushParams::Ground::uv))
    plan.uv = requireAov(plan.image, names, AovKind::uv);
  if (plan.rest) {
    plan.restInWorld = isWorldRest(names, plan.rest->name);
    plan.instanceRandom = findAov(plan.image, names, AovKind::instanceRandom);
  }
}

/// Integers hold 0..1 in steps, mostly encoded for a display: no positions, and no light.
void refuseIntegers(const ImageFile& image, const Aov& pass) {
  const Part& part = image.parts[static_cast<size_t>(image.findChannel(pass.channels[0])->part)];
  if (part.ofIntegers)
    throw InputError(fmt::format(
        "{} holds {} in integers, which are neither scene-linear nor without bounds; render it to "
        "EXR or a float TIFF, or convert a picture (oiiotool --colorconvert sRGB linear -d float)",
        part.file.string(), pass.name.empty() ? "the beauty" : pass.name));
}

/// Whether two lights are so alike that another one may lead the strokes in the next frame.
bool leadMayChange(const Look& look, const FramePlan& plan) {
  if (!plan.sidecar || plan.sidecar->shot || plan.lights.size() < 2) return false;
  const bool allChosen = !look.styles.empty() &&
                         std::all_of(look.styles.begin(), look.styles.end(),
                                     [](const StyleLook& s) { return !s.style.light.empty(); });
  std::vector<float> leads;
  for (const FrameLight& light : plan.lights) leads.push_back(light.weight.lead);
  std::sort(leads.rbegin(), leads.rend());
  return !allChosen && leads[1] > 0.5f * leads[0];
}

/// Whether the look as a whole, or a style, has passes of which `which` holds.
template <class Which>
bool anyPasses(const Look& look, const Which& which) {
  return which(look.passes) ||
         std::any_of(look.styles.begin(), look.styles.end(),
                     [&](const StyleLook& style) { return which(style.passes); });
}

bool endsPaint(const Look& look) {
  return anyPasses(look, [](const PassParams& passes) { return passes.edges.acts(); });
}

/// What shines without the lights, where a tone asks for it. A frame that lacks it is painted
/// without: the exporter writes the pass only for shots where something gives off light.
void planFloor(const Look& look, const AovNames& names, FramePlan& plan) {
  if (anyPasses(look, [](const PassParams& passes) { return passes.tone.emission > 0.0f; })) {
    plan.emission = findAov(plan.image, names, AovKind::emission);
    if (!plan.emission)
      plan.warnings.push_back(
          "tone.emission is set, but the frame has no Emission pass, so it lifts nothing; where "
          "something gives off light, export the shot again, or name the pass with frame.emission");
  }
  if (!anyPasses(look, [](const PassParams& passes) { return passes.tone.world > 0.0f; })) return;
  const std::vector<float>& own = look.scene.world;
  if (!own.empty())
    plan.worldRadiance = V3f(own[0], own[1], own[2]);
  else if (plan.sidecar && plan.sidecar->worldRadiance)
    plan.worldRadiance = V3f(*plan.sidecar->worldRadiance);
  else
    plan.warnings.push_back(
        "tone.world is set, but neither the JSON nor scene.world says how bright the world is, so "
        "it lifts nothing");
}

/// What is fixed to the world wants to know where the camera looks.
void noteFixedWithoutCamera(const Look& look, FramePlan& plan) {
  const Background background = look.output.background;
  const PaperParams& paper = look.passes.paper;
  const bool hasPaper = paper.strength > 0 || background == Background::paper;
  const bool world =
      (hasPaper && paper.fixed == PaperParams::Fixed::world) ||
      (background == Background::strip && look.passes.ground.fixed == GroundParams::Fixed::world);
  if (world && !raysOf(plan, false))
    plan.warnings.push_back(
        "paper.fixed or ground.fixed is \"world\", but the camera is not known, so the ground "
        "stands still on the screen");
}

}  // namespace

std::string FramePlan::objectName(uint32_t id) const {
  const auto found = objectNames.find(id);
  return found == objectNames.end() ? std::string() : found->second;
}

uint32_t FramePlan::cryptomatteIdOf(uint32_t id) const {
  if (idSource == IdSource::cryptomatte) return id;
  const SidecarObject* object = findObject(id);
  return object ? object->cryptoId : 0;
}

const SidecarObject* FramePlan::findObject(uint32_t id) const {
  if (!sidecar) return nullptr;
  if (idSource == IdSource::index) return sidecar->findObject(id);
  const std::string name = objectName(id);
  return name.empty() ? nullptr : sidecar->findObject(name);
}

namespace {

/// What a frame lacks without its JSON is said with the JSON that is there and is someone else's.
FramePlan planWithJson(const Look& look, ImageFile image, const std::filesystem::path& path,
                       int frame) {
  std::optional<Sidecar> sidecar = findSidecar(path);
  const std::string foreign = sidecar ? "" : foreignJson(path);
  try {
    return planOpenFrame(look, std::move(image), std::move(sidecar), frame);
  } catch (const InputError& error) {
    if (foreign.empty()) throw;
    throw InputError(fmt::format("{} ({})", error.what(), foreign));
  }
}

}  // namespace

FramePlan planFrame(const Look& look, const std::filesystem::path& path, int frame,
                    const std::string& view) {
  const std::string& taken = view.empty() ? look.frame.view : view;
  ImageFile image = openFrame(path, taken, groupFiles(path, look.frame.files, frame, taken),
                              look.keyWithPlace("frame.files"));
  const bool viewless = view.empty() && !look.frame.view.empty() && image.views.empty();
  FramePlan plan = planWithJson(look, std::move(image), path, frame);
  if (viewless)
    plan.warnings.insert(plan.warnings.begin(),
                         fmt::format("the file names no views; all of it is taken for the {} "
                                     "view that frame.view asks for",
                                     look.frame.view));
  return plan;
}

FramePlan planOpenFrame(const Look& asked, ImageFile image, std::optional<Sidecar> sidecar,
                        int frame) {
  const Look look = inRenderedPixels(asked);
  FramePlan plan;
  plan.frame = frame;
  plan.image = std::move(image);
  plan.sidecar = std::move(sidecar);
  checkScale(look, plan);
  for (const LossyPass& lossy : lossyPasses(plan.image))
    plan.warnings.push_back(fmt::format("{}; {}", lossy.what, lossy.remedy));
  if (plan.sidecar && plan.image.pixelAspect == 1.0f)
    plan.image.pixelAspect = static_cast<float>(plan.sidecar->pixelAspect);
  const AovNames names = namesFor(look, plan.sidecar);
  plan.spaces = vectorSpaces(names, plan.image, plan.sidecar ? &plan.sidecar->camera : nullptr);
  planPositions(names, plan);
  plan.normal = requireAov(plan.image, names, AovKind::normal);
  if (const std::string doubt = doubtCamera(plan.spaces); !doubt.empty())
    plan.warnings.push_back(doubt);
  plan.albedo = findAov(plan.image, names, AovKind::albedo);
  plan.beauty = findAov(plan.image, names, AovKind::beauty);
  for (const auto& pass : {std::optional(plan.position), plan.albedo, plan.beauty})
    if (pass) refuseIntegers(plan.image, *pass);
  if (plan.sidecar && !plan.sidecar->linesLayer.empty())
    for (const char* channel : {"R", "G", "B", "A"})
      plan.lines.push_back(requireLinesChannel(plan, channel));
  planGrounds(look, names, plan);
  planObjects(names, plan);
  if (anyStyleHas(look, &StyleParams::material)) planMaterials(names, plan);
  nameObjectsFromSidecar(plan);
  nameObjectsFromLook(look, plan);
  planCoverage(look, names, plan);
  if ((wantsOutlines(look) || endsPaint(look)) && !plan.sidecar)
    plan.depth = findAov(plan.image, names, AovKind::depth);
  plan.hasCasters = plan.sidecar && !plan.sidecar->casters.empty();
  plan.lights = gatherLights(look, plan.sidecar ? &*plan.sidecar : nullptr, plan.image, frame,
                             plan.hasCasters);
  planFloor(look, names, plan);
  checkLightStrips(look, plan);
  if (leadMayChange(look, plan))
    plan.warnings.push_back(
        "the JSON says nothing of the whole shot, so the light that is heaviest in each frame "
        "leads its strokes; export the shot again, or name one with style.light");
  noteFixedWithoutCamera(look, plan);
  checkLayers(look, plan.lights);
  return plan;
}

}  // namespace kagefude
