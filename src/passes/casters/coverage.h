#pragma once

#include <array>

#include "base/parameter.h"
#include "image/plane.h"
#include "passes/casters/caster_set.h"
#include "passes/casters/seen_surface.h"
#include "passes/casters/shadow_wedges.h"

namespace kagefude {

struct CoverageParams {
  bool selfShadow = true;
  float strength = 1.0f;
  float bias = 0.0005f;  ///< pixels
};

inline constexpr std::array coverageParameters = {
    plain<&CoverageParams::selfShadow>(
        "self_shadow",
        "Lets an object throw its shadow on itself; off leaves out the receiver's "
        "own triangles, as the seed does."),
    number<&CoverageParams::strength>("strength", 0, 1, "",
                                      "How much of the light a full shadow takes away."),
    number<&CoverageParams::bias>(
        "bias", 0, 10, "rendered pixels",
        "How far surfaces are lifted off themselves before they are tested."),
};

inline constexpr ParameterTable coverageTable = {
    "coverage", "Shares of pixels in hard shadow, from shadow volumes cut at 8x8 sub-pixels.",
    "004", coverageParameters};

/// Share of each pixel in shadow, 0 to 1 in steps of 1/64 (of the sub-pixels that show a surface):
/// the shadow volume of every casting triangle is cut with the surface seen in the pixel,
/// sub-pixels inside set bits of a 64-bit mask, the masks of all casters are OR-ed, and coverage is
/// the count of bits over 64 (004 2.2-2.4). Background is 0. The receiver's own object is kept or
/// left out by selfShadow, per sub-pixel.
///
/// Departures from the seed: planes of the volume are evaluated at the sub-pixels themselves rather
/// than interpolated between scanlines, so no case needs exact treatment apart; volumes are always
/// those of single triangles, whose union is the component's volume whether it is convex, closed or
/// neither; the displayed polygon comes from P, N and the casters (SurfaceSampler).
///
/// Points are lifted off their surface by `bias` pixels (plus 4e-6 of their distance, for
/// rounding) to the side that the camera sees: a contact keeps that much of a gap, a lit sheet does
/// not shade itself, and its far side lies in its shadow. Camera inside a volume, casters behind
/// it, open and concave meshes need no care: nothing is counted along the line of sight. A light on
/// or inside a caster is hidden by it. No casters: all 0. Same bits for any number of threads.
///
/// Cost: tiles of 8x8 whose whole surface is lit, or inside one triangle's volume, cost one descent
/// of the tree; only pixels with an edge, or under many small triangles, are cut at sub-pixels.
/// Memory: 4 bytes a pixel and about 160 a triangle. Throws InputError when planes differ in size.
Floats shadowCoverage(const SeenSurface& surface, const CasterSet& casters, const LightPlace& light,
                      const CoverageParams& params);

/// Hard visibility mask at pixel centres: 1 = the light is seen, 0 = hidden; background is 1. The
/// same volumes and bias as shadowCoverage, tested at P alone, so K places of a moved light cost
/// K cheap masks for the visibility of the light's shape. Throws as shadowCoverage.
Bytes hardShadowMask(const SeenSurface& surface, const CasterSet& casters, const LightPlace& light,
                     const CoverageParams& params);

/// Visibility of one light as the light sum needs it: 1 - k c, with c the coverage and k the
/// strength (004 2.4). In place.
void coverageToVisibility(View<float> coverage, const CoverageParams& params);

}  // namespace kagefude
