#include "compositor/frame_ground.h"

#include <algorithm>

#include "compositor/frame_edges.h"
#include "image/parallel.h"
#include "passes/ground/behind_things.h"
#include "passes/ground/fitted_picture.h"
#include "passes/ground/painted_sky.h"
#include "passes/ground/paper_deposit.h"

namespace kagefude {
namespace {

SkyView skyView(const FinishInput& in) {
  const Window& data = in.plan.image.dataWindow;
  const Window& display = in.plan.image.displayWindow;
  SkyView view{in.planes.width,    in.planes.height, data.x - display.x,
               data.y - display.y, display.width,    display.height};
  view.rays = in.planes.rays ? &*in.planes.rays : nullptr;
  view.upIsY = in.look.frame.up == WorldUp::y;
  return view;
}

ColourPlanes emptyColours(const FinishInput& in) {
  const int width = in.planes.width, height = in.planes.height;
  return {Floats(width, height), Floats(width, height), Floats(width, height),
          Floats(width, height)};
}

PaintViews viewsOf(ColourPlanes& planes) { return {planes.r, planes.g, planes.b, planes.a}; }
ColourViews viewsOf(const ColourPlanes& planes) { return {planes.r, planes.g, planes.b, planes.a}; }

V3f colourOf(const std::vector<float>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

/// One colour, with the paper's light and shade where there is paper.
ColourPlanes flatGround(const FinishInput& in, const V3f& colour, const PaperTooth& tooth) {
  ColourPlanes ground = emptyColours(in);
  parallelRows(in.planes.height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      for (int x = 0; x < in.planes.width; ++x) {
        const float factor =
            tooth.slope.empty() ? 1.0f : reliefFactor(tooth.slope(x, y), in.look.passes.paper);
        ground.r(x, y) = colour.x * factor;
        ground.g(x, y) = colour.y * factor;
        ground.b(x, y) = colour.z * factor;
        ground.a(x, y) = 1.0f;
      }
    }
  });
  return ground;
}

/// Whether no painted thing has a part of the pixel.
bool isOpen(const FinishInput& in, View<const float> alpha, int x, int y) {
  return in.styled.anchorIndex(x, y) == 0 && alpha(x, y) == 0.0f;
}

/// The beauty where nothing is painted, and beside what is.
ColourPlanes openBeauty(const FinishInput& in, View<const float> alpha) {
  Bytes open(in.planes.width, in.planes.height);
  parallelRows(in.planes.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < in.planes.width; ++x) open(x, y) = isOpen(in, alpha, x, y) ? 1 : 0;
  });
  const Vec3Plane& beauty = in.planes.beauty;
  return extendBehindThings({beauty.x, beauty.y, beauty.z, in.planes.alpha}, open);
}

/// Share of each pixel that painted things cover.
float coveredShare(const FinishInput& in, int x, int y) {
  if (in.planes.coverageIds.empty()) return in.styled.anchorIndex(x, y) != 0 ? 1.0f : 0.0f;
  float sum = 0;
  for (size_t i = 0; i < in.planes.coverageIds.size(); ++i)
    if (in.planes.coverageIds[i](x, y) != 0) sum += in.planes.coverageShares[i](x, y);
  return std::min(sum, 1.0f);
}

/// Puts paper under things, by what of them the paint leaves open.
void putPaperUnderThings(const FinishInput& in, View<const float> alpha, const PaperTooth& tooth,
                         ColourPlanes& ground) {
  const ColourPlanes paper = flatGround(in, colourOf(in.look.passes.paper.colour), tooth);
  parallelRows(in.planes.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < in.planes.width; ++x) {
        const float covered = isOpen(in, alpha, x, y) ? 0.0f : coveredShare(in, x, y);
        if (covered <= 0.0f) continue;
        const float beside = 1.0f - covered, gaps = std::max(covered - alpha(x, y), 0.0f);
        const float share = beside + gaps > 0.0f ? gaps / (beside + gaps) : 1.0f;
        ground.r(x, y) += (paper.r(x, y) - ground.r(x, y)) * share;
        ground.g(x, y) += (paper.g(x, y) - ground.g(x, y)) * share;
        ground.b(x, y) += (paper.b(x, y) - ground.b(x, y)) * share;
        ground.a(x, y) += (paper.a(x, y) - ground.a(x, y)) * share;
      }
  });
}

bool paintHasGaps(const FinishInput& in) {
  return in.look.passes.paper.strength > 0.0f ||
         std::any_of(in.styled.edges.begin(), in.styled.edges.end(),
                     [](const PaintedEdgeParams& edges) { return edges.dry > 0.0f; });
}

ColourPlanes beautyGround(const FinishInput& in, View<const float> alpha, const PaperTooth& tooth) {
  if (in.planes.beauty.empty()) return {};
  ColourPlanes ground = openBeauty(in, alpha);
  if (paintHasGaps(in)) putPaperUnderThings(in, alpha, tooth, ground);
  return ground;
}

/// A painted sky is paint as well, and lies on the paper.
ColourPlanes skyGround(const FinishInput& in, View<const float> alpha, const PaperTooth& tooth) {
  const GroundParams& params = in.look.passes.ground;
  const SkyView view = skyView(in);
  ColourPlanes beauty;
  if (params.row == GroundParams::Row::beauty && !in.planes.beauty.empty())
    beauty = openBeauty(in, alpha);
  const Floats tone = skyTone(view, params, {beauty.r, beauty.g, beauty.b});
  const Strip& strip = in.strips.strips()[static_cast<size_t>(in.strips.indexOf(params.strip))];
  ColourPlanes sky = paintSky(strip, tone, view, params);
  const PaperParams& paper = in.look.passes.paper;
  if (!(paper.strength > 0.0f) && strip.opaque) return sky;
  if (paper.strength > 0.0f)
    depositPaint(viewsOf(sky), tone, {}, {tooth.height, tooth.slope}, paper);
  ColourPlanes under = flatGround(in, colourOf(paper.colour), tooth);
  layOver(viewsOf(sky), viewsOf(std::as_const(under)));
  return sky;
}

}  // namespace

bool usesGround(const Look& look, const StyledSurfaces& styled) {
  const Background background = look.output.background;
  return (background != Background::beauty && background != Background::transparent) ||
         look.passes.paper.strength > 0.0f || paintsEdges(styled);
}

bool keepsGrain(const Look& look, const StyledSurfaces& styled) {
  return look.passes.paper.strength > 0.0f || paintsEdges(styled);
}

PaperTooth frameTooth(const FinishInput& in) {
  const PaperParams& paper = in.look.passes.paper;
  if (!(paper.strength > 0.0f) && in.look.output.background != Background::paper) return {};
  const ToothTile tile(paper);
  const SkyView view = skyView(in);
  if (paper.fixed == PaperParams::Fixed::screen || !view.rays)
    return screenTooth(tile, view.width, view.height, view.offsetX, view.offsetY);
  ToothPlaces places{in.planes.position, in.planes.normal, in.styled.rest, in.styled.anchorIndex,
                     in.styled.anchors};
  places.rays = view.rays;
  places.upIsY = view.upIsY;
  return worldTooth(tile, places);
}

ColourPlanes frameGround(const FinishInput& in, View<const float> alpha, const PaperTooth& tooth) {
  switch (in.look.output.background) {
    case Background::beauty:
      return beautyGround(in, alpha, tooth);
    case Background::transparent:
      return {};
    case Background::colour:
      return flatGround(in, colourOf(in.look.passes.ground.colour), tooth);
    case Background::paper:
      return flatGround(in, colourOf(in.look.passes.paper.colour), tooth);
    case Background::picture:
      return fitPicture(*in.strips.picture(), skyView(in));
    case Background::strip:
      return skyGround(in, alpha, tooth);
  }
  return {};
}

}  // namespace kagefude
