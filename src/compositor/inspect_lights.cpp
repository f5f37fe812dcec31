#include "compositor/inspect_lights.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "compositor/light_visibility.h"
#include "compositor/read_frame.h"
#include "passes/light_shape/disc_error.h"

namespace kagefude {
namespace {

/// What nine masks leave in penumbrae without thin shadows is half of it.
constexpr float mostError = 0.04f;

bool isTold(const FrameLight& light) {
  return light.readsDepthMap || !light.maskChannels.empty() || !light.tracedChannel.empty();
}

/// What is left are the lights of which something can be told, edges, and what that takes.
void keepWhatIsTold(FramePlan& plan) {
  for (std::optional<Aov>* aov :
       {&plan.albedo, &plan.beauty, &plan.rest, &plan.uv, &plan.instanceRandom, &plan.materialId})
    aov->reset();
  plan.lines.clear();
  std::erase_if(plan.lights, [](const FrameLight& light) { return !isTold(light); });
}

/// Warnings end with what to do, behind their last semicolon.
Finding findingOf(const std::string& warning) {
  const size_t end = warning.rfind("; ");
  if (end == std::string::npos) return {FindingKind::warning, warning, ""};
  return {FindingKind::warning, warning.substr(0, end), warning.substr(end + 2)};
}

std::string moreMasks(const FrameLight& light, float error) {
  const int enough = masksFor(mostError, static_cast<int>(light.places.size()), error);
  if (enough == 0) return "export the shadow itself (--masks trace:64)";
  const std::string masks = fmt::format("export --masks disc:{}", enough);
  return light.light.type == LightType::area ? masks : masks + ", or its depth map";
}

void addWantedMasks(const FramePlan& plan, const FramePlanes& planes, Inspection& inspection) {
  for (size_t i = 0; i < plan.lights.size(); ++i) {
    const FrameLight& light = plan.lights[i];
    if (light.method != ShadowMethod::disc || !planes.lights[i].depthMap.empty()) continue;
    const std::optional<float> error =
        estimateDiscError(viewsOf(planes.lights[i].masks), light.places, planes.objectId,
                          planes.position, planes.normal, light.geometry, light.passes.lightShape);
    if (!error || *error <= mostError) continue;
    inspection.findings.push_back(
        {FindingKind::warning,
         fmt::format("light {}: {} masks are few for its thin shadows (an error of about {:.2f} in "
                     "the penumbra)",
                     light.name, light.places.size(), *error),
         moreMasks(light, *error)});
  }
}

}  // namespace

void inspectLights(const AovNames& names, Inspection& inspection) {
  Look look;
  look.frame = names;
  FramePlan plan;
  try {
    plan = planFrame(look, inspection.path, inspection.frame.value_or(1));
  } catch (const Error&) {
    return;
  }
  plan.meanNormalFault.clear();  // the headers have told it
  keepWhatIsTold(plan);
  const bool ownEdges = plan.sidecar && plan.coverage;
  if (plan.lights.empty() && !ownEdges) return;
  try {
    const FramePlanes planes = readFramePlanes(plan);
    for (const auto* warnings : {&planes.warnings, &planes.meanWarnings})
      for (const std::string& warning : *warnings)
        inspection.findings.push_back(findingOf(warning));
    addWantedMasks(plan, planes, inspection);
  } catch (const InputError& error) {
    inspection.findings.push_back({FindingKind::error, error.what(), "export the frame again"});
  }
}

}  // namespace kagefude
