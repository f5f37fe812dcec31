#include "passes/edges/inner_edges.h"

#include <algorithm>

#include "passes/edges/crease_line.h"
#include "passes/edges/edge_tones.h"
#include "passes/edges/mix_at_edges.h"

namespace kagefude {
namespace {

constexpr size_t sides = 4;
constexpr int longestRun = 32;

Rgba blended(const InnerEdges& edges, const PaintViews& paint, int x, int y) {
  const std::array<double, 8> shares = edges.shares(x, y);
  double total = 0;
  for (const double share : shares) total += share;
  Rgba sum = paintAt(paint, x, y) * static_cast<float>(1 - total);
  for (size_t i = 0; i < shares.size(); ++i)
    if (shares[i] > 0)
      sum += paintAt(paint, x + edgeSteps[i].x, y + edgeSteps[i].y) * static_cast<float>(shares[i]);
  return sum;
}

}  // namespace

/// None runs along the frame's border.
bool InnerEdges::edge(int x, int y, EdgeStep step) const {
  const int qx = x + step.x, qy = y + step.y;
  if (!s_.styles.contains(x, y) || !s_.styles.contains(qx, qy)) return false;
  if (s_.styles(x, y) != s_.styles(qx, qy)) return true;
  const bool forward = step.y > 0 || (step.y == 0 && step.x > 0);
  const uint8_t joins = forward ? s_.joins(x, y) : s_.joins(qx, qy);
  const EdgeStep way = forward ? step : EdgeStep{-step.x, -step.y};
  const JoinedWay bit = way.y == 0   ? joinedRight
                        : way.x == 0 ? joinedDown
                        : way.x < 0  ? joinedDownLeft
                                     : joinedDownRight;
  return (joins & bit) == 0;
}

bool InnerEdges::plain(int x, int y) const {
  constexpr uint8_t all = joinedRight | joinedDown | joinedDownLeft | joinedDownRight;
  if (object(x, y) == 0) return true;
  if (x == 0 || y == 0 || x + 1 == s_.styles.width || y + 1 == s_.styles.height) return false;
  const uint16_t style = s_.styles(x, y);
  return s_.joins(x, y) == all && (s_.joins(x - 1, y) & joinedRight) &&
         (s_.joins(x, y - 1) & joinedDown) && (s_.joins(x + 1, y - 1) & joinedDownLeft) &&
         (s_.joins(x - 1, y - 1) & joinedDownRight) && s_.styles(x + 1, y) == style &&
         s_.styles(x, y + 1) == style && s_.styles(x - 1, y) == style &&
         s_.styles(x, y - 1) == style;
}

std::array<double, 8> InnerEdges::shares(int x, int y) const {
  std::array<double, 8> shares{};
  creases(x, y, shares);
  stairs(x, y, shares);
  double total = 0;
  for (const double share : shares) total += share;
  if (total > 1)
    for (double& share : shares) share /= total;
  return shares;
}

/// Whether an edge is one to be blended here.
bool InnerEdges::blends(int x, int y, EdgeStep step) const {
  const uint32_t own = object(x, y);
  if (!edge(x, y, step)) return false;
  const uint32_t other = object(x + step.x, y + step.y);
  return own == other || (s_.betweenObjects && other != 0);
}

std::optional<HalfPlane> InnerEdges::crease(int x, int y, EdgeStep step) const {
  if (!s_.rays || s_.normal.empty()) return {};
  const auto surface = [this](int px, int py) {
    return SurfacePoint{V3d(s_.position(px, py)) - s_.rays->eye, V3d(s_.normal(px, py))};
  };
  return creaseLine(surface(x, y), surface(x + step.x, y + step.y), *s_.rays, x, y, step.x, step.y);
}

/// The shares beyond creases: what all of them cut off, dealt out by what each cuts off alone.
void InnerEdges::creases(int x, int y, std::array<double, 8>& shares) const {
  PixelCut whole;
  double sum = 0;
  for (size_t i = 0; i < edgeSteps.size(); ++i) {
    if (!blends(x, y, edgeSteps[i])) continue;
    const std::optional<HalfPlane> line = crease(x, y, edgeSteps[i]);
    if (!line) continue;
    PixelCut alone;
    alone.take(*line);
    whole.take(*line);
    shares[i] = 1 - alone.area();
    sum += shares[i];
  }
  if (!(sum > 0)) return;
  const double scale = (1 - whole.area()) / sum;
  for (double& share : shares) share *= scale;
}

/// The run of edges beside a pixel toward `side`, on to `along`.
RunEnd InnerEdges::follow(int x, int y, EdgeStep side, EdgeStep along) const {
  RunEnd end;
  for (; end.pixels < longestRun; ++end.pixels) {
    const bool own = edge(x, y, along), other = edge(x + side.x, y + side.y, along);
    const bool on = edge(x + along.x, y + along.y, side);
    if (own || other || !on) {
      end.turn = on || own == other ? 0 : own ? 1 : -1;
      return end;
    }
    x += along.x;
    y += along.y;
  }
  return end;
}

/// The shares beyond edges of which only the staircase is known. A slope near 45 degrees is seen
/// in a row's run and a column's alike, so the greater counts, not both.
void InnerEdges::stairs(int x, int y, std::array<double, 8>& shares) const {
  std::array<double, sides> own{};
  for (size_t i = 0; i < sides; ++i) {
    const EdgeStep side = edgeSteps[i], along{side.y, side.x};
    if (!blends(x, y, side) || crease(x, y, side)) continue;
    own[i] = stairShare(follow(x, y, side, {-along.x, -along.y}), follow(x, y, side, along));
  }
  const double across = own[0] + own[2], down = own[1] + own[3];
  if (!(across + down > 0)) return;
  const double scale = std::max(across, down) / (across + down);
  for (size_t i = 0; i < sides; ++i) shares[i] += own[i] * scale;
}

void blendInnerEdges(const EdgeSurfaces& surfaces, const PaintViews& paint) {
  const InnerEdges edges(surfaces);
  mixAtEdges(
      paint, [&](int x, int y) { return edges.plain(x, y); },
      [&](int x, int y) { return blended(edges, paint, x, y); });
}

}  // namespace kagefude
