#include "passes/edges/painted_edges.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"
#include "image/real_math.h"
#include "passes/require_size.h"
#include "passes/search/nearest_site.h"
#include "passes/strip/strip.h"

namespace kagefude {
namespace {

constexpr int stepX[4] = {1, -1, 0, 0}, stepY[4] = {0, 0, 1, -1};

struct PixelAt {
  int x = 0, y = 0;
};

float eased(float t) {
  const float c = t > 0.0f ? (t < 1.0f ? t : 1.0f) : 0.0f;
  return c * c * (3.0f - 2.0f * c);
}

/// How bright a colour over nothing looks, about 0..1.
float brightness(const Rgba& colour) {
  const float luminance = 0.2126f * colour[0] + 0.7152f * colour[1] + 0.0722f * colour[2];
  return std::sqrt(luminance > 0.0f ? luminance : 0.0f);
}

/// Colour with its pigment `dense` times as dense.
Rgba pooled(const Rgba& colour, float dense) {
  const float alpha = colour[3];
  if (!(alpha > 0.0f) || dense == 1.0f) return colour;
  Rgba result = colour;
  for (int k = 0; k < 3; ++k) {
    const float own = colour[k] / alpha;
    if (own > 0.0f && own < 1.0f) result[k] = alpha * powerOf(own, dense);
  }
  return result;
}

/// A border as one pixel sees it.
struct Border {
  PixelAt own, other;    ///< the pixels on both sides that are nearest
  float distance = 0;    ///< from the pixel's centre, pixels
  bool inFront = false;  ///< whether the pixel's own thing is
};

class EdgePainter {
 public:
  explicit EdgePainter(const EdgePaint& in) : in_(in), empty_{} {
    for (const PaintedEdgeParams& params : in.params) reach_ = std::max(reach_, reachOf(params));
  }

  float reach() const { return reach_; }

  /// Whether the pixel lies at a border that may change.
  bool isAtBorder(int x, int y) const {
    const uint16_t own = in_.things(x, y);
    for (int k = 0; k < 4; ++k)
      if (isBorder(own, x + stepX[k], y + stepY[k])) return true;
    return false;
  }

  void paint(int x, int y, uint32_t nearest, const PaintViews& paint) const {
    Border border;
    if (!findBorder(x, y, nearest, border)) return;
    const PaintedEdgeParams& own = paramsAt({x, y});
    const PaintedEdgeParams& other = paramsAt(border.other);
    const PaintedEdgeParams& front = border.inFront ? own : other;
    const PixelAt beyond = mirrored(x, y, border);
    const float grain = borderGrain(x, y, border, beyond, front);
    const float melted = front.lost > 0.0f ? lostShare(border, front) : 0.0f;
    const bool moves = front.rough > 0.0f || melted > 0.0f;
    // Distance into the own side, past the border where the grain has moved it.
    const float shift = front.rough * (grain + front.overrun);
    const float inside = border.distance + (border.inFront ? shift : -shift);
    const float rimOwn = border.inFront ? rimDensity(own, inside, melted, grain) : 1.0f;
    const float gap = border.inFront ? dryShare(own, border.distance, x, y) : 0.0f;
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
  static float reachOf(const PaintedEdgeParams& p) {
    const float moved = p.rough * (1.0f + std::fabs(p.overrun)) + 0.5f * p.lost + 2.0f;
    return std::max(moved + p.rim, p.dry > 0.0f ? p.dryWidth : 0.0f);
  }

  const PaintedEdgeParams& paramsOf(uint16_t thing) const {
    return thing == 0 || thing > in_.params.size() ? empty_ : in_.params[thing - 1u];
  }
  const PaintedEdgeParams& paramsAt(const PixelAt& at) const {
    return paramsOf(in_.things(at.x, at.y));
  }

  bool isBorder(uint16_t own, int x, int y) const {
    if (!in_.things.contains(x, y)) return false;
    const uint16_t other = in_.things(x, y);
    return other != own && (paramsOf(own).acts() || paramsOf(other).acts());
  }

  Rgba colourAt(int x, int y) const {
    return Rgba{in_.own.r(x, y), in_.own.g(x, y), in_.own.b(x, y), in_.own.a(x, y)};
  }

  /// The pixel of the own thing at the border, from any that is near it.
  bool ownPixelNear(int x, int y, PixelAt& at) const {
    const uint16_t own = in_.things(x, y);
    if (in_.things(at.x, at.y) == own) return true;
    int best = 0x7fffffff;
    PixelAt found = at;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int qx = at.x + dx, qy = at.y + dy;
        if (!in_.things.contains(qx, qy) || in_.things(qx, qy) != own || !isAtBorder(qx, qy))
          continue;
        const int squared = (qx - x) * (qx - x) + (qy - y) * (qy - y);
        if (squared < best) {
          best = squared;
          found = {qx, qy};
        }
      }
    at = found;
    return best != 0x7fffffff;
  }

  bool findBorder(int x, int y, uint32_t nearest, Border& border) const {
    const int width = in_.things.width;
    border.own = {static_cast<int>(nearest) % width, static_cast<int>(nearest) / width};
    if (!ownPixelNear(x, y, border.own)) return false;
    const uint16_t own = in_.things(x, y);
    const int wayX = border.own.x - x, wayY = border.own.y - y;
    int best = -0x7fffffff;
    for (int k = 0; k < 4; ++k) {
      const PixelAt other{border.own.x + stepX[k], border.own.y + stepY[k]};
      if (!isBorder(own, other.x, other.y)) continue;
      const int ahead = wayX * stepX[k] + wayY * stepY[k];
      if (ahead <= best) continue;
      best = ahead;
      border.other = other;
    }
    if (best == -0x7fffffff) return false;
    const auto dx = static_cast<float>(wayX), dy = static_cast<float>(wayY);
    border.distance = std::sqrt(dx * dx + dy * dy) + withinPixels(x, y, border);
    border.inFront = isInFront(border);
    return true;
  }

  /// From the centre of the own pixel at the border to the border itself, by what the thing covers
  /// of the pixels on both sides.
  float withinPixels(int x, int y, const Border& border) const {
    if (in_.coverage.empty()) return 0.5f;
    const uint16_t own = in_.things(x, y);
    const uint32_t id = own == 0 || own > in_.coverageIds.size() ? 0u : in_.coverageIds[own - 1u];
    return std::clamp(covered(id, border.own) + covered(id, border.other) - 0.5f, 0.0f, 1.5f);
  }

  float covered(uint32_t id, const PixelAt& at) const {
    float own = 0, named = 0;
    for (const CoverageRank& rank : in_.coverage) {
      const float share = rank.coverage(at.x, at.y);
      if (!(share >= smallestShare)) continue;
      if (rank.id(at.x, at.y) == id) own += share;
      if (rank.id(at.x, at.y) != 0) named += share;
    }
    return std::min(id == 0 ? std::max(1.0f - named, 0.0f) : own, 1.0f);
  }

  bool isInFront(const Border& border) const {
    const uint16_t own = in_.things(border.own.x, border.own.y);
    const uint16_t other = in_.things(border.other.x, border.other.y);
    if (own == 0 || other == 0) return other == 0;
    const float here = distanceOf(border.own), there = distanceOf(border.other);
    return here != there ? here < there : own < other;
  }

  /// Squared where positions tell it; only compared.
  float distanceOf(const PixelAt& at) const {
    if (in_.position.empty()) return in_.distance.empty() ? 0.0f : in_.distance(at.x, at.y);
    const V3f d = in_.position(at.x, at.y) - in_.eye;
    return d.dot(d);
  }

  /// The pixel as far beyond the border as (x, y) is before it; the one at the border where that is
  /// of a third thing.
  PixelAt mirrored(int x, int y, const Border& border) const {
    const PixelAt at{border.other.x + border.own.x - x, border.other.y + border.own.y - y};
    const bool same = in_.things.contains(at.x, at.y) &&
                      in_.things(at.x, at.y) == in_.things(border.other.x, border.other.y);
    return same ? at : border.other;
  }

  /// Shape of the strokes in front, -1..1: mostly that of the border, seen as coarsely as it is
  /// moved, or it would fray; and a little of the pixel's own bristles.
  float borderGrain(int x, int y, const Border& border, const PixelAt& beyond,
                    const PaintedEdgeParams& front) const {
    const PixelAt at = border.inFront ? PixelAt{x, y} : beyond;
    const PixelAt rim = border.inFront ? border.own : border.other;
    const int step = std::max(1, static_cast<int>(front.rough * 0.5f + 0.5f));
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
  const PaintedEdgeParams empty_;
  float reach_ = 0;
};

void requireSizes(const EdgePaint& in, const PaintViews& paint) {
  const int width = in.things.width, height = in.things.height;
  for (const View<const float> plane :
       {in.own.r, in.own.g, in.own.b, in.own.a, in.grain, View<const float>(paint.r),
        View<const float>(paint.g), View<const float>(paint.b), View<const float>(paint.a)})
    requireSize("painted edges", plane, width, height);
}

/// Squares of the picture that edges may reach: those that hold a border, and as many round them as
/// the reach takes. Pixels in them are 1.
constexpr int square = 32;

Bytes squaresInReach(View<const uint8_t> borders, float reach) {
  const int across = (borders.width + square - 1) / square;
  const int down = (borders.height + square - 1) / square;
  Bytes held(across, down, uint8_t{0});
  parallelRows(down, 1, [&](int first, int) {
    const int end = std::min((first + 1) * square, borders.height);
    for (int y = first * square; y < end; ++y)
      for (int x = 0; x < borders.width; ++x)
        if (borders(x, y)) held(x / square, first) = 1;
  });
  const int far = static_cast<int>(reach) / square + 1;
  Bytes inReach(borders.width, borders.height, uint8_t{0});
  parallelRows(down, 1, [&](int row, int) {
    for (int column = 0; column < across; ++column) {
      bool any = false;
      for (int v = std::max(row - far, 0); v <= std::min(row + far, down - 1) && !any; ++v)
        for (int u = std::max(column - far, 0); u <= std::min(column + far, across - 1); ++u)
          any = any || held(u, v);
      if (!any) continue;
      const int left = column * square, right = std::min(left + square, borders.width);
      for (int y = row * square; y < std::min((row + 1) * square, borders.height); ++y)
        std::fill(inReach.row(y) + left, inReach.row(y) + right, uint8_t{1});
    }
  });
  return inReach;
}

Bytes findBorders(const EdgePainter& painter, View<const uint16_t> things) {
  const int width = things.width, height = things.height;
  Bytes borders(width, height);
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      const uint16_t* const own = things.row(y);
      const uint16_t* const above = things.row(std::max(y - 1, 0));
      const uint16_t* const below = things.row(std::min(y + 1, height - 1));
      uint8_t* const out = borders.row(y);
      for (int x = 0; x < width; ++x) {
        const uint16_t left = own[x > 0 ? x - 1 : 0], right = own[x + 1 < width ? x + 1 : x];
        const bool differs =
            (own[x] != left) | (own[x] != right) | (own[x] != above[x]) | (own[x] != below[x]);
        out[x] = differs && painter.isAtBorder(x, y) ? 1 : 0;
      }
    }
  });
  return borders;
}

}  // namespace

void paintEdges(const EdgePaint& in, const PaintViews& paint) {
  requireSizes(in, paint);
  const EdgePainter painter(in);
  if (!(painter.reach() > 0.0f)) return;
  const int width = in.things.width, height = in.things.height;
  const float reach = painter.reach() + 1.5f;
  const Bytes borders = findBorders(painter, in.things);
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
