#pragma once

#include <cstdint>

namespace kagefude {

/// Rectangle of pixels with integer corners, upper bound exclusive. Origins may be negative.
struct Window {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool operator==(const Window&) const = default;
  int64_t pixels() const { return static_cast<int64_t>(width) * height; }
};

}  // namespace kagefude
