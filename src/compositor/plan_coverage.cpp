#include "compositor/plan_coverage.h"

#include <fmt/format.h>

#include "frame/cryptomatte.h"
#include "frame/mean_normal_pass.h"

namespace kagefude {
namespace {

/// Of a Cryptomatte without any rank the name is all that tells.
bool isOfObjects(const AovNames& names, const std::string& name) {
  if (!names.cryptoObject.empty()) return name.ends_with(names.cryptoObject);
  return detail::aliasRank(AovKind::cryptoObject, name.substr(name.rfind('.') + 1)) >= 0;
}

/// Coverage needs ids that Cryptomatte and the object pass have in common.
bool wantsCoverage(const Look& look, const FramePlan& plan) {
  if (look.output.edges != Edges::coverage || plan.idSource == IdSource::surface) return false;
  return plan.idSource != IdSource::index || plan.sidecar;
}

/// The exporter's own pass beside its normals, in world space as they are.
void planMeanNormal(FramePlan& plan) {
  if (!plan.coverage || !plan.sidecar) return;
  MeanNormalPass found = findMeanNormal(plan.image, plan.normal);
  plan.meanNormalFault = std::move(found.fault);
  if (plan.meanNormalFault.empty()) plan.meanNormal = std::move(found.channels);
}

/// Of ranks that are read here; who lacks others loses nothing.
void noteBrokenCryptomattes(const AovNames& names, bool wantsCoverage, FramePlan& plan) {
  for (const Cryptomatte& broken : brokenCryptomattes(plan.image)) {
    const size_t left = broken.idChannels.size();
    const auto uses = [&](const Aov& aov, size_t ranks) {
      return aov.name == broken.name && left < ranks;
    };
    const bool ids = plan.idSource == IdSource::cryptomatte && uses(plan.objectId, dominantRanks);
    const bool materials = plan.materialId && plan.materialSource == IdSource::cryptomatte &&
                           uses(*plan.materialId, dominantRanks);
    const bool edges = plan.coverage
                           ? uses(*plan.coverage, edgeRanks)
                           : wantsCoverage && left == 0 && isOfObjects(names, broken.name);
    if (ids || materials || edges)
      plan.warnings.push_back(
          fmt::format("{}; what it and those after it cover is not known, so edges are less clean; "
                      "export the frame again",
                      broken.fault));
  }
}

}  // namespace

void planCoverage(const Look& look, const AovNames& names, FramePlan& plan) {
  const bool coverage = wantsCoverage(look, plan);
  if (coverage) plan.coverage = findAov(plan.image, names, AovKind::cryptoObject);
  planMeanNormal(plan);
  noteBrokenCryptomattes(names, coverage, plan);
}

}  // namespace kagefude
