#include "frame/compared_planes.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "frame/part_fixtures.h"
#include "test_folder.h"

namespace kagefude {
namespace {

using testing::writeParts;

/// 4 x 2 pixels that count up from `first`.
Floats counting(float first) {
  Floats plane(4, 2);
  for (size_t i = 0; i < 8; ++i) plane.view().data[i] = first + static_cast<float>(i);
  return plane;
}

TEST(ComparedPlanes, LieByTheirDataWindows) {
  const TestFolder folder;
  const Floats values = counting(0);
  writeParts(folder / "whole.exr", 4, 2, {{"", "", {{"Y", values}}, {}, {}}});
  writeParts(folder / "cut.exr", 4, 2, {{"", "", {{"Y", values}}, {1, 0, 2, 2}, {}}});
  const ComparedPlanes planes =
      readCompared(openImage(folder / "cut.exr"), "Y", openImage(folder / "whole.exr"), "Y", "");
  ASSERT_EQ(planes.value.width(), 2);
  ASSERT_EQ(planes.value.height(), 2);
  EXPECT_EQ(planes.value(0, 0), 1);
  EXPECT_EQ(planes.truth(0, 0), 1);
  EXPECT_EQ(planes.value(1, 1), 6);
  EXPECT_EQ(planes.truth(1, 1), 6);
  EXPECT_EQ(planes.outside, 4u);
  EXPECT_TRUE(planes.where.empty());
}

TEST(ComparedPlanes, BackgroundDoesNotCount) {
  const TestFolder folder;
  const Floats values = counting(0), zero(4, 2, 0.0f);
  Floats across(4, 2, 0.0f);
  across(1, 0) = -1;
  across(2, 1) = 0.5f;
  const testing::Channels normal{{"N.X", across}, {"N.Y", zero}, {"N.Z", zero}, {"Y", values}};
  writeParts(folder / "plain.exr", 4, 2, {{"", "", {{"Y", values}}, {}, {}}});
  writeParts(folder / "normals.exr", 4, 2, {{"", "", normal, {}, {}}});
  const ImageFile plain = openImage(folder / "plain.exr");
  const ImageFile normals = openImage(folder / "normals.exr");
  for (const auto& [file, truth] : {std::pair{plain, normals}, std::pair{normals, plain}}) {
    const ComparedPlanes planes = readCompared(file, "Y", truth, "Y", "");
    EXPECT_EQ(planes.background, 6u);
    EXPECT_EQ(planes.where(1, 0), 1);
    EXPECT_EQ(planes.where(2, 1), 1);
    EXPECT_EQ(planes.where(0, 0), 0);
  }
  const ComparedPlanes chosen = readCompared(plain, "Y", normals, "Y", "Y");
  EXPECT_EQ(chosen.background, 0u);
  EXPECT_EQ(chosen.where(3, 1), 7);
}

TEST(ComparedPlanes, PicturesOfOtherSizesAndApartAreRefused) {
  const TestFolder folder;
  const Floats values = counting(0);
  writeParts(folder / "a.exr", 4, 2, {{"", "", {{"Y", values}}, {0, 0, 1, 2}, {}}});
  writeParts(folder / "b.exr", 4, 2, {{"", "", {{"Y", values}}, {2, 0, 2, 2}, {}}});
  writeParts(folder / "c.exr", 4, 1, {{"", "", {{"Y", values}}, {}, {}}});
  const auto compared = [&](const char* a, const char* b) {
    return messageOf<InputError>(
        [&] { readCompared(openImage(folder / a), "Y", openImage(folder / b), "Y", ""); });
  };
  EXPECT_NE(compared("a.exr", "b.exr").find("no pixel in common"), std::string::npos);
  EXPECT_NE(compared("a.exr", "c.exr").find("4x1 pixels"), std::string::npos);
}

}  // namespace
}  // namespace kagefude
