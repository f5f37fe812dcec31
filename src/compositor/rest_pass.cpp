#include "compositor/rest_pass.h"

#include <limits>

#include "image/parallel.h"

namespace kagefude {

void markWithoutRest(View<const float> alpha, Vec3Plane& rest) {
  parallelRows(rest.x.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < rest.x.width(); ++x) {
        const V3f p = rest.view()(x, y);
        const float sum = p.x + p.y + p.z;
        const bool held = sum - sum == 0.0f && p != V3f(0.0f);
        if (!held || (!alpha.empty() && !(alpha(x, y) > 0.0f)))
          rest.x(x, y) = std::numeric_limits<float>::quiet_NaN();
      }
  });
}

}  // namespace kagefude
