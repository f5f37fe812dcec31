#include "compositor/output_layers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "compositor/frame_light.h"

namespace kagefude {
namespace {

FrameLight lightCalled(const std::string& name, ShadowMethod method) {
  FrameLight light;
  light.name = name;
  light.method = method;
  return light;
}

const std::vector<FrameLight> lights{lightCalled("Key", ShadowMethod::pcf),
                                     lightCalled("Fill", ShadowMethod::coverage)};

Look lookWith(const std::vector<std::string>& layers) {
  Look look;
  look.output.layers = layers;
  return look;
}

std::string errorOf(const std::vector<std::string>& layers) {
  try {
    checkLayers(lookWith(layers), lights);
  } catch (const LookError& error) {
    return error.what();
  }
  return "no error";
}

TEST(OutputLayers, EveryLightHasItsOwn) {
  const std::vector<std::string> names = layerNames(lights);
  for (const char* name : {"visibility.Key", "visibility.Fill", "confidence.Key", "coverage.Fill",
                           "brush.tone", "brush.angle", "brush.repeat", "outline", "surface.id"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  EXPECT_EQ(names.size(), 10u);  // no coverage.Key: its method brings none
}

TEST(OutputLayers, NamesAndGlobsThatMatchAreTaken) {
  EXPECT_EQ(errorOf({}), "no error");
  EXPECT_EQ(errorOf({"visibility.*", "brush.tone", "surface.id", "*"}), "no error");
}

TEST(OutputLayers, WhatMatchesNothingIsRefusedWithTheNearestName) {
  EXPECT_NE(errorOf({"brush.*", "visiblity.Key"}).find("did you mean visibility.Key?"),
            std::string::npos);
  EXPECT_NE(errorOf({"Brush.tone"}).find("did you mean brush.tone?"), std::string::npos);
  EXPECT_NE(errorOf({"depth.*"}).find("no layer of the frame is called depth.*"),
            std::string::npos);
}

TEST(OutputLayers, ALayerOfAnotherMethodSaysWhichMethodBringsIt) {
  const std::string error = errorOf({"coverage.Key"});
  EXPECT_NE(error.find("coverage.<light> comes with shadow.method = \"coverage\" only"),
            std::string::npos)
      << error;
}

TEST(OutputLayers, BytesAreOfWhatIsAskedFor) {
  EXPECT_EQ(layerBytes(lookWith({}), lights), 0u);
  EXPECT_EQ(layerBytes(lookWith({"visibility.*", "surface.id"}), lights), 12u);
}

TEST(OutputLayers, EveryRowsFunctionTakesItsPlane) {
  FramePlanes planes;
  planes.width = 3;
  planes.height = 2;
  LayerSources sources{planes};
  sources.visibility = Floats(3, 2, 0.25f);
  sources.tone = Floats(3, 2, 0.5f);
  sources.outline = Floats(3, 2, 0.75f);
  sources.angle = Floats(3, 2, 2.0f);
  sources.repeat = Floats(3, 2, 3.0f);
  sources.surfaces = Labels(3, 2, 7u);
  sources.light = &lights[1];
  FrameResult result;
  const Look all = lookWith({"*"});
  takeLayers(all, LayerStage::light, sources, result);
  takeLayers(all, LayerStage::frame, sources, result);
  std::map<std::string, const LayerPlane*> taken;
  for (const NamedPlane& layer : result.layers) taken[layer.name] = &layer.plane;
  ASSERT_EQ(taken.size(), 8u);
  EXPECT_EQ(taken.at("coverage.Fill")->floats(2, 1), 0.75f);  // before visibility moves away
  EXPECT_EQ(taken.at("visibility.Fill")->floats(2, 1), 0.25f);
  EXPECT_EQ(taken.at("confidence.Fill")->floats(2, 1), 1.0f);
  EXPECT_EQ(taken.at("brush.tone")->floats(0, 0), 0.5f);
  EXPECT_EQ(taken.at("outline")->floats(0, 0), 0.75f);
  EXPECT_EQ(taken.at("brush.angle")->floats(0, 0), 2.0f);
  EXPECT_EQ(taken.at("brush.repeat")->floats(0, 0), 3.0f);
  EXPECT_EQ(taken.at("surface.id")->labels(1, 1), 7u);
}

}  // namespace
}  // namespace kagefude
