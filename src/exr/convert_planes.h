#pragma once

#include <cstddef>

#include "exr/read_channels.h"

namespace kagefude {

/// Of one pixel.
inline size_t bytesOf(PixelType type) { return type == PixelType::half ? 2 : 4; }
inline size_t bytesOf(const PlaneTarget& target) { return target.mask ? 1 : bytesOf(target.type); }

inline const Window& partWindow(const ImageFile& file, const Channel& channel) {
  return file.parts[static_cast<size_t>(channel.part)].dataWindow;
}

/// Fills a plane from another of the same channel and the same window. `from` has the channel's own
/// type, or both have the same.
void copyPlane(const PlaneTarget& from, const PlaneTarget& to, const Window& window);

/// Lays a part's own window into a plane of the file's, with zeros around it, round a mask ones.
/// `own` is no sparse plane.
void placePlane(const ImageFile& file, const PlaneTarget& own, const PlaneTarget& whole);

}  // namespace kagefude
