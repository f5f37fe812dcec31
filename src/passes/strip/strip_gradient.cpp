#include "passes/strip/strip_gradient.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/oklab.h"

namespace kagefude {
namespace {

void checkStops(const std::vector<float>& stops) {
  if (stops.size() < 8 || stops.size() % 4 != 0)
    throw LookError(fmt::format(
        "strip.stops has {} numbers; expected two or more stops of place, red, green, blue",
        stops.size()));
  for (size_t i = 4; i < stops.size(); i += 4)
    if (stops[i] <= stops[i - 4])
      throw LookError(fmt::format("strip.stops: place {} follows {}; places must rise from 0 to 1",
                                  stops[i], stops[i - 4]));
  if (stops[0] != 0.0f || stops[stops.size() - 4] != 1.0f)
    throw LookError(fmt::format("strip.stops run from {} to {}; they must run from 0 to 1",
                                stops[0], stops[stops.size() - 4]));
}

}  // namespace

StripGradient::StripGradient(const StripPaintParams& params) : params_(params) {
  checkStops(params.stops);
}

V3f StripGradient::between(float place) const {
  const std::vector<float>& stops = params_.stops;
  const float t = std::clamp(place, 0.0f, 1.0f);
  size_t i = 0;
  while (i + 8 < stops.size() && t > stops[i + 4]) i += 4;
  const float f = (t - stops[i]) / (stops[i + 4] - stops[i]);
  const auto mix = [&](size_t c) { return stops[i + c] + (stops[i + 4 + c] - stops[i + c]) * f; };
  const V3f colour(mix(1), mix(2), mix(3));
  if (params_.hueShift == 0.0f) return colour;
  return srgbOfOklab(leanTowardsWarm(oklabOfSrgb(colour), params_.hueShift * (2.0f * t - 1.0f)));
}

V3f StripGradient::at(float place) const {
  if (params_.bands <= 0) return between(place);
  const float bands = static_cast<float>(params_.bands);
  const float band = std::min(std::floor(std::clamp(place, 0.0f, 1.0f) * bands), bands - 1.0f);
  return between(bands > 1.0f ? band / (bands - 1.0f) : 0.5f);
}

}  // namespace kagefude
