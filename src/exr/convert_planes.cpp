#include "exr/convert_planes.h"

#include <Imath/half.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "exr/fast_kernels.h"

namespace kagefude {
namespace {

void toMask(const float* values, size_t pixels, const PlaneTarget& mask) {
  const size_t unknown = fastestExrKernels().floatToMask(
      reinterpret_cast<const uint8_t*>(values), pixels, static_cast<uint8_t*>(mask.pixels));
  if (mask.unknown) *mask.unknown += unknown;
}

void toFloats(const PlaneTarget& from, size_t pixels, float* values) {
  if (from.type == PixelType::single) {
    std::memcpy(values, from.pixels, pixels * sizeof(float));
  } else if (from.type == PixelType::half) {
    const auto* halves = static_cast<const uint16_t*>(from.pixels);
    std::transform(halves, halves + pixels, values, imath_half_to_float);
  } else {
    const auto* words = static_cast<const uint32_t*>(from.pixels);
    std::transform(words, words + pixels, values,
                   [](uint32_t word) { return static_cast<float>(word); });
  }
}

void toSparse(const void* words, SparsePlane& plane) {
  const auto* const rows = static_cast<const uint32_t*>(words);
  for (int y = 0; y < plane.height(); ++y)
    plane.setRow(y, rows + static_cast<ptrdiff_t>(y) * plane.width());
}

Labels wholeOf(const SparsePlane& plane) {
  Labels whole(plane.width(), plane.height());
  for (int y = 0; y < plane.height(); ++y)
    for (int x = 0; x < plane.width(); ++x) whole(x, y) = plane(x, y);
  return whole;
}

}  // namespace

void copyPlane(const PlaneTarget& from, const PlaneTarget& to, const Window& window) {
  const auto pixels = static_cast<size_t>(window.pixels());
  if (from.sparse) {
    Labels whole = wholeOf(*from.sparse);
    copyPlane({from.channel, from.type, whole.row(0)}, to, window);
  } else if (from.type == to.type && from.mask == to.mask) {
    if (to.sparse)
      toSparse(from.pixels, *to.sparse);
    else
      std::memcpy(to.pixels, from.pixels, pixels * bytesOf(from));
    if (to.unknown && from.unknown) *to.unknown = *from.unknown;
  } else if (to.mask && from.type == PixelType::single) {
    toMask(static_cast<const float*>(from.pixels), pixels, to);
  } else if (to.mask || to.sparse) {
    std::vector<float> values(pixels);
    toFloats(from, pixels, values.data());
    copyPlane({to.channel, PixelType::single, values.data()}, to, window);
  } else {
    toFloats(from, pixels, static_cast<float*>(to.pixels));
  }
}

void placePlane(const ImageFile& file, const PlaneTarget& own, const PlaneTarget& whole) {
  const Window& from = partWindow(file, *own.channel);
  const Window& to = file.dataWindow;
  if (whole.sparse) {
    Labels placed(to.width, to.height);
    placePlane(file, own, {whole.channel, whole.type, placed.row(0)});
    return toSparse(placed.row(0), *whole.sparse);
  }
  const size_t bytes = bytesOf(own);
  const auto* source = static_cast<const std::byte*>(own.pixels);
  auto* target = static_cast<std::byte*>(whole.pixels);
  const size_t sourceRow = static_cast<size_t>(from.width) * bytes;
  const size_t targetRow = static_cast<size_t>(to.width) * bytes;
  std::memset(target, whole.mask ? 1 : 0, targetRow * static_cast<size_t>(to.height));
  target +=
      static_cast<size_t>(from.y - to.y) * targetRow + static_cast<size_t>(from.x - to.x) * bytes;
  for (int y = 0; y < from.height; ++y, source += sourceRow, target += targetRow)
    std::memcpy(target, source, sourceRow);
}

}  // namespace kagefude
