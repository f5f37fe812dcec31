#include <benchmark/benchmark.h>

#include <cmath>

#include "passes/light_shape/light_shape.h"
#ifdef KAGEFUDE_HAVE_OPENCV
#include <opencv2/imgproc.hpp>
#endif

// Nine masks at 3840x2160 with 21 surfaces: distances and integration must take under 10 times one
// OpenCV distanceTransform (PRECISE) of the frame, in the same run with two threads.
namespace kagefude {
namespace {

constexpr int width = 3840, height = 2160, surfaces = 21;
constexpr int repetitions = 5;  // gates.py takes the median

/// A floor under a light, with discs whose shadows shift by 30 pixels a radius.
struct Frame {
  Labels labels{width, height};
  Vec3Plane position{width, height}, normal{width, height};
  std::vector<Bytes> masks;
  std::vector<V2f> places{{0, 0}};
  LightGeometry geometry;

  Frame() {
    geometry.position = V3f(width / 2, height / 2, 4000);
    geometry.u = V3f(1, 0, 0);
    geometry.v = V3f(0, 1, 0);
    for (int i = 0; i < 8; ++i)
      places.emplace_back(static_cast<float>(std::cos(i * M_PI / 4)),
                          static_cast<float>(std::sin(i * M_PI / 4)));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        labels(x, y) = static_cast<uint32_t>(1 + x / 549 + y / 720 * 7);
        position.set(x, y, V3f(static_cast<float>(x), static_cast<float>(y), 0));
        normal.set(x, y, V3f(0, 0, 1));
      }
    for (const V2f& place : places) {
      Bytes& mask = masks.emplace_back(width, height);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) mask(x, y) = lit(x, y, place);
    }
  }

  static bool lit(int x, int y, const V2f& place) {
    const float u = std::remainder(static_cast<float>(x) + 30 * place.x - 270, 549.0f);
    const float v = std::remainder(static_cast<float>(y) + 30 * place.y - 360, 480.0f);
    return u * u + v * v > 110.0f * 110.0f;
  }
};

const Frame& frame() {
  static const Frame made;
  return made;
}

void lightShapeNineMasks(benchmark::State& state) {
  const Frame& f = frame();
  const std::vector<View<const uint8_t>> masks(f.masks.begin(), f.masks.end());
  LightShapeParams params;
  params.follow = state.range(0) != 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        lightShapeVisibility(masks, f.places, f.labels, f.position, f.normal, f.geometry, params));
}
BENCHMARK(lightShapeNineMasks)
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->Repetitions(repetitions)
    ->UseRealTime();

#ifdef KAGEFUDE_HAVE_OPENCV
void openCvDistanceTransform(benchmark::State& state) {
  const cv::Mat mask(height, width, CV_8U, const_cast<uint8_t*>(frame().masks[0].row(0)));
  cv::Mat distance;
  cv::setNumThreads(2);
  for (auto _ : state) cv::distanceTransform(mask, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
}
BENCHMARK(openCvDistanceTransform)
    ->Unit(benchmark::kMillisecond)
    ->Repetitions(repetitions)
    ->UseRealTime();
#endif

}  // namespace
}  // namespace kagefude
