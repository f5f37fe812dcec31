#include <cmath>
#include <cstring>
#include <limits>

#include "compositor/test_frame.h"

namespace kagefude {
namespace {

using testing::lightJson;
using testing::TestFrame;

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

class NonFinite : public ::testing::Test {
 protected:
  NonFinite() {
    frame.sidecar["lights"].push_back(lightJson("Sun", "sun", {0, 0, 9}, {0, 0, -1}, 1));
    for (const char* name : {"Combined.R", "Combined.G", "Combined.B", "Combined.A", "DiffCol.R",
                             "DiffCol.G", "DiffCol.B"})
      frame.plane(name, 0.5f);
  }
  static void expectFinite(const FrameResult& result) {
    const auto check = [](View<const float> plane, const std::string& name) {
      for (int y = 0; y < plane.height; ++y)
        for (int x = 0; x < plane.width; ++x)
          EXPECT_TRUE(std::isfinite(plane(x, y))) << name << " at " << x << ", " << y;
    };
    check(result.colour.x, "R");
    check(result.colour.y, "G");
    check(result.colour.z, "B");
    check(result.alpha, "A");
    for (const NamedPlane& layer : result.layers) if (!layer.plane.floats.empty()) check(layer.plane.floats, layer.name);
  }
  static std::string warningsOf(const FrameResult& result) {
    std::string all;
    for (const std::string& warning : result.warnings) all += warning + "\n";
    return all;
  }

  TestFrame frame{5, 5};
};

TEST_F(NonFinite, BeautyBelowOpaquePaintAndBesideIt) {
  frame.plane("Combined.R")(1, 1) = inf;
  frame.plane("Combined.G")(2, 1) = nan;
  frame.plane("Combined.B")(2, 1) = -inf;
  frame.plane("Combined.A")(0, 4) = nan;
  frame.plane("Combined.B")(4, 4) = inf;
  frame.plane("IndexOB.X")(4, 4) = 0;  // background, where the beauty is seen
  frame.plane("IndexOB.X")(0, 4) = 0;
  const FrameResult result = frame.comp("");
  expectFinite(result);
  EXPECT_NE(warningsOf(result).find("4 pixels"), std::string::npos) << warningsOf(result);
  EXPECT_NE(warningsOf(result).find("beauty"), std::string::npos) << warningsOf(result);
}

TEST_F(NonFinite, Albedo) {
  frame.plane("DiffCol.R")(1, 1) = inf;
  frame.plane("DiffCol.B")(3, 1) = nan;
  const FrameResult result = frame.comp("");
  expectFinite(result);
  EXPECT_NE(warningsOf(result).find("2 pixels"), std::string::npos) << warningsOf(result);
  EXPECT_NE(warningsOf(result).find("albedo"), std::string::npos) << warningsOf(result);
}

TEST_F(NonFinite, CoverageOfACryptomatte) {
  frame.sidecar["objects"][0]["crypto"] = "3f800001";
  const uint32_t bits = 0x3f800001;
  float id;
  std::memcpy(&id, &bits, 4);
  frame.plane("CryptoObject00.r", id);
  frame.plane("CryptoObject00.g", 1.0f);
  frame.plane("CryptoObject00.b");
  frame.plane("CryptoObject00.a");
  frame.plane("CryptoObject00.g")(1, 1) = inf;
  frame.plane("CryptoObject00.g")(2, 2) = nan;
  frame.plane("CryptoObject00.a")(3, 3) = inf;
  frame.plane("CryptoObject00.b")(3, 3) = 7.0f;
  const FrameResult result = frame.comp("");
  expectFinite(result);
  EXPECT_NE(warningsOf(result).find("coverage"), std::string::npos) << warningsOf(result);
}

TEST_F(NonFinite, RepeatOfPositionsFarOut) {
  frame.setVector("Position", 2, 2, {1e20f, 1e20f, 0});
  frame.setVector("Position", 3, 2, {3e38f, -3e38f, 3e38f});
  expectFinite(frame.comp("output.layers = [\"brush.*\"]\n"));
}

TEST_F(NonFinite, AnObjectAsThinAsANeedle) {
  frame.sidecar["objects"][0]["bounds"] = {{"min", {-2.25, -5e-10, -5e-10}},
                                           {"max", {2.25, 5e-10, 5e-10}}};
  expectFinite(frame.comp(""));
  frame.sidecar["objects"][0]["bounds"] = {{"min", {-1e30, -1e-30, -1e-30}},
                                           {"max", {1e30, 1e-30, 1e-30}}};
  expectFinite(frame.comp(""));
}

}  // namespace
}  // namespace kagefude
