#include "passes/brush/brush_frame.h"

#include <cmath>

namespace kagefude {
namespace {

V3f unitOr(const V3f& v, const V3f& otherwise) {
  const float length = std::sqrt(v.dot(v));
  return length > 0.0f && std::isfinite(length) ? v / length : otherwise;
}

V3f anyPerpendicular(const V3f& v) {
  const V3f helper = std::fabs(v.x) < 0.6f ? V3f(1, 0, 0) : V3f(0, 1, 0);
  return unitOr(v.cross(helper), V3f(0, 0, 1));
}

V3f column(const Transform& t, int i) {
  const V3d d = t.direction({i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0});
  const double length = std::sqrt(d.dot(d));
  return length > 0.0 && std::isfinite(length) ? V3f(d / length) : V3f(0.0f);
}

}  // namespace

ObjectAxes objectAxes(const Transform& worldFromObject) {
  ObjectAxes axes;
  axes.origin = V3f(worldFromObject.point({0, 0, 0}));
  axes.x = unitOr(column(worldFromObject, 0), V3f(1, 0, 0));
  const V3f y = column(worldFromObject, 1);
  const V3f beside = y - axes.x * axes.x.dot(y);
  axes.y = beside.dot(beside) > 1e-10f ? unitOr(beside, anyPerpendicular(axes.x))
                                       : anyPerpendicular(axes.x);
  axes.z = axes.x.cross(axes.y);
  return axes;
}

V3f lightAxis(const Light& light, const V3f& referencePoint) {
  const V3f direction = unitOr(light.direction, V3f(0, 0, -1));
  if (light.type == Light::Type::sun) return direction;
  return unitOr(referencePoint - light.position, direction);
}

BrushFrame seedFrame(const V3f& axis) {
  const float cosY = std::sqrt(axis.y * axis.y + axis.z * axis.z), sinY = axis.x;
  const float cosX = cosY > 0.0f ? axis.z / cosY : 1.0f;
  const float sinX = cosY > 0.0f ? -axis.y / cosY : 0.0f;
  return {axis, {cosY, sinX * sinY, -cosX * sinY}, {0, cosX, sinX}};
}

BrushFrame turningFrame(const V3f& axis, const ObjectAxes& object) {
  const V3f from = -object.z;
  const V3f side = from.cross(axis);
  const float onePlusCosine = 1.0f + from.dot(axis);
  // Below this the rotation is lost in rounding: half a turn about the object's X.
  if (onePlusCosine < 1e-6f) return {axis, object.x, object.y};
  const auto turn = [&](const V3f& v) {
    return v + side.cross(v) + side.cross(side.cross(v)) / onePlusCosine;
  };
  const V3f first = turn(object.x);
  const V3f l1 = unitOr(first - axis * axis.dot(first), object.x);
  return {axis, l1, axis.cross(l1)};
}

}  // namespace kagefude
