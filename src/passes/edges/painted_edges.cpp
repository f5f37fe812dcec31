#include "passes/edges/painted_edges.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"
#include "image/real_math.h"
#include "passes/edges/border_sites.h"
#include "passes/edges/edge_tones.h"
#include "passes/require_size.h"
#include "passes/search/nearest_site.h"

namespace kagefude {
namespace {

/// Colour with its pigment `dense` times as dense, but no less than 1 / dense as bright: what is
/// dark already gains colour, not blackness.
Rgba pooled(const Rgba& colour, float dense) {
  const float alpha = colour[3];
  if (!(alpha > 0.0f) || dense == 1.0f) return colour;
  Rgba result = colour;
  for (int k = 0; k < 3; ++k) {
    const float own = colour[k] / alpha;
    if (own > 0.0f && own < 1.0f) result[k] = alpha * powerOf(own, dense);
  }
  const float now = paintLuminance(result), least = paintLuminance(colour) / dense;
  if (dense > 1.0f && now > 0.0f && now < least)
    for (int k = 0; k < 3; ++k) result[k] *= least / now;
  return result;
}

/// A pixel before a border.
struct BeforeBorder {
  float inside = 0;  ///< distance from the border into the pixel's own side, pixels
  float along = 0;   ///< way along it from the site's middle, as slopes go
  PixelAt beyond;    ///< as far beyond it, or at it where that is of a third thing
};

class EdgePainter {
 public:
  EdgePainter(const EdgePaint& in, const EdgeBorders& borders, const BorderSites& sites)
      : in_(in), borders_(borders), sites_(sites) {}

  void paint(int x, int y, uint32_t nearest, const PaintViews& paint) const {
    const BorderSite* const site = sites_.find(x, y, nearest);
    if (site == nullptr) return;
    const PaintedEdgeParams& own = borders_.paramsAt({x, y});
    const PaintedEdgeParams& other = borders_.paramsAt(site->other);
    const PaintedEdgeParams& front = site->inFront ? own : other;
    const BeforeBorder at = before(x, y, *site);
    if (at.inside > changedWithin(front) + (site->inFront ? own.rim : 0.0f)) {
      if (site->inFront) leaveOut(dryShare(own, at.inside, *site, {x, y}), x, y, paint);
      return;
    }
    const PixelAt& frontAt = site->inFront ? PixelAt{x, y} : at.beyond;
    const float room = roomFor(*site);
    const float grain = held(site->grain + site->slope * at.along +
                             bristles(front) * in_.grain(frontAt.x, frontAt.y));
    // Distance into the own side, past the border where the grain has moved it.
    const float most = mostMoved(front, *site);
    const float shift = most * (grain + front.overrun);
    const float inside = at.inside + (site->inFront ? shift : -shift);
    const float gap = dryShare(front, site->inFront ? at.inside : -at.inside, *site, frontAt);
    const float rimOwn = site->inFront ? rimDensity(own, inside, site->melted, grain) : 1.0f;
    const bool moves = room > 0.0f && (front.rough > 0.0f || site->melted > 0.0f);
    const bool meets = moves || (room > 0.0f && gap > 0.0f && at.inside < 1.0f);
    if (!meets && rimOwn == 1.0f && gap == 0.0f) return;

    const float ownGap = site->inFront ? gap : 0.0f, otherGap = gap - ownGap;
    const Rgba still = pooled(paintAt(paint, x, y), rimOwn) * (1.0f - ownGap);
    // Where an edge is lost, strokes of both sides reach into each other.
    const float melt =
        std::min(front.lost * site->melted, 2.0f * std::min(site->half, site->behind));
    const float reached = 0.25f * melt * held(0.7f * in_.grain(frontAt.x, frontAt.y));
    const float width = slanted(most * site->slope) + 0.15f * most + 0.5f * melt;
    const float share =
        std::clamp((inside + (site->inFront ? reached : -reached)) / width + 0.5f, 0.0f, 1.0f);
    if (!meets || (share >= 1.0f && at.inside > 1.0f)) return setPaint(paint, x, y, still);
    const Rgba here = pooled(paintAt(in_.own, x, y), rimOwn);
    const float rimOther = site->inFront ? 1.0f : rimDensity(other, -inside, site->melted, grain);
    const Rgba there = pooled(paintAt(in_.own, at.beyond.x, at.beyond.y), rimOther);
    const Rgba moved =
        here * (share * (1.0f - ownGap)) + there * ((1.0f - share) * (1.0f - otherGap));
    setPaint(paint, x, y, still + (moved - still) * room);
  }

  /// How far from a border anything is done.
  static float reachOf(const PaintedEdgeParams& p) {
    const float moved = p.rough * (1.0f + std::fabs(p.overrun)) + 0.5f * p.lost + 2.0f;
    return std::max(moved + p.rim, p.dry > 0.0f ? 1.5f * p.dryWidth : 0.0f);
  }

 private:
  /// How far from the border its paint may be mixed with that beyond it.
  static float changedWithin(const PaintedEdgeParams& p) {
    return p.rough * (1.075f + std::fabs(p.overrun)) + 0.5f * p.lost + 1.0f;
  }

  /// All that is left to do further away.
  static void leaveOut(float gap, int x, int y, const PaintViews& paint) {
    if (gap == 0.0f) return;
    setPaint(paint, x, y, paintAt(paint, x, y) * (1.0f - gap));
  }

  /// A border is straight near each of its pixels, for three quarters of a pixel to both sides.
  BeforeBorder before(int x, int y, const BorderSite& site) const {
    const float dx = static_cast<float>(x) - site.x, dy = static_cast<float>(y) - site.y;
    const float across = dx * site.outX + dy * site.outY;
    const float along = dx * site.outY - dy * site.outX;
    const float straight = std::clamp(along, -0.75f, 0.75f);
    const float distance = std::sqrt(across * across + (along - straight) * (along - straight));
    BeforeBorder at{across > 0.0f ? -distance : distance, straight, site.other};
    const PixelAt mirror{x + static_cast<int>(std::floor(0.5f - 2.0f * across * site.outX)),
                         y + static_cast<int>(std::floor(0.5f - 2.0f * across * site.outY))};
    if (in_.things.contains(mirror.x, mirror.y) &&
        in_.things(mirror.x, mirror.y) == in_.things(site.other.x, site.other.y))
      at.beyond = mirror;
    return at;
  }

  /// How much of the widths there is room for: none in what is hardly wider than a pixel, which
  /// would fall to crumbs.
  static float roomFor(const BorderSite& site) {
    return std::clamp(std::min(site.half, site.behind) - 1.0f, 0.0f, 1.0f);
  }

  /// A little of the pixel's own bristles, as far as pixels can show them.
  static float bristles(const PaintedEdgeParams& front) {
    return 0.2f * std::min(front.rough / 4.0f, 1.0f);
  }

  static float held(float grain) { return grain > -1.0f ? (grain < 1.0f ? grain : 1.0f) : -1.0f; }

  /// How far the grain moves the border: no further than half way into a thin thing.
  static float mostMoved(const PaintedEdgeParams& front, const BorderSite& site) {
    return std::min(front.rough, 0.5f * site.half / (1.0f + std::fabs(front.overrun)));
  }

  /// The width of a step of one pixel across a border that is moved slantwise.
  static float slanted(float slope) { return std::sqrt(1.0f + std::min(slope * slope, 8.0f)); }

  /// How dense the pigment lies, 1 beside the rim.
  static float rimDensity(const PaintedEdgeParams& params, float inside, float melted,
                          float grain) {
    if (!(params.rim > 0.0f)) return 1.0f;
    constexpr float crest = 0.25f;
    const float t = inside / params.rim;
    if (!(t > 0.0f) || t >= 1.0f) return 1.0f;
    const float fall = (1.0f - t) / (1.0f - crest);
    const float height = t < crest ? easedIn(t / crest) : fall * fall;
    return 1.0f + params.rimStrength * height * (1.0f - melted) * (1.0f + 0.4f * grain);
  }

  /// Share of the paint that a dry brush leaves out: in its hollows, where the strokes along the
  /// border are thin. inside: from the border as it was, for beyond what the grain moves nothing
  /// tells how far it did.
  float dryShare(const PaintedEdgeParams& params, float inside, const BorderSite& site,
                 const PixelAt& at) const {
    if (!(params.dry > 0.0f)) return 0.0f;
    const float thin = easedIn(0.5f - 0.75f * site.grain);
    const float near = 1.0f - std::max(inside, 0.0f) / (params.dryWidth * (0.5f + thin));
    if (!(near > 0.0f) || !(thin > 0.0f)) return 0.0f;
    constexpr float lowest = -2.5f, rise = 3.5f, soft = 0.6f;
    const float bound = lowest + rise * params.dry * near * thin;
    return easedIn((bound - in_.grain(at.x, at.y)) / soft);
  }

  const EdgePaint& in_;
  const EdgeBorders& borders_;
  const BorderSites& sites_;
};

void requireSizes(const EdgePaint& in, const PaintViews& paint) {
  const int width = in.things.width, height = in.things.height;
  for (const View<const float> plane :
       {in.own.r, in.own.g, in.own.b, in.own.a, in.grain, View<const float>(paint.r),
        View<const float>(paint.g), View<const float>(paint.b), View<const float>(paint.a)})
    requireSize("painted edges", plane, width, height);
}

}  // namespace

void paintEdges(const EdgePaint& in, const PaintViews& paint) {
  requireSizes(in, paint);
  float reach = 0, measured = 0;
  for (const PaintedEdgeParams& params : in.params) {
    if (params.acts()) reach = std::max(reach, EdgePainter::reachOf(params) + 1.5f);
    measured = std::max({measured, reach, BorderSites::enoughOf(params)});
  }
  if (!(reach > 0.0f)) return;
  const int width = in.things.width, height = in.things.height;
  const EdgeBorders borders(in);
  const Bytes at = borders.borderPixels();
  const Bytes wanted = squaresInReach(at, reach);
  SiteSearch search;
  search.kinds = at;
  search.wantedKinds = wanted;
  Labels squared(width, height), nearest(width, height);
  parallelRows(
      height, [&](int first, int end) { std::fill(squared.row(first), squared.row(end), noSite); });
  findNearestSites(search, boxesWithin(wanted, 1, measured), squared, nearest);
  const BorderSites sites(in, borders, at, squared);
  const EdgePainter painter(in, borders, sites);
  const float most = reach * reach;
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x)
        if (wanted(x, y) && nearest(x, y) != noSite &&
            (at(x, y) || static_cast<float>(squared(x, y)) <= most))
          painter.paint(x, y, nearest(x, y), paint);
  });
}

}  // namespace kagefude
