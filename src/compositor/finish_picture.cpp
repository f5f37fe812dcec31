#include "compositor/finish_picture.h"

#include <fmt/format.h>

#include "compositor/frame_edges.h"
#include "compositor/frame_ground.h"
#include "compositor/frame_tint.h"
#include "compositor/own_lights.h"
#include "image/parallel.h"
#include "passes/ground/paper_deposit.h"

namespace kagefude {
namespace {

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

/// Painted edges want each thing's paint by itself, so things meet in two steps there.
bool meetByNormals(const FinishInput& in) {
  return in.look.output.edges == Edges::coverage && knowsMeanNormals(in.planes) &&
         !paintsEdges(in.styled);
}

/// Where edges run inside a thing they may be clean already.
void letThingsMeet(const FinishInput& in, BrushResult& brush) {
  if (meetByNormals(in))
    blendByNormals(in.plan, in.planes, in.styled, in.joins, brush);
  else
    blendEdges(in.plan, in.planes, in.styled, brush);
}

PaintViews viewsOf(BrushResult& brush) { return {brush.r, brush.g, brush.b, brush.a}; }

/// Paint takes to the paper before things meet, so that each knows its own tone; what it leaves
/// bare shows the ground.
void layOnGround(const FinishInput& in, BrushResult& brush) {
  const PaperParams& paper = in.look.passes.paper;
  const PaperSurface surface = framePaper(in);
  if (paper.strength > 0.0f) depositPaint(viewsOf(brush), in.tone, brush.grain, surface, paper);
  const bool edges = paintsEdges(in.styled);
  BrushResult own;
  if (edges) own = cloneColours(brush);
  letThingsMeet(in, brush);
  const FrameGround ground(in, brush.a, surface);
  if (edges) paintStyleEdges(in.plan, in.planes, in.styled, own, ground.get(), brush);
  if (ground.get()) layOver(viewsOf(brush), *ground.get());
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
}

}  // namespace

Floats finishPicture(const FinishInput& in, BrushResult& brush) {
  const FramePlanes& planes = in.planes;
  multiplyAlbedo(planes, in.styled, brush);
  tintPaint(in.styled, in.tone, in.lightColour, brush);
  if (in.ownLights) addOwnLights(*in.ownLights, brush);
  if (in.look.output.edges == Edges::coverage && !meetByNormals(in))
    blendInside(planes, in.styled, in.joins, brush);
  if (usesGround(in.look, in.styled)) {
    layOnGround(in, brush);
  } else {
    letThingsMeet(in, brush);
    if (in.look.output.background == Background::beauty && !planes.beauty.empty())
      putBeautyBehind(planes, brush);
  }
  Floats outline = drawStyleOutlines(in.plan, planes, in.styled, in.outlines, brush);
  if (!planes.linesAlpha.empty()) putLinesOver(planes, brush);
  return outline;
}

std::vector<std::string> inputWarnings(const FramePlan& plan, const FramePlanes& planes) {
  std::vector<std::string> warnings = plan.warnings;
  warnings.insert(warnings.end(), planes.warnings.begin(), planes.warnings.end());
  if (planes.casting)
    warnings.insert(warnings.end(), planes.casting->warnings.begin(),
                    planes.casting->warnings.end());
  noteBadPixels(planes, warnings);
  return warnings;
}

std::vector<std::string> edgeWarnings(const FramePlanes& planes, const StyledSurfaces& styled) {
  return paintsEdges(styled) ? std::vector<std::string>{} : planes.meanWarnings;
}

}  // namespace kagefude
