#include "passes/casters/shadow_volume.h"

#include <algorithm>
#include <bit>

#include "image/parallel.h"
#include "passes/casters/surface_sampler.h"

namespace kagefude {
namespace {

/// A number that is linear in the picture: n·q + k, with q the ray's direction, or its origin for
/// an orthographic camera.
struct Form {
  V3d n{0, 0, 0};
  double k = 0;

  double at(const V3d& q) const { return n.dot(q) + k; }
};

/// A face of a volume. A ray's line passes through it where all forms have one sign.
struct Face {
  std::array<Form, 4> edges;
  int edgeCount = 0;
  V3d normal{0, 0, 0};  ///< into the volume
  double offset = 0;
  int weight = 1;

  bool isInside(const V3d& point) const { return normal.dot(point) >= offset; }
};

/// Makes faces relative to the camera's eye, for its kind of rays.
class FaceMaker {
 public:
  FaceMaker(const CameraRays& rays, const LightPlace& light) : rays_(rays), light_(light) {}

  Face side(const SilhouetteEdge& edge) const {
    const V3d a = local(edge.a), b = local(edge.b);
    const V3d awayA = away(a), awayB = away(b);
    Face face;
    face.edges[face.edgeCount++] = between(a, b);
    face.edges[face.edgeCount++] = toInfinity(b, awayB);
    face.edges[face.edgeCount++] = negated(toInfinity(a, awayA));
    if (!light_.directional) face.edges[face.edgeCount++] = atInfinity(awayB, awayA);
    // The shadow lies to the left of ab seen from the light.
    face.normal = light_.directional ? (b - a).cross(awayA) : awayB.cross(awayA);
    face.offset = face.normal.dot(a);
    face.weight = edge.weight;
    return face;
  }

  /// The triangle itself, which closes its volume towards the light.
  Face cap(const V3f& cornerA, const V3f& cornerB, const V3f& cornerC) const {
    const V3d a = local(cornerA), b = local(cornerB), c = local(cornerC);
    Face face;
    face.edges[face.edgeCount++] = between(a, b);
    face.edges[face.edgeCount++] = between(b, c);
    face.edges[face.edgeCount++] = between(c, a);
    face.normal = (b - a).cross(c - a);
    if (face.normal.dot(away(a)) < 0) face.normal = -face.normal;
    face.offset = face.normal.dot(a);
    return face;
  }

 private:
  V3d local(const V3f& p) const { return V3d(p) - rays_.eye; }
  V3d away(const V3d& p) const {
    return light_.directional ? light_.direction : p - (light_.position - rays_.eye);
  }
  static Form negated(const Form& form) { return {-form.n, -form.k}; }

  /// det(d, A - o, B - o).
  Form between(const V3d& a, const V3d& b) const {
    if (!rays_.orthographic) return {a.cross(b), 0};
    const V3d d = rays_.direction0;
    return {(a - b).cross(d), d.dot(a.cross(b))};
  }
  /// det(d, A - o, v), with v the direction of a vertex at infinity.
  Form toInfinity(const V3d& a, const V3d& v) const {
    if (!rays_.orthographic) return {a.cross(v), 0};
    const V3d d = rays_.direction0;
    return {d.cross(v), d.dot(a.cross(v))};
  }
  Form atInfinity(const V3d& v, const V3d& w) const {
    if (!rays_.orthographic) return {v.cross(w), 0};
    return {V3d(0.0), rays_.direction0.dot(v.cross(w))};
  }

  const CameraRays& rays_;
  const LightPlace& light_;
};

struct Region {
  int x0, y0, x1, y1;
};

class VolumeCounter {
 public:
  VolumeCounter(const SeenSurface& surface, const std::vector<Face>& faces,
                const ShadowWedges& wedges, const ShadowWedges& sight, const LightPlace& light,
                const VolumeParams& params, View<float> result)
      : surface_(surface),
        faces_(faces),
        wedges_(wedges),
        params_(params),
        sampler_(surface, sight, light),
        result_(result) {}

  /// Halves the region, with the faces that may be met in it, down to pixels.
  void count(const Region& region, const std::vector<int>& list) {
    std::vector<int> met;
    const std::array<V3d, 4> corners = {form(region.x0, region.y0), form(region.x1, region.y0),
                                        form(region.x1, region.y1), form(region.x0, region.y1)};
    for (int i : list)
      if (mayMeet(faces_[i], corners)) met.push_back(i);
    const int width = region.x1 - region.x0, height = region.y1 - region.y0;
    if (width == 1 && height == 1) {
      pixel(region.x0, region.y0, met);
    } else if (width >= height) {
      const int middle = region.x0 + width / 2;
      count({region.x0, region.y0, middle, region.y1}, met);
      count({middle, region.y0, region.x1, region.y1}, met);
    } else {
      const int middle = region.y0 + height / 2;
      count({region.x0, region.y0, region.x1, middle}, met);
      count({region.x0, middle, region.x1, region.y1}, met);
    }
  }

 private:
  V3d form(double x, double y) const {
    return surface_.rays.orthographic ? surface_.rays.origin(x, y) : surface_.rays.direction(x, y);
  }

  static bool mayMeet(const Face& face, const std::array<V3d, 4>& corners) {
    bool positive = true, negative = true;
    for (int i = 0; i < face.edgeCount; ++i) {
      bool anyPositive = false, anyNegative = false;
      for (const V3d& q : corners) (face.edges[i].at(q) >= 0 ? anyPositive : anyNegative) = true;
      positive &= anyPositive;
      negative &= anyNegative;
    }
    return positive || negative;
  }

  /// How often the segment from `from` to `to`, on the ray of q, goes in minus out.
  int crossings(const std::vector<int>& met, const V3d& q, const V3d& from, const V3d& to) const {
    int sum = 0;
    for (int i : met) {
      const Face& face = faces_[i];
      const bool first = face.edges[0].at(q) >= 0;
      bool through = true;
      for (int k = 1; k < face.edgeCount; ++k) through &= (face.edges[k].at(q) >= 0) == first;
      if (through) sum += face.weight * (int{face.isInside(to)} - int{face.isInside(from)});
    }
    return sum;
  }

  /// How many triangles' volumes the ray's origin lies in.
  int volumesAround(const V3d& origin) {
    const PointBox box{V3f(origin), V3f(0.0f)};
    wedges_.gather(box, undecided, around_);
    const V3f q = V3f(origin) - wedges_.apex();
    int sum = 0;
    for (int i = 0; i < around_.count; ++i) {
      const std::array<float, wedgeCoefficients> c = around_.wedge(i);
      bool inside = true;
      for (int plane = 0; plane < 4; ++plane)
        inside &= c[4 * plane] * q.x + c[4 * plane + 1] * q.y + c[4 * plane + 2] * q.z >=
                  c[4 * plane + 3];
      sum += inside;
    }
    return sum;
  }

  bool shaded(const std::vector<int>& met, double x, double y, const V3d& point, double lift) {
    const V3d origin = surface_.rays.origin(x, y);
    const V3d direction = surface_.rays.direction(x, y);
    const V3d lifted = point - direction * (lift / direction.length());
    if (!known_ || origin != startOrigin_) {
      known_ = true;
      startOrigin_ = origin;
      start_ = volumesAround(origin);
    }
    return start_ + crossings(met, form(x, y), origin, lifted) > 0;
  }

  void pixel(int x, int y, const std::vector<int>& met) {
    if (!surface_.isSurface(x, y)) return;
    const V3f p = surface_.relative(x, y);
    const double lift = params_.bias * surface_.pixelSize(x, y) + 4e-6 * p.length();
    if (!params_.subpixels || (met.empty() && !surface_.rays.orthographic)) {
      result_(x, y) = shaded(met, x + 0.5, y + 0.5, V3d(p), lift) ? 1.0f : 0.0f;
      return;
    }
    FlatPixel flat;
    SubpixelPoints points;
    sampler_.startTile(x, y, x + 1, y + 1);
    sampler_.locate(x, y, static_cast<float>(lift), flat);
    sampler_.sample(points);
    int hidden = std::popcount(points.facingAway);
    for (uint64_t rest = points.present & ~points.facingAway; rest != 0; rest &= rest - 1) {
      const int k = std::countr_zero(rest);
      const V3d point(points.x[k], points.y[k], points.z[k]);
      hidden += shaded(met, x + (k % 8 + 0.5) / 8, y + (k / 8 + 0.5) / 8, point, 0);
    }
    const int seen = std::popcount(points.present);
    result_(x, y) = seen == 0 ? 0.0f : static_cast<float>(hidden) / static_cast<float>(seen);
  }

  const SeenSurface& surface_;
  const std::vector<Face>& faces_;
  const ShadowWedges& wedges_;
  const VolumeParams& params_;
  SurfaceSampler sampler_;
  View<float> result_;
  WedgeList around_;
  bool known_ = false;
  V3d startOrigin_{0, 0, 0};
  int start_ = 0;
};

std::vector<Face> facesOf(std::span<const CasterMesh> meshes, const CameraRays& rays,
                          const LightPlace& light) {
  const FaceMaker make(rays, light);
  std::vector<Face> faces;
  for (const CasterMesh& mesh : meshes) {
    for (const SilhouetteEdge& edge : silhouetteEdges(mesh, light))
      faces.push_back(make.side(edge));
    for (const auto& t : mesh.triangles)
      faces.push_back(make.cap(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]));
  }
  return faces;
}

}  // namespace

Floats shadowVolume(const SeenSurface& surface, std::span<const CasterMesh> meshes,
                    const CasterSet& casters, const LightPlace& light, const VolumeParams& params) {
  surface.check();
  const int width = surface.ids.width, height = surface.ids.height;
  Floats result(width, height, 0.0f);
  if (casters.empty() || surface.ids.empty()) return result;
  const ShadowWedges wedges(casters, light, surface.rays.eye);
  const LightPlace eye{surface.rays.orthographic, surface.rays.eye, surface.rays.direction0};
  const ShadowWedges sight(casters, eye, surface.rays.eye);
  const std::vector<Face> faces = facesOf(meshes, surface.rays, light);
  std::vector<int> all(faces.size());
  for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  parallelRows(height, 32, [&](int first, int end) {
    VolumeCounter counter(surface, faces, wedges, sight, light, params, result);
    counter.count({0, first, width, end}, all);
  });
  return result;
}

}  // namespace kagefude
