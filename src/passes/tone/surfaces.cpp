#include "passes/tone/surfaces.h"

#include <algorithm>
#include <vector>

#include "image/parallel.h"
#include "passes/require_size.h"
#include "passes/tone/surface_joins.h"

namespace kagefude {
namespace {

constexpr int bandRows = 64;

/// Union-find over pixel indices in which the root is always the smallest index of its set, that
/// is the first pixel in raster order; so the outcome does not depend on the order of unions.
struct Forest {
  uint32_t* parent;

  uint32_t root(uint32_t i) const {
    while (parent[i] != i) {
      parent[i] = parent[parent[i]];
      i = parent[i];
    }
    return i;
  }
  uint32_t rootOnly(uint32_t i) const {
    while (parent[i] != i) i = parent[i];
    return i;
  }
  void unite(uint32_t a, uint32_t b) const {
    a = root(a);
    b = root(b);
    if (a < b) {
      parent[b] = a;
    } else {
      parent[a] = b;
    }
  }
};

/// Joins of two neighbouring rows, and what has to be united for them: where a loop of other joins
/// connects two pixels anyway, nothing is.
class RowPair {
 public:
  RowPair(const SurfaceJoins& joins, const Forest& forest, int width, View<uint8_t> kept)
      : joins_(joins), forest_(forest), width_(width), kept_(kept) {
    for (std::vector<uint8_t>* row : {&upper_, &lower_, &down_, &left_, &right_})
      row->resize(static_cast<size_t>(width) + 1, 0);
  }

  /// Sets the parents of a row's pixels to the first of their run, and keeps its joins as the lower
  /// row's.
  void startRow(int y) {
    readRow(y);
    if (y + 1 == kept_.height) std::copy_n(lower_.data() + 1, width_, kept_.row(y));
    uint32_t* const parent = forest_.parent + static_cast<size_t>(y) * static_cast<size_t>(width_);
    uint32_t first = 0;
    for (int x = 0; x < width_; ++x) {
      const uint32_t i =
          static_cast<uint32_t>(y) * static_cast<uint32_t>(width_) + static_cast<uint32_t>(x);
      first = x > 0 && lower_[static_cast<size_t>(x)] ? first : i;
      parent[x] = first;
    }
  }

  /// Keeps the joins within a row as the lower row's, without touching parents.
  void readRow(int y) {
    std::swap(upper_, lower_);
    joins_.row(y, {1, 0}, lower_.data() + 1);
  }

  /// Unites row y, the upper one, with the row below it.
  void uniteDown(int y) {
    joins_.row(y, {0, 1}, down_.data() + 1);
    joins_.row(y, {-1, 1}, left_.data() + 1);
    joins_.row(y, {1, 1}, right_.data() + 1);
    if (!kept_.empty()) keep(kept_.row(y));
    const uint32_t start = static_cast<uint32_t>(y) * static_cast<uint32_t>(width_);
    const uint32_t below = static_cast<uint32_t>(width_);
    // Index k is pixel k - 1: lower_[k], upper_[k] join it to the pixel after it.
    for (int x = 0; x < width_; ++x) {
      const auto k = static_cast<size_t>(x) + 1;
      const uint32_t i = start + static_cast<uint32_t>(x);
      const bool square = (upper_[k - 1] & lower_[k - 1]) != 0;
      if (down_[k] && !(square && down_[k - 1])) forest_.unite(i, i + below);
      if (left_[k] && !(down_[k] && lower_[k - 1]) && !(upper_[k - 1] && down_[k - 1]))
        forest_.unite(i, i + below - 1);
      if (right_[k] && !(down_[k] && lower_[k]) && !(upper_[k] && down_[k + 1]))
        forest_.unite(i, i + below + 1);
    }
  }

 private:
  /// All joins of the upper row; the last row of a picture has only those to the right.
  void keep(uint8_t* __restrict to) const {
    static_assert(joinedRight == 1 && joinedDown == 2 && joinedDownLeft == 4 &&
                  joinedDownRight == 8);
    const uint8_t *along = upper_.data() + 1, *down = down_.data() + 1;
    const uint8_t *left = left_.data() + 1, *right = right_.data() + 1;
    for (int x = 0; x < width_; ++x)
      to[x] = static_cast<uint8_t>(along[x] + 2 * (down[x] + 2 * (left[x] + 2 * right[x])));
  }

  const SurfaceJoins& joins_;
  const Forest& forest_;
  int width_;
  View<uint8_t> kept_;                        ///< all joins of the picture; may be empty
  std::vector<uint8_t> upper_, lower_;        ///< to the next pixel of the row
  std::vector<uint8_t> down_, left_, right_;  ///< from the upper row to the lower
};

/// Numbers the roots from 1 in raster order; number[i] is set at roots only.
void numberRoots(const Forest& forest, View<const uint32_t> ids, uint32_t* number) {
  const int bands = (ids.height + bandRows - 1) / bandRows;
  std::vector<uint32_t> first(static_cast<size_t>(bands) + 1, 0);
  const size_t width = static_cast<size_t>(ids.width);
  const auto isRoot = [&](size_t i) { return ids.data[i] != 0 && forest.parent[i] == i; };
  parallelRows(ids.height, bandRows, [&](int y0, int y1) {
    uint32_t count = 0;
    for (size_t i = y0 * width; i < y1 * width; ++i) count += isRoot(i);
    first[static_cast<size_t>(y0 / bandRows) + 1] = count;
  });
  for (size_t band = 1; band < first.size(); ++band) first[band] += first[band - 1];
  parallelRows(ids.height, bandRows, [&](int y0, int y1) {
    uint32_t next = first[static_cast<size_t>(y0 / bandRows)];
    for (size_t i = y0 * width; i < y1 * width; ++i)
      if (isRoot(i)) number[i] = ++next;
  });
}

}  // namespace

Labels labelSurfaces(View<const uint32_t> ids, Vec3View normal, Vec3View position,
                     const SurfacesParams& params, Bytes* kept) {
  const int width = ids.width, height = ids.height;
  if (!normal.empty()) requireSize("the normal pass", normal, width, height);
  if (!position.empty()) requireSize("the position pass", position, width, height);
  Labels parents(width, height), labels(width, height);
  const Forest forest{parents.view().data};
  const SurfaceJoins joins(ids, normal, position, params);
  if (kept) *kept = Bytes(width, height);
  const View<uint8_t> keptView = kept ? kept->view() : View<uint8_t>();
  parallelRows(height, bandRows, [&](int y0, int y1) {
    RowPair rows(joins, forest, width, keptView);
    for (int y = y0; y < y1; ++y) {
      rows.startRow(y);
      if (y > y0) rows.uniteDown(y - 1);
    }
  });
  RowPair seam(joins, forest, width, keptView);
  for (int y = bandRows; y < height; y += bandRows) {
    seam.readRow(y - 1);
    seam.readRow(y);
    seam.uniteDown(y - 1);
  }
  uint32_t* const number = labels.view().data;
  numberRoots(forest, ids, number);
  // Roots keep their number, so writing the others in any order reads only finished values.
  parallelRows(height, bandRows, [&](int y0, int y1) {
    for (size_t i = static_cast<size_t>(y0) * width; i < static_cast<size_t>(y1) * width; ++i) {
      const uint32_t root = forest.rootOnly(static_cast<uint32_t>(i));
      if (ids.data[i] == 0) {
        number[i] = 0;
      } else if (root != i) {
        number[i] = number[root];
      }
    }
  });
  return labels;
}

}  // namespace kagefude
