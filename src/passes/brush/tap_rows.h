#pragma once

#include "passes/brush/brush_block.h"
#include "passes/brush/brush_rows.h"
#include "passes/brush/brush_samples.h"

// From a block's places on the strip to its colours, for every mapping that filters.
namespace kagefude {

/// A block's places on the strip, at most six a pixel: three axes, or two rings, in two octaves.
struct TapList {
  static constexpr int most = 6 * brushBlock;
  int count = 0;
  int ends[brushBlock];  ///< behind each pixel's last tap
  alignas(64) float u[most], tone[most], weight[most];
  alignas(64) float ux[most], vx[most], uy[most], vy[most];
  alignas(64) float stepU[most], stepV[most], coarser[most];
  alignas(64) int probes[most], level[most];
};

/// Paints one block, in as many goes as the list of lookups needs.
class BlockPainter {
 public:
  BlockPainter(const BrushInput& in, const Strip& strip)
      : strip_(strip), levels_(strip), perPixel_(lookups(in.params)) {}

  /// Whether the lookups of a pixel, however many probes it takes, find room.
  static bool hasRoom(const BrushParams& params) { return lookups(params) <= SampleList::most; }

  /// The block's pixels are `first` and the following ones of `out`.
  void paint(const BrushBlock& block, TapList& taps, const BrushParams& params, int first,
             int count, ColourRows& out);

 private:
  static int lookups(const BrushParams& params) { return 12 * params.maxProbes; }
  Rgba mixed(const BrushBlock& block, int i, int from, int end) const;

  const Strip& strip_;
  LevelTable levels_;
  int perPixel_;
  int ends_[brushBlock];
  Rgba colours_[brushBlock];
  SampleList samples_;
};

}  // namespace kagefude
