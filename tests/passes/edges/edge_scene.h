#pragma once

#include <vector>

#include "passes/edges/painted_edges.h"

namespace kagefude {

/// Two things side by side, or one and the background: the left one (1) ends before column 12.
struct EdgeScene {
  static constexpr int width = 24, height = 9, border = 12;
  Floats r{width, height}, g{width, height}, b{width, height}, a{width, height, 1.0f};
  Floats ownR, ownG, ownB, ownA;
  Plane<uint16_t> things{width, height};
  Floats distance{width, height}, grain{width, height, 0.0f};
  Labels ids, otherIds;
  Floats share, otherShare;
  float metBeyond = 0;  ///< of the left thing's paint, in the first column beyond it
  std::vector<PaintedEdgeParams> params = std::vector<PaintedEdgeParams>(2);

  explicit EdgeScene(uint16_t right, float left = 0.8f, float other = 0.2f) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const bool first = x < border;
        things(x, y) = first ? uint16_t{1} : right;
        const float value = first ? left : right ? other : 0.0f;
        r(x, y) = g(x, y) = b(x, y) = value;
        a(x, y) = first || right ? 1.0f : 0.0f;
        distance(x, y) = first ? 1.0f : 2.0f;
      }
  }
  void paint(const PaintGround* ground = nullptr) {
    ownR = r.clone();
    ownG = g.clone();
    ownB = b.clone();
    ownA = a.clone();
    std::vector<CoverageRank> ranks;
    if (!ids.empty()) ranks.push_back({ids, share});
    if (!otherIds.empty()) ranks.push_back({otherIds, otherShare});
    for (Floats* plane : {&r, &g, &b, &a})
      for (int y = 0; y < height; ++y)
        (*plane)(border, y) += ((*plane)(border - 1, y) - (*plane)(border, y)) * metBeyond;
    const std::vector<uint32_t> own{1, 2};
    EdgePaint in{{ownR, ownG, ownB, ownA}, things, params};
    in.distance = distance;
    in.grain = grain;
    in.coverageIds = own;
    in.coverage = ranks;
    in.ground = ground;
    paintEdges(in, {r, g, b, a});
  }
  bool isUntouched() const {
    for (size_t i = 0; i < r.view().pixels(); ++i)
      if (r.row(0)[i] != ownR.row(0)[i] || a.row(0)[i] != ownA.row(0)[i]) return false;
    return true;
  }
};

}  // namespace kagefude
