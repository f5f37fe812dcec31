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

    int stride() const { return width + 1; }
  };
  std::vector<Level> levels;  ///< full size first, 1 x 1 last, box-filtered
  /// Bytes, 128 is 0. Behind each row its first texel, behind the last row that row again, so that
  /// the four texels of a bilinear lookup are two reads of two bytes.
  Plane<uint8_t> pool;
  /// Rows are tones, brightest first; then the same at half, a quarter ... of the rows. The first
  /// level has a power of two of them, so that a level's rows and place follow from its number.
  int toneRows = 1;
  int lastToneLevel = 0;
  Plane<Rgba> colours;
};

/// First row of a level of tones in `colours`.
inline int toneLevelRow(int toneRows, int level) { return 2 * (toneRows - (toneRows >> level)); }

/// Takes a strip's full-size texels apart. Rows with less than a quarter of the strongest row's
/// deviation have no strokes to speak of (cel bands) and are left out of the grain, so that it has
/// strokes everywhere. Deviations are those of the root of the luminance, about what the eye sees,
/// each row's divided by its own root mean square. A strip without strokes has one texel of grain
/// 0. Cost: one sort of every row.
StripGrain makeStripGrain(View<const Rgba> texels);

}  // namespace kagefude
