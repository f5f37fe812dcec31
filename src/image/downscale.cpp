#include "image/downscale.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>
#include <utility>
#include <vector>

namespace kagefude {
namespace {

int64_t floorDivide(int64_t value, int64_t by) {
  return value >= 0 ? value / by : -((-value + by - 1) / by);
}

/// First and size of what `size` pixels from `first` on fall into.
std::pair<int, int> reduced(int first, int size, int scale) {
  const int64_t low = floorDivide(first, scale);
  const int64_t high = -floorDivide(-(int64_t{first} + size), scale);
  return {static_cast<int>(low), static_cast<int>(high - low)};
}

template <class Divisor>
Floats boxes(const Downscale& squares, View<const float> plane, const Divisor& divisor) {
  const Window& window = squares.window();
  Floats result(window.width, window.height);
  parallelRows(window.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < window.width; ++x) {
        const BoxSpan across = squares.across(x), down = squares.down(y);
        result(x, y) =
            static_cast<float>(boxSum<double>(across, down, plane) / divisor(across, down));
      }
  });
  return result;
}

/// The label that most of a square has; of equal ones the least.
uint32_t commonest(View<const uint32_t> labels, const BoxSpan& across, const BoxSpan& down,
                   std::vector<uint32_t>& found) {
  found.clear();
  for (int y = down.first; y < down.end; ++y)
    for (int x = across.first; x < across.end; ++x) found.push_back(labels(x, y));
  std::sort(found.begin(), found.end());
  uint32_t best = found.front();
  size_t most = 0;
  for (size_t i = 0; i < found.size();) {
    const size_t first = i;
    while (i < found.size() && found[i] == found[first]) ++i;
    if (i - first <= most) continue;
    most = i - first;
    best = found[first];
  }
  return best;
}

}  // namespace

Downscale::Downscale(const Window& large, int scale) : large_(large), scale_(scale) {
  std::tie(small_.x, small_.width) = reduced(large.x, large.width, scale);
  std::tie(small_.y, small_.height) = reduced(large.y, large.height, scale);
}

BoxSpan Downscale::span(int place, int first, int size) const {
  const int64_t begin = int64_t{place} * scale_ - first;
  return {static_cast<int>(std::max<int64_t>(begin, 0)),
          static_cast<int>(std::min<int64_t>(begin + scale_, size))};
}

Floats Downscale::mean(View<const float> plane) const {
  return boxes(*this, plane,
               [](const BoxSpan& across, const BoxSpan& down) { return pixelsIn(across, down); });
}

Floats Downscale::share(View<const float> plane) const {
  return boxes(*this, plane, [&](const BoxSpan&, const BoxSpan&) { return scale_ * scale_; });
}

Labels Downscale::standing(View<const uint32_t> labels) const {
  Labels places(small_.width, small_.height);
  parallelRows(small_.height, [&](int first, int end) {
    std::vector<uint32_t> found;
    for (int y = first; y < end; ++y)
      for (int x = 0; x < small_.width; ++x) {
        const BoxSpan across = this->across(x), down = this->down(y);
        const uint32_t label = commonest(labels, across, down, found);
        int nearest = -1;
        for (int v = down.first; v < down.end; ++v)
          for (int u = across.first; u < across.end; ++u) {
            const int distance = std::abs(2 * u - across.first - across.end + 1) +
                                 std::abs(2 * v - down.first - down.end + 1);
            if (labels(u, v) != label || (nearest >= 0 && distance >= nearest)) continue;
            nearest = distance;
            places(x, y) = static_cast<uint32_t>(v) * static_cast<uint32_t>(labels.width) +
                           static_cast<uint32_t>(u);
          }
      }
  });
  return places;
}

}  // namespace kagefude
