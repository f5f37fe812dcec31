#include <algorithm>

#include "compositor/read_frame.h"
#include "compositor/rendered_eye.h"
#include "frame/fit_camera.h"
#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

using namespace testing;

class Spaces : public ::testing::Test {
 protected:
  Spaces() : eye(renderEye(0)) {
    writeText(folder / "look.toml",
              "[[light]]\nname = \"Lamp\"\nposition = [3.0, -3.0, 5.0]\n"
              "masks = [\"mask.0\", \"mask.1\"]\n");
    look = readLook(folder / "look.toml", {});
  }

  template <class Convert>
  void changeNormals(const Convert& convert) {
    given = Vec3Plane(eye.width, eye.height);
    for (int y = 0; y < eye.height; ++y)
      for (int x = 0; x < eye.width; ++x) {
        const V3f n = eye.normal.view()(x, y);
        given.set(x, y, n == V3f(0.0f) ? n : convert(n));
      }
  }

  FramePlanes read() {
    Channels all = channelsOf(eye);
    if (!given.empty()) {
      all["N.X"] = given.x;
      all["N.Y"] = given.y;
      all["N.Z"] = given.z;
    }
    writeParts(folder / "f.exr", eye.width, eye.height,
               {{"", "", all, {}, manifestOf("crypto_object")}});
    return readFramePlanes(planFrame(look, folder / "f.exr", 1));
  }

  void expectRemedy(const std::string& remedy) {
    const auto message = messageOf<InputError>([&] { read(); });
    expectContains(message, "f.exr: the normals");
    expectContains(message, remedy);
  }

  void expectWorldNormals(float tolerance) {
    const FramePlanes planes = read();
    EXPECT_TRUE(planes.warnings.empty());
    for (int y = 0; y < eye.height; ++y)
      for (int x = 0; x < eye.width; ++x)
        ASSERT_LT((planes.normal.view()(x, y) - eye.normal.view()(x, y)).length(), tolerance)
            << x << " " << y;
  }

  TemporaryFolder folder;
  RenderedEye eye;
  Vec3Plane given;
  Look look;
};

TEST_F(Spaces, WorldNormalsAreTakenAsTheyAre) { expectWorldNormals(1e-30f); }

TEST_F(Spaces, CameraNormalsAreNamedAndTurned) {
  changeNormals([&](const V3f& n) { return eye.toCamera(n); });
  expectRemedy("set frame.normal_space = \"camera\"");
  look.frame.normalSpace = VectorSpace::camera;
  expectWorldNormals(1e-3f);
}

TEST_F(Spaces, EncodedNormalsAreNamedAndDecoded) {
  changeNormals([](const V3f& n) { return n * 0.5f + V3f(0.5f); });
  expectRemedy("frame.normal_range = \"0..1\"");
  look.frame.normalRange = NormalRange::unit;
  expectWorldNormals(1e-6f);
}

TEST_F(Spaces, OtherAxesAreNamedAndPutRight) {
  changeNormals([](const V3f& n) { return V3f(n.x, n.z, -n.y); });
  expectRemedy("frame.normal_axes = \"x -z y\"");
  look.frame.normalAxes = "x -z y";
  expectWorldNormals(1e-6f);
}

TEST_F(Spaces, FlippedNormalsAreNamed) {
  changeNormals([](const V3f& n) { return -n; });
  expectRemedy("frame.normal_axes = \"-x -y -z\"");
}

TEST_F(Spaces, AFlipThatTheGroundDoesNotShowIsNamed) {
  changeNormals([](const V3f& n) { return V3f(n.x, -n.y, n.z); });
  expectRemedy("frame.normal_axes = \"x -y z\"");
  changeNormals([](const V3f& n) { return V3f(n.y, n.x, n.z); });
  expectRemedy("frame.normal_axes = \"y x z\"");
}

TEST_F(Spaces, SmoothShadingOfFewFacesIsBelieved) {
  changeNormals([](const V3f& n) {
    const V3f size(std::fabs(n.x), std::fabs(n.y), std::fabs(n.z));
    const float most = std::max({size.x, size.y, size.z});
    const V3f face(size.x == most ? n.x : 0, size.y == most ? n.y : 0, size.z == most ? n.z : 0);
    return (n + face.normalized() * 0.8f).normalized();
  });
  EXPECT_TRUE(read().warnings.empty());
}

TEST_F(Spaces, BumpsAreBelieved) {
  int step = 0;
  changeNormals([&](const V3f& n) {
    step = (step * 7 + 5) % 31;
    return (n + V3f(0.02f * static_cast<float>(step - 15), 0.1f, 0.0f)).normalized();
  });
  EXPECT_TRUE(read().warnings.empty());
}

TEST_F(Spaces, WhatNothingExplainsIsAWarning) {
  int step = 0;
  changeNormals([&](const V3f&) {
    step = (step * 13 + 7) % 101;
    const auto angle = static_cast<float>(step);
    return V3f(std::cos(angle), std::sin(angle), std::cos(3 * angle)).normalized();
  });
  const FramePlanes planes = read();
  ASSERT_EQ(planes.warnings.size(), 1u);
  expectContains(planes.warnings[0], "off the positions' slopes");
}

TEST_F(Spaces, AxesAreCheckedWhenTheFrameIsPlanned) {
  look.frame.normalAxes = "x x y";
  expectContains(messageOf<LookError>([&] { read(); }), "x, y and z once each");
}

TEST_F(Spaces, CameraPositionsWithoutACameraAreAnError) {
  look.frame.positionSpace = VectorSpace::camera;
  expectContains(messageOf<InputError>([&] { read(); }), "frame.position_space = \"camera\"");
}

TEST(FitCamera, FindsTheCameraThatSawTheFrame) {
  const RenderedEye eye = renderEye(0.7);
  std::vector<SeenPoint> points;
  for (int y = 0; y < eye.height; y += 3)
    for (int x = 0; x < eye.width; x += 3)
      if (eye.share(x, y) > 0) points.push_back({V3d(eye.position.view()(x, y)), x + 0.5, y + 0.5});
  const auto camera = fitCamera(points);
  ASSERT_TRUE(camera);
  EXPECT_LT((camera->direction(eye.right) - V3d(1, 0, 0)).length(), 1e-4);
  EXPECT_LT((camera->direction(eye.up) - V3d(0, 1, 0)).length(), 1e-4);
  EXPECT_LT(camera->point(eye.eye).length(), 1e-3);
}

TEST(FitCamera, SaysNothingOfAPlane) {
  std::vector<SeenPoint> points;
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 10; ++x) points.push_back({V3d(x, y, 0), x + 3.0, 20.0 - y});
  EXPECT_FALSE(fitCamera(points));
  EXPECT_FALSE(fitCamera({}));
}

}  // namespace
}  // namespace kagefude
