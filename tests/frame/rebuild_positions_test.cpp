#include "frame/rebuild_positions.h"

#include <cmath>
#include <limits>

#include "exr/read_channels.h"
#include "frame/frame_fixtures.h"
#include "frame/ndc_projection.h"

namespace kagefude {
namespace {

using namespace testing;

constexpr double sqrt1_5 = 1.224744871391589;

/// Two by two pixels seen from the origin along -z, 90 degrees wide.
struct SmallView {
  SmallView() {
    file.path = "f.exr";
    file.displayWindow = file.dataWindow = {0, 0, 2, 2};
    FrameCamera camera;
    camera.clipFromCamera = detail::perspectiveClip(1, 1, 0, 0);
    camera.source = "a test";
    spaces.camera = camera;
    spaces.rebuilt = true;
  }
  Vec3Plane rebuild() const { return rebuildPositions(depth, spaces, file); }

  static void expectAt(const Vec3Plane& positions, int x, int y, const V3d& expected) {
    EXPECT_LT((V3d(positions.view()(x, y)) - expected).length(), 1e-6)
        << x << " " << y << ": " << positions.view()(x, y);
  }

  ImageFile file;
  VectorSpaces spaces;
  Floats depth{2, 2, 2.0f};
};

TEST(RebuildPositions, PlanarDepthsLieInAPlane) {
  SmallView view;
  const Vec3Plane positions = view.rebuild();
  view.expectAt(positions, 0, 0, {-1, 1, -2});
  view.expectAt(positions, 1, 1, {1, -1, -2});
}

TEST(RebuildPositions, RayDepthsLieOnASphere) {
  SmallView view;
  view.spaces.depthKind = DepthKind::ray;
  const Vec3Plane positions = view.rebuild();
  view.expectAt(positions, 1, 0, V3d(1, 1, -2) / sqrt1_5);
  EXPECT_NEAR(positions.view()(0, 1).length(), 2, 1e-6);
}

TEST(RebuildPositions, OtherwiseIsTheOtherKind) {
  SmallView view;
  const Vec3Plane planar = view.rebuild();
  view.expectAt(rebuiltOtherwise(planar, view.spaces), 0, 1, V3d(-1, -1, -2) / sqrt1_5);
  view.spaces.depthKind = DepthKind::ray;
  view.expectAt(rebuiltOtherwise(view.rebuild(), view.spaces), 0, 1, {-1, -1, -2});
}

TEST(RebuildPositions, FollowTheCamera) {
  SmallView view;
  // Stands at (0, -10, 0) and looks along y.
  view.spaces.camera->cameraFromWorld =
      Transform{{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, -10}, {0, 0, 0, 1}}};
  view.expectAt(view.rebuild(), 1, 0, {1, -8, 1});
}

TEST(RebuildPositions, OfAParallelCameraAreOfOneKind) {
  SmallView view;
  Transform clip;
  clip.m[0][0] = clip.m[1][1] = 0.25;
  view.spaces.camera->clipFromCamera = clip;
  view.expectAt(view.rebuild(), 1, 0, {2, 2, -2});
  view.spaces.depthKind = DepthKind::ray;
  view.expectAt(view.rebuild(), 1, 0, {2, 2, -2});
}

TEST(RebuildPositions, AreThoseOfTheDisplayWindow) {
  SmallView view;
  view.file.displayWindow = {10, 20, 4, 4};
  view.file.dataWindow = {12, 19, 2, 2};  // its right half, from a pixel above it
  const Vec3Plane positions = view.rebuild();
  view.expectAt(positions, 0, 0, {0.5, 2.5, -2});
  view.expectAt(positions, 1, 1, {1.5, 1.5, -2});
}

TEST(RebuildPositions, BackgroundIsNoPlace) {
  SmallView view;
  view.depth(0, 0) = 1e10f;
  view.depth(1, 0) = std::numeric_limits<float>::infinity();
  view.depth(0, 1) = 0;
  const Vec3Plane positions = view.rebuild();
  EXPECT_EQ(positions.view()(0, 0), V3f(0.0f));
  EXPECT_EQ(positions.view()(1, 0), V3f(0.0f));
  EXPECT_EQ(positions.view()(0, 1), V3f(0.0f));
  view.depth(0, 0) = std::nanf("");
  EXPECT_TRUE(std::isnan(view.rebuild().x(0, 0)));
}

TEST(RebuildPositions, NegativeDepthsAreRefused) {
  SmallView view;
  view.depth = Floats(2, 2, -3.0f);
  expectContains(messageOf<InputError>([&] { view.rebuild(); }), "f.exr has no depth above 0");
}

TEST(RebuildPositions, FewDepthsMayBeNegative) {
  SmallView view;
  view.depth(0, 0) = -3;
  EXPECT_EQ(view.rebuild().view()(0, 0), V3f(0.0f));
  view.expectAt(view.rebuild(), 1, 1, {1, -1, -2});
}

// A pixel is 2 wide there, as a float's step is at 2^24.
TEST(RebuildPositions, FarFromTheOriginAreRefused) {
  SmallView view;
  Transform& cameraFromWorld = view.spaces.camera->cameraFromWorld;
  cameraFromWorld.m[0][3] = -1.5e7;
  view.rebuild();
  cameraFromWorld.m[0][3] = -2e7;
  expectContains(messageOf<InputError>([&] { view.rebuild(); }),
                 "f.exr: a test stands 2e+07 units from the world's origin");
  view.depth(1, 1) = 1e10f;
  view.depth(0, 0) = 100;
  view.depth(1, 0) = 100;
  view.rebuild();
  cameraFromWorld.m[0][3] = -3e38;
  expectContains(messageOf<InputError>([&] { view.rebuild(); }), "3e+38 units");
}

TEST(RebuildPositions, RefuseAJsonsCameraThatIsNone) {
  SmallView view;
  Camera json;
  json.clipFromCamera = detail::perspectiveClip(1, 1, 0, 0);
  const auto fault = [&] { return rebuildFault(vectorSpaces({}, view.file, &json)); };
  EXPECT_EQ(fault(), "");
  json.cameraFromWorld.m[3][3] = 0.9999999;  // an inverse of floats
  EXPECT_EQ(fault(), "");
  json.cameraFromWorld.m[0][0] = 0;
  expectContains(fault(), "the JSON's camera_from_world scales by 0");
  json.cameraFromWorld.m[0][0] = -1;
  expectContains(fault(), "the JSON's camera_from_world mirrors");
  json.cameraFromWorld.m[0][0] = 1;
  json.clipFromCamera.m[1][1] = 0;
  expectContains(fault(), "the JSON's clip_from_camera shows a line or a point");
  json.clipFromCamera.m[1][1] = 1;
  json.clipFromCamera.m[3][2] = 1;
  expectContains(fault(), "the JSON's clip_from_camera is no projection");
}

// A JSON has one camera, whatever views a file has.
TEST(RebuildPositions, AskForTheOtherEyesCamera) {
  SmallView view;
  Camera json;
  json.clipFromCamera = detail::perspectiveClip(1, 1, 0, 0);
  view.file.views = {"left", "right"};
  view.file.view = "left";
  EXPECT_EQ(rebuildFault(vectorSpaces({}, view.file, &json)), "");
  view.file.view = "right";
  expectContains(rebuildFault(vectorSpaces({}, view.file, &json)),
                 "the JSON's camera is not said to be that of the view right");
}

TEST(RebuildPositions, SayWhatTheyLack) {
  VectorSpaces spaces;
  expectContains(rebuildFault(spaces), "no camera is known");
  spaces.camera = FrameCamera{};
  spaces.camera->source = "the header's worldToCamera";
  expectContains(rebuildFault(spaces), "worldToCamera comes without its field of view");
  spaces.camera->clipProblem = "the header's worldToNDC mirrors the picture";
  expectContains(rebuildFault(spaces), "mirrors the picture; say it with frame.clip_from_camera");
  spaces.camera->problem = "the header's worldToCamera skews";
  expectContains(rebuildFault(spaces), "skews; say it with frame.camera_from_world");
}

// Blender's planar depth (Cycles samples next to the pixel's centre).
TEST(RebuildPositions, OfARenderedFrameAreItsPositionPass) {
  const auto path = sourceFolder() / "tests/data/still/shot.0001.exr";
  const ImageFile file = openImage(path);
  const auto sidecar = findSidecar(path);
  ASSERT_TRUE(sidecar);
  const auto planes =
      readFloats(file, std::vector<std::string>{"data.Depth.V", "data.Position.X",
                                                "data.Position.Y", "data.Position.Z"});
  const VectorSpaces spaces = vectorSpaces({}, file, &sidecar->camera);
  EXPECT_EQ(spaces.camera->source, "the JSON's camera");
  const Vec3Plane positions = rebuildPositions(planes[0], spaces, file);
  double squares = 0, worst = 0;
  size_t seen = 0;
  for (int y = 0; y < file.height; ++y)
    for (int x = 0; x < file.width; ++x) {
      const V3f given(planes[1](x, y), planes[2](x, y), planes[3](x, y));
      const double off = (positions.view()(x, y) - given).length();
      squares += off * off;
      worst = std::max(worst, off);
      ++seen;
    }
  // A pixel is 0.03 wide at the middle of this scene.
  EXPECT_LT(std::sqrt(squares / static_cast<double>(seen)), 1e-5);
  EXPECT_LT(worst, 5e-4);
}

}  // namespace
}  // namespace kagefude
