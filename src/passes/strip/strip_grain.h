#pragma once

#include <cstdint>
#include <vector>

#include "image/plane.h"

namespace kagefude {

/// One colour: red, green, blue and alpha side by side, so that a lookup works on all four at once.
using Rgba = float __attribute__((vector_size(16)));

/// **[ours]** A strip taken apart, so that its strokes can lie still on an object while the tone
/// picks their colours: the strokes' *grain*, a picture of how far each place of the strip is above
/// or below its row's mean, and the *colours* that each tone gives to each grain. Reading the
/// colours at (tone, grain) with the grain of the strip itself gives each row its own colours back,
/// in the same shares.
struct StripGrain {
  /// The grain runs from -reach to reach; over the strip its mean is 0, its variance 1.
  static constexpr float reach = 3.5f;
  static constexpr float perStep = reach / 127.0f;  ///< grain of one step of a byte
  static constexpr int columns = 24;                ///< places of the grain in `colours`

  struct Level {
    int width = 0, height = 0;
    int offset = 0;  ///< of its first texel in `pool`

    int tilesAcross() const { return (width + 3) / 4; }
    int texels() const { return tilesAcross() * ((height + 3) / 4) * 16; }
  };
  std::vector<Level> levels;  ///< full size first, 1 x 1 last, box-filtered
  /// Each texel with its neighbours, as a bilinear lookup mixes them: four bytes, from the lowest
  /// on here, right (round the strip's end), below (the last row's is itself) and below right; 128
  /// is 0. In tiles of 4 x 4 texels, one line of the cache each, see grainTexel: a row of pixels
  /// crosses the grain in any direction.
  Plane<uint32_t> pool;
  /// Rows are tones, brightest first; then the same at half, a quarter ... of the rows. The first
  /// level has a power of two of them, so that a level's rows and place follow from its number.
  int toneRows = 1;
  int lastToneLevel = 0;
  Plane<Rgba> colours;
};

/// Place in a level's part of the pool.
inline int grainTexel(int x, int y, int tilesAcross) {
  return ((y >> 2) * tilesAcross + (x >> 2)) * 16 + (y & 3) * 4 + (x & 3);
}

/// First row of a level of tones in `colours`.
inline int toneLevelRow(int toneRows, int level) { return 2 * (toneRows - (toneRows >> level)); }

/// Takes a strip's full-size texels apart. Rows with less than a quarter of the strongest row's
/// deviation have no strokes to speak of (cel bands) and are left out of the grain, so that it has
/// strokes everywhere. Deviations are those of the root of the luminance, about what the eye sees,
/// each row's divided by its own root mean square. A strip without strokes has one texel of grain
/// 0. Cost: one sort of every row.
StripGrain makeStripGrain(View<const Rgba> texels);

}  // namespace kagefude
