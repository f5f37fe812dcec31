#pragma once

#include <cstdint>
#include <vector>

#include "compositor/frame_planes.h"
#include "image/plane.h"

namespace kagefude {

/// What is seen of one object in one material.
struct Surface {
  uint32_t object = 0;
  uint32_t material = 0;

  bool operator==(const Surface&) const = default;
};

/// The seen surfaces in reading order, and the plane of their numbers, from 1.
struct SurfaceIndex {
  Plane<uint16_t> plane;
  std::vector<Surface> surfaces;
};

/// Material 0 where a frame tells none. Throws InputError where there are more than 65,535.
SurfaceIndex indexSurfaces(const FramePlanes& frame);

}  // namespace kagefude
