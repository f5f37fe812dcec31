#include "passes/strip/strip_paint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/nearest_name.h"
#include "image/parallel.h"
#include "image/real_math.h"
#include "passes/strip/stroke_noise.h"

namespace kagefude {
namespace {

struct Colour {
  float r = 0, g = 0, b = 0;
};

float smoothStep(float t) {
  const float c = std::clamp(t, 0.0f, 1.0f);
  return c * c * (3.0f - 2.0f * c);
}

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

Colour gradientAt(const std::vector<float>& stops, float place) {
  const float t = std::clamp(place, 0.0f, 1.0f);
  size_t i = 0;
  while (i + 8 < stops.size() && t > stops[i + 4]) i += 4;
  const float f = (t - stops[i]) / (stops[i + 4] - stops[i]);
  const auto mix = [&](size_t c) { return stops[i + c] + (stops[i + 4 + c] - stops[i + c]) * f; };
  return {mix(1), mix(2), mix(3)};
}

Colour colourAt(const StripPaintParams& params, float place) {
  if (params.bands <= 0) return gradientAt(params.stops, place);
  const float bands = static_cast<float>(params.bands);
  const float band = std::min(std::floor(std::clamp(place, 0.0f, 1.0f) * bands), bands - 1.0f);
  return gradientAt(params.stops, bands > 1.0f ? band / (bands - 1.0f) : 0.5f);
}

/// One stroke along a row; lengths in pixels, y downward.
struct Stroke {
  float start = 0, length = 0, y = 0;
  float bow = 0;  ///< how far the middle hangs below the ends
  float strength = 1;
  Colour colour;
  uint32_t seed = 0;
};

Floats turned(View<const float> plane) {
  Floats result(plane.height, plane.width);
  parallelRows(plane.width, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < plane.height; ++x) result(x, y) = plane(y, x);
  });
  return result;
}

class Painter {
 public:
  explicit Painter(const StripPaintParams& params)
      : params_(params),
        columns_{Floats(params.height, params.width), Floats(params.height, params.width),
                 Floats(params.height, params.width)} {
    for (int y = 0; y < params.height; ++y) {
      const Colour c = colourAt(
          params, 1.0f - (static_cast<float>(y) + 0.5f) / static_cast<float>(params.height));
      for (int x = 0; x < params.width; ++x) blend(x, y, c, 1.0f);
    }
  }

  void paint() {
    const std::vector<Stroke> strokes = allStrokes();
    // Strokes lie over each other in their order; columns know nothing of each other.
    parallelRows(params_.width, [&](int first, int end) {
      for (const Stroke& stroke : strokes) paint(stroke, first, end);
    });
  }

  PaintedStrip picture() const {
    return {turned(columns_.r), turned(columns_.g), turned(columns_.b)};
  }

 private:
  std::vector<Stroke> allStrokes() const {
    std::vector<Stroke> strokes;
    const float height = static_cast<float>(params_.height);
    const float step = params_.spacing * params_.strokeWidth;
    const int rows = static_cast<int>(std::ceil(height / step)) + 2;
    for (int row = -1; row <= rows; ++row)
      addRow(row, height - (static_cast<float>(row) + 0.5f) * step, step, strokes);
    return strokes;
  }

  void addRow(int row, float y, float step, std::vector<Stroke>& strokes) const {
    StrokeNoise noise(static_cast<uint32_t>(params_.seed), static_cast<uint32_t>(row + 1));
    const float width = static_cast<float>(params_.width);
    // Twice round, so that the gaps of one turn are covered by the other.
    float x = noise.next() * width;
    const float end = x + 2.0f * width;
    while (x < end) {
      Stroke stroke;
      stroke.length = params_.strokeLength * (0.55f + 0.9f * noise.next());
      stroke.start = x;
      stroke.y = y + (noise.next() - 0.5f) * step;
      stroke.bow = (noise.next() - 0.5f) * params_.wobble * params_.strokeWidth;
      stroke.strength = 1.0f - params_.pressure * 0.6f * noise.next();
      const float place = 1.0f - stroke.y / static_cast<float>(params_.height);
      stroke.colour = colourAt(params_, place + (noise.next() - 0.5f) * 2.0f * params_.jitter);
      stroke.seed = noise.nextBits();
      strokes.push_back(stroke);
      x += stroke.length * (0.7f + 0.2f * noise.next());
    }
  }

  // What of a stroke lies in the strip's columns [first, end), on every turn round.
  void paint(const Stroke& stroke, int first, int end) {
    const int from = static_cast<int>(std::floor(stroke.start));
    const int to = static_cast<int>(std::ceil(stroke.start + stroke.length));
    const int width = params_.width;
    const int turn = (from >= 0 ? from : from - width + 1) / width;
    for (int start = turn * width; start <= to; start += width)
      for (int column = std::max(from, start + first); column <= std::min(to, start + end - 1);
           ++column)
        paintColumn(stroke, column - start, static_cast<float>(column) + 0.5f - stroke.start);
  }

  // One column of a stroke, `along` pixels from its start.
  void paintColumn(const Stroke& stroke, int x, float along) {
    const float rest = stroke.length - along;
    if (along <= 0.0f || rest <= 0.0f) return;
    const float full = 0.5f * params_.strokeWidth;
    const float slow = along / (1.6f * params_.strokeWidth);
    const float pen = 1.0f - params_.pressure * strokeNoise(stroke.seed, slow, 0.0f);
    // The pen is set down quickly and lifted slowly; the end of the stroke is a round dab.
    const float lift = smoothStep(rest / (2.5f * params_.strokeWidth));
    const float reach = std::min(1.0f, std::min(along, rest) / full);
    const float cap = std::sqrt(reach * (2.0f - reach));
    const float radius = full * (1.0f - 0.5f * (1.0f - pen)) * cap;
    const float middle = along / stroke.length - 0.5f;
    const float stray = strokeNoise(stroke.seed ^ 0x9e3779b9u, 0.5f * slow, 0.0f) - 0.5f;
    const float y = stroke.y + stroke.bow * (1.0f - 4.0f * middle * middle) +
                    stray * params_.wobble * params_.strokeWidth;
    const float cover =
        params_.opacity * stroke.strength * (0.5f + 0.5f * pen) * (0.35f + 0.65f * lift);
    const int top = std::max(0, static_cast<int>(std::floor(y - radius)));
    const int bottom = std::min(params_.height - 1, static_cast<int>(std::ceil(y + radius)));
    const float hair = 0.045f * params_.strokeWidth + 0.6f;
    StrokeNoiseColumn streaks(stroke.seed ^ 0x51ed270bu, along / (14.0f * hair));
    // Streaks along the stroke are deeper where the brush runs dry.
    const float depth = params_.bristle * (0.5f + 0.5f * (1.0f - lift));
    for (int row = top; row <= bottom; ++row) {
      const float across = (static_cast<float>(row) + 0.5f - y);
      const float alpha =
          cover * edge(std::fabs(across), radius) * (1.0f - depth * streaks.at(across / hair));
      if (alpha > 0.0f) blend(x, row, stroke.colour, alpha);
    }
  }

  // Soft edge of the round brush; never harder than one pixel.
  float edge(float distance, float radius) const {
    const float soft = std::max(1.0f, radius * (1.0f - params_.hardness));
    return smoothStep((radius - distance) / soft + 0.5f / soft);
  }

  void blend(int x, int y, const Colour& c, float alpha) {
    float &r = columns_.r(y, x), &g = columns_.g(y, x), &b = columns_.b(y, x);
    r = alpha >= 1.0f ? c.r : r + (c.r - r) * alpha;
    g = alpha >= 1.0f ? c.g : g + (c.g - g) * alpha;
    b = alpha >= 1.0f ? c.b : b + (c.b - b) * alpha;
  }

  const StripPaintParams& params_;
  PaintedStrip columns_;  ///< a column of the strip is a row of these, as strokes are painted
};

}  // namespace

PaintedStrip paintStrip(const StripPaintParams& params) {
  checkStops(params.stops);
  Painter painter(params);
  painter.paint();
  return painter.picture();
}

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
