#include "passes/edges/edge_border.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"

namespace kagefude {
namespace {

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
    if (isBorder(own, x + sideX[k], y + sideY[k])) return true;
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

float EdgeBorders::coveredBy(const PixelAt& own, const PixelAt& at) const {
  const uint16_t thing = in_.things(own.x, own.y);
  const uint32_t id =
      thing == 0 || thing > in_.coverageIds.size() ? 0u : in_.coverageIds[thing - 1u];
  float covered = 0, named = 0;
  for (const CoverageRank& rank : in_.coverage) {
    const float share = rank.coverage(at.x, at.y);
    if (!(share >= smallestShare)) continue;
    if (rank.id(at.x, at.y) == id) covered += share;
    if (rank.id(at.x, at.y) != 0) named += share;
  }
  return std::min(id == 0 ? std::max(1.0f - named, 0.0f) : covered, 1.0f);
}

bool EdgeBorders::isInFront(const PixelAt& ownAt, const PixelAt& otherAt) const {
  const uint16_t own = in_.things(ownAt.x, ownAt.y);
  const uint16_t other = in_.things(otherAt.x, otherAt.y);
  if (own == 0 || other == 0) return other == 0;
  const float here = distanceOf(ownAt), there = distanceOf(otherAt);
  const float change = std::max(changeOf(ownAt, otherAt), changeOf(otherAt, ownAt));
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
