#include "frame/frame_camera.h"

#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>

#include <cmath>

#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

using namespace testing;
using Imath::M44f;

/// Headers as renderers write them, without pixels.
class HeaderCamera : public ::testing::Test {
 protected:
  void display(int width, int height, float pixelAspect = 1) {
    file.displayWindow = file.dataWindow = {0, 0, width, height};
    file.pixelAspect = pixelAspect;
  }
  void matrix(const char* name, const M44f& m) { header.insert(name, Imf::M44fAttribute(m)); }

  FrameCamera camera() {
    file.ownParts = {0};
    file.parts.resize(1);
    file.headers = std::make_shared<const std::vector<Imf::Header>>(1, header);
    const auto found = cameraOfHeader(file);
    EXPECT_TRUE(found);
    return found.value_or(FrameCamera{});
  }

  static void expectPoint(const FrameCamera& camera, const V3d& world, const V3d& seen) {
    EXPECT_EQ(camera.problem, "");
    EXPECT_LT((camera.cameraFromWorld.point(world) - seen).length(), 1e-4)
        << camera.cameraFromWorld.point(world);
  }
  static void expectClip(const FrameCamera& camera, double scaleX, double scaleY,
                         double middleX = 0, double middleY = 0) {
    EXPECT_EQ(camera.clipProblem, "");
    ASSERT_TRUE(camera.clipFromCamera);
    const V3d seen = camera.clipFromCamera->point({1, 1, -2});
    EXPECT_NEAR(seen.x, scaleX / 2 + middleX, 1e-4);
    EXPECT_NEAR(seen.y, scaleY / 2 + middleY, 1e-4);
  }

  ImageFile file;
  Imf::Header header{8, 8};
};

// Stands at (0, -10, 0), looks along y with z up; a left-handed space, as OpenEXR says.
const M44f standing(1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 10, 1);
// The same in a right-handed space, which looks along -z.
const M44f standingRight(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, -10, 1);
// From the left-handed space, 90 degrees wide, 2 to 1: 0..1 with y down, and -1..1 with y up.
const M44f unitDown(.5f, 0, 0, 0, 0, -1, 0, 0, .5f, .5f, 1, 1, 0, 0, 0, 0);
const M44f symmetricUp(1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0);

TEST_F(HeaderCamera, IsReadAsOpenExrSays) {
  display(200, 100);
  matrix("worldToCamera", standing);
  matrix("worldToNDC", standing * unitDown);
  expectPoint(camera(), {1, 2, 3}, {1, 3, -12});
  expectClip(camera(), 1, 2);
  EXPECT_EQ(camera().source, "the header's worldToCamera");
  EXPECT_EQ(camera().doubt, "");
}

TEST_F(HeaderCamera, ShowsItsOrderByItsTranslation) {
  display(200, 100);
  matrix("worldToCamera", standing.transposed());
  matrix("worldToNDC", (standing * symmetricUp).transposed());
  expectPoint(camera(), {1, 2, 3}, {1, 3, -12});
  expectClip(camera(), 1, 2);
}

TEST_F(HeaderCamera, LooksAlongMinusZInARightHandedSpace) {
  display(200, 100);
  M44f toLeft;
  toLeft[2][2] = -1;
  matrix("worldToCamera", standingRight);
  matrix("worldToNDC", standingRight * toLeft * symmetricUp);
  expectPoint(camera(), {1, 2, 3}, {1, 3, -12});
  expectClip(camera(), 1, 2);
}

TEST_F(HeaderCamera, KeepsALensShift) {
  display(200, 100);
  const M44f shifted(1, 0, 0, 0, 0, 2, 0, 0, .15f, -.1f, 1, 1, 0, 0, 0, 0);
  matrix("worldToCamera", standing);
  matrix("worldToNDC", standing * shifted);
  expectClip(camera(), 1, 2, .15, -.1);
}

TEST_F(HeaderCamera, ReadsAParallelProjection) {
  display(200, 100);
  const M44f parallel(.1f, 0, 0, 0, 0, -.2f, 0, 0, 0, 0, 1, 0, .5f, .5f, 0, 1);
  matrix("worldToCamera", standing);
  matrix("worldToNDC", standing * parallel);
  const FrameCamera found = camera();
  ASSERT_TRUE(found.clipFromCamera) << found.clipProblem;
  EXPECT_LT((found.clipFromCamera->point({1, 1, -7}) - V3d(.2, .4, 7)).length(), 1e-5);
}

// Numbers of a real header of Mantra's (ynput/ayon-houdini, issue 76): w is -z ahead of the camera.
TEST_F(HeaderCamera, OfMantraIsUnderstood) {
  display(1280, 720);
  matrix("worldToCamera",
         M44f(-0.243232f, -0.429738f, -0.869577f, 0, -4.55991e-08f, 0.8965f, -0.443043f, 0,
              -0.969968f, 0.107762f, 0.218058f, 0, -0.49336f, -0.356619f, 6.48486f, 1));
  matrix("worldToNDC", M44f(-0.587216f, -1.84441f, -8.69577e-05f, 0.869577f, -1.10086e-07f,
                            3.84773f, -4.43043e-05f, 0.443043f, -2.34172f, 0.462509f, 2.18058e-05f,
                            -0.218058f, -1.19108f, -1.53059f, 0.000648386f, -6.48486f));
  expectPoint(camera(), {0, 0, 0}, {-0.49336, -0.356619, -6.48486});
  expectClip(camera(), 2.41422, 4.29195);
}

// Numbers of a real header of RenderMan's (jamesbowman/openexrpython, issue 27).
TEST_F(HeaderCamera, OfRenderManLooksAlongZ) {
  display(1920, 1080);
  matrix("worldToCamera",
         M44f(-0.998027f, 0.00469477f, -0.0626148f, 0, 7.91665e-09f, 0.997201f, 0.0747686f, 0,
              -0.0627905f, -0.0746212f, 0.995233f, 0, 63.5848f, -720.715f, -1061.66f, 1));
  expectPoint(camera(), {0, 0, 0}, {63.5848, -720.715, 1061.66});
  EXPECT_GT(camera().cameraFromWorld.direction({0, 1, 0}).y, 0.99);
  EXPECT_EQ(camera().doubt, "");
  EXPECT_FALSE(camera().clipFromCamera);
}

// Numbers of a real header of V-Ray 4.3 for Maya: above the ground, looking at the car at the
// origin.
TEST_F(HeaderCamera, OfVRayLooksAlongItsMinusY) {
  display(7718, 5787, 0.999563f);
  const M44f columns(0.579595f, -0.811918f, -0.06971f, -788.392f, -0.012255f, 0.0768498f,
                     -0.996967f, 34.8757f, 0.814813f, 0.578691f, 0.0345917f, 665.488f, 0, 0, 0, 1);
  header.insert("cameraFov", Imf::FloatAttribute(26.9862f));
  header.insert("cameraProjection", Imf::IntAttribute(0));
  for (const M44f& given : {columns, columns.transposed()}) {
    matrix("cameraTransform", given);
    const FrameCamera found = camera();
    const V3d place(-788.392, 34.8757, 665.488), ahead(0.811918, -0.0768498, -0.578691);
    expectPoint(found, place + ahead * 100, {0, 0, -100});
    EXPECT_GT(found.cameraFromWorld.direction({0, 1, 0}).y, 0.99);
    EXPECT_LT(found.cameraFromWorld.point({0, 0, 0}).z, -1000);
    const double scale = 1 / std::tan(26.9862 / 2 * M_PI / 180);
    expectClip(found, scale, scale * 7718 * 0.999563 / 5787);
  }
  header.insert("cameraProjection", Imf::IntAttribute(1));
  EXPECT_FALSE(camera().clipFromCamera);
  expectContains(camera().clipProblem, "cameraProjection is 1");
}

TEST_F(HeaderCamera, WithoutATranslationIsDoubtedUnlessItsNdcShowsTheOrder) {
  display(200, 100);
  M44f turned = standing;
  turned[3][2] = 0;
  const float c = std::cos(0.3f), s = std::sin(0.3f);
  turned = M44f(c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1) * turned;
  matrix("worldToCamera", turned);
  expectContains(camera().doubt, "whether its rows or its columns");
  matrix("worldToNDC", turned * unitDown);
  EXPECT_EQ(camera().doubt, "");
  expectPoint(camera(), {c, -s, 5},
              V3d(M44f(turned)[0][0] * c - M44f(turned)[1][0] * s, 5,
                  -(turned[0][2] * c - turned[1][2] * s)));
  const FrameCamera byRows = camera();
  matrix("worldToCamera", turned.transposed());
  matrix("worldToNDC", (turned * unitDown).transposed());
  EXPECT_EQ(camera().doubt, "");
  expectPoint(camera(), {1, 2, 3}, byRows.cameraFromWorld.point({1, 2, 3}));
  expectClip(camera(), 1, 2);
}

TEST_F(HeaderCamera, ThatContradictsItselfIsAProblem) {
  display(200, 100);
  M44f twice = standing;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) twice[i][j] *= 2;
  matrix("worldToCamera", twice);
  expectContains(camera().problem, "worldToCamera scales by 2");
  M44f open = standing;
  open[0][3] = 0.5f;
  matrix("worldToCamera", open);
  expectContains(camera().problem, "has no row or column 0 0 0 1");
  open[0][3] = std::nanf("");
  matrix("worldToCamera", open);
  expectContains(camera().problem, "not finite");
}

TEST_F(HeaderCamera, ThatLiesIsAProblem) {
  display(200, 100);
  matrix("worldToCamera", M44f(0.0f));
  expectContains(camera().problem, "worldToCamera has no row or column 0 0 0 1");
  M44f flat = standing;
  for (int row = 0; row < 3; ++row) flat[row][1] = 0;
  matrix("worldToCamera", flat);
  expectContains(camera().problem, "worldToCamera scales by 0");
  M44f skewed = standing;
  skewed[0][1] = 0.2f;
  matrix("worldToCamera", skewed);
  EXPECT_NE(camera().problem, "");
  matrix("worldToCamera", M44f(INFINITY));
  expectContains(camera().problem, "not finite");
  matrix("worldToCamera", standing);
  matrix("worldToNDC", M44f(std::nanf("")));
  expectContains(camera().clipProblem, "the header's worldToNDC is no projection");
  matrix("worldToNDC", M44f(0.0f));
  expectContains(camera().clipProblem, "the header's worldToNDC is no projection");
}

TEST_F(HeaderCamera, MayBeOfDoubles) {
  display(200, 100);
  header.insert("worldToCamera", Imf::M44dAttribute(Imath::M44d(standing)));
  header.insert("worldToNDC", Imf::M44dAttribute(Imath::M44d(standing * unitDown)));
  expectPoint(camera(), {1, 2, 3}, {1, 3, -12});
  expectClip(camera(), 1, 2);
}

TEST_F(HeaderCamera, OfVRayHasAnAngle) {
  display(200, 100);
  matrix("cameraTransform", M44f());
  for (const float angle : {0.0f, -20.0f, 180.0f, std::nanf(""), INFINITY}) {
    header.insert("cameraFov", Imf::FloatAttribute(angle));
    EXPECT_FALSE(camera().clipFromCamera);
    expectContains(camera().clipProblem, "degrees is no angle of view");
  }
  header.insert("cameraFov", Imf::FloatAttribute(1e-6f));
  EXPECT_FALSE(camera().clipFromCamera);
  expectContains(camera().clipProblem, "the header's cameraFov sees 1e-06 by 5e-07 degrees");
  matrix("cameraTransform", M44f(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1));
  expectContains(camera().problem, "cameraTransform mirrors");
}

TEST_F(HeaderCamera, OfPartsThatDisagreeIsAProblem) {
  display(200, 100);
  matrix("worldToCamera", standing);
  Imf::Header other = header;
  M44f moved = standing;
  moved[3][0] = 1;
  other.insert("worldToCamera", Imf::M44fAttribute(moved));
  file.ownParts = {0, 1};
  file.parts.resize(2);
  file.parts[0].name = "beauty";
  file.parts[1].file = "shots/shot.depth.exr";
  const auto of = [&](const Imf::Header& second) {
    file.headers =
        std::make_shared<const std::vector<Imf::Header>>(std::vector<Imf::Header>{header, second});
    return cameraOfHeader(file)->problem;
  };
  EXPECT_EQ(of(header), "");
  EXPECT_EQ(of(other),
            "the header's worldToCamera is another one in shot.depth.exr than in beauty");
}

// One header for the views of both eyes has one eye's camera.
TEST_F(HeaderCamera, OfAnotherViewIsAProblem) {
  display(200, 100);
  matrix("worldToCamera", standing);
  file.views = {"left", "right"};
  file.view = "left";
  EXPECT_EQ(camera().problem, "");
  file.view = "right";
  EXPECT_EQ(camera().problem,
            "the header's worldToCamera is not said to be that of the view right");
  file.parts[0].view = "right";
  EXPECT_EQ(camera().problem, "");
}

TEST_F(HeaderCamera, RefusesAnNdcThatItCannotTell) {
  display(200, 100);
  matrix("worldToCamera", standing);
  EXPECT_EQ(camera().clipProblem, "");
  const auto problemOf = [&](const M44f& ndc) {
    matrix("worldToNDC", standing * ndc);
    EXPECT_FALSE(camera().clipFromCamera);
    return camera().clipProblem;
  };
  expectContains(problemOf(M44f(-1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0)), "mirrors");
  expectContains(problemOf(M44f(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0)), "another shape");
  expectContains(problemOf(M44f(1, 0, 0, 0, 0, 2, 0, 0, .25f, .25f, 1, 1, 0, 0, 0, 0)),
                 "middle of neither");
  expectContains(problemOf(M44f(1e7f, 0, 0, 0, 0, 2e7f, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0)),
                 "which no picture does");
  expectContains(problemOf(M44f(1e-5f, 0, 0, 0, 0, 2e-5f, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0)),
                 "sees 180 by 180 degrees");
  expectContains(problemOf(M44f(1, .2f, 0, 0, 0, 2, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0)),
                 "no projection");
}

TEST_F(HeaderCamera, IsNothingWithoutMatrices) {
  display(200, 100);
  header.insert("cameraFov", Imf::FloatAttribute(30));
  file.ownParts = {0};
  file.headers = std::make_shared<const std::vector<Imf::Header>>(1, header);
  EXPECT_FALSE(cameraOfHeader(file));
}

}  // namespace
}  // namespace kagefude
