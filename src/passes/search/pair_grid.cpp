#include "passes/search/pair_grid.h"

#include <algorithm>

#include "image/parallel.h"
#include "passes/search/classes.h"

namespace kagefude {
namespace {

constexpr auto background = static_cast<uint8_t>(ShadowClass::background);
constexpr auto penumbra = static_cast<uint8_t>(ShadowClass::penumbra);
constexpr float piecesPerPenumbra = 4.0f;

}  // namespace

PairGrid::PairGrid(View<const uint8_t> classes, View<const uint32_t> labels, int step)
    : classes_(classes),
      labels_(labels),
      step_(step),
      cellsAcross_((classes.width + step - 1) / step),
      pieces_(static_cast<size_t>(cellsAcross_) *
                  static_cast<size_t>((classes.height + step - 1) / step),
              step) {}

PairGrid::Span PairGrid::spanAt(int place, int piece, int size) const {
  const int cell = place / step_ * step_;
  const int low = cell + (place - cell) / piece * piece;
  const int high = std::min({low + piece, cell + step_, size - 1});
  const float share =
      high > low ? static_cast<float>(place - low) / static_cast<float>(high - low) : 0.0f;
  return {low, high, share};
}

PairGrid::Corners PairGrid::cornersAt(int x, int y) const {
  const int piece = pieceAt(x, y);
  const Span across = spanAt(x, piece, classes_.width), down = spanAt(y, piece, classes_.height);
  Corners corners;
  for (int i = 0; i < 4; ++i) {
    const bool right = i & 1, lower = i & 2;
    const int cx = right ? across.high : across.low, cy = lower ? down.high : down.low;
    const float weight =
        (right ? across.share : 1.0f - across.share) * (lower ? down.share : 1.0f - down.share);
    corners.corner[i] = {cx, cy, sameLabel(x, y, cx, cy) ? weight : 0.0f};
  }
  return corners;
}

bool PairGrid::sameLabel(int x, int y, int qx, int qy) const {
  if (!labels_.empty()) return labels_(x, y) == labels_(qx, qy);
  return classes_(qx, qy) != background;
}

float PairGrid::narrowest(int cellX, int cellY,
                          const std::function<float(int x, int y)>& width) const {
  const int xs[] = {cellX, std::min(cellX + step_, classes_.width - 1)};
  const int ys[] = {cellY, std::min(cellY + step_, classes_.height - 1)};
  float smallest = piecesPerPenumbra * static_cast<float>(step_);
  bool found = false;
  for (const int y : ys)
    for (const int x : xs) {
      if (classes_(x, y) != penumbra) continue;
      found = true;
      smallest = std::min(smallest, width(x, y));
    }
  return found ? smallest : 0.0f;
}

void PairGrid::refine(const std::function<float(int x, int y)>& width) {
  for (int y = 0; y < classes_.height; y += step_)
    for (int x = 0; x < classes_.width; x += step_) {
      const float pieces = narrowest(x, y, width) / piecesPerPenumbra;
      pieceAt(x, y) = std::clamp(static_cast<int>(pieces), 1, step_);
    }
}

Bytes PairGrid::searched() const {
  Bytes searched(classes_.width, classes_.height, 0);
  // Cells share corners, so rows of cells may not be marked at the same time.
  for (int y = 0; y < classes_.height; ++y)
    for (int x = 0; x < classes_.width; ++x) {
      if (classes_(x, y) != penumbra) continue;
      float reached = 0.0f;
      for (const Corner& corner : cornersAt(x, y).corner) {
        reached += corner.weight;
        if (classes_(corner.x, corner.y) == penumbra) searched(corner.x, corner.y) = 1;
      }
      if (reached <= 0.0f) searched(x, y) = 1;
    }
  return searched;
}

float PairGrid::interpolate(int x, int y, View<const float> values) const {
  float sum = 0.0f, weights = 0.0f;
  for (const Corner& corner : cornersAt(x, y).corner) {
    if (corner.weight <= 0.0f) continue;
    sum += corner.weight * values(corner.x, corner.y);
    weights += corner.weight;
  }
  return sum / weights;
}

}  // namespace kagefude
