// Percentage-closer filtering against the taps alone by OpenCV: remap fetches the stored depths of
// 32 taps a pixel, compare and add count them. 3840 x 2160, a map of 2048 x 2048, two threads.
#include "bench_frame.h"
#include "contest.h"
#include "passes/depth_map/map_taps.h"
#include "passes/depth_map/pcf.h"
#ifdef KAGEFUDE_HAVE_OPENCV
#include <opencv2/imgproc.hpp>

namespace kagefude::bench {
namespace {

constexpr int width = 3840, height = 2160, mapSide = 2048, taps = 32;
constexpr float radius = 3;

/// A floor, seen from above as the light sees it, with blockers half-way to the light.
struct Scene {
  Vec3Plane position{width, height}, normal{width, height};
  Labels labels{width, height, 1u};
  Floats depth{mapSide, mapSide};
  ShadowMap map;

  Scene() {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        position.set(x, y, V3f(2.0f * (x + 0.5f) / width - 1, 1 - 2.0f * (y + 0.5f) / height, 0));
        normal.set(x, y, V3f(0, 0, 1));
      }
    for (int y = 0; y < mapSide; ++y)
      for (int x = 0; x < mapSide; ++x)
        depth(x, y) = classAt(x, y, mapSide, mapSide) == ShadowClass::umbra ? 5.0f : 10.0f;
    map.depth = depth;
    map.lightFromWorld.m[2][3] = -10;
    map.clipFromLight.m[2][2] = -0.1f;
  }
};

/// The same taps, unturned, for every pixel.
void openCvTaps(const cv::Mat& depth, const cv::Mat& mapX, const cv::Mat& mapY, cv::Mat& lit) {
  cv::Mat stored, above;
  lit = cv::Mat::zeros(height, width, CV_8U);
  for (const V2f& p : spiralPoints(taps)) {
    cv::remap(depth, stored, mapX + radius * p.x, mapY + radius * p.y, cv::INTER_NEAREST,
              cv::BORDER_REPLICATE);
    cv::compare(stored, 9.9, above, cv::CMP_GE);
    cv::subtract(lit, above, lit, cv::noArray(), CV_8U);
  }
}

void pcfWholeFrame(benchmark::State& state) {
  cv::setNumThreads(2);
  const Scene scene;
  cv::Mat mapX(height, width, CV_32F), mapY(height, width, CV_32F), lit;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      mapX.at<float>(y, x) = (x + 0.5f) * mapSide / width - 0.5f;
      mapY.at<float>(y, x) = (y + 0.5f) * mapSide / height - 0.5f;
    }
  const cv::Mat depth(mapSide, mapSide, CV_32F, const_cast<float*>(scene.depth.row(0)));
  PcfParams params;
  params.radius = radius;
  for (auto _ : state) {
    const auto t = contest({[&] {
                              benchmark::DoNotOptimize(pcfVisibility(
                                  scene.position, scene.normal, scene.labels, scene.map, params));
                            },
                            [&] { openCvTaps(depth, mapX, mapY, lit); }});
    record(state, "OpenCV remap nearest, compare and add", t[0], t[1], 5);
  }
}
BENCHMARK(pcfWholeFrame)->Iterations(1);

}  // namespace
}  // namespace kagefude::bench

#endif
