#include "passes/edges/outline.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "image/parallel.h"
#include "passes/edges/edge_window.h"

namespace kagefude {
namespace {

constexpr float pieceHalfLength = 0.75f;
constexpr float longestShift = 1.0f;

/// A short straight piece of boundary near a pixel's centre.
struct Piece {
  float x, y;              ///< its middle, pixels; centres at whole numbers
  float normalX, normalY;  ///< unit, across
  float depth;             ///< of the nearest surface beside it
  uint32_t owner;
};

struct Input {
  View<const uint32_t> ids;
  Vec3View normal, position;
  View<const float> depth;
  float depthStep, creaseCosine;
  bool objects;
};

float depthAt(const Input& in, int x, int y) {
  if (in.ids(x, y) == 0 || in.depth.empty()) return 3.0e38f;
  const float z = in.depth(x, y);
  return z > 0.0f ? z : 3.0e38f;
}

// Whether a line is drawn between two ids.
bool parted(const Input& in, uint32_t a, uint32_t b) {
  return a != b && (in.objects || a == 0 || b == 0);
}

bool isCrease(const Input& in, int px, int py, int qx, int qy) {
  const V3f n = in.normal(px, py), m = in.normal(qx, qy);
  return n.dot(m) < in.creaseCosine * std::sqrt(n.dot(n) * m.dot(m));
}

// Whether p lies on a lip: no more than two pixels from a line between ids to a crease. Centres of
// pixels hit what is so narrow now and then, and its crease would be dashes beside that line.
bool onLip(const Input& in, int x, int y) {
  constexpr int steps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  constexpr int lip = 2;
  const uint32_t own = in.ids(x, y);
  for (const auto& step : steps) {
    bool ends = false, turns = false;
    for (int i = 1; i <= lip; ++i) {
      const int rx = x - i * step[0], ry = y - i * step[1];
      const int qx = x + i * step[0], qy = y + i * step[1];
      ends = ends || (in.ids.contains(rx, ry) && parted(in, own, in.ids(rx, ry)));
      turns =
          turns || (in.ids.contains(qx, qy) && in.ids(qx, qy) == own && isCrease(in, x, y, qx, qy));
    }
    if (ends && turns) return true;
  }
  return false;
}

// Whether q is on p's side of every line.
bool sameSide(const Input& in, int px, int py, int qx, int qy) {
  const uint32_t a = in.ids(px, py), b = in.ids(qx, qy);
  if (parted(in, a, b)) return false;
  if (a == 0 || in.normal.empty()) return true;
  if (isCrease(in, px, py, qx, qy) && !onLip(in, px, py) && !onLip(in, qx, qy)) return false;
  if (in.position.empty() || in.depth.empty() || in.depthStep <= 0.0f) return true;
  const V3f n = in.normal(px, py), m = in.normal(qx, qy);
  const V3f d = in.position(qx, qy) - in.position(px, py);
  // Off either plane alone happens on curved surfaces; a step is off both.
  const float off = std::min(std::fabs(d.dot(n)), std::fabs(d.dot(m)));
  return !(off > in.depthStep * depthAt(in, px, py));
}

bool besideALine(const Input& in, int x, int y) {
  constexpr int steps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (const auto& step : steps) {
    const int qx = x + step[0], qy = y + step[1];
    if (in.ids.contains(qx, qy) && !sameSide(in, x, y, qx, qy)) return true;
  }
  return false;
}

// Smoothed boundary near (x, y): where the share of the pixel's own side falls to one half.
Piece pieceAt(const Input& in, const EdgeWindow& window, int x, int y) {
  Piece piece{static_cast<float>(x), static_cast<float>(y), 1, 0, depthAt(in, x, y), in.ids(x, y)};
  const EdgeWindow::Side seen =
      window.sideOf(x, y, in.ids.width, in.ids.height, [&](int qx, int qy, int dx, int dy) {
        if (sameSide(in, x, y, qx, qy)) return true;
        if (std::abs(dx) + std::abs(dy) == 1 && depthAt(in, qx, qy) < piece.depth) {
          piece.depth = depthAt(in, qx, qy);
          piece.owner = in.ids(qx, qy);
        }
        return false;
      });
  const float length = std::sqrt(seen.towardsX * seen.towardsX + seen.towardsY * seen.towardsY);
  if (!(length > 1e-6f * seen.sum)) return piece;
  constexpr float variance = EdgeWindow::sigma * EdgeWindow::sigma;
  const float slope = length / (variance * seen.sum);
  const float shift = std::clamp((seen.own / seen.sum - 0.5f) / slope, 0.0f, longestShift);
  piece.normalX = seen.towardsX / length;
  piece.normalY = seen.towardsY / length;
  piece.x -= piece.normalX * shift;
  piece.y -= piece.normalY * shift;
  return piece;
}

// The line's share of a pixel whose centre lies `distance` from its middle line.
float lineCoverage(float distance, float width) {
  const float half = 0.5f * width;
  const float outer = std::clamp(half - distance + 0.5f, 0.0f, 1.0f);
  return std::min(outer, width);
}

void drawPiece(const Piece& piece, float width, int first, int end, OutlineResult& result,
               Floats& nearest) {
  const float reach = 0.5f * width + 0.5f + pieceHalfLength;
  const int top = std::max(first, static_cast<int>(std::ceil(piece.y - reach)));
  const int bottom = std::min(end - 1, static_cast<int>(std::floor(piece.y + reach)));
  const int left = std::max(0, static_cast<int>(std::ceil(piece.x - reach)));
  const int right =
      std::min(result.coverage.width() - 1, static_cast<int>(std::floor(piece.x + reach)));
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      const float dx = static_cast<float>(x) - piece.x, dy = static_cast<float>(y) - piece.y;
      const float across = dx * piece.normalX + dy * piece.normalY;
      const float along = std::fabs(dx * piece.normalY - dy * piece.normalX);
      const float beyond = std::max(0.0f, along - pieceHalfLength);
      const float coverage = lineCoverage(std::sqrt(across * across + beyond * beyond), width);
      if (!(coverage > 0.0f)) continue;
      result.coverage(x, y) = std::max(result.coverage(x, y), coverage);
      // Nearest surface wins, then the smaller id, so that the order of pieces does not matter.
      if (piece.depth < nearest(x, y) ||
          (piece.depth == nearest(x, y) &&
           (result.owner(x, y) == 0 || piece.owner < result.owner(x, y)))) {
        nearest(x, y) = piece.depth;
        result.owner(x, y) = piece.owner;
      }
    }
}

std::vector<std::vector<Piece>> findPieces(const Input& in) {
  std::vector<std::vector<Piece>> rows(static_cast<size_t>(in.ids.height));
  const EdgeWindow window;
  parallelRows(in.ids.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < in.ids.width; ++x)
        if (besideALine(in, x, y))
          rows[static_cast<size_t>(y)].push_back(pieceAt(in, window, x, y));
  });
  return rows;
}

}  // namespace

OutlineResult drawOutlines(View<const uint32_t> ids, Vec3View normal, Vec3View position,
                           View<const float> depth, const OutlineParams& params) {
  const Input in{ids,
                 normal,
                 position,
                 depth,
                 params.depthStep,
                 params.creaseAngle >= 180 ? -2.0f : sinCosTurns(params.creaseAngle / 360.0f).cos,
                 params.objects};
  const auto pieces = findPieces(in);
  OutlineResult result{Floats(ids.width, ids.height, 0.0f), Labels(ids.width, ids.height, 0u)};
  Floats nearest(ids.width, ids.height, 3.4e38f);
  const int reach = static_cast<int>(0.5f * params.width) + 4;
  parallelRows(ids.height, [&](int first, int end) {
    for (int y = std::max(0, first - reach); y < std::min(ids.height, end + reach); ++y)
      for (const Piece& piece : pieces[static_cast<size_t>(y)])
        drawPiece(piece, params.width, first, end, result, nearest);
  });
  return result;
}

}  // namespace kagefude
