#include "compositor/strip_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "base/error.h"
#include "base/nearest_name.h"
#include "image/parallel.h"
#include "passes/strip/strip_paint.h"
#include "picture/strip_file.h"

namespace kagefude {
namespace {

constexpr std::string_view builtinPrefix = "builtin:";
constexpr std::string_view paintedSpace = "sRGB";

Strip loadBuiltin(const Colour& colour, const std::string& preset) {
  const std::vector<std::string> names(std::begin(stripPresets), std::end(stripPresets));
  if (std::find(names.begin(), names.end(), preset) == names.end())
    throw LookError(fmt::format("there is no built-in strip {}{}; there are {}", preset,
                                didYouMean(preset, names), listNames(names)));
  PaintedStrip picture = paintStrip(stripPreset(preset));
  colour.toWorking(picture.r, picture.g, picture.b, paintedSpace);
  return makeStrip(picture.r, picture.g, picture.b);
}

Strip loadStrip(const Look& look, const Colour& colour, const std::string& name) {
  if (isBuiltinStrip(name)) return loadBuiltin(colour, name.substr(builtinPrefix.size()));
  StripPicture picture = readStrip(look.resolve(name));
  const std::string space =
      look.colour.strip.empty() ? std::string(paintedSpace) : look.colour.strip;
  if (!picture.sceneLinear || !look.colour.strip.empty())
    colour.toWorking(picture.red, picture.green, picture.blue, space);
  return makeStrip(picture.red, picture.green, picture.blue);
}

}  // namespace

bool isBuiltinStrip(const std::string& name) { return name.starts_with(builtinPrefix); }

bool multipliesColour(const StyleParams& style) {
  if (style.colour == StripColour::automatic) return style.strip == "builtin:neutral";
  return style.colour == StripColour::multiply;
}

int StripSet::indexOf(const std::string& name) const {
  const int index = indices_.at(name);
  if (index == 0)
    tbb::collaborative_call_once(neutral_, [this] {
      strips_[0] = loadBuiltin(colour_, StyleParams{}.strip.substr(builtinPrefix.size()));
    });
  return index;
}

StripSet::StripSet(const Look& look, const Colour& colour) : colour_(colour) {
  std::vector<std::string> names = {StyleParams{}.strip};
  for (const StyleLook& style : look.styles) names.push_back(style.style.strip);
  std::vector<std::string> distinct;
  for (const std::string& name : names)
    if (indices_.emplace(name, static_cast<int>(distinct.size())).second) distinct.push_back(name);
  strips_.resize(distinct.size());
  std::vector<std::exception_ptr> errors(distinct.size());
  parallelRows(static_cast<int>(distinct.size()) - 1, 1, [&](int first, int) {
    const auto i = static_cast<size_t>(first) + 1;
    try {
      strips_[i] = loadStrip(look, colour, distinct[i]);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)  // the first of the look, whoever was faster
    if (error) std::rethrow_exception(error);
}

}  // namespace kagefude
