#pragma once

#include "compositor/frame_plan.h"
#include "compositor/frame_result.h"
#include "compositor/stage_clock.h"
#include "compositor/stage_sink.h"
#include "passes/tone/tone_floor.h"

namespace kagefude {

/// The tone of a frame from all its lights: shade merged with visibility (002 eq. 3.1, 4.8), then
/// summed by the lights' weights. `colour`, if not null, gets the colour of the light at every
/// pixel (lightColour), `perLight` each light's own tone (lightTone). Layers visibility.<light> go
/// to `result` where the look asks for them.
Floats frameTone(const Look& look, const FramePlan& plan, const FramePlanes& planes,
                 View<const uint32_t> surfaces, FrameResult& result, StageSink* sink,
                 StageClock* clock, Vec3Plane* colour = nullptr,
                 std::vector<Floats>* perLight = nullptr);

/// One light's part of it, before it is weighed against the others: its shade merged with
/// `visibility` at its shadow's strength, and how far and to which side it shines.
Floats lightTone(const Look& look, const FrameLight& light, View<const float> visibility,
                 const FramePlanes& planes, View<const uint32_t> surfaces, StageSink* sink);

/// Whether the tone of the first light is that of the frame as it is, without sumTones.
bool oneToneIsAll(const Look& look, const std::vector<FrameLight>& lights);

/// By what each light's tone counts in it.
std::vector<float> toneWeights(const Look& look, const std::vector<FrameLight>& lights);

/// One light by itself: its part of all light, and what its tone is multiplied by to be 1 where
/// the light falls in fully.
struct LightPart {
  float share = 0, toOwnTone = 0;
};
std::vector<LightPart> lightParts(const Look& look, const std::vector<FrameLight>& lights);

/// What is bright without the lights, for raiseTone.
ToneFloor toneFloor(const Look& look, const FramePlan& plan, const FramePlanes& planes);

/// The lights' tones by their weights, in the order of the plan's lights.
Floats sumTones(const Look& look, const std::vector<FrameLight>& lights,
                const std::vector<View<const float>>& tones);

}  // namespace kagefude
