#include "passes/surfaces.h"

#include <vector>

#include "image/parallel.h"
#include "image/real_math.h"
#include "passes/require_size.h"

namespace kagefude {
namespace {

struct Step {
  int dx, dy;
};
// Each pair of neighbours is looked at once, from the pixel that comes first in raster order.
constexpr Step steps[] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
constexpr int bandRows = 64;

/// Decides whether two neighbours belong to one surface.
class Joins {
 public:
  Joins(View<const uint32_t> ids, Vec3View normal, Vec3View position, const SurfacesParams& params)
      : ids_(ids), normal_(normal), position_(position), gap2_(params.gap * params.gap) {
    const float cosine = sinCosTurns(params.angle / 360.0f).cos;
    cosine2_ = cosine * cosine;
  }

  bool operator()(int x, int y, Step s) const {
    const int qx = x + s.dx, qy = y + s.dy;
    if (!ids_.contains(qx, qy) || ids_(x, y) == 0 || ids_(x, y) != ids_(qx, qy)) return false;
    return (normal_.empty() || normalsAgree(x, y, qx, qy)) &&
           (position_.empty() || positionsAgree(x, y, s));
  }

 private:
  bool normalsAgree(int x, int y, int qx, int qy) const {
    const V3f a = normal_(x, y), b = normal_(qx, qy);
    const float dot = a.dot(b), lengths = a.dot(a) * b.dot(b);
    return dot > 0 && lengths < 1e30f && dot * dot >= cosine2_ * lengths;
  }

  bool positionsAgree(int x, int y, Step s) const {
    const V3f p = position_(x, y), q = position_(x + s.dx, y + s.dy), d = q - p;
    float spacing2 = d.dot(d);
    if (!(spacing2 < 1e30f)) return false;
    lowerByStep(x, y, {-s.dx, -s.dy}, spacing2);
    lowerByStep(x + s.dx, y + s.dy, s, spacing2);
    if (normal_.empty()) return true;
    return nearPlane(d, normal_(x, y), spacing2) &&
           nearPlane(d, normal_(x + s.dx, y + s.dy), spacing2);
  }

  /// Lowers the squared spacing to four times that of the step s from (x, y), if that is smaller.
  void lowerByStep(int x, int y, Step s, float& spacing2) const {
    const int bx = x + s.dx, by = y + s.dy;
    if (!ids_.contains(bx, by) || ids_(bx, by) != ids_(x, y)) return;
    const V3f d = position_(bx, by) - position_(x, y);
    const float step2 = 4.0f * d.dot(d);
    if (step2 < spacing2) spacing2 = step2;
  }

  bool nearPlane(const V3f& d, const V3f& n, float spacing2) const {
    const float off = d.dot(n);
    return off * off <= gap2_ * spacing2 * n.dot(n);
  }

  View<const uint32_t> ids_;
  Vec3View normal_, position_;
  float gap2_, cosine2_;
};

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

void joinRow(const Joins& joins, const Forest& forest, int y, int width, bool sameRow,
             bool nextRow) {
  const uint32_t start = static_cast<uint32_t>(y) * static_cast<uint32_t>(width);
  for (int x = 0; x < width; ++x)
    for (const Step s : steps) {
      if (s.dy == 0 ? !sameRow : !nextRow) continue;
      const uint32_t i = start + static_cast<uint32_t>(x);
      if (joins(x, y, s)) forest.unite(i, i + static_cast<uint32_t>(s.dy * width + s.dx));
    }
}

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
                     const SurfacesParams& params) {
  const int width = ids.width, height = ids.height;
  if (!normal.empty()) requireSize("the normal pass", normal, width, height);
  if (!position.empty()) requireSize("the position pass", position, width, height);
  Labels parents(width, height), labels(width, height);
  const Forest forest{parents.view().data};
  const Joins joins(ids, normal, position, params);
  parallelRows(height, bandRows, [&](int y0, int y1) {
    for (size_t i = static_cast<size_t>(y0) * width; i < static_cast<size_t>(y1) * width; ++i)
      forest.parent[i] = static_cast<uint32_t>(i);
    for (int y = y0; y < y1; ++y) joinRow(joins, forest, y, width, true, y + 1 < y1);
  });
  for (int y = bandRows - 1; y + 1 < height; y += bandRows)
    joinRow(joins, forest, y, width, false, true);
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
