#pragma once

#include "compositor/light_visibility.h"
#include "passes/casters/coverage.h"
#include "passes/casters/seen_surface.h"
#include "passes/casters/texture_shadow.h"

namespace kagefude {

/// What the caster passes see of a frame; needs its casting scene.
SeenSurface seenSurface(const FramePlanes& frame);

/// Where a light stands for the caster passes.
LightPlace placeOf(const Light& light);

/// The id of the object that shadow.receiver names. Throws InputError naming the nearest.
uint32_t receiverId(const ShadowWork& work);

/// Makes a share that is hidden a visibility.
LightVisibility visibilityFrom(Floats hidden);

}  // namespace kagefude
