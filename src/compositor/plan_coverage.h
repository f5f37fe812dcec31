#pragma once

#include "compositor/frame_plan.h"
#include "frame/aov_names.h"

namespace kagefude {

/// Plans what edges between things take: the Cryptomatte whose ids the object pass shares, where
/// the look wants clean edges, and the exporter's mean normals. Cryptomattes of the plan that lack
/// channels are said. The ids are planned already.
void planCoverage(const Look& look, const AovNames& names, FramePlan& plan);

}  // namespace kagefude
