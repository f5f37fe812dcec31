#include "passes/strip/strip_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kagefude {
namespace {

constexpr float visibleSeam = 1.0f / 255.0f;
constexpr float seamLimit = 3.0f;
constexpr float disorderLimit = 0.1f;
constexpr int smallestSide = 16;

float finiteOrZero(float value) { return std::isfinite(value) ? value : 0.0f; }

struct Picture {
  View<const float> r, g, b;

  double difference(int columnA, int columnB) const {
    double sum = 0;
    for (int y = 0; y < r.height; ++y)
      for (const View<const float>& plane : {r, g, b})
        sum += std::fabs(finiteOrZero(plane(columnA, y)) - finiteOrZero(plane(columnB, y)));
    return sum / (3.0 * r.height);
  }
  double brightness(int row) const {
    double sum = 0;
    for (int x = 0; x < r.width; ++x)
      sum += 0.2126 * finiteOrZero(r(x, row)) + 0.7152 * finiteOrZero(g(x, row)) +
             0.0722 * finiteOrZero(b(x, row));
    return sum / r.width;
  }
  size_t broken() const {
    size_t count = 0;
    for (int y = 0; y < r.height; ++y)
      for (int x = 0; x < r.width; ++x)
        count += !std::isfinite(r(x, y)) || !std::isfinite(g(x, y)) || !std::isfinite(b(x, y));
    return count;
  }
};

double meanOf(const std::vector<double>& values, size_t first, size_t end) {
  double sum = 0;
  for (size_t i = first; i < end; ++i) sum += values[i];
  return sum / static_cast<double>(end - first);
}

void measureSeam(const Picture& picture, StripReport& report) {
  report.seamError = static_cast<float>(picture.difference(report.width - 1, 0));
  double inside = 0;
  for (int x = 0; x + 1 < report.width; ++x) inside += picture.difference(x, x + 1);
  report.interiorError = static_cast<float>(inside / std::max(1, report.width - 1));
  report.seamRatio = report.seamError / std::max(report.interiorError, 1e-6f);
}

void measureOrder(const Picture& picture, StripReport& report) {
  std::vector<double> upward;
  for (int y = report.height - 1; y >= 0; --y) upward.push_back(picture.brightness(y));
  const size_t rows = upward.size(), eighth = std::max<size_t>(1, rows / 8);
  report.bottomBrightness = static_cast<float>(meanOf(upward, 0, eighth));
  report.topBrightness = static_cast<float>(meanOf(upward, rows - eighth, rows));
  const size_t window = std::max<size_t>(1, rows / 32);
  double falls = 0;
  for (size_t i = 0; i + 2 * window <= rows; i += window)
    falls +=
        std::max(0.0, meanOf(upward, i, i + window) - meanOf(upward, i + window, i + 2 * window));
  const double rise = std::fabs(report.topBrightness - report.bottomBrightness);
  report.disorder = static_cast<float>(falls / std::max(rise, 1e-6));
}

void judge(const Picture& picture, StripReport& report) {
  if (const size_t broken = picture.broken())
    report.problems.push_back(fmt::format("{} texels are NaN or infinite", broken));
  if (report.width < smallestSide || report.height < smallestSide)
    report.problems.push_back(fmt::format("{}x{} is too small; expected at least {}x{}",
                                          report.width, report.height, smallestSide, smallestSide));
  if (report.seamError > visibleSeam && report.seamRatio > seamLimit)
    report.problems.push_back(
        fmt::format("left and right edges do not join: their difference is {:.1f} times that of "
                    "neighbouring columns",
                    report.seamRatio));
  if (report.topBrightness <= report.bottomBrightness)
    report.problems.push_back(
        fmt::format("the top ({:.2f}) is not brighter than the bottom ({:.2f}); is the strip "
                    "upside down?",
                    report.topBrightness, report.bottomBrightness));
  else if (report.disorder > disorderLimit)
    report.problems.push_back(fmt::format(
        "brightness does not rise steadily from bottom to top: its falls make up {:.0f} "
        "% of the rise",
        100.0f * report.disorder));
}

}  // namespace

StripReport checkStrip(View<const float> r, View<const float> g, View<const float> b) {
  StripReport report;
  if (r.empty()) {
    report.problems.push_back("the strip has no pixels");
    return report;
  }
  report.width = r.width;
  report.height = r.height;
  const Picture picture{r, g, b};
  measureSeam(picture, report);
  measureOrder(picture, report);
  judge(picture, report);
  return report;
}

}  // namespace kagefude
