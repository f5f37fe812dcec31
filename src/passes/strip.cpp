#include "passes/strip.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "passes/strip_lookup.h"

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
template <class Read, class Write>
void shrinkLine(int from, int to, const Read& read, const Write& write) {
  const double scale = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    const double begin = i * scale, end = (i + 1) * scale;
    Rgba sum{};
    for (int j = static_cast<int>(begin); j < from && j < end; ++j) {
      const double share = std::min<double>(j + 1, end) - std::max<double>(j, begin);
      sum += read(j) * static_cast<float>(share / scale);
    }
    write(i, sum);
  }
}

void addRowMeans(Strip::Level& level) {
  level.rowMeans = Plane<Rgba>(1, level.height);
  for (int y = 0; y < level.height; ++y)
    shrinkLine(
        level.width, 1, [&](int x) { return level.texels(x, y); },
        [&](int, Rgba mean) { level.rowMeans(0, y) = mean; });
}

Strip::Level shrink(const Strip::Level& fine) {
  Strip::Level coarse;
  coarse.width = std::max(1, fine.width / 2);
  coarse.height = std::max(1, fine.height / 2);
  Plane<Rgba> narrow(coarse.width, fine.height);
  for (int y = 0; y < fine.height; ++y)
    shrinkLine(
        fine.width, coarse.width, [&](int x) { return fine.texels(x, y); },
        [&](int x, Rgba c) { narrow(x, y) = c; });
  coarse.texels = Plane<Rgba>(coarse.width, coarse.height);
  for (int x = 0; x < coarse.width; ++x)
    shrinkLine(
        fine.height, coarse.height, [&](int y) { return narrow(x, y); },
        [&](int y, Rgba c) { coarse.texels(x, y) = c; });
  return coarse;
}

}  // namespace

Strip makeStrip(View<const float> r, View<const float> g, View<const float> b,
                View<const float> a) {
  if (r.empty()) throw InputError("the strip has no pixels");
  if (r.width > largestSide || r.height > largestSide)
    throw InputError(fmt::format("the strip is {}x{}; at most {} pixels a side are allowed",
                                 r.width, r.height, largestSide));
  Strip strip;
  Strip::Level full;
  full.width = r.width;
  full.height = r.height;
  full.texels = Plane<Rgba>(r.width, r.height);
  for (int y = 0; y < r.height; ++y)
    for (int x = 0; x < r.width; ++x)
      full.texels(x, y) = finiteOrZero(Rgba{r(x, y), g(x, y), b(x, y), a.empty() ? 1.0f : a(x, y)});
  strip.levels.push_back(std::move(full));
  while (strip.width() > 0 && (strip.levels.back().width > 1 || strip.levels.back().height > 1))
    strip.levels.push_back(shrink(strip.levels.back()));
  for (Strip::Level& level : strip.levels) addRowMeans(level);
  return strip;
}

Rgba stripBilinear(const Strip& strip, float u, float v) {
  return bilinearTexels(strip.levels.front(), u - std::floor(u), v);
}

Rgba stripFiltered(const Strip& strip, float u, float v, const Footprint& footprint,
                   int maxProbes) {
  return lookUp(strip, u, v, stripProbe(strip, footprint, maxProbes));
}

Rgba stripRowMean(const Strip& strip, float v, float dv) {
  const float lod = log2Of(std::max(1.0f, std::fabs(dv) * static_cast<float>(strip.height())));
  return rowMeanAt(strip, v, lod);
}

}  // namespace kagefude
