#include "passes/search/uniform_blocks.h"

#include "image/parallel.h"

namespace kagefude {
namespace {

constexpr int farthest = 255;  ///< blocks
constexpr uint32_t mixed = 0xffffffffu;

/// The one label of a block, or `mixed`; mixed, too, where the frame's edge cuts it.
uint32_t labelOf(View<const uint32_t> labels, int x0, int y0, int side) {
  if (x0 + side > labels.width || y0 + side > labels.height) return mixed;
  const uint32_t first = labels(x0, y0);
  uint32_t differs = 0;
  for (int y = y0; y < y0 + side; ++y)
    for (int x = x0; x < x0 + side; ++x) differs |= labels(x, y) ^ first;
  return differs ? mixed : first;
}

}  // namespace

UniformBlocks::UniformBlocks(View<const uint32_t> labels)
    : blocksX_((labels.width + side - 1) / side), blocksY_((labels.height + side - 1) / side) {
  const auto at = [this](int x, int y) {
    return static_cast<size_t>(y) * static_cast<size_t>(blocksX_) + static_cast<size_t>(x);
  };
  std::vector<uint32_t> label(at(0, blocksY_));
  around_.resize(label.size());
  parallelRows(blocksY_, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < blocksX_; ++x)
        label[at(x, y)] = labelOf(labels, x * side, y * side, side);
  });
  // The greatest square of blocks of one label round each: chessboard distance in two sweeps.
  constexpr int ahead[4][2] = {{-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  const auto lower = [&](int x, int y, int sign) {
    const size_t here = at(x, y);
    if (label[here] == mixed) return;
    int least = sign > 0 ? farthest : around_[here];
    for (const auto& step : ahead) {
      const int nx = x + sign * step[0], ny = y + sign * step[1];
      const bool inside = nx >= 0 && ny >= 0 && nx < blocksX_ && ny < blocksY_;
      const bool same = inside && label[at(nx, ny)] == label[here];
      least = std::min(least, same ? around_[at(nx, ny)] + 1 : 1);
    }
    around_[here] = static_cast<uint8_t>(least);
  };
  for (int y = 0; y < blocksY_; ++y)
    for (int x = 0; x < blocksX_; ++x) lower(x, y, 1);
  for (int y = blocksY_ - 1; y >= 0; --y)
    for (int x = blocksX_ - 1; x >= 0; --x) lower(x, y, -1);
}

}  // namespace kagefude
