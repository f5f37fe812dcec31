#include "compositor/write_frame_picture.h"

#include <OpenImageIO/oiioversion.h>

#include "compositor/test_frame.h"
#include "picture/picture_file.h"

namespace kagefude {
namespace {

using namespace testing;

/// Two pixels of a picture that is given outright: a half covered one, and light without a surface.
class FramePicture : public ::testing::Test {
 protected:
  FramePicture() : frame(2, 1), colour(look.colourConfig()) {
    look = readLook({}, {"colour.view=Raw"});
    plan.image = openImage(frame.write());
    for (Floats* plane : {&result.colour.x, &result.colour.y, &result.colour.z})
      *plane = Floats(2, 1, 0.25f);
    result.alpha = Floats(2, 1, 0.5f);
    result.alpha(1, 0) = 0.0f;
  }

  /// The red and alpha of both pixels as the file has them.
  std::vector<float> written(const std::string& name, SampleDepth depth) {
    const PictureFormat& format = formatOf(name, "--output");
    const auto path = frame.folder.path() / name;
    writeFramePicture(look, colour, plan, result, path, {&format, depth, alphaFor(format, depth)},
                      fingerprint);
    EXPECT_EQ(pictureFingerprint(path, format), fingerprint) << name;
    PictureFile file(path);
    Floats red(2, 1), alpha(2, 1, -1.0f);
    std::vector<PicturePlane> planes = {{0, red, {}, {}}};
    if (file.header().channels.size() > 3) planes.push_back({3, alpha, {}, {}});
    file.read(planes);
    return {red(0, 0), alpha(0, 0), red(1, 0), alpha(1, 0)};
  }

  void expect(const std::string& name, SampleDepth depth, const std::vector<float>& wanted) {
    const std::vector<float> got = written(name, depth);
    const float step = isDisplayReferred(depth) ? 1.0f / static_cast<float>(mostOf(depth)) : 0.0f;
    for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(got[i], wanted[i], step) << name << " " << i;
  }

  static constexpr const char* fingerprint = "0123456789abcdef0123456789abcdef";
  TestFrame frame;
  Look look;
  Colour colour;
  FramePlan plan;
  FrameResult result;
};

TEST_F(FramePicture, ColoursAreByThemselvesOrMultipliedAsTheFormatHasThem) {
  expect("a.png", SampleDepth::uint16, {0.5f, 0.5f, 0.25f, 0});
  expect("a.png", SampleDepth::uint8, {0.5f, 0.5f, 0.25f, 0});
  expect("a.tif", SampleDepth::uint16, {0.25f, 0.5f, 0.25f, 0});
  expect("a.dpx", SampleDepth::uint12, {0.25f, 0.5f, 0.25f, 0});
}

TEST_F(FramePicture, WithoutAlphaItStandsOnBlack) {
  expect("a.dpx", SampleDepth::uint10, {0.25f, -1, 0.25f, -1});
  const std::vector<float> jpeg = written("a.jpg", SampleDepth::uint8);
  EXPECT_NEAR(jpeg[0], 0.25f, 0.03f);
}

TEST_F(FramePicture, TheViewWorksOnColoursByThemselves) {
  look = readLook({}, {});          // sRGB
  const float encoded = 0.735357f;  // of 0.5, by IEC 61966-2-1
  const std::vector<float> png = written("a.png", SampleDepth::uint16);
  EXPECT_NEAR(png[0], encoded, 2e-5f);
  const std::vector<float> tiff = written("a.tif", SampleDepth::uint16);
  EXPECT_NEAR(tiff[0], encoded / 2, 2e-5f);
}

TEST_F(FramePicture, FloatsAreSceneLinearAsTheyAre) {
  look = readLook({}, {});
  result.colour.x(0, 0) = 40.0f;
  expect("a.tif", SampleDepth::single, {40.0f, 0.5f, 0.25f, 0});
}

TEST_F(FramePicture, WebpKeepsColoursAndMetadata) {
  look = readLook({}, {"colour.view=Raw", "output.quality=100"});
  // OpenImageIO's reader before 3.1 multiplies by alpha in 8 bits, which leaves no light without a
  // surface.
  if (OIIO_VERSION < 30100)
    expect("a.webp", SampleDepth::uint8, {0.25f, 0.5f, 0, 0});
  else
    expect("a.webp", SampleDepth::uint8, {0.5f, 0.5f, 0.25f, 0});
}

TEST_F(FramePicture, ACutPictureIsNotUpToDate) {
  for (const char* name : {"a.png", "a.tif", "a.dpx", "a.jpg", "a.webp"}) {
    const PictureFormat& format = formatOf(name, "--output");
    written(name, format.depths.front());
    const auto path = frame.folder.path() / name;
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 3);
    std::string found;
    try {
      found = pictureFingerprint(path, format);
    } catch (const InputError&) {
    }
    EXPECT_EQ(found, "") << name;
  }
}

}  // namespace
}  // namespace kagefude
