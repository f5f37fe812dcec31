#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "passes/casters/caster_mesh.h"
#include "passes/casters/wedge_list.h"

namespace kagefude {

/// The casters' triangles in world space under a tree of boxes, built once per frame for all
/// lights and for the camera. Leaves are blocks of up to wedgeLanes triangles.
/// Deterministic: the tree depends on the meshes alone. Memory about 140 bytes a triangle.
class CasterSet {
 public:
  struct Triangle {
    V3f a, b, c;
    uint32_t id = 0;     ///< the mesh's id
    bool valid = false;  ///< false for the padding of a block
    /// Whether exactly one other triangle shares the edge ab, bc, ca, and that one's third corner.
    std::array<bool, 3> shared = {false, false, false};
    std::array<V3f, 3> across = {V3f(0.0f), V3f(0.0f), V3f(0.0f)};
  };
  struct Node {
    V3f low, high;
    uint32_t first = 0;  ///< index of the first of two children, or of the block when leaf
    bool leaf = false;
  };

  CasterSet() = default;
  /// Takes meshes as cleanCasterMesh left them (every index in range, every corner finite).
  explicit CasterSet(std::span<const CasterMesh> worldMeshes);

  bool empty() const { return nodes_.empty(); }
  size_t blocks() const { return triangles_.size() / wedgeLanes; }
  /// Whether a mesh with this id, not 0, has triangles here.
  bool holds(uint32_t id) const;
  /// Node 0 is the root.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Block b holds triangles wedgeLanes*b …, padded with invalid ones.
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  struct Builder;
  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
  std::vector<uint32_t> ids_;  ///< sorted
};

}  // namespace kagefude
