#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "look/look_presets.h"

namespace kagefude {

/// A thing that a frame shows, for which a look gets a style: a material of an object.
struct DraftThing {
  std::string object, material;  ///< "" where nothing names it
  uint32_t index = 0;            ///< object index where only that is known, else 0
  size_t pixels = 0;
  size_t rimPixels = 0;  ///< of them those beside another thing: 2 pixels / rimPixels is its width
  V3f colour{0, 0, 0};   ///< its own, linear Rec. 709
  bool fromBeauty = false;  ///< taken from the picture, for want of an albedo
  float brightTone = 1;     ///< tone that a twentieth of its pixels exceed, 0..1
  float pixelWidth = 0;     ///< world units that a pixel shows of it; 0: unknown
};

struct DraftFrame {
  std::string name;           ///< the frame's file, for the comment
  int width = 0, height = 0;  ///< pixels
  int scale = 1;              ///< how many times larger it is than what is to be written
  float brightTone = 1;       ///< of all things
  bool smooths = true;        ///< whether [smooth] acts on the shadow of any of its lights
  std::vector<DraftThing> things;
};

/// A strip to be painted into the look's folder of strips.
struct DraftStrip {
  std::string file;  ///< name in that folder
  StripPaintParams params;
};

struct DraftLook {
  std::string text;
  std::vector<DraftStrip> strips;
};

/// **[ours]** A look for what a frame shows, painted as a preset paints, with comments that say
/// why. One style for each material, or object where materials have no names; a material whose
/// objects differ in colour (by more than 0.06 in Oklab) has one for each. Things beyond the 24
/// largest take the strip of a larger one that differs by less than 0.06, and beyond 64 strips the
/// nearest, and share its style. `tone.white` is 1.15 times the frame's bright tone (from 0.5 on),
/// of a thing of more than a tenth of the frame that stays below three quarters of it its own.
/// Outlines are thinner on things narrower than three of them, and none on those narrower than 3
/// pixels. A last style catches what the frame does not show. Strokes are sized by the pixels that
/// a thing fills, but for presets without strokes (brush.contrast = 0); keys of [smooth] are only
/// written where they act; strips that are shown at less than half their size are painted at half
/// of it. `stripFolder` is the folder of strips as the look names it. The same text for the same
/// frame.
DraftLook draftLook(const LookPreset& preset, const DraftFrame& frame,
                    const std::string& stripFolder);

}  // namespace kagefude
