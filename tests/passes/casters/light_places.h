#pragma once

#include "passes/traced_scene.h"

// Lights for the tests of casters' shadows.
namespace kagefude::test {

inline LightPlace pointAt(const V3d& position) { return {false, position, V3d(0.0)}; }
inline LightPlace sunAlong(const V3d& direction) { return {true, V3d(0.0), direction}; }

}  // namespace kagefude::test
