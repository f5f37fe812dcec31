// The mean within each surface against OpenCV's box filter, object by object. 3840 x 2160, 21
// objects, two threads.
#include "bench_frame.h"
#include "contest.h"
#include "passes/search/nearest_site.h"
#include "passes/tone/smooth.h"
#ifdef KAGEFUDE_HAVE_OPENCV
#include <opencv2/imgproc.hpp>

namespace kagefude::bench {
namespace {

constexpr int width = 3840, height = 2160;

/// Masked sums and counts on the box of each label, with the window's margin around it.
void openCvMeans(const cv::Mat& value, const cv::Mat& labels, const std::vector<LabelBox>& boxes,
                 int h, cv::Mat& result) {
  const cv::Size window(2 * h + 1, 2 * h + 1);
  cv::Mat sum, count;
  for (const LabelBox& box : boxes) {
    const cv::Rect area(box.x0, box.y0, box.x1 - box.x0, box.y1 - box.y0);
    const cv::Mat own = labels(area) == static_cast<int>(box.label);
    cv::Mat ones, masked = cv::Mat::zeros(area.size(), CV_32F);
    own.convertTo(ones, CV_32F, 1.0 / 255);
    value(area).copyTo(masked, own);
    constexpr int outside = cv::BORDER_CONSTANT | cv::BORDER_ISOLATED;
    cv::boxFilter(masked, sum, CV_32F, window, {-1, -1}, false, outside);
    cv::boxFilter(ones, count, CV_32F, window, {-1, -1}, false, outside);
    cv::divide(sum, count, masked);
    masked.copyTo(result(area), own);
  }
}

bool same(View<const float> ours, const cv::Mat& theirs) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (std::fabs(ours(x, y) - theirs.at<float>(y, x)) > 1e-4f) return false;
  return true;
}

void meanWithinLabels(benchmark::State& state) {
  cv::setNumThreads(2);
  const int h = static_cast<int>(state.range(0));
  const LabelledShadow f(width, height);
  Floats value(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      value(x, y) = static_cast<float>(f.classes(x, y)) * 0.25f + static_cast<float>(x & 7) * 0.01f;
  const cv::Mat values(height, width, CV_32F, value.row(0));
  const cv::Mat labels(height, width, CV_32S, const_cast<uint32_t*>(f.labels.row(0)));
  const Bytes all(width, height, 1);
  const std::vector<LabelBox> boxes = findLabelBoxes({all, 0, all, 1, f.labels});
  cv::Mat theirs(height, width, CV_32F);
  Floats ours;
  for (auto _ : state) {
    const auto t = contest({[&] { ours = smoothWithinSurfaces(value, f.labels, {h}); },
                            [&] { openCvMeans(values, labels, boxes, h, theirs); }});
    record(state, "OpenCV boxFilter per object on its box", t[0], t[1], h == 2 ? 7 : 4);
  }
  if (!same(ours, theirs)) state.SkipWithError("the means differ from OpenCV's");
}
BENCHMARK(meanWithinLabels)->Arg(2)->Arg(10)->Iterations(1);

}  // namespace
}  // namespace kagefude::bench

#endif
