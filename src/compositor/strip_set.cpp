#include "compositor/strip_set.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/nearest_name.h"
#include "frame/strip_file.h"
#include "passes/strip_paint.h"

namespace kagefude {
namespace {

constexpr std::string_view builtinPrefix = "builtin:";
constexpr std::string_view paintedSpace = "sRGB";

}  // namespace

bool isBuiltinStrip(const std::string& name) { return name.starts_with(builtinPrefix); }

bool multipliesColour(const StyleParams& style) {
  if (style.colour == StripColour::automatic) return style.strip == "builtin:neutral";
  return style.colour == StripColour::multiply;
}

StripSet::StripSet(const Look& look, const Colour& colour) {
  load(look, colour, StyleParams{}.strip);
  for (const StyleLook& style : look.styles) load(look, colour, style.style.strip);
}

void StripSet::load(const Look& look, const Colour& colour, const std::string& name) {
  if (indices_.contains(name)) return;
  const std::string space =
      look.colour.strip.empty() ? std::string(paintedSpace) : look.colour.strip;
  if (isBuiltinStrip(name)) {
    const std::string preset = name.substr(builtinPrefix.size());
    const std::vector<std::string> names(std::begin(stripPresets), std::end(stripPresets));
    if (std::find(names.begin(), names.end(), preset) == names.end())
      throw LookError(fmt::format("there is no built-in strip {}{}; there are {}", preset,
                                  didYouMean(preset, names), listNames(names)));
    PaintedStrip picture = paintStrip(stripPreset(preset));
    colour.toWorking(picture.r, picture.g, picture.b, paintedSpace);
    strips_.push_back(makeStrip(picture.r, picture.g, picture.b));
  } else {
    StripPicture picture = readStrip(look.resolve(name));
    if (!picture.sceneLinear || !look.colour.strip.empty())
      colour.toWorking(picture.red, picture.green, picture.blue, space);
    strips_.push_back(makeStrip(picture.red, picture.green, picture.blue));
  }
  indices_[name] = static_cast<int>(strips_.size()) - 1;
}

}  // namespace kagefude
