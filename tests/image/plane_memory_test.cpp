#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>

#include "image/plane.h"

namespace kagefude {
namespace {

#if defined(__SANITIZE_ADDRESS__)
#define KAGEFUDE_KEEPS_PLANES 0
#elif defined(__has_feature)
#define KAGEFUDE_KEEPS_PLANES !__has_feature(address_sanitizer)
#else
#define KAGEFUDE_KEEPS_PLANES 1
#endif
#if KAGEFUDE_KEEPS_PLANES

constexpr size_t mebi = size_t{1} << 20;

size_t residentBytes() {
  size_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * static_cast<size_t>(::sysconf(_SC_PAGESIZE));
}

/// A plane of that many mebibytes, every page of it touched.
Bytes touched(int size) { return Bytes(1024, 1024 * size, uint8_t{1}); }

TEST(PlaneMemory, APlanesMemoryGoesToTheNextOfItsSize) {
  struct Sizes {
    int width, height, otherWidth, otherHeight;
  };
  for (const Sizes& size : {Sizes{3000, 3000, 4000, 3000}, Sizes{1024, 576, 1024, 700}}) {
    releaseKeptPlaneMemory();
    const uint8_t* first = nullptr;
    {
      // Both at once, so that keeping the first beside another of the second's size adds nothing.
      const Bytes plane(size.width, size.height), beside(size.otherWidth, size.otherHeight);
      first = plane.row(0);
    }
    const Bytes other(size.otherWidth, size.otherHeight), same(size.width, size.height);
    EXPECT_EQ(same.row(0), first);
    EXPECT_NE(other.row(0), first);
  }
}

TEST(PlaneMemory, WhatIsKeptNeverAddsToTheMostThatWasUsed) {
  releaseKeptPlaneMemory();
  const size_t before = residentBytes();
  { const Bytes plane = touched(200); }
  {
    const Bytes plane = touched(230);
    EXPECT_LT(residentBytes(), before + 250 * mebi) << "the 200 MiB must not be kept beside these";
  }
  const Bytes a = touched(100), b = touched(120);
  EXPECT_LT(residentBytes(), before + 250 * mebi);
}

TEST(PlaneMemory, APlaneMovesWithItsMemory) {
  Bytes plane(3000, 3000, uint8_t{7});
  const uint8_t* const pixels = plane.row(0);
  Bytes moved = std::move(plane);
  Bytes assigned(10, 10);
  assigned = std::move(moved);
  EXPECT_EQ(assigned.row(0), pixels);
  EXPECT_EQ(assigned(2999, 2999), 7);
}

#endif

TEST(PlaneMemory, PlanesStartOnALineAndMayBeReadBehindTheirEnd) {
  for (const int side : {1, 17, 63, 2500}) {
    const Floats plane(side, side, 0.0f);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(plane.row(0)) % 64, 0u) << side;
    volatile float behind = plane.row(side)[15];
    static_cast<void>(behind);
  }
}

}  // namespace
}  // namespace kagefude
