#include <algorithm>
#include <cmath>

#include "compositor/light_visibility.h"
#include "image/parallel.h"

namespace kagefude {

/// What the renderer traced, kept within 0 and 1. What is not a number, and the background, counts
/// as lit.
LightVisibility tracedShadow(const ShadowWork& work) {
  const Floats& traced = work.planes.traced;
  LightVisibility result{Floats(traced.width(), traced.height()), {}};
  parallelRows(traced.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < traced.width(); ++x) {
        const bool lit = std::isnan(traced(x, y)) || work.frame.objectId(x, y) == 0;
        result.visibility(x, y) = lit ? 1.0f : std::clamp(traced(x, y), 0.0f, 1.0f);
      }
  });
  return result;
}

}  // namespace kagefude
