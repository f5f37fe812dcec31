#include "frame/inspect_frame.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

using namespace testing;

bool mentions(const Inspection& inspection, FindingKind kind, const std::string& text) {
  return std::any_of(inspection.findings.begin(), inspection.findings.end(),
                     [&](const Finding& finding) {
                       return finding.kind == kind && !finding.remedy.empty() &&
                              finding.what.find(text) != std::string::npos;
                     });
}

const std::vector<std::string> dataChannels = {
    "data.Position.X",   "data.Position.Y",   "data.Position.Z", "data.Normal.X",
    "data.Normal.Y",     "data.Normal.Z",     "data.IndexOB.V",  "beauty.Combined.R",
    "beauty.Combined.G", "beauty.Combined.B", "mask.Key.0.V"};

TEST(InspectFrame, ShowsLayersPassesAndWhatIsMissing) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", {"VL.Normal.X", "VL.Normal.Y", "VL.Normal.Z"});
  const Inspection inspection = inspectFrame(folder / "a.exr");
  ASSERT_EQ(inspection.layers.size(), 1u);
  EXPECT_EQ(inspection.layers[0].name, "VL");
  EXPECT_EQ(inspection.layers[0].passes[0].type, "float");
  EXPECT_TRUE(mentions(inspection, FindingKind::missing, "no Position pass"));
  EXPECT_TRUE(mentions(inspection, FindingKind::missing, "neither an object index"));
  EXPECT_TRUE(mentions(inspection, FindingKind::missing, "no JSON beside the frame"));
  EXPECT_FALSE(mentions(inspection, FindingKind::missing, "no Normal pass"));
}

TEST(InspectFrame, AForeignJsonIsCalledSo) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", {"VL.Normal.X", "VL.Normal.Y", "VL.Normal.Z"});
  writeText(folder / "a.json", "[]");
  EXPECT_TRUE(mentions(inspectFrame(folder / "a.exr"), FindingKind::missing,
                       "a.json beside the frame is none of kagefude's"));
}

TEST(InspectFrame, HalfPositionsAreAWarning) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", dataChannels, PixelType::half);
  EXPECT_TRUE(mentions(inspectFrame(folder / "a.exr"), FindingKind::warning,
                       "Position is stored as half float"));
}

TEST(InspectFrame, BrokenSidecarIsAFindingNotAFailure) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", dataChannels);
  writeText(folder / "a.json", "{");
  const Inspection inspection = inspectFrame(folder / "a.exr");
  EXPECT_TRUE(mentions(inspection, FindingKind::error, "a.json is not valid JSON"));
  EXPECT_FALSE(mentions(inspection, FindingKind::missing, "pass"));
}

TEST(InspectFrame, SidecarsMasksAndDepthMapsAreLookedFor) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", dataChannels);
  const std::string identity = "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]";
  writeText(folder / "a.json",
            R"({"kagefude":1,"frame":3,"fps":25,"resolution":[4,3],
"layers":{"data":"data","beauty":"beauty"},
"camera":{"type":"perspective","position":[0,0,0],"direction":[0,0,-1],"camera_from_world":)" +
                identity + R"(,"clip_from_camera":)" + identity + R"(},
"lights":[{"name":"Key","type":"point","position":[0,0,1],"direction":[0,0,-1],"radius":1,
"masks":{"arrangement":"pair","offset":1,"samples":[
{"layer":"mask.Key.0","position":[0,0,1],"uv":[1,0]},
{"layer":"mask.Key.1","position":[0,0,2],"uv":[-1,0]}]},
"depth_map":{"file":"d.exr","channel":"Depth.V","resolution":[4,4],"projection":"perspective",
"light_from_world":)" +
                identity + R"(,"clip_from_light":)" + identity + R"(}}],"objects":[]})");
  const Inspection inspection = inspectFrame(folder / "a.exr");
  ASSERT_EQ(inspection.lights.size(), 1u);
  EXPECT_TRUE(inspection.lights[0].masks[0].found);
  EXPECT_FALSE(inspection.lights[0].masks[1].found);
  EXPECT_FALSE(inspection.lights[0].depthMapFound);
  EXPECT_TRUE(mentions(inspection, FindingKind::missing, "no mask layer mask.Key.1"));
  EXPECT_TRUE(mentions(inspection, FindingKind::missing, "d.exr of light Key does not exist"));
  const nlohmann::json json = toJson(inspection);
  EXPECT_EQ(json["frame"], 3);
  EXPECT_EQ(json["lights"][0]["masks"][1]["found"], false);
  EXPECT_EQ(json["findings"].size(), inspection.findings.size());
  EXPECT_EQ(json["parts"][0]["compression"], "zip");
}

TEST(InspectFrame, OnlyAnUnreadableFrameFails) {
  const TemporaryFolder folder;
  EXPECT_THROW(inspectFrame(folder / "none.exr"), InputError);
}

}  // namespace
}  // namespace kagefude
