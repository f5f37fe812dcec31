#pragma once

#include <string>
#include <vector>

#include "compositor/frame_plan.h"
#include "compositor/frame_planes.h"
#include "frame/coverage_planes.h"

namespace kagefude {

/// How many pixels of a Cryptomatte were mended.
struct MendedCoverage {
  size_t impossible = 0;  ///< see clearImpossibleCoverage
  size_t none = 0;        ///< a thing is seen that covers nothing
};

/// Mends the coverage that edges are made of. Where a thing is seen at a pixel's centre, something
/// covers the pixel; at its rim the few samples of a render may all miss it, inside it they cannot.
/// So a pixel that nothing covers, and round which the 3x3 shows that one thing, is damaged, and in
/// a frame that has such a pixel all things that are seen without coverage cover their pixels
/// wholly. Healthy frames keep their bits. Wants ids of what is seen alone, with the ranks of what
/// is not painted still in them. Cost: reads the first rank.
MendedCoverage mendCoverage(const FramePlan& plan, FramePlanes& planes);

/// The same of a Cryptomatte that the ids themselves are made from: what is seen is the first
/// rank's id, where there is a normal.
MendedCoverage mendNamed(const Vec3Plane& normal, CoveragePlanes& matte);

/// Says it, once for each Cryptomatte.
void noteMended(const std::string& name, const MendedCoverage& mended,
                std::vector<std::string>& warnings);

}  // namespace kagefude
