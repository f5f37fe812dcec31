#include "passes/edges/border_sites.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"
#include "image/real_math.h"
#include "passes/edges/edge_tones.h"
#include "passes/search/nearest_site.h"

namespace kagefude {
namespace {

/// Neighbours along the border over which a site is evened.
constexpr int evenedOver = 2;

}  // namespace

BorderSites::BorderSites(const EdgePaint& in, const EdgeBorders& borders, View<const uint8_t> at,
                         View<uint32_t> squared)
    : in_(in), borders_(borders), at_(at), squared_(squared) {
  std::vector<size_t> starts(static_cast<size_t>(at.height) + 1, 0);
  for (int y = 0; y < at.height; ++y)
    starts[static_cast<size_t>(y) + 1] =
        starts[static_cast<size_t>(y)] +
        static_cast<size_t>(std::count(at.row(y), at.row(y) + at.width, uint8_t{1}));
  std::vector<BorderSite> raw(starts.back());
  const auto forEach = [&](const auto& body) {
    parallelRows(at.height, [&](int first, int end) {
      for (int y = first; y < end; ++y)
        for (size_t x = 0, i = starts[static_cast<size_t>(y)];
             i < starts[static_cast<size_t>(y) + 1]; ++x)
          if (at.row(y)[x]) body(static_cast<int>(x), y, i++);
    });
  };
  forEach([&](int x, int y, size_t i) { raw[i] = siteAt(x, y); });
  forEach([&](int x, int y, size_t i) { squared(x, y) = static_cast<uint32_t>(i); });
  sites_.resize(raw.size());
  forEach([&](int, int, size_t i) { sites_[i] = evened(raw[i], raw); });
}

const BorderSite* BorderSites::find(int x, int y, uint32_t nearest) const {
  const uint16_t own = in_.things(x, y);
  const int width = in_.things.width;
  const int nearX = static_cast<int>(nearest) % width, nearY = static_cast<int>(nearest) / width;
  if (in_.things(nearX, nearY) == own) return &sites_[squared_(nearX, nearY)];
  int best = 0x7fffffff;
  const BorderSite* found = nullptr;
  for (int qy = nearY - 1; qy <= nearY + 1; ++qy)
    for (int qx = nearX - 1; qx <= nearX + 1; ++qx) {
      if (!in_.things.contains(qx, qy) || in_.things(qx, qy) != own || !at_(qx, qy)) continue;
      const int squared = (qx - x) * (qx - x) + (qy - y) * (qy - y);
      if (squared >= best) continue;
      best = squared;
      found = &sites_[squared_(qx, qy)];
    }
  return found;
}

float BorderSites::enoughOf(const PaintedEdgeParams& front) {
  return 2.0f + 2.0f * front.rough * (1.0f + std::fabs(front.overrun)) + front.lost;
}

BorderSite BorderSites::siteAt(int x, int y) const {
  BorderSite site;
  site.own = {x, y};
  placeBorder(site);
  site.inFront = borders_.isInFront(site.own, site.other);
  const PixelAt& at = site.inFront ? site.own : site.other;
  const PaintedEdgeParams& front = borders_.paramsAt(at);
  site.grain = meanGrain(at, front.rough);
  const float enough = enoughOf(front);
  site.half = halfThickness(site, site.inFront, enough);
  site.behind = halfThickness(site, !site.inFront, enough);
  if (front.lost > 0.0f) site.melted = lostShare(site, front);
  return site;
}

/// Where the border runs, and the pixel beyond it.
void BorderSites::placeBorder(BorderSite& site) const {
  const uint16_t own = in_.things(site.own.x, site.own.y);
  const int x = site.own.x, y = site.own.y;
  const EdgeWindow::Side seen =
      window_.sideOf(x, y, in_.things.width, in_.things.height,
                     [&](int qx, int qy, int, int) { return in_.things(qx, qy) == own; });
  const float length = std::sqrt(seen.towardsX * seen.towardsX + seen.towardsY * seen.towardsY);
  const bool known = length > 1e-4f * seen.sum;
  if (known) {
    site.outX = -seen.towardsX / length;
    site.outY = -seen.towardsY / length;
  }
  float most = -2.0f;
  int side = 0;
  for (int k = 0; k < 4; ++k) {
    const auto stepX = static_cast<float>(sideX[k]), stepY = static_cast<float>(sideY[k]);
    const float ahead = site.outX * stepX + site.outY * stepY;
    if (!borders_.isBorder(own, x + sideX[k], y + sideY[k]) || !(ahead > most)) continue;
    most = ahead;
    side = k;
  }
  site.other = {x + sideX[side], y + sideY[side]};
  const auto stepX = static_cast<float>(sideX[side]), stepY = static_cast<float>(sideY[side]);
  if (!known) {
    site.outX = stepX;
    site.outY = stepY;
  }
  site.x = static_cast<float>(x);
  site.y = static_cast<float>(y);
  if (!in_.coverage.empty()) {
    const float covered =
        borders_.coveredBy(site.own, site.own) + borders_.coveredBy(site.own, site.other);
    const float way = std::clamp(covered - 0.5f, 0.0f, 1.5f);
    site.x += way * stepX;
    site.y += way * stepY;
  } else if (known) {
    const float slope = length / seen.sum * window_.slopeOfGradient();
    const float way = std::clamp((seen.own / seen.sum - 0.5f) / slope, 0.0f, 1.0f);
    site.x += way * site.outX;
    site.y += way * site.outY;
  } else {
    site.x += 0.5f * stepX;
    site.y += 0.5f * stepY;
  }
}

/// Mean of a thing's grain round a pixel, as coarse as its border is moved.
float BorderSites::meanGrain(const PixelAt& at, float rough) const {
  const uint16_t own = in_.things(at.x, at.y);
  const int reach = std::max(2, static_cast<int>(rough * 0.5f + 0.5f));
  const int step = (reach + 3) / 4;
  float sum = 0, count = 0;
  for (int dy = -reach; dy <= reach; dy += step)
    for (int dx = -reach; dx <= reach; dx += step) {
      const int qx = at.x + dx, qy = at.y + dy;
      if (!in_.things.contains(qx, qy) || in_.things(qx, qy) != own) continue;
      sum += in_.grain(qx, qy);
      count += 1.0f;
    }
  // The pixel itself is left out where the steps pass it.
  return count > 0.0f ? sum / count : in_.grain(at.x, at.y);
}

/// The greatest distance from the border on the way through a side of it, no more than `enough`.
float BorderSites::halfThickness(const BorderSite& site, bool ownSide, float enough) const {
  const PixelAt& start = ownSide ? site.own : site.other;
  const uint16_t own = in_.things(start.x, start.y);
  const float side = ownSide ? -1.0f : 1.0f;
  float half = 0.5f, way = 0;
  for (float step = 1; half < enough;) {
    way += step;
    const int x = start.x + static_cast<int>(std::floor(side * way * site.outX + 0.5f));
    const int y = start.y + static_cast<int>(std::floor(side * way * site.outY + 0.5f));
    if (!in_.things.contains(x, y)) return enough;
    if (in_.things(x, y) != own) break;
    if (squared_(x, y) == noSite) return enough;
    const float distance = std::sqrt(static_cast<float>(squared_(x, y))) + 0.5f;
    if (distance < 0.7f * half) break;
    half = std::max(half, distance);
    step = std::max(1.0f, distance - 0.5f);
  }
  return std::min(half, enough);
}

/// How far the border is lost, 0..1: where both sides are equally bright over their ground.
float BorderSites::lostShare(const BorderSite& site, const PaintedEdgeParams& front) const {
  const bool background =
      in_.things(site.own.x, site.own.y) == 0 || in_.things(site.other.x, site.other.y) == 0;
  if ((background && !in_.ground) || !(front.lostTone > 0.0f)) return 0.0f;
  const float step = std::fabs(meanBrightness(site.own) - meanBrightness(site.other));
  return 1.0f - easedIn(step / front.lostTone);
}

/// Mean of a thing's paint, over its ground, in the 5x5 round one of its pixels.
float BorderSites::meanBrightness(const PixelAt& at) const {
  Rgba sum{};
  float count = 0;
  const uint16_t own = in_.things(at.x, at.y);
  for (int y = at.y - 2; y <= at.y + 2; ++y)
    for (int x = at.x - 2; x <= at.x + 2; ++x) {
      if (!in_.things.contains(x, y) || in_.things(x, y) != own) continue;
      sum += shownAt(x, y);
      count += 1.0f;
    }
  return paintBrightness(sum / count);
}

/// A thing's paint over its ground.
Rgba BorderSites::shownAt(int x, int y) const {
  const Rgba paint = paintAt(in_.own, x, y);
  if (!in_.ground || paint[3] == 1.0f) return paint;
  ColourRun ground;
  in_.ground->read(x, y, 1, ground);
  return paint + Rgba{ground.r[0], ground.g[0], ground.b[0], ground.a[0]} * (1.0f - paint[3]);
}

/// A site with the means of its neighbours on the same border, and the line through their grain.
BorderSite BorderSites::evened(const BorderSite& site, const std::vector<BorderSite>& raw) const {
  const uint16_t own = in_.things(site.own.x, site.own.y);
  const uint16_t other = in_.things(site.other.x, site.other.y);
  float count = 0, outX = 0, outY = 0, half = 0, behind = 0, melted = 0;
  float grain = 0, way = 0, ways = 0, wayGrain = 0;
  for (int y = site.own.y - evenedOver; y <= site.own.y + evenedOver; ++y)
    for (int x = site.own.x - evenedOver; x <= site.own.x + evenedOver; ++x) {
      if (!in_.things.contains(x, y) || !at_(x, y) || in_.things(x, y) != own) continue;
      const BorderSite& near = raw[squared_(x, y)];
      // The other rim of a thin thing is another border.
      if (in_.things(near.other.x, near.other.y) != other ||
          near.outX * site.outX + near.outY * site.outY < 0.0f)
        continue;
      const float along = (near.x - site.x) * site.outY - (near.y - site.y) * site.outX;
      count += 1.0f;
      outX += near.outX;
      outY += near.outY;
      half += near.half;
      behind += near.behind;
      melted += near.melted;
      grain += near.grain;
      way += along;
      ways += along * along;
      wayGrain += along * near.grain;
    }
  BorderSite even = site;
  const float length = std::sqrt(outX * outX + outY * outY);
  even.outX = outX / length;
  even.outY = outY / length;
  even.half = half / count;
  even.behind = behind / count;
  even.melted = melted / count;
  constexpr float ofMean = 1.1f;
  const float spread = ways - way * way / count;
  const float slope = spread > 1.0f ? (wayGrain - way * grain / count) / spread : 0.0f;
  even.slope = ofMean * slope;
  even.grain = ofMean * (grain - slope * way) / count;
  return even;
}

}  // namespace kagefude
