#include "frame/casters.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

class Casters : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("kagefude_casters_") + test->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  static std::string entry(const std::string& file, const std::string& rows) {
    return R"({"object":"Cup","file":")" + file + R"(","world_from_object":)" + rows + "}";
  }

  /// The sidecar of a frame whose JSON has this as its casters.
  Sidecar with(const std::string& casters) const {
    const std::string unit = "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]";
    return readSidecar(write(
        "f.json", R"({"kagefude":1,"frame":1,"fps":24,"resolution":[8,8],"lights":[],"camera":{)"
                  R"("type":"perspective","position":[0,0,5],"direction":[0,0,-1],)"
                  R"("camera_from_world":)" +
                      unit + R"(,"clip_from_camera":)" + unit + R"(},"casters":)" + casters + "}"));
  }

  const std::string moved_ = "[[1,0,0,5],[0,1,0,0],[0,0,2,0],[0,0,0,1]]";
  const std::string triangle_ = "# c\nmtllib ../x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n";
  fs::path folder_;
};

TEST_F(Casters, PlacedNamedAndNumbered) {
  write("a.obj", triangle_);
  const Sidecar sidecar = with("[" + entry("a.obj", moved_) + "]");
  const FrameCasters casters = readCasters(sidecar, {{"Cup", 7}});
  ASSERT_EQ(casters.meshes.size(), 1u);
  EXPECT_TRUE(casters.warnings.empty());
  const CasterMesh& mesh = casters.meshes[0];
  EXPECT_EQ(mesh.object, "Cup");
  EXPECT_EQ(mesh.id, 7u);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.vertices[2], V3f(5, 1, 2));
}

TEST_F(Casters, InstancesShareAFileAndPolygonsAreCut) {
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const std::string one = entry("a.obj", moved_);
  const Sidecar sidecar = with("[" + one + "," + one + "]");
  const FrameCasters casters = readCasters(sidecar, {});
  ASSERT_EQ(casters.meshes.size(), 2u);
  EXPECT_EQ(casters.meshes[1].triangles.size(), 2u);
  EXPECT_EQ(casters.meshes[1].id, 0u);
}

TEST_F(Casters, BadTrianglesWarn) {
  write("a.obj", triangle_ + "v nan 0 0\nf 1 2 9\nf 1 1 2\n");
  const Sidecar sidecar = with("[" + entry("a.obj", moved_) + "]");
  const FrameCasters casters = readCasters(sidecar, {});
  EXPECT_EQ(casters.meshes[0].triangles.size(), 1u);
  ASSERT_EQ(casters.warnings.size(), 1u);
  EXPECT_NE(casters.warnings[0].find("Cup has 2 triangles"), std::string::npos)
      << casters.warnings[0];
}

TEST_F(Casters, HostileMeshesAreRefusedOrLeftOut) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 1\n";
  const std::string hostile[] = {"",
                                 std::string("\0\0v 1 2\xff\xfe", 9),
                                 "f 1 2 3\n",
                                 points + "f 1 2 99999999999999999999999\n",
                                 points + "f 1 2 2147483647\n",
                                 points + "f 1 2 -2147483648\n",
                                 points + "f 1 2 -9\n",
                                 points + "f 0 1 2\n",
                                 points + "f 1 2\n",
                                 points + "f\n",
                                 points + "f 1//// 2/x/ 3/\n",
                                 points + "f 1 2 3 4 5 6 7 8\n",
                                 points + "f 1 2 3 9\n",
                                 points + "f 1 2 4",
                                 "v 0 0 0\nv 1 0 0\nv 0 1",
                                 "v 1e999 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n",
                                 "v x y z\nv 1 0 0\nv 0 1 1\nf 1 2 3\n"};
  for (const std::string& text : hostile) {
    write("a.obj", text);
    const Sidecar sidecar = with("[" + entry("a.obj", moved_) + "]");
    try {
      const FrameCasters casters = readCasters(sidecar, {});
      ASSERT_EQ(casters.meshes.size(), 1u);
      for (const auto& triangle : casters.meshes[0].triangles)
        for (const uint32_t corner : triangle)
          ASSERT_LT(corner, casters.meshes[0].vertices.size()) << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("a.obj"), std::string::npos) << error.what();
    }
  }
}

TEST_F(Casters, AMatrixThatFlattensOrThrowsOutIsWarnedOf) {
  write("a.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1e30 1\nf 1 2 3\n");
  for (const char* rows : {"[[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,1]]",
                           "[[1e30,0,0,0],[0,1e30,0,0],[0,0,1e30,0],[0,0,0,1]]"}) {
    const Sidecar sidecar = with("[" + entry("a.obj", rows) + "]");
    const FrameCasters casters = readCasters(sidecar, {});
    EXPECT_TRUE(casters.meshes[0].triangles.empty()) << rows;
    ASSERT_EQ(casters.warnings.size(), 1u) << rows;
    EXPECT_NE(casters.warnings[0].find("caster Cup has 1 triangles"), std::string::npos)
        << casters.warnings[0];
  }
}

TEST_F(Casters, NoCastersIsNoError) {
  EXPECT_TRUE(readCasters(with("[]"), {}).meshes.empty());
  EXPECT_TRUE(readCasters(with("null"), {}).meshes.empty());
}

TEST_F(Casters, MalformedSidecarsAndFilesAreRefused) {
  for (const char* casters : {"3", "{}", "[3]", "[{\"object\":\"Cup\"}]"})
    EXPECT_THROW(with(casters), InputError) << casters;
  for (const char* rows : {"[]", "null", "[[1,0,0],[0,1,0],[0,0,1],[0,0,0]]",
                           "[[1,0,0,\"x\"],[0,1,0,0],[0,0,1,0],[0,0,0,1]]",
                           "[[1e300,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]"})
    EXPECT_THROW(with("[" + entry("a.obj", rows) + "]"), InputError) << rows;
  for (const char* file : {"/etc/passwd", "../a.obj", "x/../../a.obj", ""})
    EXPECT_THROW(with("[" + entry(file, moved_) + "]"), InputError) << file;
  EXPECT_THROW(readCasters(with("[" + entry("gone.obj", moved_) + "]"), {}), InputError);
}

TEST_F(Casters, AWrongEntryIsNamedByItsPlace) {
  const std::string right = entry("a.obj", moved_);
  try {
    with("[" + right + "," + entry("../a.obj", moved_) + "]");
    FAIL() << "a path out of the folder was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("f.json: casters[1].file"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace kagefude
