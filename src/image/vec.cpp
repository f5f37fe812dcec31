#include "image/vec.h"

namespace kagefude {

V4d Transform::homogeneous(const V3d& p) const {
  V4d r;
  for (int i = 0; i < 4; ++i) r[i] = m[i][0] * p.x + m[i][1] * p.y + m[i][2] * p.z + m[i][3];
  return r;
}

V3d Transform::point(const V3d& p) const {
  const V4d h = homogeneous(p);
  return {h[0] / h[3], h[1] / h[3], h[2] / h[3]};
}

V3d Transform::direction(const V3d& d) const {
  V3d r;
  for (int i = 0; i < 3; ++i) r[i] = m[i][0] * d.x + m[i][1] * d.y + m[i][2] * d.z;
  return r;
}

Transform Transform::inverse() const {
  Imath::M44d rows(m);
  Transform result;
  const Imath::M44d inverted = rows.inverse(false);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) result.m[i][j] = inverted[i][j];
  return result;
}

Transform operator*(const Transform& a, const Transform& b) {
  Transform result;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      result.m[i][j] = 0;
      for (int k = 0; k < 4; ++k) result.m[i][j] += a.m[i][k] * b.m[k][j];
    }
  return result;
}

}  // namespace kagefude
