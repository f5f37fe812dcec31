#include "passes/strip/strip_paint.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"
#include "image/vec.h"
#include "passes/strip/paper_tooth.h"
#include "passes/strip/strip_gradient.h"
#include "passes/strip/strip_hatch.h"

namespace kagefude {
namespace {

float smoothStep(float t) {
  const float c = std::clamp(t, 0.0f, 1.0f);
  return c * c * (3.0f - 2.0f * c);
}

/// One stroke along a row; lengths in pixels, y downward.
struct Stroke {
  float start = 0, length = 0, y = 0;
  float bow = 0;  ///< how far the middle hangs below the ends
  float strength = 1;
  V3f colour{0, 0, 0};
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
        gradient_(params),
        paper_(static_cast<uint32_t>(params.seed) ^ 0x2545f491u, params.width, params.height,
               params.toothSize),
        columns_{Floats(params.height, params.width), Floats(params.height, params.width),
                 Floats(params.height, params.width)} {
    for (int y = 0; y < params.height; ++y) {
      const float place = 1.0f - (static_cast<float>(y) + 0.5f) / static_cast<float>(params.height);
      const V3f c = gradient_.at(place + params.under);
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
      stroke.colour = gradient_.at(place + (noise.next() - 0.5f) * 2.0f * params_.jitter);
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
    float above = 0.0f;
    for (int row = top; row <= bottom; ++row) {
      const float across = (static_cast<float>(row) + 0.5f - y);
      const float inside = edge(std::fabs(across), radius), streak = streaks.at(across / hair);
      float alpha = cover * inside * (1.0f - depth * streak);
      if (params_.tooth > 0.0f) alpha *= takenByPaper(x, row, pen * lift);
      const float height = inside * (1.0f - streak);
      const float light = lightOn(height - above, std::fabs(across) / radius);
      above = height;
      if (alpha > 0.0f) blend(x, row, light == 1.0f ? stroke.colour : lit(stroke, light), alpha);
    }
  }

  // How much of a stroke the paper takes: its peaks all, its hollows less the lighter the pen.
  float takenByPaper(int x, int row, float pen) const {
    const float peak = paper_.at(static_cast<float>(x) + 0.5f, static_cast<float>(row) + 0.5f);
    const float taken = smoothStep((peak - 0.62f + 0.3f * pen) * 5.0f + 0.5f);
    return 1.0f - params_.tooth * (1.0f - taken);
  }

  // What thickness (`rise` from the texel above) and a dried rim make of a colour, as a factor.
  float lightOn(float rise, float out) const {
    if (params_.relief == 0.0f && params_.pool == 0.0f) return 1.0f;
    const float ridge = std::clamp(1.6f * rise, -0.6f, 0.6f);
    const float rim = smoothStep((out - 0.7f) / 0.25f);
    return (1.0f + params_.relief * ridge) * (1.0f - 0.35f * params_.pool * rim);
  }

  static V3f lit(const Stroke& stroke, float light) {
    const V3f& c = stroke.colour;
    return {std::min(c.x * light, 1.0f), std::min(c.y * light, 1.0f), std::min(c.z * light, 1.0f)};
  }

  // Soft edge of the round brush; never harder than one pixel.
  float edge(float distance, float radius) const {
    const float soft = std::max(1.0f, radius * (1.0f - params_.hardness));
    return smoothStep((radius - distance) / soft + 0.5f / soft);
  }

  void blend(int x, int y, const V3f& c, float alpha) {
    float &r = columns_.r(y, x), &g = columns_.g(y, x), &b = columns_.b(y, x);
    r = alpha >= 1.0f ? c.x : r + (c.x - r) * alpha;
    g = alpha >= 1.0f ? c.y : g + (c.y - g) * alpha;
    b = alpha >= 1.0f ? c.z : b + (c.z - b) * alpha;
  }

  const StripPaintParams& params_;
  StripGradient gradient_;
  PaperTooth paper_;
  PaintedStrip columns_;  ///< a column of the strip is a row of these, as strokes are painted
};

}  // namespace

PaintedStrip paintStrip(const StripPaintParams& params) {
  if (params.hatch > 0) return hatchStrip(params);
  Painter painter(params);
  painter.paint();
  return painter.picture();
}

}  // namespace kagefude
