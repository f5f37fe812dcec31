#include "compositor/frame_tone.h"

#include <fmt/format.h>

#include <algorithm>

#include "compositor/frame_tint.h"
#include "compositor/light_visibility.h"
#include "compositor/output_layers.h"
#include "image/parallel.h"
#include "image/real_math.h"
#include "passes/tone/lambert.h"
#include "passes/tone/light_reach.h"
#include "passes/tone/merge.h"
#include "passes/tone/tint.h"

namespace kagefude {
namespace {

/// 1 - k (1 - v): how much of the light a shadow of strength k leaves (004, light sum). Empty where
/// k = 1 leaves it as it is.
Floats weakened(View<const float> visibility, float strength) {
  if (strength == 1.0f) return {};
  Floats weak(visibility.width, visibility.height);
  parallelRows(visibility.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < visibility.width; ++x)
        weak(x, y) = 1.0f - strength * (1.0f - visibility(x, y));
  });
  return weak;
}

/// What is white: all lights together, or the heaviest where the brightest is taken.
float whiteOf(const std::vector<FrameLight>& lights, MergeParams::Lights merge,
              float LightWeight::*of) {
  float white = 0;
  for (const FrameLight& light : lights) {
    const float own = light.weight.*of;
    white = merge == MergeParams::Lights::sum ? white + own : std::max(white, own);
  }
  return white;
}

/// Lights that all shine away from the subject are measured on their axes.
float whiteOf(const std::vector<FrameLight>& lights, const Look& look) {
  const float white = whiteOf(lights, look.passes.merge.lights, &LightWeight::subject);
  return white > 0 ? white : whiteOf(lights, look.passes.merge.lights, &LightWeight::axis);
}

/// By what each light's tone counts; where no light gives anything, nothing does.
std::vector<float> weightsOf(const std::vector<FrameLight>& lights, const Look& look) {
  const float white = whiteOf(lights, look);
  std::vector<float> weights;
  for (const FrameLight& light : lights) {
    const bool irradiance = look.passes.tone.light == ToneLight::irradiance;
    const float own = irradiance ? 1.0f : light.weight.axis * light.weight.dimming;
    weights.push_back(white > 0 ? own / white : 0.0f);
  }
  return weights;
}

/// Lays over a light's tone how it shines to each side and, if asked for, how far.
void applyReach(const FrameLight& light, ToneLight counts, const FramePlanes& planes,
                View<const uint32_t> surfaces, View<float> tone) {
  const bool irradiance = counts == ToneLight::irradiance;
  if (!irradiance && light.light.type != Light::Type::area) return;
  const LightWeight& weight = light.weight;
  const bool ahead = weight.subject > 0 && weight.axis > 0;
  const Floats reach = lightReach(planes.position, surfaces, light.light, weight.power, irradiance,
                                  ahead ? weight.subject / weight.axis : 1.0f);
  parallelRows(tone.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < tone.width; ++x) tone(x, y) *= reach(x, y);
  });
}

}  // namespace

Floats lightTone(const Look& look, const FrameLight& light, View<const float> visibility,
                 const FramePlanes& planes, View<const uint32_t> surfaces, StageSink* sink) {
  Floats tone =
      lambertShade(planes.normal, planes.position, surfaces, light.light, light.passes.shade);
  if (sink) sink->number(fmt::format("shade of {}", light.name), tone);
  // The layers hold what was measured; only the tone takes the shadow's strength.
  const Floats weak = weakened(visibility, light.strength);
  mergeTone(weak.empty() ? visibility : weak, tone, light.passes.merge, tone);
  applyReach(light, look.passes.tone.light, planes, surfaces, tone);
  return tone;
}

std::vector<float> toneWeights(const Look& look, const std::vector<FrameLight>& lights) {
  return weightsOf(lights, look);
}

std::vector<LightPart> lightParts(const Look& look, const std::vector<FrameLight>& lights) {
  const std::vector<float> weights = weightsOf(lights, look);
  std::vector<LightPart> parts;
  for (size_t i = 0; i < lights.size(); ++i) {
    const LightWeight& weight = lights[i].weight;
    if (look.passes.tone.light == ToneLight::shade) {
      parts.push_back({weights[i], 1.0f});
      continue;
    }
    const float own = weight.subject > 0 ? weight.subject : weight.axis;
    parts.push_back(own > 0 ? LightPart{weights[i] * own, 1.0f / own} : LightPart{});
  }
  return parts;
}

ToneFloor toneFloor(const Look& look, const FramePlan& plan, const FramePlanes& planes) {
  const float white = whiteOf(plan.lights, look);
  if (!(white > 0)) return {};
  // A radiance L from everywhere arrives as pi L; a white surface in irradiance E shines as E / pi.
  return {pi * luminanceOf(plan.worldRadiance) / white, planes.emission, pi / white};
}

bool oneToneIsAll(const Look& look, const std::vector<FrameLight>& lights) {
  return lights.size() == 1 && look.passes.tone.light == ToneLight::shade &&
         weightsOf(lights, look)[0] == 1.0f;
}

Floats sumTones(const Look& look, const std::vector<FrameLight>& lights,
                const std::vector<View<const float>>& tones) {
  Floats sum(tones.front().width, tones.front().height);
  combineTones(tones, weightsOf(lights, look), look.passes.merge, sum);
  return sum;
}

Floats frameTone(const Look& look, const FramePlan& plan, const FramePlanes& planes,
                 View<const uint32_t> surfaces, FrameResult& result, StageSink* sink,
                 StageClock* clock, Vec3Plane* colour, std::vector<Floats>* perLight) {
  std::vector<Floats> tones;
  for (size_t i = 0; i < plan.lights.size(); ++i) {
    const FrameLight& light = plan.lights[i];
    LightVisibility shadow = lightVisibility(light, plan, planes.lights[i], planes, surfaces, sink);
    lap(clock, fmt::format("visibility.{}", light.name));
    tones.push_back(lightTone(look, light, shadow.visibility, planes, surfaces, sink));
    lap(clock, fmt::format("shade and merge of {}", light.name));
    LayerSources sources{planes};
    sources.light = &light;
    sources.visibility = std::move(shadow.visibility);
    sources.confidence = std::move(shadow.confidence);
    takeLayers(look, LayerStage::light, sources, result);
  }
  if (colour)
    *colour = lightColour(plan, {tones.begin(), tones.end()}, toneWeights(look, plan.lights));
  Floats all;
  if (!oneToneIsAll(look, plan.lights))
    all = sumTones(look, plan.lights, {tones.begin(), tones.end()});
  else
    all = perLight ? tones.front().clone() : std::move(tones.front());
  if (perLight) *perLight = std::move(tones);
  return all;
}

}  // namespace kagefude
