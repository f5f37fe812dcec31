#include "passes/edges/painted_edges.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"
#include "image/real_math.h"
#include "passes/edges/edge_border.h"
#include "passes/require_size.h"
#include "passes/search/nearest_site.h"
#include "passes/strip/strip.h"

namespace kagefude {
namespace {

float eased(float t) {
  const float c = t > 0.0f ? (t < 1.0f ? t : 1.0f) : 0.0f;
  return c * c * (3.0f - 2.0f * c);
}

float luminanceOf(const Rgba& colour) {
  return 0.2126f * colour[0] + 0.7152f * colour[1] + 0.0722f * colour[2];
}

/// How bright a colour over nothing looks, about 0..1.
float brightness(const Rgba& colour) {
  const float luminance = luminanceOf(colour);
  return std::sqrt(luminance > 0.0f ? luminance : 0.0f);
}

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
  const float now = luminanceOf(result), least = luminanceOf(colour) / dense;
  if (dense > 1.0f && now > 0.0f && now < least)
    for (int k = 0; k < 3; ++k) result[k] *= least / now;
  return result;
}

class EdgePainter {
 public:
  explicit EdgePainter(const EdgePaint& in) : in_(in), borders_(in) {
    for (const PaintedEdgeParams& params : in.params) reach_ = std::max(reach_, reachOf(params));
  }

  float reach() const { return reach_; }
  const EdgeBorders& borders() const { return borders_; }

  void paint(int x, int y, uint32_t nearest, const PaintViews& paint) const {
    Border border;
    if (!borders_.find(x, y, nearest, border)) return;
    const PaintedEdgeParams& own = borders_.paramsAt({x, y});
    const PaintedEdgeParams& other = borders_.paramsAt(border.other);
    const PaintedEdgeParams& front = border.inFront ? own : other;
    const float gap = border.inFront ? dryShare(own, border.distance, x, y) : 0.0f;
    if (border.distance > changedWithin(front) + (border.inFront ? own.rim : 0.0f))
      return leaveOut(gap, x, y, paint);
    const PixelAt beyond = borders_.mirrored(x, y, border);
    const float grain = borderGrain(x, y, border, beyond, front);
    const float melted = front.lost > 0.0f ? lostShare(border, front) : 0.0f;
    const bool moves = front.rough > 0.0f || melted > 0.0f;
    // Distance into the own side, past the border where the grain has moved it.
    const float shift = front.rough * (grain + front.overrun);
    const float inside = border.distance + (border.inFront ? shift : -shift);
    const float rimOwn = border.inFront ? rimDensity(own, inside, melted, grain) : 1.0f;
    if (!moves && rimOwn == 1.0f && gap == 0.0f) return;

    Rgba colour{paint.r(x, y), paint.g(x, y), paint.b(x, y), paint.a(x, y)};
    if (moves) {
      const float width = 1.0f + 0.15f * front.rough + front.lost * melted;
      const float share = std::clamp(inside / width + 0.5f, 0.0f, 1.0f);
      if (share >= 1.0f && border.distance > 1.0f) {
        colour = pooled(colour, rimOwn);
      } else {
        const Rgba here = pooled(colourAt(x, y), rimOwn);
        const float rimOther = border.inFront ? 1.0f : rimDensity(other, -inside, melted, grain);
        const Rgba there = pooled(colourAt(beyond.x, beyond.y), rimOther);
        colour = here * share + there * (1.0f - share);
      }
    } else {
      colour = pooled(colour, rimOwn);
    }
    colour = colour * (1.0f - gap);
    paint.r(x, y) = colour[0];
    paint.g(x, y) = colour[1];
    paint.b(x, y) = colour[2];
    paint.a(x, y) = colour[3];
  }

 private:
  /// How far from the border its paint may be mixed with that beyond it.
  static float changedWithin(const PaintedEdgeParams& p) {
    return p.rough * (1.075f + std::fabs(p.overrun)) + 0.5f * p.lost + 1.0f;
  }

  /// All that is left to do further away.
  static void leaveOut(float gap, int x, int y, const PaintViews& paint) {
    if (gap == 0.0f) return;
    for (const View<float>* plane : {&paint.r, &paint.g, &paint.b, &paint.a})
      (*plane)(x, y) *= 1.0f - gap;
  }

  static float reachOf(const PaintedEdgeParams& p) {
    const float moved = p.rough * (1.0f + std::fabs(p.overrun)) + 0.5f * p.lost + 2.0f;
    return std::max(moved + p.rim, p.dry > 0.0f ? p.dryWidth : 0.0f);
  }

  Rgba colourAt(int x, int y) const {
    return Rgba{in_.own.r(x, y), in_.own.g(x, y), in_.own.b(x, y), in_.own.a(x, y)};
  }

  /// Shape of the strokes in front, -1..1: mostly that of the border, seen as coarsely as it is
  /// moved, or it would fray; and a little of the pixel's own bristles.
  float borderGrain(int x, int y, const Border& border, const PixelAt& beyond,
                    const PaintedEdgeParams& front) const {
    const PixelAt at = border.inFront ? PixelAt{x, y} : beyond;
    const PixelAt rim = border.inFront ? border.own : border.other;
    const int step = std::max(2, static_cast<int>(front.rough * 0.5f + 0.5f));
    constexpr float ofBorder = 1.1f, ofPixel = 0.2f;
    const float grain = ofBorder * meanGrain(rim, step) + ofPixel * in_.grain(at.x, at.y);
    return grain > -1.0f ? (grain < 1.0f ? grain : 1.0f) : -1.0f;
  }

  /// Mean of a thing's grain at nine places round a pixel, `step` apart.
  float meanGrain(const PixelAt& at, int step) const {
    const uint16_t own = in_.things(at.x, at.y);
    float sum = 0, count = 0;
    for (int dy = -step; dy <= step; dy += step)
      for (int dx = -step; dx <= step; dx += step) {
        if (!in_.things.contains(at.x + dx, at.y + dy) || in_.things(at.x + dx, at.y + dy) != own)
          continue;
        sum += in_.grain(at.x + dx, at.y + dy);
        count += 1.0f;
      }
    return sum / count;
  }

  /// Mean of a thing's paint, over its ground, in the 3x3 round one of its pixels.
  float meanBrightness(const PixelAt& at) const {
    Rgba sum{};
    float count = 0;
    const uint16_t own = in_.things(at.x, at.y);
    for (int y = at.y - 1; y <= at.y + 1; ++y)
      for (int x = at.x - 1; x <= at.x + 1; ++x) {
        if (!in_.things.contains(x, y) || in_.things(x, y) != own) continue;
        sum += shownAt(x, y);
        count += 1.0f;
      }
    return brightness(sum / count);
  }

  Rgba shownAt(int x, int y) const {
    const Rgba paint = colourAt(x, y);
    if (in_.ground.r.empty()) return paint;
    const Rgba ground{in_.ground.r(x, y), in_.ground.g(x, y), in_.ground.b(x, y),
                      in_.ground.a(x, y)};
    return paint + ground * (1.0f - paint[3]);
  }

  /// How far the border is lost, 0..1.
  float lostShare(const Border& border, const PaintedEdgeParams& front) const {
    const bool background = in_.things(border.own.x, border.own.y) == 0 ||
                            in_.things(border.other.x, border.other.y) == 0;
    if (background && in_.ground.r.empty()) return 0.0f;
    const float step = std::fabs(meanBrightness(border.own) - meanBrightness(border.other));
    return front.lostTone > 0.0f ? 1.0f - eased(step / front.lostTone) : 0.0f;
  }

  /// How dense the pigment lies, 1 beside the rim.
  static float rimDensity(const PaintedEdgeParams& params, float inside, float melted,
                          float grain) {
    if (!(params.rim > 0.0f)) return 1.0f;
    constexpr float crest = 0.25f;
    const float t = inside / params.rim;
    if (!(t > 0.0f) || t >= 1.0f) return 1.0f;
    const float fall = (1.0f - t) / (1.0f - crest);
    const float height = t < crest ? eased(t / crest) : fall * fall;
    return 1.0f + params.rimStrength * height * (1.0f - melted) * (1.0f + 0.4f * grain);
  }

  /// Share of the paint that a dry brush leaves out.
  float dryShare(const PaintedEdgeParams& params, float distance, int x, int y) const {
    if (!(params.dry > 0.0f)) return 0.0f;
    const float near = 1.0f - distance / params.dryWidth;
    if (!(near > 0.0f)) return 0.0f;
    constexpr float lowest = -2.5f, rise = 3.5f, soft = 0.6f;
    const float bound = lowest + rise * params.dry * near;
    return eased((bound - in_.grain(x, y)) / soft);
  }

  const EdgePaint& in_;
  const EdgeBorders borders_;
  float reach_ = 0;
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
  const EdgePainter painter(in);
  if (!(painter.reach() > 0.0f)) return;
  const int width = in.things.width, height = in.things.height;
  const float reach = painter.reach() + 1.5f;
  const Bytes borders = painter.borders().borderPixels();
  const Bytes wanted = squaresInReach(borders, reach);
  SiteSearch search;
  search.kinds = borders;
  search.wantedKinds = wanted;
  Labels squared(width, height, noSite), nearest(width, height, noSite);
  findNearestSites(search, findLabelBoxes(search), squared, nearest);
  const float most = reach * reach;
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x)
        if (wanted(x, y) && nearest(x, y) != noSite && static_cast<float>(squared(x, y)) <= most)
          painter.paint(x, y, nearest(x, y), paint);
  });
}

}  // namespace kagefude
