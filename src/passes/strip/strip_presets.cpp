#include <fmt/format.h>

#include "base/error.h"
#include "base/nearest_name.h"
#include "passes/strip/strip_paint.h"

namespace kagefude {

StripPaintParams stripPreset(std::string_view name) {
  StripPaintParams params;
  if (name == "soft") return params;
  if (name == "fine") {
    params.strokeWidth = 15;
    params.strokeLength = 130;
    params.spacing = 0.45f;
    params.opacity = 0.8f;
    params.bristle = 0.25f;
    params.wobble = 0.25f;
    params.jitter = 0.05f;
    params.stops = {0.00f, 0.05f, 0.11f, 0.19f, 0.35f, 0.11f, 0.32f, 0.40f, 0.65f, 0.36f,
                    0.62f, 0.55f, 0.88f, 0.78f, 0.86f, 0.68f, 1.00f, 0.98f, 0.97f, 0.86f};
    return params;
  }
  if (name == "neutral") {
    params.strokeWidth = 40;
    params.strokeLength = 220;
    params.jitter = 0.05f;
    params.stops = {0.00f, 0.13f, 0.14f, 0.22f, 0.40f, 0.42f, 0.41f, 0.47f,
                    0.75f, 0.76f, 0.73f, 0.70f, 1.00f, 1.00f, 0.98f, 0.94f};
    return params;
  }
  if (name == "cel") {
    params.strokeWidth = 26;
    params.strokeLength = 150;
    params.spacing = 0.35f;
    params.opacity = 0.9f;
    params.hardness = 0.85f;
    params.wobble = 0.35f;
    params.jitter = 0.03f;
    params.bands = 4;
    params.stops = {0.00f, 0.22f, 0.13f, 0.29f, 0.34f, 0.55f, 0.27f, 0.36f,
                    0.67f, 0.90f, 0.56f, 0.42f, 1.00f, 1.00f, 0.88f, 0.70f};
    return params;
  }
  throw UsageError(fmt::format("no strip is called {}{}; there are neutral, soft, fine and cel",
                               name, didYouMean(name, {"neutral", "soft", "fine", "cel"})));
}

}  // namespace kagefude
