#include "passes/strip/strip_hatch.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"
#include "passes/strip/paper_tooth.h"

namespace kagefude {
namespace {

constexpr float secondSet = 0.45f;  ///< share of ink from which lines cross
constexpr float firstAtFull = 0.8f;
constexpr float secondSlant = 1.2f;
constexpr float trace = 0.02f;

float brightness(const V3f& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

float triangle(float turns) { return std::fabs(2.0f * (turns - std::floor(turns)) - 1.0f); }

/// Distance from the middle of a line, 0..1, of lines that stray and thin out as they go. They run
/// down the strip, straight or slanting, so that every row crosses all of them: a row's mean is its
/// share of ink.
class Lines {
 public:
  /// `slant`: columns that a line moves on from row to row.
  Lines(const StripPaintParams& params, float slant, uint32_t seed)
      : params_(params),
        slant_(slant),
        count_(std::max(1, static_cast<int>(static_cast<float>(params.width) / params.strokeWidth /
                                            std::sqrt(1.0f + slant * slant)))),
        perTexel_(static_cast<float>(count_) / static_cast<float>(params.width)),
        perCell_(3.0f / params.strokeLength),
        seed_(seed) {}

  float at(float column, float row) const {
    const float line = (column + slant_ * row) * perTexel_, along = row * perCell_;
    const float stray = wrappedNoise(seed_, line, along, count_, endless) - 0.5f;
    const float place = line + params_.wobble * stray;
    const float own = std::floor(place) + 0.5f;
    const float thin = wrappedNoise(seed_ ^ 0x51ed270bu, own, along, count_, endless) - 0.5f;
    const float distance = triangle(place);
    return std::clamp(distance + params_.pressure * thin * (1.0f - distance), 0.0f, 1.0f);
  }

 private:
  static constexpr int endless = 1 << 20;
  const StripPaintParams& params_;
  float slant_;
  int count_;
  float perTexel_;
  float perCell_;
  uint32_t seed_;
};

}  // namespace

float hatchShare(float straight, float slanting, int sets) {
  if (sets < 2) return straight;
  // Of the first set's lines a share s is inked at c = s, from secondSet on slower:
  // a + b c. Both sets together cover c = 1 - (1 - first) (1 - second).
  constexpr float b = (firstAtFull - secondSet) / (1.0f - secondSet);
  constexpr float a = secondSet - b * secondSet;
  const float first = straight < secondSet ? straight : (straight - a) / b;
  const float left = 1.0f - slanting;
  const float second = (1.0f - left * (1.0f - a)) / (1.0f - left * b);
  return std::min(std::min(first, second), 1.0f);
}

PaintedStrip hatchStrip(const StripPaintParams& params) {
  const StripGradient gradient(params);
  const V3f ink(params.ink[0], params.ink[1], params.ink[2]), paper = gradient.at(1.0f);
  const float range = std::max(brightness(paper) - brightness(ink), 1e-6f);
  const uint32_t seed = static_cast<uint32_t>(params.seed);
  const Lines straight(params, 0.0f, seed), slanting(params, secondSlant, seed ^ 0x9e3779b9u);
  const float soft = std::max(1.5f / params.strokeWidth, 0.02f);
  PaintedStrip strip{Floats(params.width, params.height), Floats(params.width, params.height),
                     Floats(params.width, params.height)};
  parallelRows(params.height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      const float row = static_cast<float>(y) + 0.5f;
      const float place = 1.0f - row / static_cast<float>(params.height);
      const float share =
          std::clamp((brightness(paper) - brightness(gradient.at(place))) / range, 0.0f, 1.0f);
      // So that no ink is left on white, and no white in full black.
      const float reached = share * (1.0f + soft) - 0.5f * soft;
      for (int x = 0; x < params.width; ++x) {
        const float column = static_cast<float>(x) + 0.5f;
        const float h =
            hatchShare(straight.at(column, row), slanting.at(column, row), params.hatch);
        const float inked = std::clamp((reached - h) / soft + 0.5f, 0.0f, 1.0f);
        const float light = std::clamp(1.0f - inked + trace * (h - 1.0f + inked), 0.0f, 1.0f);
        const V3f c = ink + (paper - ink) * light;
        strip.r(x, y) = c.x;
        strip.g(x, y) = c.y;
        strip.b(x, y) = c.z;
      }
    }
  });
  return strip;
}

}  // namespace kagefude
