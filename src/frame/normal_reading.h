#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "image/vec.h"

namespace kagefude::detail {

/// How a normal's three numbers become a world vector: 0..1 decoded, axes picked and turned round,
/// then from the camera's space.
struct NormalReading {
  bool unit = false;
  std::array<int, 3> axis = {0, 1, 2};
  std::array<float, 3> sign = {1, 1, 1};
  std::optional<Transform> worldFromCamera;

  V3f operator()(const V3f& given) const;
  bool isPlain() const;
  /// How far it departs from taking the numbers as they are; of equals the simpler is meant.
  int departures() const;
  /// "frame.normal_space = \"camera\" and frame.normal_axes = \"x y -z\"".
  std::string settings() const;
  /// "are in the camera's space", "hold 0..1 instead of -1..1", "have other axes".
  std::string sentence() const;
};

/// The reading that frame.normal_axes asks for; "" takes them as they are. LookError when it does
/// not name x, y and z once each.
NormalReading readingOf(const std::string& axes);

/// Every order and direction of the axes: 48, the plain one first.
std::vector<NormalReading> allAxes();

}  // namespace kagefude::detail
