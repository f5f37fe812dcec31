#include "passes/edges/edge_border.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"

namespace kagefude {
namespace {

constexpr int stepX[4] = {1, -1, 0, 0}, stepY[4] = {0, 0, 1, -1};
constexpr int square = 32;

/// By the numbers' runs along rows.
std::vector<uint32_t> countPixels(View<const uint16_t> things, size_t most) {
  std::vector<uint32_t> sizes(most + 1, 0u);
  for (int y = 0; y < things.height; ++y) {
    const uint16_t* const row = things.row(y);
    for (int x = 0, first = 0; x < things.width; first = x) {
      while (x < things.width && row[x] == row[first]) ++x;
      if (row[first] <= most) sizes[row[first]] += static_cast<uint32_t>(x - first);
    }
  }
  return sizes;
}

}  // namespace

EdgeBorders::EdgeBorders(const EdgePaint& in)
    : in_(in), sizes_(countPixels(in.things, in.params.size())) {}

bool EdgeBorders::isBorder(uint16_t own, int x, int y) const {
  if (!in_.things.contains(x, y)) return false;
  const uint16_t other = in_.things(x, y);
  return other != own && (paramsOf(own).acts() || paramsOf(other).acts());
}

bool EdgeBorders::isAtBorder(int x, int y) const {
  const uint16_t own = in_.things(x, y);
  for (int k = 0; k < 4; ++k)
    if (isBorder(own, x + stepX[k], y + stepY[k])) return true;
  return false;
}

Bytes EdgeBorders::borderPixels() const {
  const View<const uint16_t> things = in_.things;
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
        out[x] = differs && isAtBorder(x, y) ? 1 : 0;
      }
    }
  });
  return borders;
}

/// The pixel of the own thing at the border, from any that is near it.
bool EdgeBorders::ownPixelNear(int x, int y, PixelAt& at) const {
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

bool EdgeBorders::find(int x, int y, uint32_t nearest, Border& border) const {
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
float EdgeBorders::withinPixels(int x, int y, const Border& border) const {
  if (in_.coverage.empty()) return 0.5f;
  const uint16_t own = in_.things(x, y);
  const uint32_t id = own == 0 || own > in_.coverageIds.size() ? 0u : in_.coverageIds[own - 1u];
  return std::clamp(covered(id, border.own) + covered(id, border.other) - 0.5f, 0.0f, 1.5f);
}

float EdgeBorders::covered(uint32_t id, const PixelAt& at) const {
  float own = 0, named = 0;
  for (const CoverageRank& rank : in_.coverage) {
    const float share = rank.coverage(at.x, at.y);
    if (!(share >= smallestShare)) continue;
    if (rank.id(at.x, at.y) == id) own += share;
    if (rank.id(at.x, at.y) != 0) named += share;
  }
  return std::min(id == 0 ? std::max(1.0f - named, 0.0f) : own, 1.0f);
}

bool EdgeBorders::isInFront(const Border& border) const {
  const uint16_t own = in_.things(border.own.x, border.own.y);
  const uint16_t other = in_.things(border.other.x, border.other.y);
  if (own == 0 || other == 0) return other == 0;
  const float here = distanceOf(border.own), there = distanceOf(border.other);
  const float change =
      std::max(changeOf(border.own, border.other), changeOf(border.other, border.own));
  if (std::fabs(here - there) > 2.0f * change) return here < there;
  const uint32_t size = sizeOf(own), otherSize = sizeOf(other);
  return size != otherSize ? size < otherSize : own < other;
}

/// How the distance of the thing at `at` changes to its next pixel, seen from `beyond`.
float EdgeBorders::changeOf(const PixelAt& at, const PixelAt& beyond) const {
  const PixelAt next{2 * at.x - beyond.x, 2 * at.y - beyond.y};
  if (!in_.things.contains(next.x, next.y) || in_.things(next.x, next.y) != in_.things(at.x, at.y))
    return 0.0f;
  return std::fabs(distanceOf(next) - distanceOf(at));
}

/// Squared where positions tell it; only compared.
float EdgeBorders::distanceOf(const PixelAt& at) const {
  if (in_.position.empty()) return in_.distance.empty() ? 0.0f : in_.distance(at.x, at.y);
  const V3f d = in_.position(at.x, at.y) - in_.eye;
  return d.dot(d);
}

PixelAt EdgeBorders::mirrored(int x, int y, const Border& border) const {
  const PixelAt at{border.other.x + border.own.x - x, border.other.y + border.own.y - y};
  const bool same = in_.things.contains(at.x, at.y) &&
                    in_.things(at.x, at.y) == in_.things(border.other.x, border.other.y);
  return same ? at : border.other;
}

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

}  // namespace kagefude
