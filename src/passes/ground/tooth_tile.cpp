#include "passes/ground/tooth_tile.h"

#include <vector>

#include "image/parallel.h"
#include "image/real_math.h"
#include "passes/strip/stroke_noise.h"

namespace kagefude {
namespace {

/// Texels on a side, about.
constexpr float wantedSize = 512;
/// Grains from one chain line of laid paper to the next.
constexpr float chainLines = 16;

float eased(float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }

/// Gradient noise (Perlin 2002) on a lattice that repeats after `cells`; about -0.7..0.7. Asked for
/// at x, y >= 0.
class GradientNoise {
 public:
  GradientNoise(uint32_t seed, int cells)
      : cells_(cells), ways_(static_cast<size_t>(cells) * static_cast<size_t>(cells)) {
    for (size_t i = 0; i < ways_.size(); ++i) {
      const uint32_t bits = scrambled(seed ^ scrambled(static_cast<uint32_t>(i)));
      ways_[i] = sinCosTurns(static_cast<float>(bits >> 8) * (1.0f / 16777216.0f));
    }
  }

  float at(float x, float y) const {
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
    const float sx = eased(fx), sy = eased(fy);
    const int left = i % cells_, right = (i + 1) % cells_;
    const SinCos *top = row(j), *bottom = row(j + 1);
    const float a = along(top[left], fx, fy), b = along(top[right], fx - 1, fy);
    const float c = along(bottom[left], fx, fy - 1), d = along(bottom[right], fx - 1, fy - 1);
    const float upper = a + (b - a) * sx, lower = c + (d - c) * sx;
    return upper + (lower - upper) * sy;
  }

 private:
  const SinCos* row(int j) const {
    return ways_.data() + static_cast<size_t>(j % cells_) * static_cast<size_t>(cells_);
  }
  static float along(const SinCos& way, float dx, float dy) { return way.cos * dx + way.sin * dy; }

  int cells_;
  std::vector<SinCos> ways_;
};

/// Noise of two grains, one and half of one to a cell.
struct ToothNoise {
  GradientNoise coarse, fine, finest;
};

float roughAt(const ToothNoise& noise, float u, float v) {
  // A bump is half of a wave, so one grain is half a cell wide.
  return noise.coarse.at(0.5f * u, 0.5f * v) + 0.5f * noise.fine.at(u, v) +
         0.3f * noise.finest.at(2.0f * u, 2.0f * v);
}

/// A thread's height over its width and along it, where it is above or below the crossing one.
float threadHeight(float across, float along, bool above) {
  const float round = std::fabs(sinCosTurns(0.5f * across).sin);
  const float bow = std::fabs(sinCosTurns(0.5f * along).sin);
  return round * (above ? 0.55f + 0.45f * bow : 0.45f - 0.35f * bow);
}

float canvasAt(const ToothNoise& noise, float u, float v) {
  // Threads wander a little and are of unequal thickness.
  const float x = u + 0.2f * noise.coarse.at(0.5f * v, 0.5f * u);
  const float y = v + 0.2f * noise.coarse.at(0.5f * u, 0.5f * v);
  const bool warpAbove = (static_cast<int>(u + 64) + static_cast<int>(v + 64)) % 2 == 0;
  const float warp = threadHeight(x, y, warpAbove), weft = threadHeight(y, x, !warpAbove);
  return (warp > weft ? warp : weft) + 0.12f * noise.fine.at(u, v);
}

float laidAt(const ToothNoise& noise, float u, float v) {
  const float line = sinCosTurns(v + 0.2f * noise.coarse.at(0.5f * u, 0.5f * v)).cos;
  const float across = u / chainLines - std::floor(u / chainLines);
  const float chains = across < 0.06f ? -0.2f : 0.0f;
  return 0.3f * line + chains + 0.3f * noise.finest.at(2.0f * u, 2.0f * v) +
         0.9f * noise.fine.at(u, v) + 0.6f * noise.coarse.at(0.5f * u, 0.5f * v);
}

float heightAt(PaperParams::Kind kind, const ToothNoise& noise, float u, float v) {
  switch (kind) {
    case PaperParams::Kind::canvas:
      return canvasAt(noise, u, v);
    case PaperParams::Kind::laid:
      return laidAt(noise, u, v);
    case PaperParams::Kind::rough:
      break;
  }
  return roughAt(noise, u, v);
}

/// Turns heights into the shares of the tile that lie below them.
void rankHeights(Floats& heights) {
  constexpr int bins = 4096;
  constexpr float reach = 2.0f;
  const auto binOf = [](float h) {
    const float at = (h + reach) * (bins / (2.0f * reach));
    return static_cast<float>(at < 0.0f ? 0.0f : at > bins - 1.001f ? bins - 1.001f : at);
  };
  const size_t pixels = heights.view().pixels();
  std::vector<uint32_t> below(bins + 1, 0);
  for (size_t i = 0; i < pixels; ++i) ++below[static_cast<size_t>(binOf(heights.row(0)[i])) + 1];
  for (size_t bin = 1; bin < below.size(); ++bin) below[bin] += below[bin - 1];
  const float perPixel = 1.0f / static_cast<float>(pixels);
  for (size_t i = 0; i < pixels; ++i) {
    const float at = binOf(heights.row(0)[i]);
    const auto bin = static_cast<size_t>(at);
    const auto lower = static_cast<float>(below[bin]), upper = static_cast<float>(below[bin + 1]);
    heights.row(0)[i] = (lower + (upper - lower) * (at - static_cast<float>(bin))) * perPixel;
  }
}

}  // namespace

ToothTile::ToothTile(const PaperParams& params) {
  // A whole number of threads and lattice cells goes into the tile, and of chain lines unless they
  // are far apart.
  const int wanted = static_cast<int>(wantedSize / params.grain);
  const int step = wanted >= static_cast<int>(chainLines) ? static_cast<int>(chainLines) : 4;
  const int grains = std::max(step, wanted / step * step);
  const int side = static_cast<int>(static_cast<float>(grains) * params.grain + 0.5f);
  texelsPerGrain_ = static_cast<float>(side) / static_cast<float>(grains);
  Floats raw(side, side);
  const ToothNoise noise{
      {0x70617065u, grains / 2}, {0x746f6f74u, grains}, {0x66696265u, 2 * grains}};
  parallelRows(side, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < side; ++x)
        raw(x, y) = heightAt(params.kind, noise, (static_cast<float>(x) + 0.5f) / texelsPerGrain_,
                             (static_cast<float>(y) + 0.5f) / texelsPerGrain_);
  });
  slope_ = Floats(side, side);
  height_ = std::move(raw);
  rankHeights(height_);
  parallelRows(side, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < side; ++x) {
        const float fall =
            height_(wrapped(x + 1), wrapped(y + 1)) - height_(wrapped(x - 1), wrapped(y - 1));
        slope_(x, y) = std::clamp(fall * std::max(texelsPerGrain_, 2.0f) * 0.5f, -2.0f, 2.0f);
      }
  });
}

void ToothTile::copyRow(int x, int y, int count, float* height, float* slope) const {
  const int row = wrapped(y);
  for (int done = 0; done < count;) {
    const int from = wrapped(x + done), run = std::min(size() - from, count - done);
    std::copy_n(height_.row(row) + from, run, height + done);
    std::copy_n(slope_.row(row) + from, run, slope + done);
    done += run;
  }
}

ToothSample ToothTile::between(float u, float v) const {
  const float x = u * texelsPerGrain_ - 0.5f, y = v * texelsPerGrain_ - 0.5f;
  const float left = std::floor(x), top = std::floor(y);
  const float fx = x - left, fy = y - top;
  const int i = wrapped(static_cast<int>(left)), j = wrapped(static_cast<int>(top));
  const int i1 = i + 1 < size() ? i + 1 : 0, j1 = j + 1 < size() ? j + 1 : 0;
  const auto mixed = [&](const Floats& plane) {
    const float a = plane(i, j), b = plane(i1, j), c = plane(i, j1), d = plane(i1, j1);
    const float upper = a + (b - a) * fx, lower = c + (d - c) * fx;
    return upper + (lower - upper) * fy;
  };
  return {mixed(height_), mixed(slope_)};
}

}  // namespace kagefude
