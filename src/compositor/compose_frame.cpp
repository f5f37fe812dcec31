#include "compositor/compose_frame.h"

#include <algorithm>
#include <cmath>

#include "compositor/finish_picture.h"
#include "compositor/frame_ground.h"
#include "compositor/frame_tint.h"
#include "compositor/frame_tone.h"
#include "compositor/output_layers.h"
#include "compositor/own_lights.h"
#include "compositor/paint_styles.h"
#include "compositor/scale_down.h"
#include "compositor/stroke_normals.h"
#include "compositor/styled_surfaces.h"
#include "image/parallel.h"
#include "passes/tone/surfaces.h"

namespace kagefude {
namespace {

/// Repeat counts run far above 1; their fractions show the rings.
Floats fractions(View<const float> values) {
  Floats result(values.width, values.height);
  parallelRows(values.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < values.width; ++x) result(x, y) = values(x, y) - std::floor(values(x, y));
  });
  return result;
}

void showInputs(const FramePlanes& planes, View<const uint32_t> surfaces, StageSink& sink) {
  if (!planes.beauty.empty()) sink.picture("beauty", planes.beauty);
  if (!planes.albedo.empty()) sink.picture("albedo", planes.albedo);
  sink.directions("normals", planes.normal);
  sink.labels("objects", planes.objectId);
  sink.labels("surfaces", surfaces);
}

bool multipliesAny(const StyledSurfaces& styled) {
  const auto any = [](const std::vector<bool>& multiplies) {
    return std::find(multiplies.begin(), multiplies.end(), true) != multiplies.end();
  };
  return any(styled.multiplies) ||
         std::any_of(styled.ownLights.begin(), styled.ownLights.end(),
                     [&](const OwnLight& light) { return any(light.multiplies); });
}

/// Surfaces have their styles and strokes their places; what those were made of is read by no one
/// else, nor is the colour of surfaces that no style multiplies.
void freeStyled(const StyledSurfaces& styled, FramePlanes& planes) {
  if (!multipliesAny(styled)) planes.albedo = {};
  planes.rest = {};
  for (Floats* plane : {&planes.u, &planes.v, &planes.instanceRandom}) *plane = {};
  for (Labels* plane : {&planes.objectId, &planes.materialId}) *plane = {};
}

/// Whether the surfaces are still wanted once the tone is known.
bool wantsSurfaces(const Look& look, const StyledSurfaces& styled) {
  return smoothsNormals(styled) || look.output.scale > 1 || asksFor(look, "surface.id");
}

}  // namespace

FrameResult composeFrame(const Look& asked, const StripSet& strips, const FramePlan& plan,
                         FramePlanes planes, StageSink* sink, StageClock* clock) {
  const Look look = inRenderedPixels(asked);
  FrameResult result;
  result.warnings = inputWarnings(plan, planes);
  Bytes joins;
  Labels surfaces =
      labelSurfaces(planes.objectId, planes.normal, planes.position, look.passes.surfaces, &joins);
  lap(clock, "surfaces");
  if (sink) showInputs(planes, surfaces, *sink);
  Vec3Plane light;
  Vec3Plane* const wantedLight = lightsTint(look) ? &light : nullptr;
  std::vector<Floats> perLight;
  std::vector<Floats>* const wantedTones = paintsOwnLights(look, plan) ? &perLight : nullptr;
  Floats tone =
      frameTone(look, plan, planes, surfaces, result, sink, clock, wantedLight, wantedTones);
  planes.lights.clear();

  const StyledSurfaces styled = styleSurfaces(look, strips, plan, planes, result.warnings);
  for (std::string& warning : edgeWarnings(planes, styled))
    result.warnings.push_back(std::move(warning));
  result.fittingStyles = styled.fitting;
  result.outrankedStyles = styled.outranked;
  result.paintingStyles.resize(look.styles.size());
  for (const int style : styled.styles)
    if (style >= 0) result.paintingStyles[static_cast<size_t>(style)] = true;
  const std::vector<View<const float>> tones(perLight.begin(), perLight.end());
  const bool ownLights = !styled.ownLights.empty();
  Floats shared = ownLights ? sharedTone(look, plan, styled, tones) : Floats();
  const ToneFloor floor = toneFloor(look, plan, planes);
  levelTone(floor, styled, tone);
  if (ownLights) levelTone(floor, styled, shared);
  freeStyled(styled, planes);
  if (!wantsSurfaces(look, styled)) surfaces = {};
  lap(clock, "styles and tone");
  if (sink) sink->number("brush.tone", tone);
  const bool diagnostics = sink || asksFor(look, "brush.angle") || asksFor(look, "brush.repeat");
  BrushResult brush = paintStyles(strips, planes, ownLights ? shared : tone, styled, surfaces,
                                  diagnostics, keepsGrain(look, styled));
  const BrushResult added = paintOwnLights(look, strips, plan, planes, styled, surfaces, tones);
  lap(clock, "brush");
  if (sink) {
    sink->number("brush.angle", brush.angle);
    sink->number("brush.repeat, within each ring", fractions(brush.repeat));
  }
  FinishInput finish{look, strips, plan, planes, styled, tone, joins};
  finish.lightColour = wantedLight;
  finish.ownLights = &added;
  finish.outlines = asksFor(look, "outline");
  Floats outline = finishPicture(finish, brush);
  lap(clock, "edges and outlines");
  if (sink && !outline.empty()) sink->number("outline", outline);
  result.colour.x = std::move(brush.r);
  result.colour.y = std::move(brush.g);
  result.colour.z = std::move(brush.b);
  result.alpha = std::move(brush.a);
  if (sink) sink->picture("result", result.colour);
  const Labels own = look.output.scale == 1 ? Labels() : surfaces.clone();
  LayerSources sources{planes};
  sources.tone = std::move(tone);
  sources.outline = std::move(outline);
  sources.angle = std::move(brush.angle);
  sources.repeat = std::move(brush.repeat);
  sources.surfaces = std::move(surfaces);
  takeLayers(look, LayerStage::frame, sources, result);
  scaleDown(look, plan, own, result);
  return result;
}

}  // namespace kagefude
