#include "compositor/compose_frame.h"

#include <fmt/format.h>

#include <cmath>

#include "compositor/frame_edges.h"
#include "compositor/frame_tone.h"
#include "compositor/output_layers.h"
#include "compositor/paint_styles.h"
#include "compositor/scale_down.h"
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

void multiplyAlbedo(const FramePlanes& planes, const StyledSurfaces& styled, BrushResult& brush) {
  if (planes.albedo.empty()) return;
  parallelRows(planes.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < planes.width; ++x) {
        const uint16_t anchor = styled.anchorIndex(x, y);
        if (anchor == 0 || !styled.multiplies[anchor - 1u]) continue;
        brush.r(x, y) *= planes.albedo.x(x, y);
        brush.g(x, y) *= planes.albedo.y(x, y);
        brush.b(x, y) *= planes.albedo.z(x, y);
      }
  });
}

/// Associated "over": drawn lines over what is painted and what is not.
void putLinesOver(const FramePlanes& planes, BrushResult& brush) {
  parallelRows(planes.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < planes.width; ++x) {
        const float behind = 1.0f - planes.linesAlpha(x, y);
        brush.r(x, y) = planes.lines.x(x, y) + behind * brush.r(x, y);
        brush.g(x, y) = planes.lines.y(x, y) + behind * brush.g(x, y);
        brush.b(x, y) = planes.lines.z(x, y) + behind * brush.b(x, y);
        brush.a(x, y) = planes.linesAlpha(x, y) + behind * brush.a(x, y);
      }
  });
}

void showInputs(const FramePlanes& planes, View<const uint32_t> surfaces, StageSink& sink) {
  if (!planes.beauty.empty()) sink.picture("beauty", planes.beauty);
  if (!planes.albedo.empty()) sink.picture("albedo", planes.albedo);
  sink.directions("normals", planes.normal);
  sink.labels("objects", planes.objectId);
  sink.labels("surfaces", surfaces);
}

void noteBadPixels(const FramePlanes& planes, std::vector<std::string>& warnings) {
  const auto note = [&](size_t count, const char* what, const char* taken) {
    if (count)
      warnings.push_back(fmt::format("NaN or Inf in {} is taken as {} ({} pixel{})", what, taken,
                                     count, count == 1 ? "" : "s"));
  };
  note(planes.badPixels, "Position or Normal", "background");
  note(planes.badBeauty, "the beauty", "black");
  note(planes.badAlbedo, "the albedo", "black");
  note(planes.badCoverage, "the coverage of Cryptomatte", "wholly its first id");
}

}  // namespace

FrameResult composeFrame(const Look& asked, const StripSet& strips, const FramePlan& plan,
                         FramePlanes planes, StageSink* sink, StageClock* clock) {
  const Look look = inRenderedPixels(asked);
  FrameResult result;
  result.warnings = plan.warnings;
  result.warnings.insert(result.warnings.end(), planes.warnings.begin(), planes.warnings.end());
  if (planes.casting)
    result.warnings.insert(result.warnings.end(), planes.casting->warnings.begin(),
                           planes.casting->warnings.end());
  noteBadPixels(planes, result.warnings);
  Bytes joins;
  Labels surfaces =
      labelSurfaces(planes.objectId, planes.normal, planes.position, look.passes.surfaces, &joins);
  lap(clock, "surfaces");
  if (sink) showInputs(planes, surfaces, *sink);
  Floats tone = frameTone(look, plan, planes, surfaces, result, sink, clock);

  const StyledSurfaces styled = styleSurfaces(look, strips, plan, planes, result.warnings);
  result.fittingStyles = styled.fitting;
  adjustTone(tone, styled.anchorIndex, styled.tones);
  lap(clock, "styles and tone");
  if (sink) sink->number("brush.tone", tone);
  const bool diagnostics = sink || asksFor(look, "brush.angle") || asksFor(look, "brush.repeat");
  BrushResult brush = paintStyles(strips, planes, tone, styled, diagnostics);
  lap(clock, "brush");
  if (sink) {
    sink->number("brush.angle", brush.angle);
    sink->number("brush.repeat, within each ring", fractions(brush.repeat));
  }
  multiplyAlbedo(planes, styled, brush);
  if (look.output.edges == Edges::coverage && !std::getenv("NOINNER"))
    blendInside(plan, planes, styled, joins, brush);
  blendEdges(plan, planes, brush);
  if (look.output.background == Background::beauty && !planes.beauty.empty())
    putBeautyBehind(planes, brush);
  Floats outline = drawStyleOutlines(plan, planes, styled, asksFor(look, "outline"), brush);
  lap(clock, "edges and outlines");
  if (sink && !outline.empty()) sink->number("outline", outline);
  if (!planes.linesAlpha.empty()) putLinesOver(planes, brush);
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
