// Frames made to hurt: 5,000 surfaces, scattered or in patches, checkerboard masks, one lit pixel,
// thin diagonals. None may be worse than linear: the cost a pixel at 4K is compared with that at a
// quarter of the pixels.
#include "contest.h"
#include "image/parallel.h"
#include "passes/search/pair_search.h"
#include "passes/tone/smooth.h"
#include "passes/tone/surfaces.h"

namespace kagefude::bench {
namespace {

enum class Kind { patches, scattered, checkerboard, oneLit, diagonals };

uint32_t hashed(int x, int y) {
  uint32_t h = static_cast<uint32_t>(x) * 0x9e3779b1u ^ static_cast<uint32_t>(y) * 0x85ebca77u;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  return h ^ (h >> 12);
}

struct Frame {
  Labels labels;
  Bytes farMask, nearMask;

  Frame(Kind kind, int width, int height)
      : labels(width, height, 1u), farMask(width, height, 0), nearMask(width, height, 1) {
    parallelRows(height, [&](int first, int end) {
      for (int y = first; y < end; ++y)
        for (int x = 0; x < width; ++x) set(kind, x, y);
    });
    if (kind == Kind::oneLit) {
      nearMask.fill(1);
      nearMask(0, 0) = 0;
      farMask(width - 1, height - 1) = 1;
    }
  }

 private:
  void set(Kind kind, int x, int y) {
    const int width = labels.width(), height = labels.height();
    const int column = x * 100 / width, line = y * 50 / height;
    switch (kind) {
      case Kind::patches:
        labels(x, y) = static_cast<uint32_t>(1 + column + 100 * line);
        farMask(x, y) = hashed(x / 16, y / 16) % 3 == 0;
        nearMask(x, y) = hashed(x / 16, y / 16) % 3 != 1;
        break;
      case Kind::scattered:
        labels(x, y) = 1 + hashed(x, y) % 5000;
        farMask(x, y) = hashed(x / 16, y / 16) % 3 == 0;
        nearMask(x, y) = hashed(x / 16, y / 16) % 3 != 1;
        break;
      case Kind::checkerboard:
        farMask(x, y) = (x + y) % 4 == 0;
        nearMask(x, y) = (x + y) % 4 != 2;
        break;
      case Kind::diagonals:
        farMask(x, y) = (x + y) % 400 == 0;
        nearMask(x, y) = (x + y) % 400 != 200;
        break;
      case Kind::oneLit:
        break;
    }
  }
};

void comp(const Frame& frame) {
  const Labels surfaces = labelSurfaces(frame.labels, {}, {}, {});
  const Floats raw = pairVisibility(frame.farMask, frame.nearMask, frame.labels, {});
  benchmark::DoNotOptimize(smoothWithinSurfaces(raw, frame.labels, {10}));
}

void worstCase(benchmark::State& state) {
  const auto kind = static_cast<Kind>(state.range(0));
  static const char* const names[] = {"5,000 patches", "5,000 scattered surfaces",
                                      "checkerboard masks", "one lit pixel", "thin diagonals"};
  const Frame small(kind, 1920, 1080), large(kind, 3840, 2160);
  for (auto _ : state) {
    const auto t = contest({[&] { comp(large); }, [&] { comp(small); }}, 3);
    state.SetLabel(names[state.range(0)]);
    state.counters["ns_per_pixel"] = t[0] * 1e9 / (3840.0 * 2160);
    state.counters["growth"] = t[0] / (4 * t[1]);
  }
}
BENCHMARK(worstCase)->DenseRange(0, 4)->Iterations(1);

}  // namespace
}  // namespace kagefude::bench
