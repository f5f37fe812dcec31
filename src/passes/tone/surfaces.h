#pragma once

#include "base/parameter.h"
#include "image/plane.h"
#include "image/vec.h"

namespace kagefude {

struct SurfacesParams {
  float angle = 30.0f;  ///< degrees between the normals of neighbours
  float gap = 0.5f;     ///< plane distance of neighbours, as a share of the pixel spacing there
};

inline constexpr Parameter surfacesParameters[] = {
    number<&SurfacesParams::angle>(
        "angle", 0, 89, "degrees",
        "Neighbouring pixels whose normals differ by more belong to different surfaces."),
    number<&SurfacesParams::gap>(
        "gap", 0, 1, "spacing",
        "Neighbouring pixels that lie further off each other's tangent plane than this share of "
        "the distance between neighbours there belong to different surfaces."),
};
inline constexpr ParameterTable surfacesTable{
    "surfaces", "Labels the smoothly connected surfaces of the picture.",
    "002 section 4.2.2 (the ID of a smoothly connected surface); method.md section 6",
    surfacesParameters};

/// Which of its neighbours a pixel is joined to, as bits of a byte.
enum JoinedWay : uint8_t {
  joinedRight = 1,
  joinedDown = 2,
  joinedDownLeft = 4,
  joinedDownRight = 8
};

/// Labels of smoothly connected surfaces: 8-connected pixels of one id whose normals differ by at
/// most `angle` and that lie near each other's tangent plane.
///
/// ids: 0 = background. normal: world space, any length. position: world space, world units. Empty
/// normal or position views leave that test out. Result: 0 = background, else 1, 2 … in the order
/// of each surface's first pixel in raster order, so it is the same for any number of threads.
///
/// Plane distance: for neighbours p and q both |(Q - P)·Np| and |(Q - P)·Nq| must be at most
/// `gap` times the spacing, the smallest of |Q - P| and twice the steps |P - P'| and |Q' - Q| to
/// the pixels beyond on the same line (those of the same id). So a smooth surface passes at any
/// slant (its plane distance is second order), while parallel planes at different heights do not.
///
/// Degenerate: a pixel with NaN or Inf in its normal or position, or a zero normal, is a surface
/// of its own. `joins`, where it is given, becomes a byte a pixel: which neighbours it is joined to
/// directly (JoinedWay). Throws InputError when the planes differ in size.
/// Cost: linear in pixels whatever the number of ids; 8 bytes a pixel with the result.
Labels labelSurfaces(View<const uint32_t> ids, Vec3View normal, Vec3View position,
                     const SurfacesParams& params, Bytes* joins = nullptr);

}  // namespace kagefude
