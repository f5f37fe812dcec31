#pragma once

#include <span>
#include <string_view>

#include "image/vec.h"
#include "passes/strip/strip_paint.h"
#include "passes/strip/strip_tones.h"

namespace kagefude {

/// A key that a preset writes into a look, and why.
struct PresetKey {
  std::string_view section, key;
  std::string_view value;  ///< as TOML spells it; "" where it is a share of the picture's height
  float ofHeight = 0;      ///< pixels, of the picture's height
  std::string_view why;
};

/// A way of painting, from which `look new` makes looks: how its strips are painted, which tones it
/// mixes from a thing's colour, how large its strokes are, and what else it sets.
struct LookPreset {
  std::string_view name;
  std::string_view sentence;  ///< what it looks like, for help and the look's first line
  void (*paint)(StripPaintParams& strip);
  std::span<const TonePoint> ramp;
  std::span<const PresetKey> keys;
  /// Width of the strip on the screen for a thing that fills the frame, of the picture's height.
  float strokeSize = 0.5f;
  /// How brushes follow the things' sizes: 0 the same one everywhere, 1 in proportion.
  float followsSize = 0.5f;
  float outlineLightness = -1;  ///< of the own colour's; below 0: no outlines
  float outlineChroma = 1;
  bool inColour = true;  ///< false: the ramp's tones are greys on warm paper
};

std::span<const LookPreset> lookPresets();

/// Throws UsageError that names the nearest.
const LookPreset& lookPreset(std::string_view name);

/// The strip of a thing of that colour (linear Rec. 709). `seed` makes strokes of two strips
/// differ.
StripPaintParams presetStrip(const LookPreset& preset, const V3f& colour, int seed);

/// The colour of its outlines, linear Rec. 709; of a preset that draws some.
V3f presetOutline(const LookPreset& preset, const V3f& colour);

}  // namespace kagefude
