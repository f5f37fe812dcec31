#include "frame/inspect_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "frame/aov_names.h"
#include "frame/cryptomatte.h"
#include "frame/foreign_json.h"
#include "frame/frame_view.h"
#include "frame/lossy_passes.h"
#include "frame/mean_normal_pass.h"
#include "frame/rebuild_positions.h"
#include "frame/sidecar.h"
#include "picture/frame_picture.h"

namespace kagefude {
namespace {

void add(Inspection& inspection, FindingKind kind, std::string what, std::string remedy) {
  inspection.findings.push_back({kind, std::move(what), std::move(remedy)});
}

std::string typeOf(const ImageFile& file, const std::vector<std::string>& channels) {
  const PixelType first = file.findChannel(channels.front())->type;
  const bool same = std::all_of(channels.begin(), channels.end(), [&](const std::string& name) {
    return file.findChannel(name)->type == first;
  });
  return same ? std::string(pixelTypeName(first)) : "mixed";
}

void addLayers(Inspection& inspection, const ImageFile& file) {
  for (const PassChannels& pass : listPasses(file)) {
    auto& layers = inspection.layers;
    auto layer = std::find_if(layers.begin(), layers.end(),
                              [&](const InspectedLayer& l) { return l.name == pass.layer; });
    if (layer == layers.end()) layer = layers.insert(layer, {pass.layer, {}});
    const std::string name = pass.view.empty() ? pass.pass : pass.pass + "." + pass.view;
    layer->passes.push_back(
        {name.empty() ? "RGBA" : name, pass.channels, typeOf(file, pass.channels)});
  }
}

void addAovs(Inspection& inspection, const ImageFile& file, const AovNames& names) {
  for (const AovKind kind : detail::searchedKinds) {
    InspectedAov aov{std::string(aovName(kind)), aovKey(kind), ""};
    try {
      if (const auto found = findAov(file, names, kind)) aov.pass = found->name;
    } catch (const InputError& problem) {
      add(inspection, FindingKind::error, problem.what(),
          fmt::format("set {} in the look", aovKey(kind)));
    }
    inspection.aovs.push_back(std::move(aov));
  }
}

bool isFound(const Inspection& inspection, AovKind kind) {
  return std::any_of(inspection.aovs.begin(), inspection.aovs.end(), [&](const InspectedAov& aov) {
    return aov.purpose == aovName(kind) && !aov.pass.empty();
  });
}

// Only the exporter makes them, so nobody else's frames lack them.
void addMeanNormal(Inspection& inspection, const ImageFile& file, const AovNames& names) {
  if (!isFound(inspection, AovKind::normal)) return;
  MeanNormalPass found = findMeanNormal(file, *findAov(file, names, AovKind::normal));
  inspection.aovs.push_back({"MeanNormal", "", std::move(found.name)});
  if (!found.fault.empty())
    add(inspection, FindingKind::warning, std::move(found.fault), "export the frame again");
}

// Positions may be rebuilt: what from, or why not.
void addPositions(Inspection& inspection, const ImageFile& file, const AovNames& names,
                  const std::optional<Sidecar>& sidecar) {
  constexpr auto use = "which the shadow search and the brush mapping need";
  const auto remedy = "turn it on in the renderer or the exporter, or name it with frame.position";
  if (isFound(inspection, AovKind::position)) return;
  if (!isFound(inspection, AovKind::depth)) {
    add(inspection, FindingKind::missing, fmt::format("there is no Position pass, {}", use),
        remedy);
    return;
  }
  const VectorSpaces spaces = vectorSpaces(names, file, sidecar ? &sidecar->camera : nullptr);
  const std::string fault = rebuildFault(spaces);
  if (fault.empty())
    add(inspection, FindingKind::warning,
        fmt::format("there is no Position pass; positions are rebuilt from the depth and {}",
                    spaces.camera->source),
        "render a Position pass if the depth is filtered; frame.depth_kind says what it measures");
  else
    add(inspection, FindingKind::missing,
        fmt::format("there is no Position pass, {}, and none can be rebuilt from the depth: {}",
                    use, fault),
        remedy);
}

void addMissing(Inspection& inspection) {
  const auto need = [&](AovKind kind, std::string_view use) {
    if (isFound(inspection, kind)) return;
    add(inspection, FindingKind::missing,
        fmt::format("there is no {} pass, which {} needs", aovName(kind), use),
        fmt::format("turn it on in the renderer or the exporter, or name it with {}",
                    aovKey(kind)));
  };
  need(AovKind::normal, "shading and the surface labels");
  need(AovKind::beauty, "the background");
  if (!isFound(inspection, AovKind::objectIndex)) {
    if (!isFound(inspection, AovKind::cryptoObject)) {
      add(inspection, FindingKind::missing,
          "there is neither an object index nor an object Cryptomatte to tell surfaces apart",
          "turn one of them on in the renderer, or name it with frame.object_index or "
          "frame.crypto_object");
    }
  }
}

void addLossyPasses(Inspection& inspection, const ImageFile& file) {
  for (LossyPass& lossy : lossyPasses(file))
    add(inspection, FindingKind::warning, std::move(lossy.what), std::move(lossy.remedy));
}

void addCryptomattes(Inspection& inspection, const ImageFile& file) {
  for (const Cryptomatte& broken : brokenCryptomattes(file))
    add(inspection, FindingKind::warning,
        broken.fault + ", so that rank and those after it are not read", "export the frame again");
  for (const Cryptomatte& found : listCryptomattes(file)) {
    const Manifest manifest = readManifest(file, found);
    InspectedCryptomatte shown{found.name, static_cast<int>(found.idChannels.size()), {}};
    for (const auto& entry : manifest.names) shown.names.push_back(entry.second);
    for (const std::string& warning : manifest.warnings) {
      add(inspection, FindingKind::warning, warning,
          "name objects in full instead of by pattern, or render the manifest into the file");
    }
    for (const std::string& channel : found.idChannels) {
      if (file.findChannel(channel)->type != PixelType::half) continue;
      add(inspection, FindingKind::error,
          fmt::format("the id channel {} is stored as half float, which destroys ids", channel),
          "render it again with 32-bit float");
      break;
    }
    inspection.cryptomattes.push_back(std::move(shown));
  }
}

void addMasks(Inspection& inspection, const ImageFile& file, const SidecarLight& light,
              InspectedLight& shown) {
  constexpr std::array<std::string_view, 3> arrangements = {"pair", "line", "disc"};
  if (!light.masks) return;
  shown.arrangement = arrangements[static_cast<size_t>(light.masks->arrangement)];
  for (const MaskSample& sample : light.masks->samples) {
    InspectedMask mask{sample.layer, true};
    try {
      requireMaskChannel(file, sample.layer);
    } catch (const InputError& problem) {
      mask.found = false;
      add(inspection, FindingKind::missing, problem.what(), "export the frame again");
    }
    shown.masks.push_back(std::move(mask));
  }
}

void addLights(Inspection& inspection, const ImageFile& file, const Sidecar& sidecar) {
  constexpr std::array<std::string_view, 4> types = {"point", "spot", "sun", "area"};
  for (const SidecarLight& light : sidecar.lights) {
    InspectedLight shown;
    shown.name = light.name;
    shown.type = types[static_cast<size_t>(light.type)];
    shown.truthLayer = light.truthLayer;
    addMasks(inspection, file, light, shown);
    if (light.depthMap) {
      std::error_code problem;
      shown.depthMap = light.depthMap->file.string();
      shown.depthMapFound = std::filesystem::exists(light.depthMap->file, problem);
      if (!shown.depthMapFound) {
        add(inspection, FindingKind::missing,
            fmt::format("the depth map {} of light {} does not exist", shown.depthMap, light.name),
            "copy it beside the frame, or export the frame again");
      }
    }
    inspection.lights.push_back(std::move(shown));
  }
}

// Names from the look win over those of the sidecar.
AovNames namesWith(AovNames names, const Sidecar& sidecar) {
  if (names.layer.empty()) names.layer = sidecar.dataLayer;
  if (names.beautyLayer.empty()) names.beautyLayer = sidecar.beautyLayer;
  return names;
}

void addSidecar(Inspection& inspection, const ImageFile& file, const Sidecar& sidecar) {
  inspection.sidecar = sidecar.path.string();
  inspection.frame = sidecar.frame;
  inspection.fps = sidecar.fps;
  addLights(inspection, file, sidecar);
  for (const SidecarObject& object : sidecar.objects) {
    inspection.objects.push_back({object.name, object.index, object.materials});
  }
  const Window& display = file.displayWindow;
  if (sidecar.width == display.width && sidecar.height == display.height) return;
  add(inspection, FindingKind::warning,
      fmt::format("the frame's display window is {} x {} pixels, but its JSON says {} x {}",
                  display.width, display.height, sidecar.width, sidecar.height),
      "use the JSON that was exported with this frame");
}

std::optional<Sidecar> trySidecar(Inspection& inspection) {
  try {
    auto sidecar = findSidecar(inspection.path);
    if (!sidecar) {
      const std::string foreign = foreignJson(inspection.path);
      add(inspection, FindingKind::missing,
          (foreign.empty() ? "there is no JSON beside the frame" : foreign) +
              ", so lights, camera and objects are not known",
          "export the frame with the Blender add-on, or give lights and camera in the look");
    }
    return sidecar;
  } catch (const InputError& problem) {
    add(inspection, FindingKind::error, problem.what(), "export the frame again");
    return std::nullopt;
  }
}

}  // namespace

Inspection inspectFrame(const std::filesystem::path& path, const AovNames& names) {
  const ImageFile whole = openAnyImage(path);
  const ImageFile file = takeView(whole, names.view);
  Inspection inspection;
  inspection.path = path;
  inspection.dataWindow = file.dataWindow;
  inspection.displayWindow = file.displayWindow;
  inspection.pixelAspect = file.pixelAspect;
  inspection.parts = file.parts;
  inspection.views = file.views;
  inspection.view = file.view;
  inspection.channelCount = static_cast<int>(whole.channels.size());
  const auto sidecar = trySidecar(inspection);
  addLayers(inspection, whole);
  const AovNames own = sidecar ? namesWith(names, *sidecar) : names;
  addAovs(inspection, file, own);
  if (sidecar) addMeanNormal(inspection, file, own);
  addPositions(inspection, file, names, sidecar);
  addMissing(inspection);
  addCryptomattes(inspection, file);
  addLossyPasses(inspection, file);
  if (sidecar) addSidecar(inspection, file, *sidecar);
  return inspection;
}

}  // namespace kagefude
