#include "passes/brush/grain_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "image/clones.h"
#include "passes/brush/grain_block.h"
#include "passes/brush/grain_lookup.h"

namespace kagefude {
namespace {

/// Where each pixel's colour lies.
struct ColourPlaces {
  alignas(64) int texel[brushBlock], down[brushBlock];
  alignas(64) float fx[brushBlock], fy[brushBlock];
};

KAGEFUDE_CLONES
void placeColours(int rows, int lastLevel, const BrushBlock& block, const float* __restrict grain,
                  int count, ColourPlaces& places) {
  int* __restrict texel = places.texel, * __restrict down = places.down;
  float* __restrict fx = places.fx, * __restrict fy = places.fy;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float across = std::fabs(block.across.tone[i]), below = std::fabs(block.down.tone[i]);
    const int level = toneLevel(across > below ? across : below, rows, lastLevel);
    const RowPlace row = rowPlace(block.here.tone[i + 1], rows >> level);
    const float at = grainColumn(grain[i]);
    const int whole = static_cast<int>(at);
    const int left = whole < StripGrain::columns - 1 ? whole : StripGrain::columns - 2;
    texel[i] = (toneLevelRow(rows, level) + row.upper) * StripGrain::columns + left;
    down[i] = (row.lower - row.upper) * StripGrain::columns;
    fx[i] = at - static_cast<float>(left);
    fy[i] = row.fraction;
  }
}

/// Two neighbouring colours, from wherever the left one lies.
using RgbaPair = float __attribute__((vector_size(32)));

// The two rows are mixed for both columns at once.
__attribute__((always_inline)) inline Rgba colourAt(const Rgba* colours, const ColourPlaces& places,
                                                    int i) {
  const Rgba* const left = colours + places.texel[i];
  RgbaPair upper, lower;
  std::memcpy(&upper, left, sizeof upper);
  std::memcpy(&lower, left + places.down[i], sizeof lower);
  const RgbaPair mixed = upper + (lower - upper) * places.fy[i];
  const Rgba a = __builtin_shufflevector(mixed, mixed, 0, 1, 2, 3);
  const Rgba b = __builtin_shufflevector(mixed, mixed, 4, 5, 6, 7);
  return a + (b - a) * places.fx[i];
}

// The common case: opaque strips at their own contrast, every pixel there.
KAGEFUDE_CLONES
void storePlainly(const Strip& strip, const ColourPlaces& places, int first, int count,
                  ColourRows& out) {
  const Rgba* const colours = strip.grain.colours.row(0);
  int i = 0;
  for (; i + 4 <= count; i += 4) {
    const Rgba four[4] = {colourAt(colours, places, i), colourAt(colours, places, i + 1),
                          colourAt(colours, places, i + 2), colourAt(colours, places, i + 3)};
    out.storeFour(first + i, four);
  }
  for (; i < count; ++i) out.store(first + i, colourAt(colours, places, i));
  std::fill_n(out.a + first, count, 1.0f);
}

KAGEFUDE_CLONES
void storeColours(const BrushInput& in, const Strip& strip, const BrushBlock& block,
                  const ColourPlaces& places, int first, int count, ColourRows& out) {
  const Rgba* const colours = strip.grain.colours.row(0);
  const float contrast = in.params.contrast;
  const bool opaque = strip.opaque;
  for (int i = 0; i < count; ++i) {
    Rgba colour = colourAt(colours, places, i);
    if (contrast != 1.0f) {
      const Rgba mean = stripRowMean(strip, block.here.tone[i + 1]);
      colour = mean + (colour - mean) * contrast;
      colour = colour > 0.0f ? colour : Rgba{};
    }
    if (opaque) colour[3] = 1.0f;
    out.store(first + i, block.here.absent[i + 1] == 0.0f ? colour : Rgba{});
  }
}

bool allPresent(const BrushBlock& block, int count) {
  return std::all_of(block.here.absent + 1, block.here.absent + 1 + count,
                     [](float absent) { return absent == 0.0f; });
}

}  // namespace

bool canPaintObjectRow(const BrushInput& in, const BrushAnchor& anchor) {
  return in.params.mapping == BrushParams::Mapping::held &&
         in.params.grain == BrushParams::Grain::object &&
         in.params.filter == BrushParams::Filter::anisotropic && !keepsSizeInWorld(in, anchor) &&
         !(liesAtRest(in, anchor) && anchor.placesTurned);
}

void paintObjectRow(const BrushInput& in, const BrushAnchor& anchor, int first, int end, int y,
                    ColourRows& out) {
  const Strip& strip = in.strips[static_cast<size_t>(anchor.strip)];
  const StripGrain::Level& full = strip.grain.levels.front();
  const float aspect = static_cast<float>(full.width) / static_cast<float>(full.height);
  BrushBlock blocks[2];
  GrainTaps taps;
  ColourPlaces places;
  GrainReader reader(strip.grain, in.params.maxProbes);
  alignas(64) float grain[brushBlock];
  const auto load = [&](int x, int which) {
    if (x < end) loadBlock(in, anchor, x, std::min(x + brushBlock, end), y, blocks[which]);
  };
  load(first, 0);
  for (int x = first, which = 0; x < end; x += brushBlock, which = 1 - which) {
    BrushBlock& block = blocks[which];
    const int count = std::min(end - x, brushBlock);
    listGrainTaps(in, anchor, aspect, count, block, taps);
    reader.place(taps);
    load(x + brushBlock, 1 - which);  // while the texels come
    reader.read(taps, grain);
    if (out.grain) std::copy_n(grain, count, out.grain + x);
    placeColours(strip.grain.toneRows, strip.grain.lastToneLevel, block, grain, count, places);
    if (in.params.contrast == 1.0f && strip.opaque && allPresent(block, count))
      storePlainly(strip, places, x, count, out);
    else
      storeColours(in, strip, block, places, x, count, out);
  }
}

}  // namespace kagefude
