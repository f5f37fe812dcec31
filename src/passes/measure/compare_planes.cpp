#include "passes/measure/compare_planes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "passes/require_size.h"

namespace kagefude {
namespace {

constexpr float penumbraLow = 0.02f, penumbraHigh = 0.98f;

bool counts(View<const float> where, size_t i) { return where.empty() || where.data[i] != 0.0f; }

/// The smallest value that at least this share of the values does not exceed.
double percentile(const std::vector<float>& sorted, double share) {
  if (sorted.empty()) return 0;
  const double rank = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[static_cast<size_t>(std::max(rank, 1.0)) - 1];
}

void requireSame(View<const float> value, View<const float> truth, View<const float> where) {
  requireSize("the plane to compare", value, truth.width, truth.height);
  if (!where.empty())
    requireSize("the plane of pixels to compare", where, truth.width, truth.height);
}

}  // namespace

PlaneDifference comparePlanes(View<const float> value, View<const float> truth,
                              View<const float> where, int truthSamples) {
  requireSame(value, truth, where);
  PlaneDifference d;
  double all = 0, penumbra = 0, bias = 0, noise = 0;
  std::vector<float> errors;
  for (size_t i = 0; i < truth.pixels(); ++i) {
    const float v = value.data[i], t = truth.data[i];
    if (!counts(where, i) || !std::isfinite(v) || !std::isfinite(t)) continue;
    const double error = static_cast<double>(v) - t;
    ++d.pixels;
    all += error * error;
    d.maximum = std::max(d.maximum, std::fabs(error));
    if (!(t > penumbraLow && t < penumbraHigh)) continue;
    penumbra += error * error;
    bias += error;
    noise += static_cast<double>(t) * (1.0 - t);
    errors.push_back(static_cast<float>(std::fabs(error)));
  }
  d.penumbraPixels = errors.size();
  if (d.pixels > 0) d.rmse = std::sqrt(all / static_cast<double>(d.pixels));
  if (errors.empty()) return d;
  const double count = static_cast<double>(errors.size());
  d.penumbraRmse = std::sqrt(penumbra / count);
  d.penumbraBias = bias / count;
  if (truthSamples > 0) d.truthNoise = std::sqrt(noise / count / truthSamples);
  std::sort(errors.begin(), errors.end());
  d.median = percentile(errors, 0.5);
  d.p90 = percentile(errors, 0.9);
  d.p99 = percentile(errors, 0.99);
  return d;
}

Floats differencePicture(View<const float> value, View<const float> truth, View<const float> where,
                         float gain) {
  requireSame(value, truth, where);
  Floats picture(truth.width, truth.height, 0.5f);
  for (size_t i = 0; i < truth.pixels(); ++i) {
    const float shade = 0.5f + gain * (value.data[i] - truth.data[i]);
    if (counts(where, i) && std::isfinite(shade))
      picture.view().data[i] = std::clamp(shade, 0.0f, 1.0f);
  }
  return picture;
}

}  // namespace kagefude
