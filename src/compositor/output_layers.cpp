#include "compositor/output_layers.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/glob.h"
#include "base/nearest_name.h"
#include "compositor/frame_light.h"

namespace kagefude {
namespace {

std::string nameFor(const OutputLayerEntry& entry, const FrameLight* light) {
  return std::string(entry.name) + (entry.stage == LayerStage::light ? light->name : "");
}

bool brings(const FrameLight& light, const OutputLayerEntry& entry) {
  return entry.onlyMethod.empty() || entryOf(light.method).name == entry.onlyMethod;
}

/// Calls `use(entry, name)` for every layer that a frame with these lights can write.
template <class Use>
void forEachLayer(const std::vector<FrameLight>& lights, const Use& use) {
  for (const OutputLayerEntry& entry : outputLayers) {
    if (entry.stage == LayerStage::frame) {
      use(entry, nameFor(entry, nullptr));
      continue;
    }
    for (const FrameLight& light : lights)
      if (brings(light, entry)) use(entry, nameFor(entry, &light));
  }
}

/// Why a layer that exists elsewhere is not here: the method that would bring it; else "".
std::string methodHint(const std::string& wanted, const std::vector<FrameLight>& lights) {
  for (const OutputLayerEntry& entry : outputLayers)
    for (const FrameLight& light : lights)
      if (!brings(light, entry) && matchesGlob(nameFor(entry, &light), wanted))
        return fmt::format("; {}<light> comes with shadow.method = \"{}\" only", entry.name,
                           entry.onlyMethod);
  return "";
}

}  // namespace

bool asksFor(const Look& look, std::string_view layer) {
  return matchesAny(layer, look.output.layers);
}

std::vector<std::string> layerNames(const std::vector<FrameLight>& lights) {
  std::vector<std::string> names;
  forEachLayer(
      lights, [&](const OutputLayerEntry&, std::string name) { names.push_back(std::move(name)); });
  return names;
}

void checkLayers(const Look& look, const std::vector<FrameLight>& lights) {
  const std::vector<std::string> names = layerNames(lights);
  for (const std::string& wanted : look.output.layers) {
    const auto matches = [&](const std::string& name) { return matchesGlob(name, wanted); };
    if (std::any_of(names.begin(), names.end(), matches)) continue;
    throw LookError(fmt::format("{}: no layer of the frame is called {}{}{}; there are {}",
                                look.keyWithPlace("output.layers"), wanted,
                                didYouMean(wanted, names), methodHint(wanted, lights),
                                listNames(names)));
  }
}

size_t layerBytes(const Look& look, const std::vector<FrameLight>& lights) {
  size_t bytes = 0;
  forEachLayer(lights, [&](const OutputLayerEntry& entry, const std::string& name) {
    if (asksFor(look, name)) bytes += bytesOf(entry);
  });
  return bytes;
}

void takeLayers(const Look& look, LayerStage stage, LayerSources& sources, FrameResult& result) {
  for (const OutputLayerEntry& entry : outputLayers) {
    if (entry.stage != stage || (stage == LayerStage::light && !brings(*sources.light, entry)))
      continue;
    std::string name = nameFor(entry, sources.light);
    if (asksFor(look, name)) result.layers.push_back({std::move(name), entry.function(sources)});
  }
}

LayerPlane coverageLayer(LayerSources& sources) {
  const View<const float> visibility = sources.visibility;
  Floats hidden(visibility.width, visibility.height);
  for (size_t i = 0; i < visibility.pixels(); ++i) hidden.row(0)[i] = 1.0f - visibility.data[i];
  return {std::move(hidden), {}};
}

LayerPlane visibilityLayer(LayerSources& sources) { return {std::move(sources.visibility), {}}; }

LayerPlane confidenceLayer(LayerSources& sources) {
  if (sources.confidence.empty())
    return {Floats(sources.planes.width, sources.planes.height, 1.0f), {}};
  return {std::move(sources.confidence), {}};
}

LayerPlane toneLayer(LayerSources& sources) { return {std::move(sources.tone), {}}; }

LayerPlane outlineLayer(LayerSources& sources) { return {std::move(sources.outline), {}}; }

LayerPlane angleLayer(LayerSources& sources) { return {std::move(sources.angle), {}}; }

LayerPlane repeatLayer(LayerSources& sources) { return {std::move(sources.repeat), {}}; }

LayerPlane surfaceLayer(LayerSources& sources) { return {{}, std::move(sources.surfaces)}; }

}  // namespace kagefude
