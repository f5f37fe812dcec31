#pragma once

#include <string>

#include "image/vec.h"

namespace kagefude {

/// Receives every intermediate picture of a frame while it is there: what `sheet` draws. The views
/// live only during the call.
class StageSink {
 public:
  virtual ~StageSink() = default;
  /// One number a pixel, shown as grey from 0 to 1.
  virtual void number(const std::string& title, View<const float> plane) = 0;
  /// A hard mask: 0 or 1.
  virtual void mask(const std::string& title, View<const uint8_t> plane) = 0;
  /// Labels, shown in distinct colours; 0 is black.
  virtual void labels(const std::string& title, View<const uint32_t> plane) = 0;
  /// Shadow classes (ShadowClass values).
  virtual void classes(const std::string& title, View<const uint8_t> plane) = 0;
  /// Unit vectors, shown as 0.5 + 0.5 n.
  virtual void directions(const std::string& title, Vec3View plane) = 0;
  /// A picture in the working space.
  virtual void picture(const std::string& title, Vec3View plane) = 0;
};

}  // namespace kagefude
