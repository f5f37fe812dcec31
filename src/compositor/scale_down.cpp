#include "compositor/scale_down.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "look/look_sections.h"

namespace kagefude {
namespace {

void multiplyPixels(const ParameterTable& table, void* values, double factor) {
  for (const Parameter& parameter : table.parameters) {
    if (parameter.unit != "pixels") continue;
    Value value = parameter.get(values);
    if (auto* number = std::get_if<double>(&value)) *number *= factor;
    if (auto* whole = std::get_if<int>(&value))
      *whole = static_cast<int>(std::lround(std::max(*whole * factor, parameter.minimum)));
    parameter.set(values, value);
  }
}

/// The row of a layer by the name that it has in the file.
const OutputLayerEntry& layerOf(std::string_view name) {
  return *std::find_if(outputLayers.begin(), outputLayers.end(), [&](const auto& entry) {
    return entry.stage == LayerStage::light ? name.starts_with(entry.name) : name == entry.name;
  });
}

}  // namespace

Look inRenderedPixels(Look look) {
  const int scale = look.output.scale;
  return multiplyPixels(std::move(look), scale);
}

Look multiplyPixels(Look look, double factor) {
  if (factor == 1) return look;
  for (const LookSection& section : lookSections) {
    if (section.inLook) multiplyPixels(*section.table, section.inLook(look), factor);
    for (LightLook& light : look.lights)
      if (section.inLight) multiplyPixels(*section.table, section.inLight(light), factor);
    for (StyleLook& style : look.styles)
      if (section.inStyle) multiplyPixels(*section.table, section.inStyle(style), factor);
  }
  return look;
}

void checkScale(const Look& look, FramePlan& plan) {
  const int scale = look.output.scale;
  if (scale == 1) return;
  const Window& w = plan.image.displayWindow;
  if (w.x % scale != 0 || w.y % scale != 0 || w.width % scale != 0 || w.height % scale != 0)
    throw InputError(fmt::format(
        "{} shows {}x{} pixels from ({}, {}), which output.scale = {} does not divide; it is for "
        "frames that were rendered so many times larger than the shot",
        plan.image.path.string(), w.width, w.height, w.x, w.y, scale));
  if (plan.sidecar && plan.sidecar->scale != scale)
    plan.warnings.push_back(
        fmt::format("output.scale is {}, but the JSON says that the frame was rendered at scale "
                    "{}; what is written is not of the shot's size",
                    scale, plan.sidecar->scale));
}

void scaleDown(const Look& look, const FramePlan& plan, View<const uint32_t> surfaces,
               FrameResult& result) {
  if (look.output.scale == 1) return;
  const Downscale squares(plan.image.dataWindow, look.output.scale);
  result.standing = squares.standing(surfaces);
  for (Floats* plane : {&result.colour.x, &result.colour.y, &result.colour.z, &result.alpha})
    *plane = squares.share(*plane);
  for (NamedPlane& layer : result.layers) {
    Floats& floats = layer.plane.floats;
    Labels& labels = layer.plane.labels;
    if (!labels.empty())
      labels = squares.pick<uint32_t>(labels, result.standing);
    else
      floats = layerOf(layer.name).mixes ? squares.mean(floats)
                                         : squares.pick<float>(floats, result.standing);
  }
}

}  // namespace kagefude
