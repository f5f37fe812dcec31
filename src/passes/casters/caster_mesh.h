#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "image/vec.h"

namespace kagefude {

/// The triangles of one object that throws shadows. No order, closedness or consistent winding is
/// asked for: every triangle throws its own shadow, and the shadows are united.
struct CasterMesh {
  std::string object;
  uint32_t id = 0;  ///< the object's value in the ID plane; 0 = appears in no pixel
  std::vector<V3f> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};

/// What was wrong with a mesh. Triangles of the first three kinds are dropped; the last two kinds
/// are right as they are and only counted.
struct CasterFaults {
  size_t badIndices = 0;        ///< triangles that name a vertex that does not exist
  size_t nonFinite = 0;         ///< triangles with a NaN or infinite corner
  size_t degenerate = 0;        ///< triangles without area
  size_t openEdges = 0;         ///< edges with one triangle (vertices at one place count as one)
  size_t nonManifoldEdges = 0;  ///< edges with three or more triangles

  size_t dropped() const { return badIndices + nonFinite + degenerate; }
};

/// For each vertex the first vertex at the very same place, so that meshes split at seams join
/// again. A vertex that is not finite stands for itself. Cost: O(n log n).
std::vector<uint32_t> weldedIndices(const std::vector<V3f>& vertices);

/// Drops the triangles that cannot throw a shadow and counts all faults. Order of the rest is kept.
/// An empty mesh is allowed. Cost: O(n log n).
CasterFaults cleanCasterMesh(CasterMesh& mesh);

/// One lower-case sentence about the dropped triangles, or "" when none was dropped.
std::string faultWarning(const CasterMesh& mesh, const CasterFaults& faults);

/// The mesh with every vertex mapped by an affine transform, e.g. worldFromObject.
CasterMesh placed(const CasterMesh& mesh, const Transform& transform);

}  // namespace kagefude
