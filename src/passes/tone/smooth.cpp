#include "passes/tone/smooth.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <unordered_map>
#include <vector>

#include "image/clones.h"
#include "image/window.h"
#include "passes/require_size.h"

namespace kagefude {
namespace {

constexpr int tileSide = 128;

/// Turns every element into the sum of itself and the n - 1 elements after it (stride apart), for
/// `count` positions of `lane` neighbouring elements each; the last n - 1 positions are spoilt.
/// Adds by doubling; `sum` is scratch of the same size.
KAGEFUDE_CLONES void windowSums(float* data, float* sum, int count, int lane, int n) {
  std::fill(sum, sum + static_cast<ptrdiff_t>(count) * lane, 0.0f);
  int done = 0;  // elements of the window that are summed already
  for (int size = 1; size <= n; size *= 2) {
    if (n & size) {
      const ptrdiff_t end = static_cast<ptrdiff_t>(count - done) * lane;
      const float* const from = data + static_cast<ptrdiff_t>(done) * lane;
      for (ptrdiff_t i = 0; i < end; ++i) sum[i] += from[i];
      done += size;
    }
    const ptrdiff_t reach = static_cast<ptrdiff_t>(size) * lane;
    const ptrdiff_t end = static_cast<ptrdiff_t>(count) * lane - reach;
    for (ptrdiff_t i = 0; i < end; ++i) data[i] += data[i + reach];
  }
  std::copy(sum, sum + static_cast<ptrdiff_t>(count) * lane, data);
}

/// Copies values (or ones) of one label and zeros elsewhere.
KAGEFUDE_CLONES void maskRow(const float* value, const uint32_t* labels, uint32_t label, int count,
                             float* values, float* ones) {
  for (int i = 0; i < count; ++i) {
    values[i] = labels[i] == label ? value[i] : 0.0f;
    ones[i] = labels[i] == label ? 1.0f : 0.0f;
  }
}

KAGEFUDE_CLONES bool allAre(const uint32_t* labels, uint32_t label, int count) {
  uint32_t other = 0;
  for (int i = 0; i < count; ++i) other |= labels[i] ^ label;
  return other == 0;
}

/// Whether all are 0 to the bit.
KAGEFUDE_CLONES bool allZero(const float* value, int count) {
  uint32_t any = 0;
  for (int i = 0; i < count; ++i) any |= std::bit_cast<uint32_t>(value[i]);
  return any == 0;
}

KAGEFUDE_CLONES void divideRow(const float* sums, const float* columns, float rows, int count,
                               float* means) {
  for (int i = 0; i < count; ++i) means[i] = sums[i] / (rows * columns[i]);
}

/// Sums of one label's values and pixels, kept from tile to tile: new ones would cost page faults.
struct Scratch {
  std::vector<float> values, ones, sum;
};

/// One tile: its own pixels, and the frame it reads around them.
class Tile {
 public:
  Tile(View<const float> value, View<const uint32_t> labels, int h, View<float> result, Window own,
       Scratch& scratch)
      : value_(value), labels_(labels), h_(h), result_(result), own_(own), scratch_(scratch) {}

  void run() {
    if (isEmpty(
            insideFrame({own_.x - h_, own_.y - h_, own_.width + 2 * h_, own_.height + 2 * h_}))) {
      for (int y = own_.y; y < own_.y + own_.height; ++y)
        std::fill_n(result_.row(y) + own_.x, own_.width, 0.0f);
      return;
    }
    const uint32_t first = labels_(own_.x, own_.y);
    if (first != 0 && isUniform(own_, first)) {
      sumLabel(first, own_);
      return;
    }
    findLabels();
    double cost = 0;
    for (const auto& [label, box] : boxes_)
      cost += static_cast<double>(box.width + 2 * h_) * (box.height + 2 * h_);
    // Measured: a masked pixel costs about a fifth of one step of the sliding window.
    if (boxes_.size() > 8 && cost > 5.0 * (2 * h_ + 1) * static_cast<double>(own_.pixels())) {
      slide();
      return;
    }
    for (const auto& [label, box] : boxes_) sumLabel(label, box);
  }

 private:
  void findLabels() {
    for (int y = own_.y; y < own_.y + own_.height; ++y) {
      const uint32_t* const label = labels_.row(y);
      for (int x = own_.x, end; x < own_.x + own_.width; x = end) {
        for (end = x; end < own_.x + own_.width && label[end] == label[x];) ++end;
        if (label[x] == 0) {
          std::copy(value_.row(y) + x, value_.row(y) + end, result_.row(y) + x);
        } else {
          include(boxes_.try_emplace(label[x], Window{x, y, 0, 0}).first->second, x, end, y);
        }
      }
    }
  }

  static void include(Window& box, int x0, int x1, int y) {
    const int right = std::max(box.x + box.width, x1);
    box.x = std::min(box.x, x0);
    box.width = right - box.x;
    box.height = y + 1 - box.y;
  }

  /// Means over the label's box, from its surroundings too; outside the frame is nothing.
  void sumLabel(uint32_t label, const Window& box) {
    const Window reach{box.x - h_, box.y - h_, box.width + 2 * h_, box.height + 2 * h_};
    const Window seen = insideFrame(reach);
    const auto size = static_cast<size_t>(reach.pixels());
    scratch_.sum.resize(size);
    scratch_.values.assign(size, 0.0f);
    if (isUniform(seen, label)) {
      for (int y = seen.y; y < seen.y + seen.height; ++y)
        std::copy_n(value_.row(y) + seen.x, seen.width, &scratch_.values[at(reach, seen.x, y)]);
      sumWindows(scratch_.values, reach, box);
      storeUniform(reach, box);
      return;
    }
    scratch_.ones.assign(size, 0.0f);
    for (int y = seen.y; y < seen.y + seen.height; ++y)
      maskRow(value_.row(y) + seen.x, labels_.row(y) + seen.x, label, seen.width,
              &scratch_.values[at(reach, seen.x, y)], &scratch_.ones[at(reach, seen.x, y)]);
    sumWindows(scratch_.values, reach, box);
    sumWindows(scratch_.ones, reach, box);
    storeMasked(label, reach, box);
  }

  Window insideFrame(const Window& w) const {
    const int x0 = std::max(w.x, 0), x1 = std::min(w.x + w.width, labels_.width);
    const int y0 = std::max(w.y, 0), y1 = std::min(w.y + w.height, labels_.height);
    return {x0, y0, x1 - x0, y1 - y0};
  }

  static size_t at(const Window& reach, int x, int y) {
    return static_cast<size_t>(y - reach.y) * static_cast<size_t>(reach.width) +
           static_cast<size_t>(x - reach.x);
  }

  bool isUniform(const Window& w, uint32_t label) const {
    for (int y = w.y; y < w.y + w.height; ++y)
      if (!allAre(labels_.row(y) + w.x, label, w.width)) return false;
    return true;
  }

  /// Whether there is nothing to average.
  bool isEmpty(const Window& w) const {
    for (int y = w.y; y < w.y + w.height; ++y)
      if (!allZero(value_.row(y) + w.x, w.width)) return false;
    return true;
  }

  /// The sum over the window that begins at each pixel of the box's rows and columns in `reach`.
  void sumWindows(std::vector<float>& plane, const Window& reach, const Window& box) {
    const int n = 2 * h_ + 1;
    windowSums(plane.data(), scratch_.sum.data(), reach.height, reach.width, n);
    for (int row = 0; row < box.height; ++row)
      windowSums(plane.data() + static_cast<size_t>(row) * static_cast<size_t>(reach.width),
                 scratch_.sum.data(), reach.width, 1, n);
  }

  void storeUniform(const Window& reach, const Window& box) const {
    float columns[tileSide];
    for (int i = 0; i < box.width; ++i)
      columns[i] = static_cast<float>(windowIn(box.x + i, labels_.width));
    for (int y = box.y; y < box.y + box.height; ++y)
      divideRow(&scratch_.values[static_cast<size_t>(y - box.y) * static_cast<size_t>(reach.width)],
                columns, static_cast<float>(windowIn(y, labels_.height)), box.width,
                result_.row(y) + box.x);
  }

  /// Rows or columns of the window round a place that lie in the frame.
  int windowIn(int place, int side) const {
    return std::min(place + h_, side - 1) - std::max(place - h_, 0) + 1;
  }

  void storeMasked(uint32_t label, const Window& reach, const Window& box) const {
    for (int row = 0; row < box.height; ++row) {
      const uint32_t* const here = labels_.row(box.y + row) + box.x;
      float* const out = result_.row(box.y + row) + box.x;
      const size_t from = static_cast<size_t>(row) * static_cast<size_t>(reach.width);
      for (int i = 0; i < box.width; ++i)
        if (here[i] == label) out[i] = scratch_.values[from + i] / scratch_.ones[from + i];
    }
  }

  /// One window slid along each row, with a running sum and count for every label in reach.
  void slide() {
    const int x0 = std::max(own_.x - h_, 0), x1 = std::min(own_.x + own_.width + h_, labels_.width);
    for (int y = own_.y; y < own_.y + own_.height; ++y) {
      running_.clear();
      const int y0 = std::max(y - h_, 0), y1 = std::min(y + h_ + 1, labels_.height);
      for (int x = x0; x < std::min(own_.x + h_, x1); ++x) addColumn(x, y0, y1, 1);
      for (int x = own_.x; x < own_.x + own_.width; ++x) {
        if (x + h_ < x1) addColumn(x + h_, y0, y1, 1);
        if (x - h_ - 1 >= x0) addColumn(x - h_ - 1, y0, y1, -1);
        const uint32_t label = labels_(x, y);
        if (label == 0) continue;
        const Running& r = running_[label];
        result_(x, y) = static_cast<float>(r.sum / r.count);
      }
    }
  }

  void addColumn(int x, int y0, int y1, int sign) {
    for (int y = y0; y < y1; ++y) {
      if (labels_(x, y) == 0) continue;
      Running& r = running_[labels_(x, y)];
      r.sum += sign * static_cast<double>(value_(x, y));
      r.count += sign;
    }
  }

  struct Running {
    double sum = 0;
    int count = 0;
  };

  View<const float> value_;
  View<const uint32_t> labels_;
  int h_;
  View<float> result_;
  Window own_;
  std::unordered_map<uint32_t, Window> boxes_;
  std::unordered_map<uint32_t, Running> running_;
  Scratch& scratch_;
};

}  // namespace

Floats smoothWithinSurfaces(View<const float> value, View<const uint32_t> labels,
                            const SmoothParams& params) {
  requireSize("the visibility to smooth", value, labels.width, labels.height);
  Floats result(labels.width, labels.height);
  const int across = (labels.width + tileSide - 1) / tileSide;
  const int down = (labels.height + tileSide - 1) / tileSide;
  tbb::enumerable_thread_specific<Scratch> scratch;
  tbb::parallel_for(0, across * down, [&](int i) {
    const int x = i % across * tileSide, y = i / across * tileSide;
    Tile(value, labels, params.h, result,
         {x, y, std::min(tileSide, labels.width - x), std::min(tileSide, labels.height - y)},
         scratch.local())
        .run();
  });
  return result;
}

}  // namespace kagefude
