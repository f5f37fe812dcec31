#pragma once

#include "compositor/frame_plan.h"
#include "compositor/frame_result.h"
#include "compositor/stage_clock.h"
#include "compositor/stage_sink.h"
#include "compositor/strip_set.h"

namespace kagefude {

/// Runs the look on one frame: surfaces, each light's visibility, shade and merge, tone, brush,
/// and the composite over the background (method sections 3 to 8). `planes` is used up. `sink`, if
/// given, is shown every intermediate picture; `clock`, if given, times the stages. The same bits
/// for any number of threads.
FrameResult composeFrame(const Look& look, const StripSet& strips, const FramePlan& plan,
                         FramePlanes planes, StageSink* sink = nullptr,
                         StageClock* clock = nullptr);

}  // namespace kagefude
