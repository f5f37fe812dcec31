#include "passes/ground/painted_sky.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"
#include "passes/brush/brush_params.h"
#include "passes/brush/grain_lookup.h"
#include "passes/ground/view_angles.h"

namespace kagefude {
namespace {

constexpr float degreesWithoutCamera = 40;

float heightShare(const SkyView& view, int y) {
  const float down = (static_cast<float>(y + view.offsetY) + 0.5f) /
                     static_cast<float>(std::max(view.displayHeight, 1));
  return std::clamp(1.0f - down, 0.0f, 1.0f);
}

float elevationShare(const SkyView& view, int x, int y) {
  const float above = viewAngles(view.rays->direction(x + 0.5, y + 0.5), view.upIsY).above;
  const float rest = 1.0f - std::clamp(4.0f * above, 0.0f, 1.0f);
  return 1.0f - rest * rest;
}

float brightness(const V3f& colour) {
  const float luminance = 0.2126f * colour.x + 0.7152f * colour.y + 0.0722f * colour.z;
  return std::min(powerOf(luminance, 1 / 2.2f), 1.0f);
}

/// Place on the strip's grain: turns along the strokes, heights of the grain across them.
struct SkyPlace {
  float u = 0, across = 0;
};

class SkyMap {
 public:
  SkyMap(const SkyView& view, const GroundParams& params, float aspect)
      : view_(view), aspect_(aspect) {
    round_ = params.fixed == GroundParams::Fixed::world && view.looksRound();
    turns_ = std::max(1.0f, std::floor(360.0f / params.width + 0.5f));
    const float shown = static_cast<float>(std::max(view.displayWidth, 1));
    perPixel_ = view.looksRound()
                    ? static_cast<float>(view.rays->directionX.length()) * (180 / pi) / params.width
                    : degreesWithoutCamera / shown / params.width;
  }

  SkyPlace at(int x, int y) const {
    if (!round_)
      return {static_cast<float>(x + view_.offsetX) * perPixel_,
              static_cast<float>(y + view_.offsetY) * perPixel_ * aspect_};
    const ViewAngles angles = viewAngles(view_.rays->direction(x + 0.5, y + 0.5), view_.upIsY);
    return {angles.round * turns_, angles.above * turns_ * aspect_};
  }

  Footprint footprint(int x, int y, const SkyPlace& here) const {
    if (!round_) return {perPixel_, 0, 0, perPixel_ * aspect_};
    const SkyPlace right = at(x + 1, y), below = at(x, y + 1);
    return {unwrapped(right.u - here.u), right.across - here.across, unwrapped(below.u - here.u),
            below.across - here.across};
  }

 private:
  /// The turn ends where it began.
  float unwrapped(float du) const { return du - turns_ * std::floor(du / turns_ + 0.5f); }

  const SkyView& view_;
  float aspect_, turns_ = 1, perPixel_ = 1;
  bool round_ = false;
};

}  // namespace

Floats skyTone(const SkyView& view, const GroundParams& params, const Vec3View& behind) {
  Floats tone(view.width, view.height);
  const bool byBeauty = params.row == GroundParams::Row::beauty && !behind.empty();
  const bool byView = params.row == GroundParams::Row::view && view.looksRound();
  parallelRows(view.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < view.width; ++x) {
        if (byBeauty) {
          tone(x, y) = brightness(behind(x, y));
          continue;
        }
        const float share = byView ? elevationShare(view, x, y) : heightShare(view, y);
        tone(x, y) = params.low + (params.high - params.low) * share;
      }
  });
  return tone;
}

ColourPlanes paintSky(const Strip& strip, View<const float> tone, const SkyView& view,
                      const GroundParams& params) {
  const StripGrain::Level& full = strip.grain.levels.front();
  const SkyMap map(view, params, static_cast<float>(full.width) / static_cast<float>(full.height));
  ColourPlanes sky{Floats(view.width, view.height), Floats(view.width, view.height),
                   Floats(view.width, view.height), Floats(view.width, view.height)};
  parallelRows(view.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < view.width; ++x) {
        const SkyPlace place = map.at(x, y);
        const StripProbe probe =
            grainProbe(strip.grain, map.footprint(x, y, place), BrushParams{}.maxProbes);
        const float grain = lookUpGrain(strip.grain, place.u, place.across, probe);
        const Rgba colour = grainColour(strip.grain, tone(x, y), grain, 0.0f);
        sky.r(x, y) = colour[0];
        sky.g(x, y) = colour[1];
        sky.b(x, y) = colour[2];
        sky.a(x, y) = strip.opaque ? 1.0f : colour[3];
      }
  });
  return sky;
}

}  // namespace kagefude
