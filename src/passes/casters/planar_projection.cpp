#include "passes/casters/planar_projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "image/parallel.h"
#include "passes/casters/pixel_boxes.h"
#include "passes/casters/surface_sampler.h"

namespace kagefude {
namespace {

/// Clipping stops this share short of the light's height, where projections run to infinity.
constexpr double nearLight = 1e-4;

using Polygon = std::vector<V3d>;

/// The part of the polygon where height * sign >= limit * sign.
template <class Height>
Polygon clipped(const Polygon& polygon, const Height& height, double limit, double sign) {
  Polygon result;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const V3d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double hp = (height(p) - limit) * sign, hq = (height(q) - limit) * sign;
    if (hp >= 0) result.push_back(p);
    if ((hp >= 0) != (hq >= 0)) result.push_back(p + (q - p) * (hp / (hp - hq)));
  }
  return result;
}

/// Sub-pixels of the pixel at (x, y) whose rays pass through one of the triangles.
uint64_t coveredBy(const WedgeList& list, const CameraRays& rays, int x, int y) {
  alignas(64) float q[3][64];
  for (int k = 0; k < 64; ++k) {
    const double u = x + (k % 8 + 0.5) / 8, v = y + (k / 8 + 0.5) / 8;
    const V3d form = rays.orthographic ? rays.origin(u, v) : rays.direction(u, v);
    for (int i = 0; i < 3; ++i) q[i][k] = static_cast<float>(form[i]);
  }
  uint64_t covered = 0;
  for (int i = 0; i < list.count && covered != ~uint64_t{0}; ++i) {
    std::array<float, wedgeCoefficients> wedge = list.wedge(i);
    // Only the sides matter: all of the flattened caster lies in the receiver's surface.
    std::fill(wedge.begin() + 12, wedge.end(), 0.0f);
    covered |= wedgeMask(wedge, q[0], q[1], q[2]);
  }
  return covered;
}

/// Draws the flattened casters tile by tile.
class PlanarShader {
 public:
  PlanarShader(const SeenSurface& surface, uint32_t receiver, const ShadowWedges& flat,
               const ShadowWedges& sight, const LightPlace& light, float alpha, View<float> result)
      : surface_(surface),
        receiver_(receiver),
        flat_(flat),
        sampler_(surface, sight, light),
        alpha_(alpha),
        result_(result) {}

  void tile(int x0, int y0, int x1, int y1) {
    const CameraRays& rays = surface_.rays;
    const auto corner = [&](int x, int y) {
      return V3f(rays.orthographic ? rays.origin(x, y) : rays.direction(x, y));
    };
    flat_.gatherSeen({corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1)}, list_);
    if (list_.empty()) return;
    sampler_.startTile(x0, y0, x1, y1);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        if (surface_.ids(x, y) == receiver_ && surface_.isSurface(x, y))
          result_(x, y) = alpha_ * share(x, y);
  }

 private:
  float share(int x, int y) {
    const uint64_t covered = coveredBy(list_, surface_.rays, x, y);
    if (covered == 0 || covered == ~uint64_t{0}) return covered == 0 ? 0.0f : 1.0f;
    uint64_t shows = showsReceiver(x, y);
    if (shows == 0) shows = ~uint64_t{0};
    return static_cast<float>(std::popcount(covered & shows)) /
           static_cast<float>(std::popcount(shows));
  }

  uint64_t showsReceiver(int x, int y) {
    FlatPixel flat;
    sampler_.locate(x, y, 0.0f, flat);
    sampler_.sample(points_);
    uint64_t shows = 0;
    for (int k = 0; k < 64; ++k)
      if (points_.id[k] == receiver_) shows |= points_.present & (uint64_t{1} << k);
    return shows;
  }

  const SeenSurface& surface_;
  uint32_t receiver_;
  const ShadowWedges& flat_;
  SurfaceSampler sampler_;
  float alpha_;
  View<float> result_;
  WedgeList list_;
  SubpixelPoints points_;
};

}  // namespace

ReceiverPlane planeOfReceiver(const SeenSurface& surface, uint32_t id,
                              const std::string& receiver) {
  surface.check();
  V3d sum(0.0), normals(0.0);
  size_t count = 0;
  const auto eachPixel = [&](const auto& use) {
    for (int y = 0; y < surface.ids.height; ++y)
      for (int x = 0; x < surface.ids.width; ++x)
        if (surface.ids(x, y) == id && surface.isSurface(x, y)) use(x, y);
  };
  eachPixel([&](int x, int y) {
    sum += V3d(surface.position(x, y));
    normals += V3d(surface.normal(x, y));
    ++count;
  });
  if (count == 0)
    throw InputError(fmt::format("the receiver {} of shadow.receiver is in no pixel", receiver));
  const ReceiverPlane plane{sum / static_cast<double>(count), normals.normalized()};
  double away = 0, extent = 0;
  eachPixel([&](int x, int y) {
    const V3d offset = V3d(surface.position(x, y)) - plane.point;
    away = std::max(away, std::fabs(offset.dot(plane.normal)));
    extent = std::max(extent, offset.length());
  });
  if (!(away <= 0.01 * extent) && count > 1)
    throw InputError(
        fmt::format("the receiver {} of shadow.receiver is not flat: points lie {:.3g} from its "
                    "plane, more than "
                    "a hundredth of its extent of {:.3g}",
                    receiver, away, extent));
  return plane;
}

std::vector<CasterMesh> projectedOnPlane(std::span<const CasterMesh> casters,
                                         const ReceiverPlane& plane, const LightPlace& light) {
  const V3d toLight = light.directional ? -light.direction : light.position - plane.point;
  const double side = plane.normal.dot(toLight);
  if (side == 0) return {};
  const V3d up = side > 0 ? plane.normal : -plane.normal;
  const double lightHeight = std::fabs(side);
  const auto height = [&](const V3d& p) { return up.dot(p - plane.point); };
  const auto flattened = [&](const V3d& p) {
    if (light.directional) return p + light.direction * (height(p) / lightHeight);
    return light.position + (p - light.position) * (lightHeight / (lightHeight - height(p)));
  };
  std::vector<CasterMesh> result;
  for (const CasterMesh& mesh : casters) {
    CasterMesh flat{mesh.object, mesh.id, {}, {}};
    for (const auto& t : mesh.triangles) {
      Polygon polygon = {V3d(mesh.vertices[t[0]]), V3d(mesh.vertices[t[1]]),
                         V3d(mesh.vertices[t[2]])};
      polygon = clipped(polygon, height, 0, 1);
      if (!light.directional) polygon = clipped(polygon, height, lightHeight * (1 - nearLight), -1);
      const auto first = static_cast<uint32_t>(flat.vertices.size());
      for (const V3d& p : polygon) flat.vertices.push_back(V3f(flattened(p)));
      for (uint32_t i = 2; i < polygon.size(); ++i)
        flat.triangles.push_back({first, first + i - 1, first + i});
    }
    result.push_back(std::move(flat));
  }
  return result;
}

Floats planarShadow(const SeenSurface& surface, uint32_t receiverId, const ReceiverPlane& plane,
                    std::span<const CasterMesh> casters, const CasterSet& set,
                    const LightPlace& light, const PlanarParams& params) {
  surface.check();
  Floats result(surface.ids.width, surface.ids.height, 0.0f);
  std::vector<CasterMesh> others;
  for (const CasterMesh& mesh : casters)
    if (mesh.id != receiverId) others.push_back(mesh);
  const CasterSet projected(projectedOnPlane(others, plane, light));
  const CameraRays& rays = surface.rays;
  const LightPlace eye{rays.orthographic, rays.eye, rays.direction0};
  const ShadowWedges flat(projected, eye, rays.eye);
  const ShadowWedges sight(set, eye, rays.eye);
  parallelRows(result.height(), coverageTile, [&](int first, int end) {
    PlanarShader shader(surface, receiverId, flat, sight, light, params.alpha, result);
    for (int x0 = 0; x0 < result.width(); x0 += coverageTile)
      shader.tile(x0, first, std::min(x0 + coverageTile, result.width()), end);
  });
  return result;
}

}  // namespace kagefude
