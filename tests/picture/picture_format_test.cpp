#include "picture/picture_format.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "test_folder.h"

namespace kagefude {
namespace {

TEST(PictureFormat, SuffixesOfEitherCaseNameIt) {
  EXPECT_EQ(formatOf("a/shot.####.TIFF", "--output").name, "tiff");
  EXPECT_EQ(formatOf("shot.%04d.jpg", "--output").name, "jpeg");
  EXPECT_TRUE(formatOf("x.exr", "--output").isExr());
}

TEST(PictureFormat, OtherSuffixesAreAnsweredWithAllOfThem) {
  const std::string near = messageOf<UsageError>([] { formatOf("out/a.tga", "--output"); });
  EXPECT_NE(near.find("--output out/a.tga: no pictures are written as .tga"), std::string::npos);
  EXPECT_NE(near.find(".exr, .tif, .tiff, .png, .dpx, .jpg, .jpeg and .webp"), std::string::npos);
  EXPECT_NE(messageOf<UsageError>([] { formatOf("shot", "--output"); }).find("no suffix"),
            std::string::npos);
}

TEST(PictureFormat, DepthIsTheUsualOneOrOneThatItHolds) {
  const PictureFormat& png = formatOf("a.png", "--output");
  EXPECT_EQ(depthFor(png, SampleDepth::automatic), SampleDepth::uint16);
  EXPECT_EQ(depthFor(png, SampleDepth::uint8), SampleDepth::uint8);
  EXPECT_EQ(messageOf<LookError>([&] { depthFor(png, SampleDepth::half); }),
            "output.colour = \"half\" does not go into .png files, which hold uint16 and uint8");
  EXPECT_EQ(depthFor(formatOf("a.dpx", ""), SampleDepth::automatic), SampleDepth::uint10);
}

TEST(PictureFormat, EveryDepthHasItsRange) {
  EXPECT_EQ(mostOf(SampleDepth::uint8), 255);
  EXPECT_EQ(mostOf(SampleDepth::uint10), 1023);
  EXPECT_EQ(mostOf(SampleDepth::uint16), 65535);
  EXPECT_FALSE(isDisplayReferred(SampleDepth::single));
  EXPECT_TRUE(isDisplayReferred(SampleDepth::uint12));
}

}  // namespace
}  // namespace kagefude
