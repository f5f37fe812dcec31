#include <cmath>

#include "compositor/test_frame.h"
#include "passes/light_shape/light_share.h"

namespace kagefude {
namespace {

using testing::lightJson;
using testing::TestFrame;

TEST(LightLayers, VisibilityIsWrittenAsItIsMeasured) {
  TestFrame frame(6, 6);
  frame.plane("dark.R");
  frame.sidecar["lights"].push_back(lightJson("Key", "point", {0, 0, 5}, {0, 0, -1}, 10));
  const auto sample = [](double u) {
    return nlohmann::json{{"layer", "ViewLayer.dark"}, {"uv", {u, 0}}, {"position", {0, 0, 5}}};
  };
  frame.sidecar["lights"][0]["masks"] = {
      {"arrangement", "line"}, {"offset", 0.1}, {"samples", {sample(-1), sample(1)}}};
  FrameResult result =
      frame.comp("output.layers = [\"visibility.*\", \"brush.tone\"]\nshadow.strength = 0.5\n");
  EXPECT_EQ(TestFrame::layer(result, "visibility.Key")(2, 2), 0.0f);
  EXPECT_NEAR(TestFrame::layer(result, "brush.tone")(2, 2), 0.5f, 1e-6f);
}

TEST(LightLayers, WhatTheRendererTracedIsTheVisibility) {
  TestFrame frame(4, 1);
  Floats& traced = frame.plane("traced.Key.V");
  traced(0, 0) = 0.25f;
  traced(1, 0) = 1.5f;  // a renderer's rounding
  traced(2, 0) = std::nanf("");
  frame.sidecar["lights"].push_back(lightJson("Key", "point", {0, 0, 5}, {0, 0, -1}, 10));
  frame.sidecar["lights"][0]["traced"] = {{"layer", "ViewLayer.traced.Key"}, {"samples", 16}};
  const std::string look = "output.layers = [\"visibility.*\"]\n";
  for (const char* method : {"auto", "traced"}) {
    FrameResult result = frame.comp(look + "shadow.method = \"" + method + "\"\n");
    const auto visibility = TestFrame::layer(result, "visibility.Key");
    EXPECT_EQ(visibility(0, 0), 0.25f) << method;
    EXPECT_EQ(visibility(1, 0), 1.0f) << method;
    EXPECT_EQ(visibility(2, 0), 1.0f) << method;
    EXPECT_EQ(visibility(3, 0), 0.0f) << method;
  }
}

TEST(LightLayers, WithoutATracedLayerTheMethodSaysHowToExportOne) {
  TestFrame frame(2, 1);
  frame.sidecar["lights"].push_back(lightJson("Key", "point", {0, 0, 5}, {0, 0, -1}, 10));
  try {
    frame.comp("shadow.method = \"traced\"\n");
    FAIL() << "expected an error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--masks trace:64"), std::string::npos)
        << error.what();
  }
}

TEST(LightLayers, WholeNumbersAbove2To24AreDifferentObjects) {
  TestFrame frame(4);
  frame.sidecar["lights"].push_back(lightJson("Sun", "sun", {0, 0, 9}, {0, 0, -1}, 1));
  Labels& index = frame.numbers("IndexOB.X");
  for (int x = 0; x < 4; ++x) index(x, 0) = 16777216u + (x < 2 ? 0u : 1u);
  const FrameResult result = frame.comp("output.layers = [\"surface.id\"]\n");
  ASSERT_EQ(result.layers.size(), 1u);
  const Labels& ids = result.layers[0].plane.labels;
  EXPECT_NE(ids(1, 0), ids(2, 0));
}

TEST(LightLayers, AStripsAlphaIsPainted) {
  TestFrame frame(4, 4);
  frame.sidecar["lights"].push_back(lightJson("Sun", "sun", {0, 0, 9}, {0, 0, -1}, 1));
  const Floats half(4, 4, 0.5f), one(4, 4, 1.0f);
  writePng(frame.folder / "clear.png", one, one, one, half);
  OutputImage image;
  image.dataWindow = image.displayWindow = {0, 0, 4, 4};
  for (const char* name : {"R", "G", "B", "A"})  // white at half, associated
    image.channels.push_back(floatChannel(name, PixelType::single, half));
  writeExr(frame.folder / "clear.exr", image);
  for (const char* strip : {"clear.png", "clear.exr"}) {
    const FrameResult result =
        frame.comp("[output]\nbackground = \"transparent\"\n[[style]]\nstrip = \"" +
                   std::string(strip) + "\"\n");
    EXPECT_NEAR(result.alpha.view()(1, 1), 0.5f, 0.003f) << strip;
    EXPECT_NEAR(result.colour.x.view()(1, 1), 0.5f, 0.003f) << strip;
  }
}

TEST(LightLayers, BuiltInStripsNeedNoSpaceOfTheConfig) {
  TestFrame frame(4, 4);
  frame.sidecar["lights"].push_back(lightJson("Sun", "sun", {0, 0, 9}, {0, 0, -1}, 1));
  const FrameResult known = frame.comp("[[style]]\nstrip = \"builtin:soft\"\n");
  frame.folder.write("own.ocio",
                     "ocio_profile_version: 2\nroles:\n  default: raw\n  scene_linear: lin\n"
                     "file_rules:\n  - !<Rule> {name: Default, colorspace: default}\n"
                     "displays:\n  none:\n    - !<View> {name: Raw, colorspace: raw}\n"
                     "colorspaces:\n  - !<ColorSpace>\n    name: lin\n"
                     "  - !<ColorSpace>\n    name: raw\n    isdata: true\n");
  const FrameResult own =
      frame.comp("[colour]\nconfig = \"own.ocio\"\n[[style]]\nstrip = \"builtin:soft\"\n");
  EXPECT_NEAR(own.colour.x.view()(1, 1), known.colour.x.view()(1, 1), 1e-3f);
}

TEST(LightLayers, AnyNinePlacesAreNoRing) {
  std::vector<V2f> grid;
  for (const float v : {-1.0f, 0.0f, 1.0f})
    for (const float u : {-1.0f, 0.0f, 1.0f}) grid.emplace_back(u, v);
  for (const float edge : {-0.6f, 0.0f, 0.4f}) {
    std::vector<float> s;
    for (const V2f& p : grid) s.push_back(p.x - edge);
    // With masks at its corners the light is the square itself.
    EXPECT_NEAR(LightShare(grid, false, 1).of(s.data()), (1 - edge) / 2, 1e-5);
  }
}

TEST(LightLayers, APlaneFitsPlacesOfAnyKind) {
  const V2f places[] = {{0.1f, 0.2f}, {0.9f, 0.1f}, {0.8f, 0.5f}, {0.3f, 0.9f}, {0.5f, -0.4f}};
  const float distance = 0.3f;
  std::vector<float> s;
  for (const V2f& p : places) s.push_back(2 * (distance + p.x));
  EXPECT_NEAR(LightShare(places, true, 1).of(s.data()), discShare(distance), 1e-4);
}

TEST(LightLayers, EqualPlacesOnALineDivideByNothing) {
  const V2f doubled[] = {{-1, 0}, {-1, 0}, {1, 0}, {1, 0}}, one[] = {{0.5f, 0}, {0.5f, 0}};
  const float s[] = {-1, -1, 3, 3}, mixed[] = {-1, 1};
  EXPECT_FLOAT_EQ(LightShare(doubled, false, 1).of(s), 0.75f);
  EXPECT_FLOAT_EQ(LightShare(one, false, 1).of(mixed), 0.5f);
}

}  // namespace
}  // namespace kagefude
