// Frames without positions: what is rebuilt from their depth, and what is doubted.
#include <algorithm>
#include <cmath>

#include "compositor/read_frame.h"
#include "compositor/rendered_eye.h"
#include "compositor/test_frame.h"
#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

using namespace testing;
using Imath::M44f;

class RebuiltFrame : public ::testing::Test {
 protected:
  RebuiltFrame() : eye(renderEye(0)), depth(eye.width, eye.height) {
    writeText(folder / "look.toml",
              "[[light]]\nname = \"Lamp\"\nposition = [3.0, -3.0, 5.0]\n"
              "masks = [\"mask.0\", \"mask.1\"]\n");
    look = readLook(folder / "look.toml", {});
    part = {"", "", channelsOf(eye), {}, manifestOf("crypto_object")};
    part.matrices = {{"worldToCamera", toCamera()}, {"worldToNDC", toCamera() * toNdc}};
    planar();
  }

  // As OpenEXR says: row vectors, a left-handed space that looks along +z.
  M44f toCamera() const {
    M44f m;
    const V3d axes[] = {eye.right, eye.up, eye.ahead};
    for (int column = 0; column < 3; ++column) {
      for (int row = 0; row < 3; ++row) m[row][column] = static_cast<float>(axes[column][row]);
      m[3][column] = static_cast<float>(-axes[column].dot(eye.eye));
    }
    return m;
  }

  template <class Measure>
  void measure(const Measure& along) {
    for (int y = 0; y < eye.height; ++y)
      for (int x = 0; x < eye.width; ++x)
        depth(x, y) = eye.share(x, y) > 0
                          ? static_cast<float>(along(V3d(eye.position.view()(x, y)) - eye.eye))
                          : 1e10f;
  }
  void planar() {
    measure([&](const V3d& v) { return v.dot(eye.ahead); });
  }
  void alongRays() {
    measure([](const V3d& v) { return v.length(); });
  }

  FramePlanes read(bool withPositions = false) {
    for (const char* name : {"P.X", "P.Y", "P.Z"})
      if (!withPositions) part.channels.erase(name);
    part.channels.insert_or_assign("Z", View<const float>(depth));
    writeParts(folder / "f.exr", eye.width, eye.height, {part});
    const FramePlan plan = planFrame(look, folder / "f.exr", 1);
    FramePlanes planes = readFramePlanes(plan);
    planes.warnings.insert(planes.warnings.begin(), plan.warnings.begin(), plan.warnings.end());
    return planes;
  }

  void expectPositions(const FramePlanes& planes) const {
    for (int y = 0; y < eye.height; ++y)
      for (int x = 0; x < eye.width; ++x) {
        if (eye.share(x, y) == 0) continue;
        ASSERT_LT((planes.position.view()(x, y) - eye.position.view()(x, y)).length(), 1e-4f)
            << x << " " << y;
        ASSERT_NE(planes.objectId(x, y), 0u);
      }
  }
  static void expectWarning(const FramePlanes& planes, const std::string& text) {
    EXPECT_TRUE(std::any_of(planes.warnings.begin(), planes.warnings.end(), [&](const auto& w) {
      return w.find(text) != std::string::npos;
    })) << text;
  }

  const M44f toNdc{0.75f, 0, 0, 0, 0, -1, 0, 0, 0.5f, 0.5f, 1, 1, 0, 0, 0, 0};
  TemporaryFolder folder;
  RenderedEye eye;
  Floats depth;
  PartSpec part;
  Look look;
};

TEST_F(RebuiltFrame, TakesDepthAndTheHeadersCamera) {
  const FramePlanes planes = read();
  expectPositions(planes);
  ASSERT_EQ(planes.warnings.size(), 1u);
  EXPECT_EQ(planes.warnings[0],
            "there is no Position pass; positions are rebuilt from Z, taken as planar, and the "
            "header's worldToCamera");
}

TEST_F(RebuiltFrame, StopsAtRayDepthAndTakesItWhenTold) {
  alongRays();
  const auto message = messageOf<InputError>([&] { read(); });
  expectContains(message, "f.exr: positions rebuilt from the depth, taken as planar");
  expectContains(message, "set frame.depth_kind = \"ray\"");
  look.frame.depthKind = DepthKind::ray;
  const FramePlanes planes = read();
  expectPositions(planes);
  EXPECT_EQ(planes.warnings.size(), 1u);
}

TEST_F(RebuiltFrame, SaysThatTheNamedKindDoesNotFit) {
  look.frame.depthKind = DepthKind::ray;
  expectWarning(read(), "frame.depth_kind = \"ray\" sets the rebuilt positions");
}

// Bumps of ten degrees hide a wrong kind from the middle, not from pairs of places.
TEST_F(RebuiltFrame, SeesRayDepthUnderBumps) {
  alongRays();
  int step = 0;
  for (int y = 0; y < eye.height; ++y)
    for (int x = 0; x < eye.width; ++x) {
      const V3f n = eye.normal.view()(x, y);
      if (n == V3f(0.0f)) continue;
      step = (step * 13 + 7) % 101;
      const auto angle = static_cast<float>(step);
      eye.normal.set(x, y, (n + V3f(std::cos(angle), std::sin(angle), 0) * 0.18f).normalized());
    }
  expectContains(messageOf<InputError>([&] { read(); }), "set frame.depth_kind = \"ray\"");
  planar();
  EXPECT_EQ(read().warnings.size(), 1u);
}

TEST_F(RebuiltFrame, SaysThatAWrongAngleOfViewDoesNotFit) {
  const auto see = [&](float wider) {
    const M44f ndc(0.75f / wider, 0, 0, 0, 0, -1 / wider, 0, 0, 0.5f, 0.5f, 1, 1, 0, 0, 0, 0);
    part.matrices["worldToNDC"] = toCamera() * ndc;
    return read();
  };
  expectWarning(see(1.25f),
                "if the camera had seen 0.8 times as wide as the header's worldToCamera");
  expectWarning(see(0.9f), "if the camera had seen 1.1 times as wide");
  EXPECT_EQ(see(1.0f).warnings.size(), 1u);
}

TEST_F(RebuiltFrame, SaysThatAWrongCameraDoesNotFit) {
  // Turned by 40 degrees about its own axis.
  const float c = std::cos(0.7f), s = std::sin(0.7f);
  const M44f turn(c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  part.matrices["worldToNDC"] = toCamera() * turn * toNdc;
  part.matrices["worldToCamera"] = toCamera() * turn;
  expectWarning(read(), "so the depth or the header's worldToCamera is not what it is taken for");
}

TEST_F(RebuiltFrame, TakesTheLooksCamera) {
  part.matrices.clear();
  const auto message = messageOf<InputError>([&] { read(); });
  expectContains(message, "has no Position pass");
  expectContains(message, "nor can positions be rebuilt from Z: no camera is known");
  look.frame.clipFromCamera = {1.5f, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -0.2f, 0, 0, -1, 0};
  const M44f m = toCamera();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      look.frame.cameraFromWorld.push_back(m[column][row] * (row == 2 ? -1.0f : 1.0f));
  expectPositions(read());
  look.frame.cameraFromWorld[2] += 0.5f;
  expectContains(messageOf<LookError>([&] { read(); }), "frame.camera_from_world is no turn");
  look.frame.cameraFromWorld[2] -= 0.5f;
  look.frame.clipFromCamera[14] = 1;
  expectContains(messageOf<LookError>([&] { read(); }), "frame.clip_from_camera is no projection");
}

TEST_F(RebuiltFrame, PositionsOfAPassStayAsTheyAre) {
  depth = Floats(eye.width, eye.height, 1.0f);
  const FramePlanes planes = read(true);
  expectPositions(planes);
  EXPECT_TRUE(planes.warnings.empty());
}

TEST_F(RebuiltFrame, NothingIsSeenWithoutDepth) {
  depth(48, 40) = 0;
  ASSERT_GT(eye.share(48, 40), 0);
  EXPECT_EQ(read().objectId(48, 40), 0u);
}

TEST_F(RebuiltFrame, RefusesADepthThatIsNoPlaceAnywhere) {
  for (const float nowhere : {0.0f, 1e30f, INFINITY}) {
    depth = Floats(eye.width, eye.height, nowhere);
    expectContains(messageOf<InputError>([&] { read(); }),
                   "f.exr: Z is no place (0, negative, or above 9e9) in all of the pixels");
  }
}

TEST_F(RebuiltFrame, SaysWhereMuchDepthIsMissing) {
  for (int y = eye.height / 2; y < eye.height; ++y)
    for (int x = 0; x < eye.width; ++x) depth(x, y) = -depth(x, y);
  const FramePlanes planes = read();
  expectWarning(planes, "Z is no place (0, negative, or above 9e9) in ");
  EXPECT_EQ(planes.objectId(48, 60), 0u);
  EXPECT_NE(planes.objectId(48, 30), 0u);
}

TEST_F(RebuiltFrame, DepthThatIsNoNumberIsCounted) {
  depth(48, 40) = std::nanf("");
  const FramePlanes planes = read();
  EXPECT_EQ(planes.badPixels, 1u);
  EXPECT_EQ(planes.objectId(48, 40), 0u);
}

// The depth of a right eye and one header, which has the left eye's camera.
TEST_F(RebuiltFrame, AskForTheOtherEyesCamera) {
  const auto write = [&] {
    Channels both;
    for (const auto& [name, plane] : part.channels) {
      const bool bare = name.find('.') == std::string::npos;
      for (const char* view : {"left", "right"})
        both.emplace(bare ? std::string(view) + "." + name
                          : std::string(name).insert(name.rfind('.'), std::string(".") + view),
                     plane);
    }
    PartSpec stereo = part;
    stereo.channels = std::move(both);
    writeParts(folder / "s.exr", eye.width, eye.height, {stereo}, {"left", "right"});
  };
  read();
  write();
  look.frame.view = "left";
  planFrame(look, folder / "s.exr", 1);
  look.frame.view = "right";
  expectContains(messageOf<InputError>([&] { planFrame(look, folder / "s.exr", 1); }),
                 "worldToCamera is not said to be that of the view right; say it with "
                 "frame.camera_from_world");
}

// Without normals' help: the ball's and the floor's bounds of the JSON show depth in other units.
TEST_F(RebuiltFrame, SaysThatDepthIsInOtherUnits) {
  const M44f m = toCamera();
  nlohmann::json fromWorld;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      fromWorld[row][column] = m[column][row] * (row == 2 ? -1.0f : 1.0f);
  const auto object = [](const char* name, const V3f& low, const V3f& high) {
    return nlohmann::json{{"name", name},
                          {"world_from_object", identityRows()},
                          {"bounds", {{"min", pointOf(low)}, {"max", pointOf(high)}}},
                          {"reference_point", {0, 0, 0}}};
  };
  const nlohmann::json sidecar = {
      {"kagefude", 1},
      {"frame", 1},
      {"fps", 24},
      {"resolution", {eye.width, eye.height}},
      {"camera",
       {{"type", "perspective"},
        {"position", pointOf(V3f(eye.eye))},
        {"direction", pointOf(V3f(eye.ahead))},
        {"camera_from_world", fromWorld},
        {"clip_from_camera", {{1.5, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, -1, -0.2}, {0, 0, -1, 0}}}}},
      {"lights", nlohmann::json::array()},
      {"objects",
       {object("Ball", {-1, -1, 0}, {1, 1, 2}), object("Floor", {-9, -9, 0}, {9, 9, 0})}}};
  writeText(folder / "f.json", sidecar.dump());
  EXPECT_EQ(read().warnings.size(), 1u);
  const auto scaled = [&](float factor) {
    planar();
    for (int y = 0; y < eye.height; ++y)
      for (int x = 0; x < eye.width; ++x)
        if (depth(x, y) < 1e9f) depth(x, y) *= factor;
    return read();
  };
  expectWarning(scaled(100), "of the rebuilt positions lie in the bounds that the JSON gives");
  expectWarning(scaled(100), "if the depth were 0.01 times as large; it counts in the world's");
  expectWarning(scaled(0.0254f), "if the depth were 39.37 times as large");
  expectWarning(scaled(2), "so the depth or the JSON's camera is not what it is taken for");
}

// Normals and positions of the camera's space are turned by the header's camera alone.
TEST_F(RebuiltFrame, TheHeadersCameraTurnsNormalsAndPositions) {
  for (int y = 0; y < eye.height; ++y)
    for (int x = 0; x < eye.width; ++x) {
      if (eye.share(x, y) == 0) continue;
      eye.normal.set(x, y, eye.toCamera(eye.normal.view()(x, y)));
      eye.position.set(x, y, eye.toCamera(eye.position.view()(x, y) - V3f(eye.eye)));
    }
  look.frame.normalSpace = look.frame.positionSpace = VectorSpace::camera;
  const FramePlanes planes = read(true);
  const RenderedEye truth = renderEye(0);
  for (int y = 0; y < eye.height; ++y)
    for (int x = 0; x < eye.width; ++x) {
      if (eye.share(x, y) == 0) continue;
      ASSERT_LT((planes.position.view()(x, y) - truth.position.view()(x, y)).length(), 1e-4f);
      ASSERT_LT((planes.normal.view()(x, y) - truth.normal.view()(x, y)).length(), 1e-5f);
    }
  part.matrices["worldToCamera"] = toCamera() * 2.0f;
  expectContains(messageOf<InputError>([&] { read(true); }), "so it is no camera");
}

}  // namespace
}  // namespace kagefude
