#include "live/strip_easel.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/output_name.h"
#include "exr/write_image.h"
#include "look/override.h"
#include "look/parameter_json.h"
#include "look/read_section.h"
#include "passes/strip/strip_paint.h"

namespace kagefude {
namespace {

constexpr int64_t mostPixels = int64_t{1} << 22;

StripPaintParams paramsOf(const StripRecipe& recipe) {
  const auto known = std::begin(stripPresets), end = std::end(stripPresets);
  if (std::find(known, end, recipe.preset) == end)
    throw LookError(fmt::format("there is no preset {} of strips", recipe.preset));
  StripPaintParams params = stripPreset(recipe.preset);
  toml::table section;
  for (const std::string& text : recipe.settings) setValue(section, text);
  readSection(section, stripTable, &params);
  if (int64_t{params.width} * params.height > mostPixels)
    throw LookError(
        fmt::format("the page paints at most {} pixels; larger strips are painted by "
                    "`kagefude strip make`",
                    mostPixels));
  return params;
}

}  // namespace

nlohmann::ordered_json stripKnobs() {
  nlohmann::ordered_json presets = nlohmann::ordered_json::object();
  for (const std::string_view preset : stripPresets) {
    const StripPaintParams params = stripPreset(preset);
    for (const Parameter& parameter : stripTable.parameters)
      presets[std::string(preset)][std::string(parameter.name)] =
          jsonOf(parameter, parameter.get(&params));
  }
  return {{"table", jsonOf(stripTable)}, {"presets", std::move(presets)}};
}

ShownPixels paintedStrip(const StripRecipe& recipe) {
  const PaintedStrip strip = paintStrip(paramsOf(recipe));
  return showPainted(strip.r, strip.g, strip.b);
}

StripKept keepPaintedStrip(const Look& onDisk, const std::string& name, const StripRecipe& recipe) {
  requireSuffix(name, ".png", "a painted strip's name");
  const PaintedStrip strip = paintStrip(paramsOf(recipe));
  return keepStrip(onDisk, name, [&](const std::filesystem::path& file) {
    writePng(file, strip.r, strip.g, strip.b, {}, 16);
  });
}

}  // namespace kagefude
