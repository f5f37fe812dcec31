#include <algorithm>

#include "compositor/light_visibility.h"

namespace kagefude {

LightVisibility slopeShadow(const ShadowWork& work) {
  Floats visibility(work.frame.width, work.frame.height, 1.0f);
  for (int y = 0; y < work.frame.height; ++y)
    for (int x = 0; x < work.frame.width; ++x)
      if (work.frame.objectId(x, y) != 0)
        visibility(x, y) = std::clamp(work.frame.normal.z(x, y), 0.0f, 1.0f);
  return {std::move(visibility), {}};
}

}  // namespace kagefude
