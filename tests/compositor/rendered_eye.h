#pragma once

#include <bit>
#include <cmath>
#include <functional>

#include "frame/cryptomatte.h"
#include "frame/part_fixtures.h"
#include "image/vec.h"

namespace kagefude::testing {

/// A ball on a floor as a renderer's data layer shows it, seen by one eye of a camera that looks
/// down on it.
struct RenderedEye {
  static constexpr int width = 96, height = 72;
  V3d eye{0, 0, 0}, right{0, 0, 0}, up{0, 0, 0}, ahead{0, 0, 0};
  Vec3Plane position{width, height}, normal{width, height};
  Floats id{width, height}, share{width, height}, mask{width, height}, colour{width, height};

  V3f toCamera(const V3f& v) const {
    return {static_cast<float>(right.dot(V3d(v))), static_cast<float>(up.dot(V3d(v))),
            static_cast<float>(-ahead.dot(V3d(v)))};
  }
};

inline void renderPixel(RenderedEye& out, int x, int y) {
  const double across = (x + 0.5 - out.width / 2.0) / out.height;
  const double down = (y + 0.5 - out.height / 2.0) / out.height;
  const V3d ray = (out.ahead + out.right * across - out.up * down).normalized();
  const V3d centre(0, 0, 1);
  const V3d toBall = out.eye - centre;
  const double b = toBall.dot(ray), inside = b * b - toBall.length2() + 1;
  const char* name = nullptr;
  V3d p(0, 0, 0), n(0, 0, 0);
  if (inside > 0) {
    p = out.eye + ray * (-b - std::sqrt(inside));
    n = p - centre;
    name = "Ball";
  } else if (ray.z < 0 && (p = out.eye - ray * (out.eye.z / ray.z)).length() < 9) {
    n = V3d(0, 0, 1);
    name = "Floor";
  } else {
    p = V3d(0, 0, 0);
  }
  out.position.set(x, y, V3f(p));
  out.normal.set(x, y, V3f(n));
  out.id(x, y) = name ? std::bit_cast<float>(cryptomatteId(name)) : 0.0f;
  out.share(x, y) = name ? 1.0f : 0.0f;
  out.mask(x, y) = V3d(p.x - 1, p.y + 1, p.z).length() > 1.2 ? 1.0f : 0.0f;
  out.colour(x, y) = static_cast<float>(0.25 + 0.01 * p.x);
}

inline RenderedEye renderEye(double aside) {
  RenderedEye out;
  out.eye = V3d(aside - 3, -8, 4);
  out.ahead = (V3d(aside, 0, 0.5) - out.eye).normalized();
  out.right = out.ahead.cross(V3d(0, 0, 1)).normalized();
  out.up = out.right.cross(out.ahead);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) renderPixel(out, x, y);
  return out;
}

/// Its channels as a renderer names them, each name as `rename` changes it.
inline Channels channelsOf(
    const RenderedEye& eye,
    const std::function<std::string(const std::string&)>& rename = std::identity()) {
  Channels all;
  const std::pair<const char*, View<const float>> named[] = {{"R", eye.colour},
                                                             {"G", eye.colour},
                                                             {"B", eye.colour},
                                                             {"A", eye.share},
                                                             {"N.X", eye.normal.x},
                                                             {"N.Y", eye.normal.y},
                                                             {"N.Z", eye.normal.z},
                                                             {"P.X", eye.position.x},
                                                             {"P.Y", eye.position.y},
                                                             {"P.Z", eye.position.z},
                                                             {"mask.0.Y", eye.mask},
                                                             {"mask.1.Y", eye.mask},
                                                             {"crypto_object00.r", eye.id},
                                                             {"crypto_object00.g", eye.share}};
  for (const auto& [name, plane] : named) all.emplace(rename(name), plane);
  return all;
}

inline std::map<std::string, std::string> manifestOf(const std::string& name) {
  return {{"cryptomatte/f834d0a/name", name},
          {"cryptomatte/f834d0a/manifest", R"({"Ball":"74d3ebe9","Floor":"6a2fb16e"})"}};
}

}  // namespace kagefude::testing
