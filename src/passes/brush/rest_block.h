#pragma once

#include "passes/brush/brush_block.h"

namespace kagefude {

/// Fills places, their changes and the normals of a block at rest, as the plain pass has them. The
/// block's lines, normals and changes must be loaded: a place changes to the same neighbour as its
/// position.
void loadRest(const BrushInput& in, const ObjectAxes& object, int first, int end, int y,
              BrushBlock& block);

}  // namespace kagefude
