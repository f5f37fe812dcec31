#include "compositor/strip_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <functional>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/place_error.h"
#include "image/parallel.h"
#include "image/real_math.h"
#include "look/light_strip.h"
#include "passes/strip/strip_paint.h"
#include "picture/strip_file.h"

namespace kagefude {
namespace {

constexpr std::string_view builtinPrefix = "builtin:";
/// Names under which configurations hold display-encoded sRGB pictures.
constexpr std::string_view paintedSpaces[] = {"sRGB",
                                              "srgb_tx",
                                              "sRGB - Texture",
                                              "sRGB Encoded Rec.709 (sRGB)",
                                              "Utility - sRGB - Texture",
                                              "Input - Generic - sRGB - Texture",
                                              "texture_paint",
                                              "matte_paint"};

float linearFromSrgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : powerOf((encoded + 0.055f) / 1.055f, 2.4f);
}

float linearFromRec709(float encoded) {
  return encoded < 0.081f ? encoded / 4.5f : powerOf((encoded + 0.099f) / 1.099f, 1 / 0.45f);
}

/// What OpenImageIO's names for encodings mean that a configuration need not have: Rec709 (ITU-R
/// BT.709-6, 1.2, turned round), and a plain power such as Gamma2.2 or GammaCorrected2.2.
std::function<float(float)> knownDecoding(const std::string& space) {
  if (space == "Rec709") return linearFromRec709;
  for (const std::string prefix : {"GammaCorrected", "Gamma"}) {
    if (!space.starts_with(prefix)) continue;
    float power = 2.2f;
    const char* const end = space.data() + space.size();
    const char* const number = space.data() + prefix.size();
    const auto [read, error] = std::from_chars(number, end, power);
    if (number != end && (error != std::errc() || read != end || !(power > 0 && power < 10)))
      return nullptr;
    return [power](float v) { return v > 0.0f ? powerOf(v, power) : 0.0f; };
  }
  return nullptr;
}

/// From display-encoded sRGB; by its own curve where the configuration knows no such space.
void paintedToWorking(const Colour& colour, Floats& r, Floats& g, Floats& b) {
  for (const std::string_view space : paintedSpaces)
    if (colour.hasSpace(space)) return colour.toWorking(r, g, b, space);
  for (Floats* plane : {&r, &g, &b})
    for (size_t i = 0; i < plane->view().pixels(); ++i)
      plane->row(0)[i] = linearFromSrgb(plane->row(0)[i]);
}

Strip loadBuiltin(const Colour& colour, const std::string& preset) {
  const std::vector<std::string> names(std::begin(stripPresets), std::end(stripPresets));
  if (std::find(names.begin(), names.end(), preset) == names.end())
    throw LookError(fmt::format("there is no built-in strip {}{}; there are {}", preset,
                                didYouMean(preset, names), listNames(names)));
  PaintedStrip picture = paintStrip(stripPreset(preset));
  paintedToWorking(colour, picture.r, picture.g, picture.b);
  return makeStrip(picture.r, picture.g, picture.b);
}

/// Multiplies or divides the colour by alpha; where alpha is 0 a quotient is 0.
void associate(StripPicture& picture, bool divide) {
  for (Floats* plane : {&picture.red, &picture.green, &picture.blue})
    for (size_t i = 0; i < plane->view().pixels(); ++i) {
      const float alpha = picture.alpha.row(0)[i];
      float& value = plane->row(0)[i];
      value = !divide ? value * alpha : alpha > 0.0f ? value / alpha : 0.0f;
    }
}

/// From the space that the file names, which the configuration may know by that name.
void namedToWorking(const Colour& colour, const std::string& file, std::string_view what,
                    StripPicture& picture) {
  const std::string& space = picture.space;
  if (space.empty() || space == "sRGB")
    return paintedToWorking(colour, picture.red, picture.green, picture.blue);
  if (colour.hasSpace(space))
    return colour.toWorking(picture.red, picture.green, picture.blue, space);
  const auto decode = knownDecoding(space);
  if (!decode)
    throw InputError(fmt::format(
        "{} {} says that its colours are {}, which the colour configuration {} has no space "
        "for; say with colour.strip what they are",
        what, file, space, colour.source()));
  for (Floats* plane : {&picture.red, &picture.green, &picture.blue})
    for (size_t i = 0; i < plane->view().pixels(); ++i) plane->row(0)[i] = decode(plane->row(0)[i]);
}

/// Transforms want the colour apart from its alpha; the painting wants it multiplied. The picture
/// behind things is held as a strip is.
Strip loadStrip(const Look& look, const Colour& colour, const std::string& name) {
  if (isBuiltinStrip(name)) return loadBuiltin(colour, name.substr(builtinPrefix.size()));
  const bool behind =
      look.output.background == Background::picture && name == look.passes.ground.picture;
  const std::string_view what = behind ? "picture" : "strip";
  StripPicture picture = readStrip(look.resolve(name), what);
  const bool transformed = !picture.sceneLinear || !look.colour.strip.empty();
  if (picture.associated && transformed) associate(picture, true);
  if (!look.colour.strip.empty())
    colour.toWorking(picture.red, picture.green, picture.blue, look.colour.strip);
  else if (!picture.sceneLinear)
    namedToWorking(colour, look.resolve(name).string(), what, picture);
  if (!picture.hasAlpha) return makeStrip(picture.red, picture.green, picture.blue);
  if (transformed || !picture.associated) associate(picture, false);
  return makeStrip(picture.red, picture.green, picture.blue, picture.alpha);
}

/// A strip or picture, and the key that names it.
struct PaintedFile {
  std::string name, key;
};

std::vector<PaintedFile> filesWithKeys(const Look& look) {
  std::vector<PaintedFile> files;
  for (size_t i = 0; i < look.styles.size(); ++i)
    files.push_back({look.styles[i].style.strip, fmt::format("style[{}].strip", i)});
  for (size_t i = 0; i < look.styles.size(); ++i)
    for (const LightStrip& own : lightStripsOf(look.styles[i].style))
      if (!own.strip.empty())
        files.push_back({own.strip, fmt::format("style[{}].light_strips", i)});
  for (size_t i = 0; i < look.lights.size(); ++i)
    if (const std::string& strip = look.lights[i].light.strip; !strip.empty())
      files.push_back({strip, fmt::format("light[{}].strip", i)});
  const bool picture = look.output.background == Background::picture;
  if (std::string ground = groundFile(look); !ground.empty())
    files.push_back({std::move(ground), picture ? "ground.picture" : "ground.strip"});
  return files;
}

}  // namespace

V3f toStripLinear(const Colour& colour, const V3f& working) {
  for (const std::string_view space : paintedSpaces) {
    if (!colour.hasSpace(space)) continue;
    V3f c = working;
    colour.fromWorking({&c.x, 1, 1}, {&c.y, 1, 1}, {&c.z, 1, 1}, space);
    return {linearFromSrgb(c.x), linearFromSrgb(c.y), linearFromSrgb(c.z)};
  }
  return working;
}

std::string stripColourSpace(const Look& look) {
  return look.colour.strip.empty() ? std::string(paintedSpaces[0]) : look.colour.strip;
}

bool isBuiltinStrip(const std::string& name) { return name.starts_with(builtinPrefix); }

bool multipliesColour(const StyleParams& style, const std::string& strip) {
  if (style.colour == StripColour::automatic) return strip == "builtin:neutral";
  return style.colour == StripColour::multiply;
}

std::vector<std::string> paintedFiles(const Look& look) {
  std::vector<std::string> names;
  for (PaintedFile& file : filesWithKeys(look)) names.push_back(std::move(file.name));
  return names;
}

std::string groundFile(const Look& look) {
  const GroundParams& ground = look.passes.ground;
  if (look.output.background == Background::strip) return ground.strip;
  if (look.output.background != Background::picture) return {};
  if (ground.picture.empty())
    throw LookError(look.keyWithPlace("output.background") +
                    " = \"picture\" shows the file that ground.picture names, which is empty");
  return ground.picture;
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
  Loaded none;
  load(look, none);
}

StripSet::StripSet(const Look& look, const Colour& colour, Loaded& loaded) : colour_(colour) {
  load(look, loaded);
}

/// The neutral strip is empty until it was asked for.
StripSet::Loaded StripSet::release() {
  Loaded loaded;
  for (const auto& [name, index] : indices_) {
    Strip& strip = strips_[static_cast<size_t>(index)];
    if (!strip.levels.empty()) loaded.emplace(name, std::move(strip));
  }
  strips_.clear();
  indices_.clear();
  return loaded;
}

void StripSet::load(const Look& look, Loaded& loaded) {
  std::vector<PaintedFile> files = {{StyleParams{}.strip, ""}};
  for (PaintedFile& file : filesWithKeys(look)) files.push_back(std::move(file));
  if (look.output.background == Background::picture) picture_ = look.passes.ground.picture;
  std::vector<PaintedFile> distinct;
  for (const PaintedFile& file : files)
    if (indices_.emplace(file.name, static_cast<int>(distinct.size())).second)
      distinct.push_back(file);
  strips_.resize(distinct.size());
  std::vector<std::exception_ptr> errors(distinct.size());
  parallelRows(static_cast<int>(distinct.size()) - 1, 1, [&](int first, int) {
    const auto i = static_cast<size_t>(first) + 1;
    const auto& [name, key] = distinct[i];
    try {
      if (!loaded.contains(name))
        strips_[i] = withPlace(look.keyWithPlace(key),
                               [&, &file = name] { return loadStrip(look, colour_, file); });
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)  // the first of the look, whoever was faster
    if (error) std::rethrow_exception(error);
  for (size_t i = 0; i < distinct.size(); ++i)
    if (auto there = loaded.extract(distinct[i].name)) {
      strips_[i] = std::move(there.mapped());
      if (i == 0) tbb::collaborative_call_once(neutral_, [] {});
    }
}

}  // namespace kagefude
