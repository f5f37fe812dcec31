#include "passes/strip/strip_from_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "image/oklab.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

constexpr int tones = 256;
constexpr float leastRange = 0.05f;
constexpr float overlap = 0.25f;  ///< of the strip's width

struct LabPicture {
  Floats lightness, a, b;
  int width() const { return lightness.width(); }
  int height() const { return lightness.height(); }
};

LabPicture labOf(View<const float> r, View<const float> g, View<const float> b) {
  LabPicture picture{Floats(r.width, r.height), Floats(r.width, r.height),
                     Floats(r.width, r.height)};
  const auto unit = [](float v) { return v > 0.0f ? std::min(v, 1.0f) : 0.0f; };
  parallelRows(r.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < r.width; ++x) {
        const V3f lab = oklabOfSrgb({unit(r(x, y)), unit(g(x, y)), unit(b(x, y))});
        picture.lightness(x, y) = lab.x;
        picture.a(x, y) = lab.y;
        picture.b(x, y) = lab.z;
      }
  });
  return picture;
}

Floats turned(const Floats& plane) {
  Floats result(plane.height(), plane.width());
  for (int y = 0; y < plane.height(); ++y)
    for (int x = 0; x < plane.width(); ++x) result(y, x) = plane(x, y);
  return result;
}

/// Whether strokes run up and down: values change more from column to column than from row to row.
bool runsDown(const Floats& plane) {
  double across = 0, down = 0;
  for (int y = 0; y + 1 < plane.height(); ++y)
    for (int x = 0; x + 1 < plane.width(); ++x) {
      const double dx = plane(x + 1, y) - plane(x, y), dy = plane(x, y + 1) - plane(x, y);
      across += dx * dx;
      down += dy * dy;
    }
  return across > down;
}

/// Mean over a window of 2 h + 1 pixels each way, cut off at the rim: running sums in doubles.
Floats boxMean(const Floats& plane, int h) {
  const auto rows = [h](const Floats& in) {
    Floats out(in.width(), in.height());
    parallelRows(in.height(), [&](int first, int end) {
      for (int y = first; y < end; ++y) {
        double sum = 0;
        int count = 0;
        for (int x = 0; x < std::min(h, in.width()); ++x, ++count) sum += in(x, y);
        for (int x = 0; x < in.width(); ++x) {
          if (x + h < in.width()) sum += in(x + h, y), ++count;
          if (x - h - 1 >= 0) sum -= in(x - h - 1, y), --count;
          out(x, y) = static_cast<float>(sum / count);
        }
      }
    });
    return out;
  };
  return turned(rows(turned(rows(plane))));
}

/// The picture's tones: colour of each lightness between the darkest and the brightest percent, and
/// how strong strokes are there.
struct Tones {
  float dark = 0, bright = 1;
  std::array<V3f, tones> colour;
  std::array<float, tones> strength;

  float lightness(float place) const { return dark + (bright - dark) * place; }
  V3f at(float lightness) const {
    const float t = std::clamp((lightness - dark) / (bright - dark), 0.0f, 1.0f) * (tones - 1);
    const int i = std::min(static_cast<int>(t), tones - 2);
    const auto k = static_cast<size_t>(i);
    const V3f c = colour[k] + (colour[k + 1] - colour[k]) * (t - static_cast<float>(i));
    return {lightness, c.y, c.z};
  }
};

void findRange(const Floats& lightness, Tones& found) {
  std::vector<float> sorted(lightness.row(0), lightness.row(0) + lightness.view().pixels());
  const auto quantile = [&](double share) {
    const auto place = sorted.begin() + static_cast<ptrdiff_t>(share * (sorted.size() - 1));
    std::nth_element(sorted.begin(), place, sorted.end());
    return *place;
  };
  found.dark = quantile(0.01);
  found.bright = quantile(0.99);
  if (found.bright - found.dark < leastRange)
    throw InputError(
        fmt::format("its lightness runs from {:.2f} to {:.2f} only; a strip needs tones from dark "
                    "to bright, so take a patch with light and shadow",
                    found.dark, found.bright));
}

/// Colours and strokes' squares by lightness, spread so that gaps take after their neighbours.
Tones tonesIn(const LabPicture& picture, const Floats& detail) {
  Tones found;
  findRange(picture.lightness, found);
  std::array<std::array<double, 4>, tones> bins{};  // count, a, b, detail²
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const float place = (picture.lightness(x, y) - found.dark) / (found.bright - found.dark);
      auto& bin = bins[static_cast<size_t>(std::clamp(place, 0.0f, 1.0f) * (tones - 1) + 0.5f)];
      bin[0] += 1;
      bin[1] += picture.a(x, y);
      bin[2] += picture.b(x, y);
      bin[3] += static_cast<double>(detail(x, y)) * detail(x, y);
    }
  for (int i = 0; i < tones; ++i) {
    std::array<double, 4> sum{};
    for (int j = 0; j < tones; ++j) {
      const double d = std::fabs(i - j) / 10.0, weight = 1.0 / ((1.0 + d * d) * (1.0 + d * d));
      for (size_t k = 0; k < 4; ++k) sum[k] += weight * bins[static_cast<size_t>(j)][k];
    }
    const auto k = static_cast<size_t>(i);
    found.colour[k] = {found.lightness(static_cast<float>(i) / (tones - 1)),
                       static_cast<float>(sum[1] / sum[0]), static_cast<float>(sum[2] / sum[0])};
    found.strength[k] = static_cast<float>(std::sqrt(sum[3] / sum[0]));
  }
  return found;
}

float bilinear(const Floats& plane, float x, float y) {
  const float cx = std::clamp(x, 0.0f, static_cast<float>(plane.width() - 1));
  const float cy = std::clamp(y, 0.0f, static_cast<float>(plane.height() - 1));
  const int x0 = static_cast<int>(cx), y0 = static_cast<int>(cy);
  const int x1 = std::min(x0 + 1, plane.width() - 1), y1 = std::min(y0 + 1, plane.height() - 1);
  const float fx = cx - static_cast<float>(x0), fy = cy - static_cast<float>(y0);
  const float upper = plane(x0, y0) + (plane(x1, y0) - plane(x0, y0)) * fx;
  const float lower = plane(x0, y1) + (plane(x1, y1) - plane(x0, y1)) * fx;
  return upper + (lower - upper) * fy;
}

/// The grain laid over the strip once, as large as it covers it, its end blended into its beginning
/// with weights whose squares add up to 1, so that contrast stays.
Floats wrappedGrain(const Floats& grain, int width, int height) {
  const float join = overlap * static_cast<float>(width);
  const float scale =
      std::min(static_cast<float>(grain.width()) / (static_cast<float>(width) + join),
               static_cast<float>(grain.height()) / static_cast<float>(height));
  const float left =
      0.5f * (static_cast<float>(grain.width()) - (static_cast<float>(width) + join) * scale);
  const float top =
      0.5f * (static_cast<float>(grain.height()) - static_cast<float>(height) * scale);
  Floats result(width, height);
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        const float row = top + (static_cast<float>(y) + 0.5f) * scale - 0.5f;
        const float column = left + (static_cast<float>(x) + 0.5f) * scale - 0.5f;
        const float own = bilinear(grain, column, row);
        const float share = (static_cast<float>(x) + 0.5f) / join;
        if (share >= 1.0f) {
          result(x, y) = own;
          continue;
        }
        const float beyond = bilinear(grain, column + static_cast<float>(width) * scale, row);
        const SinCos weights = sinCosTurns(0.25f * share);
        result(x, y) = weights.sin * own + weights.cos * beyond;
      }
  });
  return result;
}

/// Detail of even strength and mean 0 in every row.
Floats evenGrain(const Floats& detail, int h, int width, int height) {
  Floats squares(detail.width(), detail.height());
  for (size_t i = 0; i < squares.view().pixels(); ++i)
    squares.row(0)[i] = detail.row(0)[i] * detail.row(0)[i];
  const Floats local = boxMean(squares, h);
  Floats even(detail.width(), detail.height());
  for (size_t i = 0; i < even.view().pixels(); ++i)
    even.row(0)[i] = detail.row(0)[i] / std::sqrt(std::max(local.row(0)[i], 1e-6f));
  Floats grain = wrappedGrain(even, width, height);
  for (int y = 0; y < height; ++y) {
    double sum = 0;
    for (int x = 0; x < width; ++x) sum += grain(x, y);
    for (int x = 0; x < width; ++x) grain(x, y) -= static_cast<float>(sum / width);
  }
  return grain;
}

}  // namespace

PaintedStrip stripFromPicture(View<const float> r, View<const float> g, View<const float> b,
                              const FromPictureParams& params) {
  constexpr int leastSide = 16;
  if (r.width < leastSide || r.height < leastSide)
    throw InputError(
        fmt::format("{} x {} pixels are too few to take strokes from; expected at "
                    "least {} x {}",
                    r.width, r.height, leastSide, leastSide));
  LabPicture picture = labOf(r, g, b);
  if (runsDown(picture.lightness)) {
    picture.lightness = turned(picture.lightness);
    picture.a = turned(picture.a);
    picture.b = turned(picture.b);
  }
  const int h = std::max(2, std::min(r.width, r.height) / 24);
  const Floats coarse = boxMean(boxMean(picture.lightness, h), h);
  Floats detail(picture.width(), picture.height());
  for (size_t i = 0; i < detail.view().pixels(); ++i)
    detail.row(0)[i] = picture.lightness.row(0)[i] - coarse.row(0)[i];
  const Tones found = tonesIn(picture, detail);
  const Floats grain = evenGrain(detail, 2 * h, params.width, params.height);
  PaintedStrip strip{Floats(params.width, params.height), Floats(params.width, params.height),
                     Floats(params.width, params.height)};
  parallelRows(params.height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      const float place = 1.0f - (static_cast<float>(y) + 0.5f) / static_cast<float>(params.height);
      const float tone = found.lightness(place);
      const float strength =
          params.strokes * found.strength[static_cast<size_t>(place * (tones - 1) + 0.5f)];
      for (int x = 0; x < params.width; ++x) {
        const float stroke = std::clamp(grain(x, y), -2.5f, 2.5f) * strength;
        const V3f lab = leanTowardsWarm(found.at(tone + stroke), params.hueShift * (2 * place - 1));
        const V3f c = srgbOfOklab(lab);
        strip.r(x, y) = c.x;
        strip.g(x, y) = c.y;
        strip.b(x, y) = c.z;
      }
    }
  });
  return strip;
}

}  // namespace kagefude
