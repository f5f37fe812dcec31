#include "passes/brush/rest_block.h"

#include <algorithm>
#include <cmath>

#include "image/clones.h"
#include "passes/brush/rest_axes.h"

namespace kagefude {
namespace {

using Line = BrushBlock::Line;

/// One component of places at rest, with one neighbour on either side; 0 outside the picture.
struct Places {
  alignas(64) float at[brushBlock + 2];
};

// Pixels [first - 1, end + 1) of row y.
void copyPlaces(const View<const float>& plane, int first, int end, int y, Places& places) {
  const int begin = std::max(first - 1, 0), stop = std::min(end + 1, plane.width);
  places.at[0] = places.at[end - first + 1] = 0.0f;
  if (y < 0 || y >= plane.height)
    std::fill_n(places.at, end - first + 2, 0.0f);
  else
    std::copy_n(plane.row(y) + begin, stop - begin, places.at + (begin - (first - 1)));
}

// 1 where the neighbour behind is taken, -1 where the one before is, 0 for neither; see `changes`.
KAGEFUDE_CLONES
void sidesTaken(const Line& here, const Line& behind, int offsetBehind, const Line& before,
                int offsetBefore, int count, float* __restrict side) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const int c = i + 1, f = i + offsetBehind, b = i + offsetBefore;
    const float fx = behind.x[f] - here.x[c], gx = here.x[c] - before.x[b];
    const float fy = behind.y[f] - here.y[c], gy = here.y[c] - before.y[b];
    const float fz = behind.z[f] - here.z[c], gz = here.z[c] - before.z[b];
    const float lengthF = fx * fx + fy * fy + fz * fz + behind.absent[f];
    const float lengthG = gx * gx + gy * gy + gz * gz + before.absent[b];
    const float taken = lengthG < lengthF ? -1.0f : 1.0f;
    const float least = lengthG < lengthF ? lengthG : lengthF;
    side[i] = least < noChange ? taken : 0.0f;
  }
}

KAGEFUDE_CLONES
void placeChanges(const float* __restrict here, const float* __restrict behind,
                  const float* __restrict before, const float* __restrict side, int count,
                  float* __restrict change) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float forward = behind[i] - here[i], back = here[i] - before[i];
    const float taken = side[i] > 0.0f ? forward : back;
    change[i] = side[i] != 0.0f ? taken : 0.0f;
  }
}

KAGEFUDE_CLONES
void carryNormals(const ObjectAxes& object, int count, BrushBlock& block) {
  const V3f a = object.x, b = object.y, c = object.z;
  const BrushBlock::Change &across = block.across, &down = block.down;
  float* __restrict nx = block.normalX, * __restrict ny = block.normalY, * __restrict nz = block.normalZ;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const RestChange change{
        across.x[i],
        across.y[i],
        across.z[i],
        down.x[i],
        down.y[i],
        down.z[i],
        {block.placeAcross[0][i], block.placeAcross[1][i], block.placeAcross[2][i]},
        {block.placeDown[0][i], block.placeDown[1][i], block.placeDown[2][i]}};
    float x[3] = {a.x, b.x, c.x}, y[3] = {a.y, b.y, c.y}, z[3] = {a.z, b.z, c.z};
    restAxes(change, x, y, z);
    const float onA = x[0] * nx[i] + y[0] * ny[i] + z[0] * nz[i];
    const float onB = x[1] * nx[i] + y[1] * ny[i] + z[1] * nz[i];
    const float onC = x[2] * nx[i] + y[2] * ny[i] + z[2] * nz[i];
    const float length = std::sqrt(onA * onA + onB * onB + onC * onC);
    const float scale = length > 0.0f ? 1.0f / length : 0.0f;
    nx[i] = onA * scale;
    ny[i] = onB * scale;
    nz[i] = onC * scale;
  }
}

}  // namespace

void loadRest(const BrushInput& in, const ObjectAxes& object, int first, int end, int y,
              BrushBlock& block) {
  const int count = end - first;
  alignas(64) float sideAcross[brushBlock], sideDown[brushBlock];
  sidesTaken(block.here, block.here, 2, block.here, 0, count, sideAcross);
  sidesTaken(block.here, block.below, 1, block.above, 1, count, sideDown);
  const View<const float> planes[3] = {in.rest.x, in.rest.y, in.rest.z};
  Places above, here, below;
  for (int k = 0; k < 3; ++k) {
    copyPlaces(planes[k], first, end, y - 1, above);
    copyPlaces(planes[k], first, end, y, here);
    copyPlaces(planes[k], first, end, y + 1, below);
    std::copy_n(here.at + 1, count, block.place[k]);
    placeChanges(here.at + 1, here.at + 2, here.at, sideAcross, count, block.placeAcross[k]);
    placeChanges(here.at + 1, below.at + 1, above.at + 1, sideDown, count, block.placeDown[k]);
  }
  carryNormals(object, count, block);
}

}  // namespace kagefude
