#include "compositor/inspect_depth_maps.h"

#include <algorithm>

#include "base/error.h"
#include "compositor/read_frame.h"

namespace kagefude {
namespace {

/// What is left are the lights whose maps are read, and what these are held against.
void keepWhatMapsNeed(FramePlan& plan) {
  for (std::optional<Aov>* aov : {&plan.albedo, &plan.beauty, &plan.rest, &plan.uv,
                                  &plan.instanceRandom, &plan.coverage, &plan.materialId})
    aov->reset();
  plan.lines.clear();
  plan.meanNormal.clear();
  std::erase_if(plan.lights, [](const FrameLight& light) { return !light.readsDepthMap; });
}

/// Warnings end with what to do, behind their last semicolon.
Finding findingOf(const std::string& warning) {
  const size_t end = warning.rfind("; ");
  if (end == std::string::npos) return {FindingKind::warning, warning, ""};
  return {FindingKind::warning, warning.substr(0, end), warning.substr(end + 2)};
}

}  // namespace

void inspectDepthMaps(const AovNames& names, Inspection& inspection) {
  if (std::none_of(inspection.lights.begin(), inspection.lights.end(),
                   [](const InspectedLight& light) { return light.depthMapFound; }))
    return;
  Look look;
  look.frame = names;
  FramePlan plan;
  try {
    plan = planFrame(look, inspection.path, inspection.frame.value_or(1));
  } catch (const Error&) {
    return;
  }
  keepWhatMapsNeed(plan);
  if (plan.lights.empty()) return;
  try {
    for (const std::string& warning : readFramePlanes(plan).warnings)
      inspection.findings.push_back(findingOf(warning));
  } catch (const InputError& error) {
    inspection.findings.push_back({FindingKind::error, error.what(), "export the frame again"});
  }
}

}  // namespace kagefude
