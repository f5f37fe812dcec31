#include "colour/display_bytes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "base/error.h"
#include "image/vec.h"
#include "test_folder.h"

namespace kagefude {
namespace {

/// A view that mixes channels, and one that has a curve of its own for each.
constexpr const char* displayBytesConfig = R"(ocio_profile_version: 2
roles: {scene_linear: lin, default: lin}
displays:
  screen:
    - !<View> {name: Mixed, colorspace: mixed}
    - !<View> {name: Apart, colorspace: apart}
colorspaces:
  - !<ColorSpace> {name: lin}
  - !<ColorSpace>
    name: mixed
    from_scene_reference: !<MatrixTransform> {matrix: [0.7, 0.2, 0.1, 0, 0.1, 0.8, 0.1, 0, 0.3, 0.3, 0.4, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: apart
    from_scene_reference: !<ExponentTransform> {value: [0.4, 0.5, 0.6, 1]}
)";

class DisplayBytes : public ::testing::Test {
 protected:
  void SetUp() override { unsetenv("OCIO"); }

  /// Most values between 0 and 1, some far out or none at all.
  static Floats noise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    Floats plane(width, height);
    const float strange[] = {0.0f,   -0.0f, -0.5f,     1.0f,     2.0f,
                             1e-30f, 7e4f,  -INFINITY, INFINITY, NAN};
    for (size_t i = 0; i < plane.view().pixels(); ++i) {
      const auto number = static_cast<float>(random()) / 4294967296.0f;
      plane.row(0)[i] = random() % 40 == 0 ? strange[random() % 10] : number * number * 1.5f;
    }
    return plane;
  }

  static uint8_t byteOf(float value) {
    return value > 0.0f ? static_cast<uint8_t>(std::min(value, 1.0f) * 255.0f + 0.5f) : uint8_t{0};
  }

  /// Every byte against toDisplay's.
  static void expectOfDisplay(const Colour& colour, int width, int height, float exposure,
                              const std::string& display, const std::string& view) {
    Floats planes[3];
    for (unsigned k = 0; k < 3; ++k) planes[k] = noise(width, height, k + 1);
    std::string bytes(4 * planes[0].view().pixels(), '\0');
    displayBytes(colour, planes[0], planes[1], planes[2], exposure, display, view, bytes.data());
    for (Floats& plane : planes)
      for (size_t i = 0; i < plane.view().pixels(); ++i) plane.row(0)[i] *= std::exp2(exposure);
    colour.toDisplay(planes[0], planes[1], planes[2], display, view);
    for (size_t i = 0; i < bytes.size(); ++i) {
      const uint8_t wanted = i % 4 == 3 ? uint8_t{255} : byteOf(planes[i % 4].row(0)[i / 4]);
      ASSERT_EQ(static_cast<uint8_t>(bytes[i]), wanted) << view << " at byte " << i;
    }
  }
};

TEST_F(DisplayBytes, AreThoseOfTheDisplayWhateverTheSizeAndExposure) {
  const Colour colour;
  for (const char* view : {"Standard", "Raw"})
    for (const float exposure : {0.0f, -3.5f, 2.0f})
      for (const int height : {3, 500})  // by each pixel, by a table
        expectOfDisplay(colour, 400, height, exposure, "sRGB", view);
}

TEST_F(DisplayBytes, OfViewsWithACurveForEachChannelAndOfThoseThatMixThem) {
  const TestFolder folder;
  const Colour colour(folder.write("config.ocio", displayBytesConfig));
  EXPECT_TRUE(colour.mixesChannels("screen", "Mixed"));
  EXPECT_FALSE(colour.mixesChannels("screen", "Apart"));
  for (const char* view : {"Mixed", "Apart"})
    expectOfDisplay(colour, 400, 500, 0.5f, "screen", view);
}

TEST_F(DisplayBytes, AnUnknownViewIsALookError) {
  const Colour colour;
  const Floats plane(2, 2, 0.0f);
  char bytes[16];
  EXPECT_THROW(displayBytes(colour, plane, plane, plane, 0, "sRGB", "Standart", bytes), LookError);
}

}  // namespace
}  // namespace kagefude
