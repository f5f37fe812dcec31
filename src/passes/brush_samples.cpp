#include "passes/brush_samples.h"

#include "image/clones.h"
#include "passes/strip_lookup.h"

namespace kagefude {

LevelTable::LevelTable(const Strip& strip) : last(static_cast<int>(strip.levels.size()) - 1) {
  for (int i = 0; i <= last; ++i) {
    const Strip::Level& level = strip.levels[static_cast<size_t>(i)];
    width[i] = level.width;
    height[i] = level.height;
    offset[i] = level.offset;
  }
}

KAGEFUDE_CLONES
void placeSamples(const LevelTable& levels, SampleList& samples) {
  const float *u = samples.u, *v = samples.v;
  const int* level = samples.level;
  int *__restrict offset = samples.offset, *__restrict right = samples.right,
                  *__restrict down = samples.down;
  float* __restrict fx = samples.fx, * __restrict fy = samples.fy;
  const int count = samples.count;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const int width = levels.width[level[i]], height = levels.height[level[i]];
    const RowPlace row = rowPlace(v[i], height);
    const ColumnPlace column = columnPlace(fractionOf(u[i]), width);
    offset[i] = levels.offset[level[i]] + row.upper * width + column.left;
    right[i] = column.right - column.left;
    down[i] = (row.lower - row.upper) * width;
    fx[i] = column.fraction;
    fy[i] = row.fraction;
  }
}

}  // namespace kagefude
