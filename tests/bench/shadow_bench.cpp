#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "passes/depth_map/pcf.h"
#include "passes/search/classes.h"
#include "passes/search/pair_search.h"
#include "passes/tone/smooth.h"
#include "passes/tone/surfaces.h"

// Ratios within one run are what counts: the pair search must take under 1/20 of the naive
// nearest-pixel search of the same frame.
namespace kagefude {
namespace {

/// Discs of shadow with soft rims on labelled columns, each with umbra, penumbra and lit pixels.
struct Frame {
  Bytes farMask, nearMask;
  Labels labels;

  explicit Frame(int size, int columns = 5)
      : farMask(size, size, 1), nearMask(size, size, 1), labels(size, size) {
    std::mt19937 random(1);
    for (int i = 0; i < 12; ++i) {
      const int cx = static_cast<int>(random() % size), cy = static_cast<int>(random() % size);
      const double inner = size * 0.05 + random() % (size / 12);
      const double outer = inner + size * 0.04;
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          const double d = std::hypot(x - cx, y - cy);
          if (d < inner) farMask(x, y) = 0;
          if (d < outer) nearMask(x, y) = 0;
        }
    }
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) labels(x, y) = static_cast<uint32_t>(1 + x * columns / size);
  }
};

/// Nearest pixel of a class by rings of growing size; stops when no nearer one can follow.
float naiveDistance(const Bytes& classes, const Labels& labels, int x, int y, ShadowClass wanted) {
  const int size = classes.width();
  int best = 1 << 30;
  for (int r = 1; r < size && r * r < best; ++r)
    for (int v = std::max(y - r, 0); v <= std::min(y + r, size - 1); ++v) {
      const int step = v == y - r || v == y + r ? 1 : 2 * r;
      for (int u = x - r; u <= x + r; u += step) {
        if (u < 0 || u >= size || classes(u, v) != static_cast<uint8_t>(wanted)) continue;
        if (labels(u, v) == labels(x, y))
          best = std::min(best, (u - x) * (u - x) + (v - y) * (v - y));
      }
    }
  return std::sqrt(static_cast<float>(best));
}

Floats naivePair(const Frame& f) {
  const View<const uint8_t> masks[] = {f.farMask, f.nearMask};
  const Bytes classes = classifyShadow(masks, f.labels);
  const int size = classes.width();
  Floats v(size, size, 1.0f);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      if (classes(x, y) == static_cast<uint8_t>(ShadowClass::umbra)) v(x, y) = 0;
      if (classes(x, y) != static_cast<uint8_t>(ShadowClass::penumbra)) continue;
      const float d1 = naiveDistance(classes, f.labels, x, y, ShadowClass::umbra);
      v(x, y) = d1 / (d1 + naiveDistance(classes, f.labels, x, y, ShadowClass::lit));
    }
  return v;
}

void pairNaive(benchmark::State& state) {
  const Frame f(1024);
  Floats naive;
  for (auto _ : state) naive = naivePair(f);
  const Floats exact = pairVisibility(f.farMask, f.nearMask, f.labels, {});
  for (size_t i = 0; i < exact.view().pixels(); ++i)
    if (naive.view().data[i] != exact.view().data[i]) {
      state.SkipWithError("the pair search is not exact");
      return;
    }
}
BENCHMARK(pairNaive)->Unit(benchmark::kMillisecond)->Iterations(1);

void pairExact(benchmark::State& state) {
  const Frame f(static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(pairVisibility(f.farMask, f.nearMask, f.labels, {}));
}
BENCHMARK(pairExact)->Arg(1024)->Arg(2880)->Unit(benchmark::kMillisecond)->UseRealTime();

void pairGrid(benchmark::State& state) {
  const Frame f(1024);
  PairParams params;
  params.search = PairSearch::grid;
  params.step = static_cast<int>(state.range(0));
  params.adaptive = state.range(1) != 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(pairVisibility(f.farMask, f.nearMask, f.labels, params));
}
BENCHMARK(pairGrid)
    ->Args({3, 0})
    ->Args({10, 0})
    ->Args({10, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void pairFiveThousandLabels(benchmark::State& state) {
  Frame f(1024);
  std::mt19937 random(2);
  const bool scattered = state.range(0) != 0;
  for (int y = 0; y < 1024; ++y)
    for (int x = 0; x < 1024; ++x)
      f.labels(x, y) =
          scattered ? 1 + random() % 5000 : static_cast<uint32_t>(1 + x / 14 + y / 15 * 73);
  for (auto _ : state)
    benchmark::DoNotOptimize(pairVisibility(f.farMask, f.nearMask, f.labels, {}));
}
BENCHMARK(pairFiveThousandLabels)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

void smooth(benchmark::State& state) {
  const Frame f(2880);
  const Floats v = pairVisibility(f.farMask, f.nearMask, f.labels, {});
  SmoothParams params;
  params.h = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(smoothWithinSurfaces(v, f.labels, params));
}
BENCHMARK(smooth)->Arg(2)->Arg(10)->Arg(40)->Unit(benchmark::kMillisecond)->UseRealTime();

/// A flat floor under a depth map with discs of blockers, at 2880 squared.
void pcf(benchmark::State& state) {
  const int size = 2880;
  const Frame f(size);
  Vec3Plane position(size, size), normal(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      position.set(x, y, V3f(x, y, 0) * (2.0f / size) - V3f(1, 1, 0));
      normal.set(x, y, V3f(0, 0, 1));
    }
  Floats depth(1024, 1024);
  for (int y = 0; y < 1024; ++y)
    for (int x = 0; x < 1024; ++x)
      depth(x, y) = f.farMask(x * size / 1024, (1023 - y) * size / 1024) ? 10 : 5;
  ShadowMap map{depth, {}, {}};
  map.lightFromWorld.m[2][3] = -10;
  map.clipFromLight.m[2][2] = -0.1;
  PcfParams params;
  params.radius = static_cast<float>(state.range(1));
  const auto run = state.range(0) ? &pcfVisibility : &detail::pcfVisibilityByTaps;
  for (auto _ : state) benchmark::DoNotOptimize(run(position, normal, f.labels, map, params));
}
BENCHMARK(pcf)
    ->Args({0, 4})
    ->Args({1, 4})
    ->Args({1, 16})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void surfaces(benchmark::State& state) {
  const Frame f(2880);
  for (auto _ : state) benchmark::DoNotOptimize(labelSurfaces(f.labels, {}, {}, {}));
}
BENCHMARK(surfaces)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace kagefude
