#include "passes/brush/brush_samples.h"

#include "image/clones.h"
#include "passes/strip/strip_lookup.h"

namespace kagefude {

LevelTable::LevelTable(const Strip& strip) : last(static_cast<int>(strip.levels.size()) - 1) {
  for (int i = 0; i <= last; ++i) {
    const Strip::Level& level = strip.levels[static_cast<size_t>(i)];
    width[i] = level.width;
    height[i] = level.height;
    offset[i] = level.offset;
  }
}

namespace {

// Sizes of each sample's level, into the arrays that the columns and rows are then found in.
KAGEFUDE_CLONES
void findLevels(const LevelTable& levels, int count, SampleList& samples) {
  const int* level = samples.level;
  int *__restrict right = samples.right, *__restrict down = samples.down,
                  *__restrict offset = samples.offset;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    right[i] = levels.width[level[i]];
    down[i] = levels.height[level[i]];
    offset[i] = levels.offset[level[i]];
  }
}

KAGEFUDE_CLONES
void findRows(int count, SampleList& samples) {
  const float* v = samples.v;
  const int* width = samples.right;
  int* __restrict down = samples.down, * __restrict offset = samples.offset;
  float* __restrict fy = samples.fy;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const RowPlace row = rowPlace(v[i], down[i]);
    offset[i] += row.upper * width[i];
    down[i] = (row.lower - row.upper) * width[i];
    fy[i] = row.fraction;
  }
}

KAGEFUDE_CLONES
void wrapPlaces(int count, float* __restrict u) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) u[i] = fractionOf(u[i]);
}

KAGEFUDE_CLONES
void findColumns(int count, SampleList& samples) {
  const float* u = samples.u;
  int* __restrict right = samples.right, * __restrict offset = samples.offset;
  float* __restrict fx = samples.fx;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const ColumnPlace column = columnPlace(u[i], right[i]);
    offset[i] += column.left;
    right[i] = column.right - column.left;
    fx[i] = column.fraction;
  }
}

}  // namespace

void placeSamples(const LevelTable& levels, SampleList& samples) {
  const int count = samples.count;
  findLevels(levels, count, samples);
  wrapPlaces(count, samples.u);
  findRows(count, samples);
  findColumns(count, samples);
}

}  // namespace kagefude
