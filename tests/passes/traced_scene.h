#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "passes/casters/coverage.h"

namespace kagefude {

/// A small renderer for tests: brute force, in doubles, one ray after the other.
struct TracedScene {
  std::vector<CasterMesh> meshes;
  V3d eye{0, -8, 5}, target{0, 0, 0};
  bool orthographic = false;
  int width = 48, height = 40;
  double opening = 0.45;  ///< half the picture's width at distance 1, or in world units

  Transform cameraFromWorld, clipFromCamera;
  Vec3Plane position, normal;
  Labels ids;
  CameraRays rays;

  struct Hit {
    double t;
    uint32_t id;
    V3d normal;
  };

  static std::optional<double> meet(const V3d& o, const V3d& d, const V3d& a, const V3d& b,
                                    const V3d& c) {
    const V3d e1 = b - a, e2 = c - a, p = d.cross(e2);
    const double det = e1.dot(p);
    if (det == 0) return {};
    const V3d s = o - a, q = s.cross(e1);
    const double u = s.dot(p) / det, v = d.dot(q) / det;
    if (u < 0 || v < 0 || u + v > 1) return {};
    return e2.dot(q) / det;
  }

  template <class Use>
  void eachTriangle(const Use& use) const {
    for (const CasterMesh& mesh : meshes)
      for (const auto& t : mesh.triangles)
        use(mesh.id, V3d(mesh.vertices[t[0]]), V3d(mesh.vertices[t[1]]), V3d(mesh.vertices[t[2]]));
  }

  std::optional<Hit> nearest(const V3d& o, const V3d& d) const {
    std::optional<Hit> best;
    eachTriangle([&](uint32_t id, const V3d& a, const V3d& b, const V3d& c) {
      const auto t = meet(o, d, a, b, c);
      if (t && *t > 1e-9 && (!best || *t < best->t))
        best = Hit{*t, id, (b - a).cross(c - a).normalized()};
    });
    return best;
  }

  bool hidden(const V3d& p, const LightPlace& light) const {
    const V3d d = light.directional ? -light.direction * 1e3 : light.position - p;
    bool found = false;
    eachTriangle([&](uint32_t, const V3d& a, const V3d& b, const V3d& c) {
      const auto t = meet(p, d, a, b, c);
      found |= t && *t > 0 && *t < 1;
    });
    return found;
  }

  /// The hit point lifted off its surface by `gap`, to the side that the ray comes from.
  static V3d lifted(const V3d& o, const V3d& d, const Hit& hit, double gap) {
    return o + d * hit.t + hit.normal * (hit.normal.dot(d) > 0 ? -gap : gap);
  }

  void render() {
    const V3d z = (eye - target).normalized();
    const V3d x = V3d(0, 0, 1).cross(z).normalized(), y = z.cross(x);
    const V3d axes[3] = {x, y, z};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) cameraFromWorld.m[i][j] = axes[i][j];
      cameraFromWorld.m[i][3] = -axes[i].dot(eye);
    }
    clipFromCamera = Transform();
    const double near = 0.1, far = 100, aspect = double(width) / height;
    auto& m = clipFromCamera.m;
    m[0][0] = 1 / opening;
    m[1][1] = aspect / opening;
    if (orthographic) {
      m[2][2] = -2 / (far - near);
      m[2][3] = -(far + near) / (far - near);
    } else {
      m[2][2] = -(far + near) / (far - near);
      m[2][3] = -2 * far * near / (far - near);
      m[3][2] = -1;
      m[3][3] = 0;
    }
    rays = cameraRays(clipFromCamera, cameraFromWorld, eye, orthographic,
                      V2f(float(width), float(height)), {0, 0, width, height});
    position = Vec3Plane(width, height);
    normal = Vec3Plane(width, height);
    ids = Labels(width, height, 0u);
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column) {
        const V3d o = eye + rays.origin(column + 0.5, row + 0.5);
        const V3d d = rays.direction(column + 0.5, row + 0.5);
        const auto hit = nearest(o, d);
        position.set(column, row, hit ? V3f(o + d * hit->t) : V3f(0.0f));
        normal.set(column, row, hit ? V3f(hit->normal) : V3f(0.0f));
        ids(column, row) = hit ? hit->id : 0;
      }
  }

  SeenSurface seen() const { return {position, normal, ids, rays}; }
  CasterSet casters() const { return CasterSet(meshes); }

  /// Share of the pixel's 64 surface points that are hidden, traced ray by ray.
  double tracedCoverage(int column, int row, const LightPlace& light, double gap = 1e-4) const {
    int present = 0, shaded = 0;
    for (int k = 0; k < 64; ++k) {
      const double x = column + (k % 8 + 0.5) / 8, y = row + (k / 8 + 0.5) / 8;
      const V3d o = eye + rays.origin(x, y), d = rays.direction(x, y);
      const auto hit = nearest(o, d);
      if (!hit) continue;
      ++present;
      shaded += hidden(lifted(o, d, *hit, gap), light);
    }
    return present == 0 ? 0 : double(shaded) / present;
  }
};

inline CasterMesh quadMesh(uint32_t id, const V3f& a, const V3f& b, const V3f& c, const V3f& d) {
  return {"quad", id, {a, b, c, d}, {{0, 1, 2}, {0, 2, 3}}};
}

inline CasterMesh groundMesh(uint32_t id, float half = 6) {
  return quadMesh(id, {-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0});
}

inline CasterMesh boxMesh(uint32_t id, const V3f& low, const V3f& high) {
  CasterMesh mesh{"box", id, {}, {}};
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(
        {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

}  // namespace kagefude
