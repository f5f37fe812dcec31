#pragma once

#include <tbb/collaborative_call_once.h>

#include <map>
#include <string>
#include <vector>

#include "colour/colour.h"
#include "image/vec.h"
#include "look/look.h"
#include "passes/strip/strip.h"

namespace kagefude {

/// The strips of a look, loaded once a run, in the working space with their mip levels.
class StripSet {
 public:
  /// Loads every style's strip. Throws InputError when a file cannot be used, LookError when a
  /// built-in name is unknown. `colour` must outlive the set.
  StripSet(const Look& look, const Colour& colour);
  StripSet(const Look& look, Colour&& colour) = delete;
  /// By its name, a strip that was loaded before.
  using Loaded = std::map<std::string, Strip>;
  /// The same, but takes strips out of `loaded`, where they are. Whoever has put them there answers
  /// for it that they would be loaded alike now. When this throws, all are where they were.
  StripSet(const Look& look, const Colour& colour, Loaded& loaded);

  /// Every strip that was loaded. Afterwards this has none.
  Loaded release();

  /// The index of a style's strip in strips(); "builtin:neutral" for surfaces without a style. That
  /// one is painted when it is first asked for: many looks leave no surface to it.
  int indexOf(const std::string& name) const;
  const std::vector<Strip>& strips() const { return strips_; }
  /// The picture behind things (ground.picture), held as a strip; null where the look shows none.
  const Strip* picture() const {
    return picture_.empty() ? nullptr : &strips_[static_cast<size_t>(indexOf(picture_))];
  }

 private:
  void load(const Look& look, Loaded& loaded);

  const Colour& colour_;
  mutable std::vector<Strip> strips_;  ///< the first is the neutral one, empty until asked for
  mutable tbb::collaborative_once_flag neutral_;
  std::map<std::string, int> indices_;
  std::string picture_;
};

/// Names of all strips and pictures that a look paints with: each style's, those of single lights,
/// then the ground's.
std::vector<std::string> paintedFiles(const Look& look);

/// The strip or picture that output.background shows; "" where it shows none. Throws LookError
/// where it should name one and does not.
std::string groundFile(const Look& look);

/// The space of strips that are pictures: the look's colour.strip, else sRGB.
std::string stripColourSpace(const Look& look);

/// A colour of the working space in the linear Rec. 709 that painted strips are encoded from; as it
/// is where the configuration knows no such space.
V3f toStripLinear(const Colour& colour, const V3f& working);

/// Whether a strip's name means one that is painted by the program itself.
bool isBuiltinStrip(const std::string& name);

/// Whether a strip of a style multiplies the surface's colour; `auto` does for the neutral strip.
bool multipliesColour(const StyleParams& style, const std::string& strip);

}  // namespace kagefude
