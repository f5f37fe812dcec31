#pragma once

#include "compositor/frame_plan.h"
#include "compositor/frame_result.h"
#include "compositor/stage_clock.h"
#include "compositor/stage_sink.h"

namespace kagefude {

/// The tone of a frame from all its lights: shade merged with visibility (002 eq. 3.1, 4.8), then
/// summed by the lights' weights. Layers visibility.<light> go to `result` where the look asks for
/// them.
Floats frameTone(const Look& look, const FramePlan& plan, const FramePlanes& planes,
                 View<const uint32_t> surfaces, FrameResult& result, StageSink* sink,
                 StageClock* clock);

}  // namespace kagefude
