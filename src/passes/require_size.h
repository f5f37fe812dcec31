#pragma once

#include <fmt/format.h>

#include <string_view>

#include "base/error.h"
#include "image/plane.h"
#include "image/vec.h"

namespace kagefude {

/// Throws InputError when a plane of width x height is not as large as the frame; `what` names the
/// plane in the message.
inline void requireSize(std::string_view what, int width, int height, int frameWidth,
                        int frameHeight) {
  if (width == frameWidth && height == frameHeight) return;
  throw InputError(fmt::format("{} is {}x{} pixels, but the frame is {}x{}", what, width, height,
                               frameWidth, frameHeight));
}

template <class T>
void requireSize(std::string_view what, const View<T>& plane, int frameWidth, int frameHeight) {
  requireSize(what, plane.width, plane.height, frameWidth, frameHeight);
}

inline void requireSize(std::string_view what, const Vec3View& planes, int frameWidth,
                        int frameHeight) {
  for (const View<const float>& plane : {planes.x, planes.y, planes.z})
    requireSize(what, plane, frameWidth, frameHeight);
}

}  // namespace kagefude
