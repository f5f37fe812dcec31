#include "passes/light_shape/shadow_match.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"
#include "image/real_math.h"

namespace kagefude {
namespace {

constexpr int placesToMatch = 24;
constexpr float mismatchWeight = 0.1f;
constexpr float softness = 0.005f;  ///< disagreement that halves a tile's say, about
constexpr int largeFrame = 1200;    ///< rows from which on tiles are larger

}  // namespace

ShadowMatch::ShadowMatch(const ShadowTaps& taps, const ShadowNeed& need, const PixelSet& edges,
                         std::span<const V2f> places, Vec3View position, Vec3View normal,
                         const LightGeometry& geometry)
    : taps_(taps),
      need_(need),
      position_(position),
      normal_(normal),
      geometry_(geometry),
      tile_(edges.height() > largeFrame ? 2 * smallestTile : smallestTile),
      tilesX_((edges.width() + tile_ - 1) / tile_),
      tilesY_((edges.height() + tile_ - 1) / tile_),
      places_(placesBetween(places, placesToMatch, 1.0f)) {
  const float longest = std::clamp(static_cast<float>(edges.width()) / 4, 8.0f, 192.0f);
  for (float r = 1.0f; shifts_ < mostShifts && r <= longest; r *= 1.41421356f)
    length_[shifts_++] = r;
  findTiles(edges);
  parallelRows(tilesY_, 2, [&](int t0, int t1) {
    for (int ty = t0; ty < t1; ++ty)
      for (int tx = 0; tx < tilesX_; ++tx)
        if (slots_[tileAt(tx, ty)]) measureTile(tx, ty, edges);
  });
  choices_.resize(slots_.size());
  parallelRows(tilesY_, 2, [&](int t0, int t1) {
    for (int ty = t0; ty < t1; ++ty)
      for (int tx = 0; tx < tilesX_; ++tx) choose(tx, ty);
  });
  near_.resize(slots_.size());
  for (int ty = 0; ty < tilesY_; ++ty)
    for (int tx = 0; tx < tilesX_; ++tx) {
      if (choices_[tileAt(tx, ty)].of[0].label == 0) continue;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if (inside(tx + dx, ty + dy)) near_[tileAt(tx + dx, ty + dy)] = 1;
    }
}

bool ShadowMatch::hasEdge(int tx, int ty, const PixelSet& edges) const {
  const int x = tx * tile_, end = std::min((ty + 1) * tile_, edges.height());
  const uint32_t columns = (uint32_t{1} << tile_) - 1;
  for (int y = ty * tile_; y < end; ++y)
    if (edges.bits32(x & ~31, y) >> (x & 31) & columns) return true;
  return false;
}

void ShadowMatch::findTiles(const PixelSet& edges) {
  slots_.resize(tileAt(0, tilesY_));
  parallelRows(tilesY_, [&](int t0, int t1) {
    for (int ty = t0; ty < t1; ++ty)
      for (int tx = 0; tx < tilesX_; ++tx) slots_[tileAt(tx, ty)] = hasEdge(tx, ty, edges);
  });
  uint32_t count = 0;
  for (uint32_t& slot : slots_)
    if (slot) slot = ++count;
  tiles_.resize(count);
}

void ShadowMatch::measureTile(int tx, int ty, const PixelSet& edges) {
  Tile& tile = tiles_[slots_[tileAt(tx, ty)] - 1];
  const int step = tile_ / 2, width = edges.width(), height = edges.height();
  for (int y = ty * tile_ + step / 2; y < std::min((ty + 1) * tile_, height); y += step)
    for (int x = tx * tile_ + step / 2; x < std::min((tx + 1) * tile_, width); x += step) {
      // Large tiles: one sample each, above and below by turns.
      if (step > 2 && ((x / step & 1) || (y / step & 1) != (tx & 1))) continue;
      if (!edges.contains(x, y) || !(need_.at(x, y) > 0)) continue;
      const uint32_t label = taps_.label(x, y);
      Sums* sums = nullptr;
      for (Sums& s : tile.sums)
        if (!sums && (s.label == label || s.label == 0)) sums = &s;
      if (!sums) continue;
      const ShadowShift along = shadowShiftAt(x, y, taps_.labels(), position_, normal_, geometry_);
      if (!along.valid) continue;
      sums->label = label;
      sums->count += 1;
      for (int i = 0; i < shifts_; ++i) {
        const ShadowTaps::Mean mean = taps_.mean(places_, x, y, along, length_[i]);
        // Without the mismatch a shift that carries every tap past the shadow would agree with
        // itself.
        sums->cost[i] += (mean.valid ? mean.cost : 0.25f) +
                         mismatchWeight * taps_.mismatch(x, y, along, length_[i]);
      }
    }
}

ShadowMatch::Choice ShadowMatch::chooseFor(int tx, int ty, uint32_t label) const {
  Choice choice{label, 0, 1};
  float cost[mostShifts];
  int best = -1;
  for (int i = 0; i < shifts_; ++i) {
    const int reach =
        std::max(1, static_cast<int>(0.5f * length_[i] / static_cast<float>(tile_) + 0.5f));
    // Wide windows look at every other tile or fewer: their sums are smooth.
    const int stride = std::max(1, reach / 3);
    float sum = 0, count = 0;
    for (int dy = -reach; dy <= reach; dy += stride)
      for (int dx = -reach; dx <= reach; dx += stride) {
        if (!inside(tx + dx, ty + dy)) continue;
        const uint32_t slot = slots_[tileAt(tx + dx, ty + dy)];
        if (slot == 0) continue;
        for (const Sums& s : tiles_[slot - 1].sums)
          if (s.label == label) {
            sum += s.cost[i];
            count += s.count;
          }
      }
    cost[i] = count > 0 ? sum / count : 1.0f;
    if (best < 0 || cost[i] < cost[best]) best = i;
  }
  choice.cost = cost[best];
  choice.level = static_cast<float>(best);
  if (best > 0 && best + 1 < shifts_) {
    const float left = cost[best - 1] - cost[best], right = cost[best + 1] - cost[best];
    if (left + right > 0) choice.level += 0.5f * (left - right) / (left + right);
  }
  return choice;
}

/// Also for tiles beside those with an edge, which take their neighbours' labels: thin shadows that
/// no mask holds pass there too.
void ShadowMatch::choose(int tx, int ty) {
  Choices& mine = choices_[tileAt(tx, ty)];
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      if (!inside(tx + dx, ty + dy)) continue;
      const uint32_t tileSlot = slots_[tileAt(tx + dx, ty + dy)];
      if (tileSlot == 0) continue;
      for (const Sums& s : tiles_[tileSlot - 1].sums) {
        if (s.label == 0 || s.label == mine.of[0].label || s.label == mine.of[1].label) continue;
        Choice& slot = mine.of[0].label == 0 ? mine.of[0] : mine.of[1];
        if (slot.label == 0) slot = chooseFor(tx, ty, s.label);
      }
    }
}

ShadowMatch::Match ShadowMatch::at(int x, int y) const {
  if (!mayFind(x, y)) return {};
  const uint32_t label = taps_.label(x, y);
  const float gx = (static_cast<float>(x) + 0.5f) / static_cast<float>(tile_) - 0.5f;
  const float gy = (static_cast<float>(y) + 0.5f) / static_cast<float>(tile_) - 0.5f;
  // At least -0.5.
  const int x0 = static_cast<int>(gx + 1) - 1, y0 = static_cast<int>(gy + 1) - 1;
  const float wx = gx - static_cast<float>(x0), wy = gy - static_cast<float>(y0);
  float lowest = 1;
  const Choice* near[4] = {};
  for (int i = 0; i < 4; ++i) {
    const int tx = x0 + (i & 1), ty = y0 + (i >> 1);
    if (!inside(tx, ty)) continue;
    for (const Choice& c : choices_[tileAt(tx, ty)].of)
      if (c.label == label) {
        near[i] = &c;
        lowest = std::min(lowest, c.cost);
      }
  }
  float level = 0, cost = 0, sum = 0;
  for (int i = 0; i < 4; ++i) {
    if (!near[i]) continue;
    const float place = ((i & 1) ? wx : 1 - wx) * ((i >> 1) ? wy : 1 - wy);
    const float w = (place + 1e-3f) * exp2Of((lowest - near[i]->cost) / softness);
    level += w * near[i]->level;
    cost += w * near[i]->cost;
    sum += w;
  }
  if (!(sum > 0)) return {};
  return {exp2Of(0.5f * level / sum), cost / sum, true};
}

}  // namespace kagefude
