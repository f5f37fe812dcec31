#include "live/frame_stages.h"

#include <fmt/format.h>

#include <algorithm>

#include "compositor/finish_picture.h"
#include "compositor/frame_ground.h"
#include "compositor/frame_tint.h"
#include "compositor/frame_tone.h"
#include "compositor/own_lights.h"
#include "compositor/paint_styles.h"
#include "compositor/scale_down.h"
#include "live/stage_keys.h"
#include "passes/tone/smooth.h"
#include "passes/tone/surfaces.h"

namespace kagefude {
namespace {

StageKey keyOf(std::initializer_list<uint64_t> versions) {
  StageKey key;
  for (const uint64_t version : versions) key.add(version);
  return key;
}

std::vector<View<const float>> tonesOf(const StagedFrame& frame) {
  std::vector<View<const float>> tones;
  for (const LightStagesMade& light : frame.lights) tones.push_back(light.tone->view());
  return tones;
}

FinishedPicture finish(const Look& look, const StripSet& strips, const FramePlan& plan,
                       const StagedFrame& frame) {
  BrushResult brush = cloneColours(*frame.strokes);
  FinishedPicture picture;
  Vec3Plane light;
  if (lightsTint(look)) light = lightColour(plan, tonesOf(frame), toneWeights(look, plan.lights));
  FinishInput input{look,
                    strips,
                    plan,
                    *frame.planes,
                    frame.styles->surfaces,
                    *frame.tone,
                    frame.surfaces->joins};
  if (!light.empty()) input.lightColour = &light;
  if (frame.ownLights.value) input.ownLights = frame.ownLights.value.get();
  picture.outline = finishPicture(input, brush);
  picture.frame.colour.x = std::move(brush.r);
  picture.frame.colour.y = std::move(brush.g);
  picture.frame.colour.z = std::move(brush.b);
  picture.frame.alpha = std::move(brush.a);
  scaleDown(look, plan, frame.surfaces->labels, picture.frame);
  return picture;
}

}  // namespace

LightStagesMade FrameStages::composeLight(const Look& look, const FramePlan& plan, size_t index,
                                          const StagedFrame& frame, StageRun& run) {
  const FrameLight& light = plan.lights[index];
  LightStages& stages = lights_[light.name];
  LightStagesMade made;
  made.name = light.name;

  StageKey shadow = keyOf({frame.planes.version, frame.surfaces.version, index});
  addShadow(shadow, plan, light);
  made.shadow = stages.shadow.at(run, "shadow of " + light.name, std::move(shadow), [&] {
    const ShadowWork work{light, plan, frame.planes->lights[index], *frame.planes,
                          frame.surfaces->labels};
    return actingMethod(light, work.planes).function(work);
  });

  // Not a copy where nothing is smoothed.
  made.visibility = {{made.shadow.value, &made.shadow->visibility}, made.shadow.version};
  if (isSmoothed(light, frame.planes->lights[index])) {
    StageKey smooth = keyOf({made.shadow.version, frame.surfaces.version});
    smooth.add(smoothTable, &light.passes.smooth);
    made.visibility = stages.smoothed.at(run, "smoothing of " + light.name, std::move(smooth), [&] {
      return smoothWithinSurfaces(made.shadow->visibility, frame.surfaces->labels,
                                  light.passes.smooth);
    });
  } else {
    stages.smoothed = {};
  }

  StageKey tone = keyOf({frame.planes.version, frame.surfaces.version, made.visibility.version});
  addLight(tone, light);
  addWeight(tone, light);
  tone.add(light.strength).add(look.passes.tone.light);
  tone.add(shadeTable, &light.passes.shade).add(mergeTable, &light.passes.merge);
  made.tone = stages.tone.at(run, "tone of " + light.name, std::move(tone), [&] {
    return lightTone(look, light, *made.visibility, *frame.planes, frame.surfaces->labels, nullptr);
  });
  return made;
}

Made<Floats> FrameStages::composeTone(const Look& look, const FramePlan& plan,
                                      const StagedFrame& frame, StageRun& run) {
  if (oneToneIsAll(look, plan.lights)) {
    sum_ = {};
    return frame.lights.front().tone;
  }
  StageKey key;
  key.add(look.passes.tone.light).add(mergeTable, &look.passes.merge);
  for (size_t i = 0; i < plan.lights.size(); ++i) {
    key.add(frame.lights[i].tone.version);
    addWeight(key, plan.lights[i]);
  }
  return sum_.at(run, "sum of tones", std::move(key),
                 [&] { return sumTones(look, plan.lights, tonesOf(frame)); });
}

/// The tone of the lights without strips of their own. `tone` is the key of that of all.
Made<Floats> FrameStages::composeShared(const Look& look, const FramePlan& plan,
                                        const StagedFrame& frame, StageKey tone, StageRun& run) {
  const StyledSurfaces& styled = frame.styles->surfaces;
  tone.add(frame.styles.version);
  for (const LightStagesMade& light : frame.lights) tone.add(light.tone.version);
  return shared_.at(run, "tone of shared lights", std::move(tone), [&] {
    Floats shared = sharedTone(look, plan, styled, tonesOf(frame));
    levelTone(toneFloor(look, plan, *frame.planes), styled, shared);
    return shared;
  });
}

void FrameStages::paint(const Look& look, const Made<StripSet>& strips, const FramePlan& plan,
                        StagedFrame& frame, StageRun& run) {
  StageKey strokes = keyOf({frame.planes.version, strips.version});
  addStrokes(strokes, look, plan);
  StageKey styles = strokes;
  addStyleColours(styles, look);
  frame.styles = styles_.at(run, "styles", std::move(styles), [&] {
    DoubtedStyles doubted;
    doubted.surfaces = styleSurfaces(look, *strips, plan, *frame.planes, doubted.warnings);
    return doubted;
  });

  const StyledSurfaces& styled = frame.styles->surfaces;
  const Made<Floats> sum = composeTone(look, plan, frame, run);
  StageKey tone = keyOf({sum.version, frame.planes.version});
  for (const ToneParams& own : styled.tones) tone.add(toneTable, &own);
  const ToneFloor floor = toneFloor(look, plan, *frame.planes);
  tone.add(floor.world).add(floor.emissionUnit);
  const StageKey toneKey = tone;
  frame.tone = tone_.at(run, "tone", std::move(tone), [&] {
    Floats adjusted = sum->clone();
    levelTone(floor, styled, adjusted);
    return adjusted;
  });

  Made<Floats> shared = frame.tone;
  if (styled.ownLights.empty()) {
    shared_ = {};
    ownLights_ = {};
  } else {
    shared = composeShared(look, plan, frame, toneKey, run);
    StageKey own = strokes;
    own.add(shared.version).add(frame.surfaces.version).add(frame.styles.version);
    frame.ownLights = ownLights_.at(run, "lights with strips of their own", std::move(own), [&] {
      return paintOwnLights(look, *strips, plan, *frame.planes, styled, frame.surfaces->labels,
                            tonesOf(frame));
    });
  }
  strokes.add(shared.version).add(frame.surfaces.version).add(keepsGrain(look, styled));
  frame.strokes = strokes_.at(run, "strokes", std::move(strokes), [&] {
    return paintStyles(*strips, *frame.planes, *shared, styled, frame.surfaces->labels, false,
                       keepsGrain(look, styled));
  });

  StageKey picture = keyOf(
      {frame.strokes.version, frame.styles.version, frame.planes.version, frame.surfaces.version});
  picture.add(frame.tone.version).add(frame.ownLights.version).add(strips.version);
  picture.add(look.output.background).add(look.output.edges).add(look.output.scale);
  picture.add(groundTable, &look.passes.ground).add(paperTable, &look.passes.paper);
  picture.add(look.frame.up);
  frame.picture = picture_.at(run, "picture", std::move(picture),
                              [&] { return finish(look, *strips, plan, frame); });
}

/// Lights that take no part any more give their memory back.
void FrameStages::forgetLights(const FramePlan& plan) {
  std::erase_if(lights_, [&](const auto& entry) {
    return std::none_of(plan.lights.begin(), plan.lights.end(),
                        [&](const FrameLight& light) { return light.name == entry.first; });
  });
}

StagedFrame FrameStages::compose(const Look& look, const Made<StripSet>& strips,
                                 const FramePlan& plan, const Made<FramePlanes>& planes,
                                 StageRun& run) {
  StagedFrame frame;
  frame.planes = planes;
  frame.warnings = inputWarnings(plan, *planes);
  forgetLights(plan);
  StageKey surfaces = keyOf({planes.version});
  surfaces.add(surfacesTable, &look.passes.surfaces);
  frame.surfaces = surfaces_.at(run, "surfaces", std::move(surfaces), [&] {
    FrameSurfaces made;
    made.labels = labelSurfaces(planes->objectId, planes->normal, planes->position,
                                look.passes.surfaces, &made.joins);
    return made;
  });
  for (size_t i = 0; i < plan.lights.size(); ++i)
    frame.lights.push_back(composeLight(look, plan, i, frame, run));
  paint(look, strips, plan, frame, run);
  const std::vector<std::string>& doubts = frame.styles->warnings;
  frame.warnings.insert(frame.warnings.end(), doubts.begin(), doubts.end());
  for (std::string& warning : edgeWarnings(*planes, frame.styles->surfaces))
    frame.warnings.push_back(std::move(warning));
  return frame;
}

}  // namespace kagefude
