#include "compositor/light_visibility.h"

namespace kagefude {

LightVisibility hardShadow(const ShadowWork& work) {
  const View<const uint8_t> mask = work.planes.masks.at(0);
  Floats visibility(mask.width, mask.height);
  for (size_t i = 0; i < mask.pixels(); ++i) visibility.row(0)[i] = mask.data[i] ? 1.0f : 0.0f;
  return {std::move(visibility), {}};
}

}  // namespace kagefude
