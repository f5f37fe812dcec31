#include "compositor/light_visibility.h"
#include "passes/light_shape/light_shape.h"

namespace kagefude {

LightVisibility lightShapeShadow(const ShadowWork& work) {
  const LightShapeParams& params = work.light.passes.lightShape;
  LightShapeResult shape = lightShapeVisibility(viewsOf(work.planes.masks), work.light.places,
                                                labelsFor(params.bound, work), work.frame.position,
                                                work.frame.normal, work.light.geometry, params);
  return {std::move(shape.visibility), std::move(shape.confidence)};
}

}  // namespace kagefude
