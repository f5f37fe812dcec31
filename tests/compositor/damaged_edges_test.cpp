#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "compositor/inspect_lights.h"
#include "compositor/test_frame.h"

namespace kagefude {
namespace {

using testing::lightJson;
using testing::TestFrame;

/// A wall that fills the picture, seen straight, with its Cryptomatte and its mean normals.
class DamagedEdges : public ::testing::Test {
 protected:
  DamagedEdges() {
    frame.sidecar["lights"].push_back(lightJson("Sun", "sun", {0, 0, 9}, {0, 0, -1}, 1));
    frame.sidecar["objects"][0]["crypto"] = "3f800001";
    frame.plane("CryptoObject00.r", idOf(0x3f800001));
    frame.plane("CryptoObject00.g", 1.0f);
    for (const char* name : {"CryptoObject00.b", "CryptoObject00.a", "MeanNormal.X", "MeanNormal.Y"})
      frame.plane(name);
    frame.plane("MeanNormal.Z", 1.0f);
    for (const char* name : {"Combined.R", "Combined.G", "Combined.B"}) frame.plane(name, 0.5f);
    frame.plane("Combined.A", 1.0f);
  }
  static float idOf(uint32_t bits) {
    float id;
    std::memcpy(&id, &bits, 4);
    return id;
  }
  FramePlanes read(const std::string& lookText = "") {
    const auto path = frame.write();
    frame.folder.write("look.toml", lookText);
    const Look look = readLook(frame.folder / "look.toml", {});
    plan = planFrame(look, path, 1);
    return readFramePlanes(plan);
  }
  std::string comped(const std::string& lookText = "") {
    std::string all;
    for (const std::string& warning : frame.comp(lookText).warnings) all += warning + "\n";
    return all;
  }
  std::string inspected() {
    Inspection found = inspectFrame(frame.write());
    inspectLights({}, found);
    std::string all;
    for (const Finding& finding : found.findings) all += finding.what + "\n";
    return all;
  }
  static bool has(const std::string& all, const std::string& part) {
    return all.find(part) != std::string::npos;
  }
  void expectSaid(const std::string& part) {
    EXPECT_TRUE(has(comped(), part)) << comped();
    EXPECT_TRUE(has(inspected(), part)) << inspected();
  }
  void fillMean(const V3f& mean) {
    frame.plane("MeanNormal.X").fill(mean.x);
    frame.plane("MeanNormal.Y").fill(mean.y);
    frame.plane("MeanNormal.Z").fill(mean.z);
  }

  TestFrame frame{8, 8};
  FramePlan plan;
};

TEST_F(DamagedEdges, HealthyFramesSayNothing) {
  for (const std::string& all : {comped(), inspected()}) {
    EXPECT_FALSE(has(all, "MeanNormal")) << all;
    EXPECT_FALSE(has(all, "pixel")) << all;
    EXPECT_FALSE(has(all, "lacks")) << all;
  }
}

TEST_F(DamagedEdges, ThingsWithoutAnyCoverageCoverTheirPixels) {
  for (const float coverage : {0.0f, 1e-30f, -1.0f, -1e-3f}) {
    frame.plane("CryptoObject00.g").fill(coverage);
    const FramePlanes planes = read();
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) EXPECT_EQ(planes.coverage.share(0, x, y), 1.0f) << coverage;
    expectSaid("64 pixels");
  }
}

TEST_F(DamagedEdges, IdsFromTheCryptomatteItselfOutliveItsCoverage) {
  frame.plane("CryptoObject00.g").fill(0.0f);
  const FramePlanes planes = read("[frame]\ncrypto_object = \"CryptoObject\"\n");
  EXPECT_EQ(plan.idSource, IdSource::cryptomatte);
  EXPECT_EQ(planes.objectId(3, 3), 0x3f800001u);
  ASSERT_FALSE(planes.warnings.empty());
}

TEST_F(DamagedEdges, ARimThatAllSamplesMissIsHealthy) {
  Floats& index = frame.plane("IndexOB.X");
  for (int y = 0; y < 8; ++y)
    for (int x = 1; x < 8; ++x) index(x, y) = 0.0f;
  frame.plane("CryptoObject00.g").fill(0.0f);
  EXPECT_EQ(read().coverage.share(0, 0, 3), 0.0f);
  EXPECT_FALSE(has(comped(), "pixel")) << comped();
}

TEST_F(DamagedEdges, ImpossibleCoverageIsWhollyTheFirstId) {
  for (const float coverage : {3e38f, 2.0f, -2.0f, std::numeric_limits<float>::infinity()}) {
    frame.plane("CryptoObject00.a")(2, 5) = coverage;
    frame.plane("CryptoObject00.g")(2, 5) = 0.25f;
    const FramePlanes planes = read();
    EXPECT_EQ(planes.coverage.share(0, 2, 5), 1.0f) << coverage;
    EXPECT_EQ(planes.coverage.share(1, 2, 5), 0.0f) << coverage;
    expectSaid("1 pixel,");
  }
}

TEST_F(DamagedEdges, FiltersOvershoot) {
  frame.plane("CryptoObject00.g").fill(1.2f);
  frame.plane("CryptoObject00.a").fill(-0.2f);
  const FramePlanes planes = read();
  EXPECT_EQ(planes.coverage.share(0, 2, 5), 1.2f);
  EXPECT_EQ(planes.coverage.share(1, 2, 5), -0.2f);
  EXPECT_FALSE(has(comped(), "pixel")) << comped();
}

TEST_F(DamagedEdges, AFewMeansThatCannotBeAreUnknown) {
  frame.setVector("MeanNormal", 1, 1, {NAN, 0, 1});
  frame.setVector("MeanNormal", 2, 1, {0, 0, 1000});
  frame.setVector("MeanNormal", 3, 1, {0, 0, 0});
  const FramePlanes planes = read();
  for (int x = 1; x <= 3; ++x) EXPECT_TRUE(std::isnan(planes.meanNormal.x(x, 1))) << x;
  EXPECT_EQ(planes.meanNormal.z(4, 1), 1.0f);
  expectSaid("of the 64 pixels that show something");
}

TEST_F(DamagedEdges, MeansThatSayNothingAreSetAside) {
  for (const V3f& mean : {V3f(NAN), V3f(0.0f), V3f(1e38f), V3f(0, 0, 5), V3f(0, 0, -1),
                          V3f(0, 1, 0)}) {
    fillMean(mean);
    EXPECT_TRUE(read().meanNormal.empty()) << mean.z;
    expectSaid("edges are mixed without it");
  }
}

TEST_F(DamagedEdges, MeansAreNotDoubtedWhereEdgesArePainted) {
  fillMean(V3f(NAN));
  EXPECT_FALSE(has(comped("[edges]\nrough = 2\n"), "MeanNormal"));
}

TEST_F(DamagedEdges, ACryptomatteWithoutAllItsChannels) {
  frame.plane("CryptoObject01.r");
  expectSaid("lacks the coverage channel of rank 3");
}

TEST(DamagedEdgePasses, MeanNormalsWithoutAnAxis) {
  TestFrame frame{8, 8};
  frame.sidecar["lights"].push_back(lightJson("Sun", "sun", {0, 0, 9}, {0, 0, -1}, 1));
  frame.plane("CryptoObject00.r");
  frame.plane("CryptoObject00.g");
  frame.plane("MeanNormal.Y");
  frame.plane("MeanNormal.Z", 1.0f);
  bool said = false;
  for (const std::string& warning : frame.comp("").warnings)
    said = said || warning.find("ViewLayer.MeanNormal has no channel ViewLayer.MeanNormal.X") == 0;
  EXPECT_TRUE(said);
  const Inspection found = inspectFrame(frame.write());
  EXPECT_EQ(found.aovs.back().purpose, "MeanNormal");
  EXPECT_EQ(found.aovs.back().pass, "ViewLayer.MeanNormal");
  EXPECT_TRUE(std::any_of(found.findings.begin(), found.findings.end(), [](const Finding& finding) {
    return finding.what.find("MeanNormal has no channel") != std::string::npos;
  }));
}

}  // namespace
}  // namespace kagefude
