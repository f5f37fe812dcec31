#pragma once

#include <vector>

#include "passes/light_shape/shadow_need.h"

namespace kagefude {

/// How far shadows shift on the picture, found by matching the masks: at the right length all of
/// them, moved to one place of the light, agree. Their disagreement is summed over tiles, and over
/// windows that grow with the length, for lengths √2 apart.
class ShadowMatch {
 public:
  static constexpr int smallestTile = 4;  ///< pixels; tiles are multiples

  /// All must outlive this. edges: the pixels where masks disagree.
  ShadowMatch(const ShadowTaps& taps, const ShadowNeed& need, const PixelSet& edges,
              std::span<const V2f> places, Vec3View position, Vec3View normal,
              const LightGeometry& geometry);

  struct Match {
    float shift = 0;  ///< pixels, for the light's radius
    float cost = 1;   ///< mean disagreement
    bool found = false;
  };
  /// The shift at a pixel, interpolated between tiles towards those that match better.
  Match at(int x, int y) const;
  /// False where `at` finds nothing anywhere in the tile of the pixel.
  bool mayFind(int x, int y) const { return near_[tileAt(x / tile_, y / tile_)] != 0; }
  /// Side of a tile, pixels.
  int tile() const { return tile_; }

 private:
  static constexpr int mostShifts = 16;
  /// Disagreements of one label in one tile.
  struct Sums {
    uint32_t label = 0;
    float count = 0;
    float cost[mostShifts] = {};
  };
  struct Tile {
    Sums sums[2];
  };
  struct Choice {
    uint32_t label = 0;
    float level = 0;  ///< place among the shifts, fractional
    float cost = 1;
  };
  struct Choices {
    Choice of[2];
  };

  size_t tileAt(int tx, int ty) const {
    return static_cast<size_t>(ty) * static_cast<size_t>(tilesX_) + static_cast<size_t>(tx);
  }
  bool inside(int tx, int ty) const { return tx >= 0 && ty >= 0 && tx < tilesX_ && ty < tilesY_; }
  bool hasEdge(int tx, int ty, const PixelSet& edges) const;
  /// Numbers the tiles that hold an edge.
  void findTiles(const PixelSet& edges);
  void measureTile(int tx, int ty, const PixelSet& edges);
  void choose(int tx, int ty);
  Choice chooseFor(int tx, int ty, uint32_t label) const;

  const ShadowTaps& taps_;
  const ShadowNeed& need_;
  Vec3View position_, normal_;
  const LightGeometry& geometry_;
  int tile_, tilesX_, tilesY_;
  int shifts_ = 0;
  float length_[mostShifts];
  ShadowPlaces places_;
  std::vector<uint32_t> slots_;  ///< number of a tile that holds an edge, and 1; else 0
  std::vector<Tile> tiles_;      ///< those that hold an edge
  std::vector<Choices> choices_;
  std::vector<uint8_t> near_;
};

}  // namespace kagefude
