#include "passes/tone/surface_joins.h"

#include <algorithm>

#include "image/clones.h"
#include "image/real_math.h"

namespace kagefude {
namespace {

/// Pixels of a row whose neighbours, and the pixels beyond them, all lie in the frame.
struct Span {
  const uint32_t* ids;
  const float *nx, *ny, *nz, *px, *py, *pz;
  ptrdiff_t step;  ///< from a pixel to its neighbour
  float gap2, cosine2;
  int count;
  uint8_t* joins;
};

/// Same as SurfaceJoins::joined, in the same operations, without branches.
KAGEFUDE_CLONES void joinSpan(const Span& span) {
  const Span s = span;
  const auto square = [](float x, float y, float z) __attribute__((always_inline)) {
    return x * x + y * y + z * z;
  };
#pragma GCC ivdep
  for (int i = 0; i < s.count; ++i) {
    const ptrdiff_t q = i + s.step, back = i - s.step, on = q + s.step;
    const float ax = s.nx[i], ay = s.ny[i], az = s.nz[i];
    const float bx = s.nx[q], by = s.ny[q], bz = s.nz[q];
    const float dot = ax * bx + ay * by + az * bz, aa = square(ax, ay, az), bb = square(bx, by, bz);
    const float lengths = aa * bb;
    const bool turned = (dot > 0) & (lengths < 1e30f) & (dot * dot >= s.cosine2 * lengths);

    const float dx = s.px[q] - s.px[i], dy = s.py[q] - s.py[i], dz = s.pz[q] - s.pz[i];
    const float between = square(dx, dy, dz);
    const float before =
        4.0f * square(s.px[back] - s.px[i], s.py[back] - s.py[i], s.pz[back] - s.pz[i]);
    const float after = 4.0f * square(s.px[on] - s.px[q], s.py[on] - s.py[q], s.pz[on] - s.pz[q]);
    float spacing2 = between;
    spacing2 = (s.ids[back] == s.ids[i]) & (before < spacing2) ? before : spacing2;
    spacing2 = (s.ids[on] == s.ids[q]) & (after < spacing2) ? after : spacing2;
    const float offA = dx * ax + dy * ay + dz * az, offB = dx * bx + dy * by + dz * bz;
    const bool near = (between < 1e30f) & (offA * offA <= s.gap2 * spacing2 * aa) &
                      (offB * offB <= s.gap2 * spacing2 * bb);
    s.joins[i] = (s.ids[i] != 0) & (s.ids[i] == s.ids[q]) & turned & near;
  }
}

}  // namespace

SurfaceJoins::SurfaceJoins(View<const uint32_t> ids, Vec3View normal, Vec3View position,
                           const SurfacesParams& params)
    : ids_(ids), normal_(normal), position_(position), gap2_(params.gap * params.gap) {
  const float cosine = sinCosTurns(params.angle / 360.0f).cos;
  cosine2_ = cosine * cosine;
}

void SurfaceJoins::row(int y, NeighbourStep step, uint8_t* joins) const {
  constexpr int margin = 2;  // the pixel beyond a neighbour
  const bool rowsInside = step.dy == 0 || (y >= 1 && y + 2 < ids_.height);
  const bool whole = !normal_.empty() && !position_.empty();
  const int first = margin, end = ids_.width - margin;
  const bool fast = rowsInside && whole && end > first;
  for (int x = 0; x < ids_.width; ++x) {
    if (fast && x == first) x = end;
    joins[x] = joined(x, y, step);
  }
  if (!fast) return;
  const auto at = [&](const auto& plane) { return plane.row(y) + first; };
  joinSpan({at(ids_), at(normal_.x), at(normal_.y), at(normal_.z), at(position_.x), at(position_.y),
            at(position_.z), static_cast<ptrdiff_t>(step.dy) * ids_.width + step.dx, gap2_,
            cosine2_, end - first, joins + first});
}

bool SurfaceJoins::joined(int x, int y, NeighbourStep s) const {
  const int qx = x + s.dx, qy = y + s.dy;
  if (!ids_.contains(qx, qy) || ids_(x, y) == 0 || ids_(x, y) != ids_(qx, qy)) return false;
  return (normal_.empty() || normalsAgree(x, y, qx, qy)) &&
         (position_.empty() || positionsAgree(x, y, s));
}

bool SurfaceJoins::normalsAgree(int x, int y, int qx, int qy) const {
  const V3f a = normal_(x, y), b = normal_(qx, qy);
  const float dot = a.dot(b), lengths = a.dot(a) * b.dot(b);
  return dot > 0 && lengths < 1e30f && dot * dot >= cosine2_ * lengths;
}

bool SurfaceJoins::positionsAgree(int x, int y, NeighbourStep s) const {
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
void SurfaceJoins::lowerByStep(int x, int y, NeighbourStep s, float& spacing2) const {
  const int bx = x + s.dx, by = y + s.dy;
  if (!ids_.contains(bx, by) || ids_(bx, by) != ids_(x, y)) return;
  const V3f d = position_(bx, by) - position_(x, y);
  const float step2 = 4.0f * d.dot(d);
  if (step2 < spacing2) spacing2 = step2;
}

bool SurfaceJoins::nearPlane(const V3f& d, const V3f& n, float spacing2) const {
  const float off = d.dot(n);
  return off * off <= gap2_ * spacing2 * n.dot(n);
}

}  // namespace kagefude
