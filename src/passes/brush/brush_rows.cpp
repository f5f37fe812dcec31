#include "passes/brush/brush_rows.h"

#include <algorithm>

#include "passes/brush/brush_block.h"
#include "passes/brush/brush_taps.h"
#include "passes/brush/tap_rows.h"

namespace kagefude {
namespace {

// Taps of every pixel at one or two octaves.
template <int octaves>
void listTaps(const BrushAnchor& anchor, int count, const BrushBlock& block, TapList& taps) {
  const float perUnit = 1.0f / (2.0f * pi * anchor.mappingDistance);
  const float unit[2] = {perUnit, 0.5f * perUnit};
  const float share[2] = {1.0f - anchor.coarser, anchor.coarser};
  const float shift[2] = {anchor.shift, anchor.coarserShift};
  int n = 0;
  for (int i = 0; i < count; ++i) {
    const bool present = block.here.absent[i + 1] == 0.0f;
    for (int k = 0; k < 3; ++k) {
      const float weight = block.weight[k][i];
      if (!(present && weight > 0.0f)) continue;
      for (int octave = 0; octave < octaves; ++octave, ++n) {
        taps.u[n] = block.place[k][i] * unit[octave] + (axisOffset[k] + shift[octave]);
        taps.tone[n] = block.here.tone[i + 1];
        taps.weight[n] = weight * share[octave];
        taps.ux[n] = block.placeAcross[k][i] * unit[octave];
        taps.uy[n] = block.placeDown[k][i] * unit[octave];
        taps.vx[n] = block.across.tone[i];
        taps.vy[n] = block.down.tone[i];
      }
    }
    taps.ends[i] = n;
  }
  taps.count = n;
}

}  // namespace

bool canPaintHeldRow(const BrushInput& in, const BrushAnchor& anchor) {
  return in.params.mapping == BrushParams::Mapping::held &&
         in.params.grain == BrushParams::Grain::tone &&
         in.params.filter == BrushParams::Filter::anisotropic && anchor.points.size() == 1 &&
         !keepsSizeInWorld(in, anchor) && !(liesAtRest(in, anchor) && anchor.placesTurned) &&
         BlockPainter::hasRoom(in.params);
}

void paintHeldRow(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
                  ColourRows& out) {
  BrushBlock block;
  TapList taps;
  BlockPainter painter(in, in.strips[static_cast<size_t>(anchor.strip)]);
  for (int x = first; x < end; x += brushBlock) {
    const int count = std::min(end - x, brushBlock);
    prepareBlock(in, anchor, x, x + count, y, block);
    if (anchor.coarser > 0.0f)
      listTaps<2>(anchor, count, block, taps);
    else
      listTaps<1>(anchor, count, block, taps);
    painter.paint(block, taps, in.params, x, count, out);
  }
}

}  // namespace kagefude
