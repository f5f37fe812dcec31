#include "passes/casters/caster_set.h"

#include <algorithm>
#include <limits>

namespace kagefude {
namespace {

constexpr int bins = 16;

struct Bounds {
  V3f low = V3f(std::numeric_limits<float>::max());
  V3f high = V3f(std::numeric_limits<float>::lowest());

  void add(const V3f& p) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  void add(const Bounds& other) {
    add(other.low);
    add(other.high);
  }
  float area() const {
    const V3f e = high - low;
    return e.x < 0 ? 0.0f : e.x * e.y + e.y * e.z + e.z * e.x;
  }
};

/// Tells the triangles of one mesh, which follow `first`, of their neighbours.
void joinEdges(const CasterMesh& mesh, CasterSet::Triangle* first) {
  struct Edge {
    uint32_t low, high, triangle, side;
    auto operator<=>(const Edge&) const = default;
  };
  const std::vector<uint32_t> welded = weldedIndices(mesh.vertices);
  std::vector<Edge> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (uint32_t side = 0; side < 3; ++side) {
      const auto [low, high] =
          std::minmax({welded[mesh.triangles[t][side]], welded[mesh.triangles[t][(side + 1) % 3]]});
      edges.push_back({low, high, t, side});
    }
  std::sort(edges.begin(), edges.end());
  const auto tell = [&](const Edge& edge, const Edge& other) {
    CasterSet::Triangle& triangle = first[edge.triangle];
    triangle.shared[edge.side] = true;
    triangle.across[edge.side] =
        mesh.vertices[mesh.triangles[other.triangle][(other.side + 2) % 3]];
  };
  for (size_t i = 0; i < edges.size();) {
    size_t end = i;
    while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high)
      ++end;
    if (end - i == 2) {
      tell(edges[i], edges[i + 1]);
      tell(edges[i + 1], edges[i]);
    }
    i = end;
  }
}

struct Split {
  int axis = -1;
  int bin = 0;
};

}  // namespace

struct CasterSet::Builder {
  CasterSet& set;
  std::vector<Triangle> source;
  std::vector<Bounds> bounds;
  std::vector<uint32_t> order;

  V3f centre(uint32_t i) const { return (bounds[i].low + bounds[i].high) * 0.5f; }

  static int binOf(float position, float low, float high) {
    return std::clamp(static_cast<int>((position - low) / (high - low) * bins), 0, bins - 1);
  }

  /// The cheapest of the planes between bins by the surface area heuristic, or axis -1 where all
  /// centres lie in one place.
  Split bestSplit(uint32_t first, uint32_t end, const Bounds& centres) const {
    Split best;
    float bestCost = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis) {
      const float low = centres.low[axis], high = centres.high[axis];
      if (!(high > low)) continue;
      std::array<Bounds, bins> box;
      std::array<uint32_t, bins> count{};
      for (uint32_t i = first; i < end; ++i) {
        const int bin = binOf(centre(order[i])[axis], low, high);
        box[bin].add(bounds[order[i]]);
        ++count[bin];
      }
      std::array<float, bins> right{};
      Bounds running;
      uint32_t passed = 0;
      for (int bin = bins - 1; bin > 0; --bin) {
        if (count[bin]) running.add(box[bin]);
        passed += count[bin];
        right[bin] = running.area() * static_cast<float>(passed);
      }
      running = Bounds();
      passed = 0;
      for (int bin = 0; bin + 1 < bins; ++bin) {
        if (count[bin]) running.add(box[bin]);
        passed += count[bin];
        const float cost = running.area() * static_cast<float>(passed) + right[bin + 1];
        if (passed > 0 && passed < end - first && cost < bestCost) {
          bestCost = cost;
          best = {axis, bin + 1};
        }
      }
    }
    return best;
  }

  uint32_t partition(uint32_t first, uint32_t end, int depth) {
    Bounds centres;
    for (uint32_t i = first; i < end; ++i) centres.add(centre(order[i]));
    // Beyond this depth halves by number keep the tree, and so the recursion, shallow.
    const Split split = depth < 40 ? bestSplit(first, end, centres) : Split();
    if (split.axis < 0) return first + (end - first) / 2;
    const auto left = [&](uint32_t i) {
      return binOf(centre(i)[split.axis], centres.low[split.axis], centres.high[split.axis]) <
             split.bin;
    };
    const auto middle = std::stable_partition(order.begin() + first, order.begin() + end, left);
    return static_cast<uint32_t>(middle - order.begin());
  }

  void build(uint32_t node, uint32_t first, uint32_t end, int depth) {
    Bounds box;
    for (uint32_t i = first; i < end; ++i) box.add(bounds[order[i]]);
    set.nodes_[node].low = box.low;
    set.nodes_[node].high = box.high;
    if (end - first <= wedgeLanes) {
      set.nodes_[node].leaf = true;
      set.nodes_[node].first = static_cast<uint32_t>(set.blocks());
      for (uint32_t i = first; i < end; ++i) set.triangles_.push_back(source[order[i]]);
      set.triangles_.resize((set.triangles_.size() + wedgeLanes - 1) / wedgeLanes * wedgeLanes);
      return;
    }
    const uint32_t middle = partition(first, end, depth);
    const uint32_t child = static_cast<uint32_t>(set.nodes_.size());
    set.nodes_[node].first = child;
    set.nodes_.resize(child + 2);
    build(child, first, middle, depth + 1);
    build(child + 1, middle, end, depth + 1);
  }
};

CasterSet::CasterSet(std::span<const CasterMesh> worldMeshes) {
  Builder builder{*this, {}, {}, {}};
  for (const CasterMesh& mesh : worldMeshes) {
    const size_t first = builder.source.size();
    for (const auto& t : mesh.triangles) {
      Triangle triangle;
      triangle.a = mesh.vertices[t[0]];
      triangle.b = mesh.vertices[t[1]];
      triangle.c = mesh.vertices[t[2]];
      triangle.id = mesh.id;
      triangle.valid = true;
      Bounds box;
      box.add(triangle.a);
      box.add(triangle.b);
      box.add(triangle.c);
      builder.order.push_back(static_cast<uint32_t>(builder.source.size()));
      builder.source.push_back(triangle);
      builder.bounds.push_back(box);
    }
    joinEdges(mesh, builder.source.data() + first);
  }
  if (builder.source.empty()) return;
  for (const CasterMesh& mesh : worldMeshes)
    if (mesh.id != 0 && !mesh.triangles.empty()) ids_.push_back(mesh.id);
  std::sort(ids_.begin(), ids_.end());
  nodes_.resize(1);
  builder.build(0, 0, static_cast<uint32_t>(builder.source.size()), 0);
}

bool CasterSet::holds(uint32_t id) const {
  return std::binary_search(ids_.begin(), ids_.end(), id);
}

}  // namespace kagefude
