#include "passes/casters/caster_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace kagefude {
namespace {

bool finite(const V3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool hasArea(const V3f& a, const V3f& b, const V3f& c) {
  const V3d normal = (V3d(b) - V3d(a)).cross(V3d(c) - V3d(a));
  return normal.length2() > 0;
}

void countEdges(const CasterMesh& mesh, CasterFaults& faults) {
  const std::vector<uint32_t> welded = weldedIndices(mesh.vertices);
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (const auto& triangle : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      edges.push_back(std::minmax({welded[triangle[i]], welded[triangle[(i + 1) % 3]]}));
  std::sort(edges.begin(), edges.end());
  for (size_t first = 0; first < edges.size();) {
    size_t end = first;
    while (end < edges.size() && edges[end] == edges[first]) ++end;
    if (end - first == 1) ++faults.openEdges;
    if (end - first > 2) ++faults.nonManifoldEdges;
    first = end;
  }
}

}  // namespace

std::vector<uint32_t> weldedIndices(const std::vector<V3f>& vertices) {
  std::vector<uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto less = [&](uint32_t a, uint32_t b) {
    const V3f &p = vertices[a], &q = vertices[b];
    if (p.x != q.x) return p.x < q.x;
    if (p.y != q.y) return p.y < q.y;
    if (p.z != q.z) return p.z < q.z;
    return a < b;
  };
  const auto unusable = [&](uint32_t i) { return !finite(vertices[i]); };
  const auto end = std::remove_if(order.begin(), order.end(), unusable);
  std::sort(order.begin(), end, less);
  std::vector<uint32_t> welded(vertices.size());
  std::iota(welded.begin(), welded.end(), 0u);
  for (auto it = order.begin(); it != end; ++it)
    if (it != order.begin() && vertices[*it] == vertices[*(it - 1)])
      welded[*it] = welded[*(it - 1)];
  return welded;
}

CasterFaults cleanCasterMesh(CasterMesh& mesh) {
  CasterFaults faults;
  const auto unusable = [&](const std::array<uint32_t, 3>& t) {
    const size_t count = mesh.vertices.size();
    if (t[0] >= count || t[1] >= count || t[2] >= count) return ++faults.badIndices > 0;
    const V3f &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    if (!finite(a) || !finite(b) || !finite(c)) return ++faults.nonFinite > 0;
    if (!hasArea(a, b, c)) return ++faults.degenerate > 0;
    return false;
  };
  std::erase_if(mesh.triangles, unusable);
  countEdges(mesh, faults);
  return faults;
}

std::string faultWarning(const CasterMesh& mesh, const CasterFaults& faults) {
  if (faults.dropped() == 0) return "";
  return fmt::format(
      "caster {} has {} triangles that throw no shadow and were left out ({} name vertices that do "
      "not exist, {} are not finite, {} have no area)",
      mesh.object, faults.dropped(), faults.badIndices, faults.nonFinite, faults.degenerate);
}

CasterMesh placed(const CasterMesh& mesh, const Transform& transform) {
  CasterMesh result = mesh;
  for (V3f& vertex : result.vertices) vertex = V3f(transform.point(V3d(vertex)));
  return result;
}

}  // namespace kagefude
