#pragma once

#include <cstdint>
#include <random>

#include "image/plane.h"

namespace kagefude::test {

/// Blocks of random labels 0 .. count-1, `cell` pixels a side with ragged edges.
inline Labels randomLabels(int width, int height, int count, int cell, uint32_t seed) {
  std::mt19937 random(seed);
  const int across = width / cell + 2, down = height / cell + 2;
  Labels cells(across, down);
  for (int y = 0; y < down; ++y)
    for (int x = 0; x < across; ++x) cells(x, y) = random() % static_cast<uint32_t>(count);
  Labels labels(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      labels(x, y) = cells((x + static_cast<int>(random() % 2)) / cell, y / cell);
  return labels;
}

/// Bytes 0 .. kinds-1; `rare` in 1000 pixels differ from kind 0 when it is positive.
inline Bytes randomKinds(int width, int height, int kinds, int rare, uint32_t seed) {
  std::mt19937 random(seed);
  Bytes bytes(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool base = rare > 0 && static_cast<int>(random() % 1000) >= rare;
      bytes(x, y) = base ? 0 : static_cast<uint8_t>(random() % static_cast<uint32_t>(kinds));
    }
  return bytes;
}

inline Floats randomFloats(int width, int height, uint32_t seed) {
  std::mt19937 random(seed);
  Floats floats(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) floats(x, y) = static_cast<float>(random() >> 8) * 0x1p-24f;
  return floats;
}

template <class T>
bool equalBits(View<const T> a, View<const T> b) {
  if (a.width != b.width || a.height != b.height) return false;
  for (size_t i = 0; i < a.pixels(); ++i)
    if (a.data[i] != b.data[i]) return false;
  return true;
}

template <class T>
Plane<T> mirrored(View<const T> plane) {
  Plane<T> result(plane.width, plane.height);
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) result(x, y) = plane(plane.width - 1 - x, y);
  return result;
}

}  // namespace kagefude::test
