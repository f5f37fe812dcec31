#include "compositor/finish_picture.h"

#include <fmt/format.h>

#include "compositor/frame_edges.h"
#include "image/parallel.h"

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

Floats finishPicture(const Look& look, const FramePlan& plan, const FramePlanes& planes,
                     const StyledSurfaces& styled, View<const uint8_t> joins, bool outlines,
                     BrushResult& brush) {
  multiplyAlbedo(planes, styled, brush);
  if (look.output.edges == Edges::coverage) blendInside(planes, styled, joins, brush);
  blendEdges(plan, planes, brush);
  if (look.output.background == Background::beauty && !planes.beauty.empty())
    putBeautyBehind(planes, brush);
  Floats outline = drawStyleOutlines(plan, planes, styled, outlines, brush);
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

}  // namespace kagefude
