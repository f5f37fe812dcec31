#include "passes/depth_map/map_receiver.h"

#include <algorithm>

#include "image/clones.h"

namespace kagefude {
namespace {

constexpr float steepest = 8.0f;  ///< tangent of the steepest slope that is followed
constexpr float largest = 1e9f;   ///< texels; beyond it a point is as good as not finite

/// What a loop over lanes reads and writes, as plain pointers and numbers.
struct Lanes {
  const float *px, *py, *pz;  ///< positions
  const float *nx, *ny, *nz;  ///< normals
  const uint32_t* labels;
  const double (*light)[4];  ///< rows of lightFromWorld
  const double (*clip)[4];   ///< rows of clipFromLight
  float width, height;       ///< of the map, texels
  int count;
};

float dot(const V3f& a, const V3f& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

V3f cross(const V3f& a, const V3f& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

V3f linearPart(const double* row) {
  return {static_cast<float>(row[0]), static_cast<float>(row[1]), static_cast<float>(row[2])};
}

double apply(const double* row, double x, double y, double z) {
  return row[0] * x + row[1] * y + row[2] * z + row[3];
}

template <bool perspective>
__attribute__((always_inline)) inline void receiveLanes(const Lanes in, MapReceivers& out) {
  const V3f clipX = linearPart(in.clip[0]), clipY = linearPart(in.clip[1]);
  const V3f clipW = linearPart(in.clip[3]);
  const V3f lightX = linearPart(in.light[0]), lightY = linearPart(in.light[1]);
  const V3f lightZ = linearPart(in.light[2]);
  const float across = 0.5f * in.width * (clipX.x < 0 ? -clipX.x : clipX.x);
#pragma GCC ivdep
  for (int i = 0; i < in.count; ++i) {
    const double wx = in.px[i], wy = in.py[i], wz = in.pz[i];
    const double x = apply(in.light[0], wx, wy, wz), y = apply(in.light[1], wx, wy, wz);
    const double z = apply(in.light[2], wx, wy, wz), w = apply(in.clip[3], x, y, z);
    const float ndcX = static_cast<float>(apply(in.clip[0], x, y, z) / w);
    const float ndcY = static_cast<float>(apply(in.clip[1], x, y, z) / w);
    const float u = (ndcX * 0.5f + 0.5f) * in.width, v = (0.5f - ndcY * 0.5f) * in.height;
    const float depth = static_cast<float>(-z), perW = static_cast<float>(1.0 / w);
    const bool seen = (w > 0) & (u < largest) & (u > -largest) & (v < largest) & (v > -largest) &
                      (!perspective | (z < 0)) & (in.labels[i] != 0);

    const V3f worldNormal(in.nx[i], in.ny[i], in.nz[i]);
    const V3f n(dot(lightX, worldNormal), dot(lightY, worldNormal), dot(lightZ, worldNormal));
    const V3f p(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
    const float facing = perspective ? -dot(n, p) : n.z;
    const V3f gradientU = (clipX - clipW * ndcX) * (0.5f * in.width * perW);
    const V3f gradientV = (clipY - clipW * ndcY) * (-0.5f * in.height * perW);
    const V3f gradientBase(0, 0, perspective ? 1.0f / (depth * depth) : -1.0f);
    const float texels = across * perW;
    const float det = dot(n, cross(gradientU, gradientV));
    // Seen edge-on to within some 1e-8, a plane has no slope to speak of.
    const float least = 1.6e-8f * texels * texels;
    const bool sloped = det * det > least * least * dot(n, n);
    const float perDet = sloped ? 1.0f / det : 0.0f;

    out.u[i] = u;
    out.v[i] = v;
    out.depth[i] = depth;
    out.texelsPerUnit[i] = texels;
    out.slopeU[i] = dot(n, cross(gradientBase, gradientV)) * perDet;
    out.slopeV[i] = dot(n, cross(gradientU, gradientBase)) * perDet;
    out.limit[i] = steepest / texels;
    out.visibility[i] = !seen ? 1.0f : (facing < 0.0f ? 0.0f : MapReceivers::open);
  }
}

KAGEFUDE_CLONES void receivePerspective(const Lanes& in, MapReceivers& out) {
  receiveLanes<true>(in, out);
}

KAGEFUDE_CLONES void receiveOrthographic(const Lanes& in, MapReceivers& out) {
  receiveLanes<false>(in, out);
}

}  // namespace

void MapReceivers::storeKnown(float* row) {
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    row[column[i]] = visibility[i];
    if (visibility[i] != open) continue;
    column[kept] = column[i];
    visibility[kept] = open;
    for (float* const lane : {u, v, depth, texelsPerUnit, slopeU, slopeV, limit})
      lane[kept] = lane[i];
    ++kept;
  }
  count = kept;
}

MapProjector::MapProjector(const ShadowMap& map)
    : lightFromWorld_(map.lightFromWorld),
      clipFromLight_(map.clipFromLight),
      width_(static_cast<float>(map.depth.width)),
      height_(static_cast<float>(map.depth.height)),
      perspective_(map.clipFromLight.m[3][2] != 0) {}

void MapProjector::receive(Vec3View position, Vec3View normal, View<const uint32_t> labels, int x,
                           int y, int count, MapReceivers& receivers) const {
  static constexpr float none[MapReceivers::capacity] = {};
  const auto at = [&](const View<const float>& plane) {
    return plane.empty() ? none : plane.row(y) + x;
  };
  const Lanes lanes{at(position.x),   at(position.y), at(position.z),    at(normal.x),
                    at(normal.y),     at(normal.z),   labels.row(y) + x, lightFromWorld_.m,
                    clipFromLight_.m, width_,         height_,           count};
  receivers.perspective = perspective_;
  receivers.count = count;
  for (int i = 0; i < count; ++i) receivers.column[i] = x + i;
  (perspective_ ? receivePerspective : receiveOrthographic)(lanes, receivers);
}

}  // namespace kagefude
