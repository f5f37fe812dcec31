#include "passes/casters/texture_shadow.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"
#include "image/real_math.h"

namespace kagefude {
namespace {

/// 0 in the middle of a blob of radius 1/2, 1 from its rim on; smooth at both.
float roundBlob(float u, float v) {
  const float x = 2 * u - 1, y = 2 * v - 1;
  const float t = std::min(1.0f, x * x + y * y);
  return t * t * (3 - 2 * t);
}

/// Bilinear with texel centres at (i + 0.5)/size; untouched (1) outside of the picture.
float painted(const View<const float>& picture, float u, float v) {
  const float x = u * static_cast<float>(picture.width) - 0.5f;
  const float y = (1 - v) * static_cast<float>(picture.height) - 0.5f;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const float s = x - static_cast<float>(column), t = y - static_cast<float>(row);
  const auto texel = [&](int i, int j) { return picture.contains(i, j) ? picture(i, j) : 1.0f; };
  const float top = texel(column, row) * (1 - s) + texel(column + 1, row) * s;
  const float bottom = texel(column, row + 1) * (1 - s) + texel(column + 1, row + 1) * s;
  return top * (1 - t) + bottom * t;
}

float toneAt(const BlobPlace& place, const V3d& up, const V3d& point, View<const float> picture,
             const BlobParams& params) {
  const V3d offset = point - place.centre;
  if (std::fabs(offset.dot(up)) > params.reach * std::max(place.width, place.length)) return 1;
  const float u = static_cast<float>(offset.dot(place.across) / place.width + 0.5);
  const float v = static_cast<float>(offset.dot(place.along) / place.length + 0.5);
  if (!(u >= 0 && u <= 1 && v >= 0 && v <= 1)) return 1;
  const float paint = picture.empty() ? roundBlob(u, v) : painted(picture, u, v);
  return 1 - params.strength * (1 - std::clamp(paint, 0.0f, 1.0f));
}

}  // namespace

BlobPlace blobUnder(const Transform& worldFromObject, const V3d& low, const V3d& high,
                    const V3d& up, double height, const BlobParams& params) {
  V3d axes[3], size = high - low;
  int upright = 0;
  double most = -1;
  for (int i = 0; i < 3; ++i) {
    V3d unit(0.0);
    unit[i] = 1;
    const V3d axis = worldFromObject.direction(unit);
    const double length = axis.length();
    axes[i] = length > 0 ? axis / length : unit;
    size[i] *= length;
    if (std::fabs(axes[i].dot(up)) > most) {
      most = std::fabs(axes[i].dot(up));
      upright = i;
    }
  }
  const int first = upright == 0 ? 1 : 0, second = upright == 2 ? 1 : 2;
  V3d across = axes[first] - up * axes[first].dot(up);
  if (!(across.length() > 1e-6)) across = V3d(up.y, up.z, up.x).cross(up);
  across.normalize();
  V3d along = up.cross(across);
  if (along.dot(axes[second]) < 0) along = -along;
  const SinCos turn = sinCosTurns(params.heading);
  BlobPlace place;
  place.across = across * turn.cos + along * turn.sin;
  place.along = along * turn.cos - across * turn.sin;
  place.width = std::max(1e-9, size[first] * params.width);
  place.length = std::max(1e-9, size[second] * params.length);
  const V3d middle = worldFromObject.point((low + high) * 0.5);
  place.centre = middle + up * (height - middle.dot(up));
  return place;
}

Floats blobTone(Vec3View position, View<const uint32_t> ids, std::span<const BlobPlace> places,
                std::span<const uint32_t> ownIds, View<const float> picture,
                const BlobParams& params) {
  Floats tone(ids.width, ids.height, 1.0f);
  parallelRows(ids.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < ids.width; ++x) {
        const V3d point(position(x, y));
        if (ids(x, y) == 0 || !std::isfinite(point.x + point.y + point.z)) continue;
        for (size_t i = 0; i < places.size(); ++i) {
          if (i < ownIds.size() && ownIds[i] == ids(x, y)) continue;
          const V3d up = places[i].across.cross(places[i].along);
          tone(x, y) = std::min(tone(x, y), toneAt(places[i], up, point, picture, params));
        }
        tone(x, y) = blendBlob(1.0f, tone(x, y), params.blend);
      }
  });
  return tone;
}

float blendBlob(float destination, float tone, BlobBlend blend) {
  const float source = blend == BlobBlend::alpha ? 0.0f : tone;
  return source * (1 - tone) + destination * tone;
}

}  // namespace kagefude
