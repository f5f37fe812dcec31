#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#ifdef KAGEFUDE_HAVE_OPENCV
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#endif

#include <cmath>

#include "passes/brush/brush_map.h"
#include "passes/strip/strip_paint.h"

// The brush pass on a 4K frame of 21 balls, each with its own strip, on two threads, against
// OpenCV's phase (angle of every pixel) and remap (one bilinear lookup of every pixel).
namespace kagefude {
namespace {

constexpr int width = 3840, height = 2160;
constexpr int columns = 7, rows = 3, styles = columns * rows;

struct Scene {
  Vec3Plane position{width, height}, normal{width, height};
  Floats tone{width, height};
  Plane<uint16_t> index{width, height};
  std::vector<Strip> strips;
  std::vector<BrushAnchor> anchors;

  Scene() {
    for (int i = 0; i < styles; ++i) {
      StripPaintParams paint;
      paint.seed = i;
      const PaintedStrip picture = paintStrip(paint);
      strips.push_back(makeStrip(picture.r, picture.g, picture.b));
      BrushAnchor anchor;
      anchor.strip = i;
      anchor.mappingDistance = 0.25f;
      anchor.points.push_back({{0, 0, 0}, turningFrame(V3f(0.48f, 0.6f, -0.64f), {}), 0});
      anchors.push_back(anchor);
    }
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) placePixel(x, y);
  }

  // A ball over a floor in each of the tiles, so that no pixel is empty.
  void placePixel(int x, int y) {
    const int column = x * columns / width, row = y * rows / height;
    const float px = (static_cast<float>(x % (width / columns)) / (width / columns) - 0.5f) * 2.4f;
    const float py = (0.5f - static_cast<float>(y % (height / rows)) / (height / rows)) * 2.4f;
    const float inside = 1.0f - px * px - py * py;
    const V3f p(px, py, inside > 0 ? std::sqrt(inside) : 0);
    const V3f n = inside > 0 ? p : V3f(0, 0, 1);
    position.set(x, y, p);
    normal.set(x, y, n);
    tone(x, y) = std::max(0.0f, n.dot(V3f(-0.48f, -0.6f, 0.64f)));
    index(x, y) = static_cast<uint16_t>(1 + std::min(row, rows - 1) * columns +
                                        std::min(column, columns - 1));
  }
};

const Scene& scene() {
  static const Scene made;
  return made;
}

void brush(benchmark::State& state, BrushParams::Mapping mapping) {
  const Scene& s = scene();
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 2);
  BrushParams params;
  params.mapping = mapping;
  BrushResult result;  // painted over again and again, as OpenCV's pictures are
  applyBrush(s.position, s.normal, s.tone, s.index, s.anchors, s.strips, params, result);
  for (auto step : state) {
    applyBrush(s.position, s.normal, s.tone, s.index, s.anchors, s.strips, params, result);
    benchmark::DoNotOptimize(result.r.row(0));
  }
}

void brushHeld(benchmark::State& state) { brush(state, BrushParams::Mapping::held); }
void brushPolar(benchmark::State& state) { brush(state, BrushParams::Mapping::polar); }
void brushSeed(benchmark::State& state) { brush(state, BrushParams::Mapping::seed); }
BENCHMARK(brushHeld)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(brushPolar)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(brushSeed)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

#ifdef KAGEFUDE_HAVE_OPENCV
// Strips stacked into one atlas, so that one remap serves all styles.
cv::Mat makeAtlas(const Scene& s) {
  const int w = s.strips[0].width(), h = s.strips[0].height();
  cv::Mat atlas(h * styles, w, CV_32FC3);
  for (int i = 0; i < styles; ++i)
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const Rgba c = s.strips[static_cast<size_t>(i)].levels[0].texels(x, y);
        atlas.at<cv::Vec3f>(i * h + y, x) = cv::Vec3f(c[0], c[1], c[2]);
      }
  return atlas;
}

void openCv(benchmark::State& state, int lookups) {
  const Scene& s = scene();
  cv::setNumThreads(2);
  const cv::Mat atlas = makeAtlas(s);
  cv::Mat a(height, width, CV_32F), b(height, width, CV_32F), angle;
  cv::Mat u(height, width, CV_32F), v(height, width, CV_32F);
  const int h = s.strips[0].height(), w = s.strips[0].width();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int style = s.index(x, y) - 1;
      const BrushAnchor::Point& point = s.anchors[static_cast<size_t>(style)].points[0];
      const V3f q = Vec3View(s.position)(x, y);
      a.at<float>(y, x) = point.frame.l1.dot(q);
      b.at<float>(y, x) = point.frame.l2.dot(q);
      const float turns = turnsOf(a.at<float>(y, x), b.at<float>(y, x)) * 3.0f;
      u.at<float>(y, x) = (turns - std::floor(turns)) * static_cast<float>(w - 1);
      v.at<float>(y, x) =
          static_cast<float>(style * h) + (1.0f - s.tone(x, y)) * static_cast<float>(h - 1);
    }
  cv::Mat out;
  for (auto step : state) {
    cv::phase(b, a, angle);
    for (int i = 0; i < lookups; ++i)
      cv::remap(atlas, out, u, v, cv::INTER_LINEAR, cv::BORDER_WRAP);
    benchmark::DoNotOptimize(out.data);
    benchmark::DoNotOptimize(angle.data);
  }
}

void openCvPhaseRemap(benchmark::State& state) { openCv(state, 1); }
void openCvPhaseTwoRemaps(benchmark::State& state) { openCv(state, 2); }
BENCHMARK(openCvPhaseRemap)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(openCvPhaseTwoRemaps)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
#endif

}  // namespace
}  // namespace kagefude
