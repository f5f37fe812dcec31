#include "compositor/frame_tone.h"

#include <fmt/format.h>

#include "compositor/light_visibility.h"
#include "compositor/output_layers.h"
#include "image/parallel.h"
#include "passes/tone/lambert.h"
#include "passes/tone/merge.h"

namespace kagefude {
namespace {

/// 1 - k (1 - v): how much of the light a shadow of strength k leaves (004, light sum).
void weaken(View<float> visibility, float strength) {
  if (strength == 1.0f) return;
  parallelRows(visibility.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < visibility.width; ++x)
        visibility(x, y) = 1.0f - strength * (1.0f - visibility(x, y));
  });
}

std::vector<float> normalisedWeights(const std::vector<FrameLight>& lights) {
  float sum = 0;
  for (const FrameLight& light : lights) sum += light.weight;
  std::vector<float> weights;
  for (const FrameLight& light : lights)
    weights.push_back(sum > 0 ? light.weight / sum : 1.0f / static_cast<float>(lights.size()));
  return weights;
}

}  // namespace

Floats frameTone(const Look& look, const FramePlan& plan, const FramePlanes& planes,
                 View<const uint32_t> surfaces, FrameResult& result, StageSink* sink,
                 StageClock* clock) {
  std::vector<Floats> tones;
  for (size_t i = 0; i < plan.lights.size(); ++i) {
    const FrameLight& light = plan.lights[i];
    LightVisibility shadow = lightVisibility(light, plan, planes.lights[i], planes, surfaces, sink);
    Floats visibility = std::move(shadow.visibility);
    lap(clock, fmt::format("visibility.{}", light.name));
    Floats tone =
        lambertShade(planes.normal, planes.position, surfaces, light.light, light.passes.shade);
    if (sink) sink->number(fmt::format("shade of {}", light.name), tone);
    weaken(visibility, light.strength);
    mergeTone(visibility, tone, light.passes.merge, tone);
    tones.push_back(std::move(tone));
    lap(clock, fmt::format("shade and merge of {}", light.name));
    LayerSources sources{planes};
    sources.light = &light;
    sources.visibility = std::move(visibility);
    sources.confidence = std::move(shadow.confidence);
    takeLayers(look, LayerStage::light, sources, result);
  }
  if (tones.size() == 1) return std::move(tones.front());
  Floats sum(planes.width, planes.height);
  const std::vector<View<const float>> views(tones.begin(), tones.end());
  combineTones(views, normalisedWeights(plan.lights), look.passes.merge, sum);
  return sum;
}

}  // namespace kagefude
