#include "frame/camera_faults.h"

#include <fmt/format.h>

#include <cmath>

namespace kagefude::detail {
namespace {

V3d columnOf(const Transform& t, int column) {
  return {t.m[0][column], t.m[1][column], t.m[2][column]};
}

bool isFinite(const Transform& t) {
  for (const auto& row : t.m)
    for (const double value : row)
      if (!std::isfinite(value)) return false;
  return true;
}

constexpr double rounding = 1e-5;

// An inverse of floats may have 0.9999999 for 1.
bool isNearlyAffine(const Transform& t) {
  return std::abs(t.m[3][0]) <= rounding && std::abs(t.m[3][1]) <= rounding &&
         std::abs(t.m[3][2]) <= rounding && std::abs(t.m[3][3] - 1) <= rounding;
}

// From a telescope's hundredth of a degree to half of all that is ahead.
bool isLens(double scale) { return std::abs(scale) >= 1e-3 && std::abs(scale) <= 1e5; }

double degreesSeen(double scale) { return 360 / M_PI * std::atan(1 / std::abs(scale)); }

}  // namespace

bool isAffine(const Transform& t) {
  return t.m[3][0] == 0 && t.m[3][1] == 0 && t.m[3][2] == 0 && t.m[3][3] == 1;
}

double handedness(const Transform& t) {
  return columnOf(t, 0).cross(columnOf(t, 1)).dot(columnOf(t, 2));
}

std::string rigidFault(const Transform& t) {
  constexpr double most = 1e-3;
  if (!isFinite(t)) return "holds numbers that are not finite";
  if (!isNearlyAffine(t)) return "has another last row than 0 0 0 1";
  for (int i = 0; i < 3; ++i) {
    const double length = columnOf(t, i).length();
    if (std::abs(length - 1) > most) return fmt::format("scales by {:.4g}", length);
    if (std::abs(columnOf(t, i).dot(columnOf(t, (i + 1) % 3))) > most) return "skews";
  }
  return "";
}

std::string projectionFault(const Transform& clipFromCamera) {
  const auto& m = clipFromCamera.m;
  if (!isFinite(clipFromCamera)) return "holds numbers that are not finite";
  const double none = -rounding * m[3][2];
  const bool perspective = m[3][2] < 0 && std::abs(m[3][0]) <= none && std::abs(m[3][1]) <= none &&
                           std::abs(m[3][3]) <= none;
  if (!perspective && !isAffine(clipFromCamera))
    return "is no projection of a camera that looks along -z (its last row is 0 0 -1 0, of a "
           "parallel one 0 0 0 1)";
  if (m[0][0] * m[1][1] - m[0][1] * m[1][0] == 0) return "shows a line or a point";
  if (!perspective) return "";
  const double x = std::hypot(m[0][0], m[0][1]) / -m[3][2];
  const double y = std::hypot(m[1][0], m[1][1]) / -m[3][2];
  if (isLens(x) && isLens(y)) return "";
  return fmt::format("sees {:.3g} by {:.3g} degrees, which no picture does", degreesSeen(x),
                     degreesSeen(y));
}

}  // namespace kagefude::detail
