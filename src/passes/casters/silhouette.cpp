#include <algorithm>
#include <utility>

#include "passes/casters/shadow_volume.h"

namespace kagefude {
namespace {

struct DirectedEdge {
  uint32_t low, high;
  int weight;  ///< +1 from low to high, -1 from high to low
};

/// Positive when the corners run counter-clockwise seen from the light; 0 when seen edge-on.
double facing(const V3d& a, const V3d& b, const V3d& c, const LightPlace& light) {
  const V3d face = (b - a).cross(c - a);
  return light.directional ? face.dot(-light.direction) : face.dot(light.position - a);
}

}  // namespace

std::vector<SilhouetteEdge> silhouetteEdges(const CasterMesh& mesh, const LightPlace& light) {
  const std::vector<uint32_t> welded = weldedIndices(mesh.vertices);
  std::vector<DirectedEdge> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (const auto& t : mesh.triangles) {
    const double turn =
        facing(V3d(mesh.vertices[t[0]]), V3d(mesh.vertices[t[1]]), V3d(mesh.vertices[t[2]]), light);
    if (turn == 0) continue;
    for (int i = 0; i < 3; ++i) {
      uint32_t from = welded[t[i]], to = welded[t[(i + 1) % 3]];
      if (turn < 0) std::swap(from, to);
      edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const DirectedEdge& p, const DirectedEdge& q) {
    return std::pair(p.low, p.high) < std::pair(q.low, q.high);
  });
  std::vector<SilhouetteEdge> result;
  for (size_t i = 0; i < edges.size();) {
    int sum = 0;
    size_t end = i;
    for (; end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high;
         ++end)
      sum += edges[end].weight;
    const V3f &low = mesh.vertices[edges[i].low], &high = mesh.vertices[edges[i].high];
    if (sum > 0) result.push_back({low, high, sum});
    if (sum < 0) result.push_back({high, low, -sum});
    i = end;
  }
  return result;
}

}  // namespace kagefude
