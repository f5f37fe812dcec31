#include "passes/strip/strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/parallel.h"
#include "passes/strip/strip_lookup.h"

namespace kagefude {
namespace {

constexpr int largestSide = 16384;

Rgba finiteOrZero(Rgba c) {
  for (int i = 0; i < 4; ++i)
    if (!std::isfinite(c[i])) c[i] = 0;
  return c;
}

// Box-filters `from` texels into `to` texels along one axis; texels that straddle a border are
// shared by area, so the mean stays exact at odd sizes.
class BoxShares {
 public:
  BoxShares(int from, int to) {
    const double scale = static_cast<double>(from) / to;
    for (int i = 0; i < to; ++i) {
      const double begin = i * scale, end = (i + 1) * scale;
      first_.push_back(static_cast<int>(begin));
      start_.push_back(shares_.size());
      for (int j = first_.back(); j < from && j < end; ++j) {
        const double share = std::min<double>(j + 1, end) - std::max<double>(j, begin);
        shares_.push_back(static_cast<float>(share / scale));
      }
    }
    start_.push_back(shares_.size());
  }

  /// use(j, share) for each texel j that texel i is made of, in their order.
  template <class Use>
  void each(int i, const Use& use) const {
    const auto k = static_cast<size_t>(i);
    int j = first_[k];
    for (size_t at = start_[k]; at < start_[k + 1]; ++at) use(j++, shares_[at]);
  }

 private:
  std::vector<int> first_;
  std::vector<size_t> start_;
  std::vector<float> shares_;
};

// One level while the chain is being built.
using Texels = Plane<Rgba>;

Texels shrink(const Texels& fine) {
  const int width = std::max(1, fine.width() / 2), height = std::max(1, fine.height() / 2);
  Texels narrow(width, fine.height()), coarse(width, height);
  const BoxShares across(fine.width(), width), down(fine.height(), height);
  parallelRows(fine.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      const Rgba* const from = fine.row(y);
      for (int x = 0; x < width; ++x) {
        Rgba sum{};
        across.each(x, [&](int j, float share) { sum += from[j] * share; });
        narrow(x, y) = sum;
      }
    }
  });
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      Rgba* const to = coarse.row(y);
      std::fill_n(to, width, Rgba{});
      down.each(y, [&](int j, float share) {
        const Rgba* const from = narrow.row(j);
        for (int x = 0; x < width; ++x) to[x] += from[x] * share;
      });
    }
  });
  return coarse;
}

// Lays the levels one behind the other into the strip's pool.
Strip packed(const std::vector<Texels>& chain) {
  size_t texels = 0;
  for (const Texels& level : chain) texels += level.view().pixels();
  Strip strip;
  strip.pool = Plane<Rgba>(static_cast<int>(texels), 1);
  Rgba* next = strip.pool.row(0);
  for (const Texels& level : chain) {
    strip.levels.push_back({level.width(), level.height(),
                            static_cast<int>(next - strip.pool.row(0)),
                            View<const Rgba>(next, level.width(), level.height())});
    next = std::copy_n(level.row(0), level.view().pixels(), next);
  }
  return strip;
}

}  // namespace

Strip makeStrip(View<const float> r, View<const float> g, View<const float> b,
                View<const float> a) {
  if (r.empty()) throw InputError("the strip has no pixels");
  if (r.width > largestSide || r.height > largestSide)
    throw InputError(fmt::format("the strip is {}x{}; at most {} pixels a side are allowed",
                                 r.width, r.height, largestSide));
  std::vector<Texels> chain;
  chain.emplace_back(r.width, r.height);
  parallelRows(r.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < r.width; ++x)
        chain.front()(x, y) =
            finiteOrZero(Rgba{r(x, y), g(x, y), b(x, y), a.empty() ? 1.0f : a(x, y)});
  });
  while (chain.back().width() > 1 || chain.back().height() > 1)
    chain.push_back(shrink(chain.back()));
  Strip strip = packed(chain);
  strip.opaque = a.empty();
  strip.means = Plane<Rgba>(r.height, 1);
  const BoxShares row(r.width, 1);
  for (int y = 0; y < r.height; ++y) {
    Rgba mean{};
    row.each(0, [&](int x, float share) { mean += chain.front()(x, y) * share; });
    strip.means(y, 0) = mean;
  }
  strip.grain = makeStripGrain(strip.levels.front().texels);
  return strip;
}

Rgba stripBilinear(const Strip& strip, float u, float v) {
  return bilinearTexels(strip.levels.front(), fractionOf(u), v);
}

Rgba stripFiltered(const Strip& strip, float u, float v, const Footprint& footprint,
                   int maxProbes) {
  return lookUp(strip, u, v, stripProbe(strip, footprint, maxProbes));
}

Rgba stripRowMean(const Strip& strip, float v) {
  const RowPlace row = rowPlace(v, strip.height());
  const Rgba* mean = strip.means.row(0);
  return mean[row.upper] + (mean[row.lower] - mean[row.upper]) * row.fraction;
}

}  // namespace kagefude
