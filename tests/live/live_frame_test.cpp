#include "live/live_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "compositor/scale_down.h"
#include "compositor/sweep_frame.h"

namespace kagefude {
namespace {

using testing::companions;
using testing::contextOf;
using testing::takesPair;

void addPlane(std::string& bytes, View<const float> plane) {
  bytes.append(reinterpret_cast<const char*>(plane.data), plane.pixels() * sizeof(float));
}

/// Colour and alpha, and the planes that `layer(name)` gives, as bytes.
template <class Layer>
std::string pixelsOf(const FrameResult& frame, const std::vector<std::string>& lights,
                     const Layer& layer) {
  std::string bytes;
  for (const Floats* plane : {&frame.colour.x, &frame.colour.y, &frame.colour.z, &frame.alpha})
    addPlane(bytes, *plane);
  for (const std::string& light : lights) addPlane(bytes, layer("visibility." + light));
  addPlane(bytes, layer("brush.tone"));
  return bytes;
}

class Live : public ::testing::Test, protected testing::SweepFrame {
 protected:
  static constexpr const char* styled =
      "[[style]]\nobject = [\"Ground\"]\nstrip = \"builtin:soft\"\ncolour = \"replace\"\n"
      "outline_colour = [0, 0, 0]\n[[style]]\nstrip = \"builtin:fine\"\n";

  Look lookOf(const std::string& text, const std::vector<std::string>& set = {}) const {
    frame.folder.write("look.toml", text);
    return readLook(frame.folder / "look.toml", set);
  }

  LivePicture compose(const std::string& text, const std::vector<std::string>& set = {}) {
    return live.compose(lookOf(text, set), shelf, 0);
  }

  /// The stages that are made for a look.
  std::vector<std::string> made(const std::string& text, const std::vector<std::string>& set = {}) {
    return compose(text, set).made;
  }

  static std::string stagesOf(const LivePicture& picture) {
    std::vector<std::string> names;
    for (const LightStagesMade& light : picture.stages.lights) names.push_back(light.name);
    return pixelsOf(picture.stages.picture->frame, names, [&](const std::string& name) {
      for (const LightStagesMade& light : picture.stages.lights)
        if (name == "visibility." + light.name) return light.visibility->view();
      return picture.stages.tone->view();
    });
  }

  /// What composeFrame makes of the frame, with everything read and made anew.
  std::string wholeFrame(const std::string& text, std::vector<std::string> set) {
    set.push_back("output.layers=[\"visibility.*\", \"brush.tone\"]");
    const Look look = lookOf(text, set);
    StageRun run;
    if (stripsAnew) wholeShelf = StripShelf();
    const Made<StripSet> strips = wholeShelf.stripsOf(look, wholeShelf.colourOf(look, run), run);
    const FramePlan plan = planFrame(look, live.path(), 1);
    const FrameResult whole = composeFrame(look, *strips, plan, readFramePlanes(plan));
    std::vector<std::string> names;
    for (const FrameLight& light : plan.lights) names.push_back(light.name);
    return pixelsOf(whole, names, [&](const std::string& name) {
      for (const NamedPlane& layer : whole.layers)
        if (layer.name == name) return layer.plane.floats.view();
      ADD_FAILURE() << "no layer " << name;
      return View<const float>();
    });
  }

  void expectSame(const std::string& text, const std::vector<std::string>& set) {
    std::string expected, said, heard;
    try {
      expected = wholeFrame(text, set);
    } catch (const Error& error) {
      said = error.what();
    }
    std::string got;
    try {
      got = stagesOf(compose(text, set));
    } catch (const Error& error) {
      heard = error.what();
    }
    EXPECT_TRUE(got == expected) << text << "with " << (set.empty() ? "nothing" : set.back());
    EXPECT_EQ(heard, said) << text << "with " << (set.empty() ? "nothing" : set.back());
  }

  LiveFrame live{frame.write(), 1};
  StripShelf shelf, wholeShelf;
  bool stripsAnew = true;
};

TEST_F(Live, TurningAnyKeyOfAPassGivesTheBitsOfAWholeFrame) {
  stripsAnew = false;  // painting them takes most of the time
  addLight("Fill", {-3, -1, 9}, 4);
  for (const LookSection& row : lookSections) {
    const std::string section(row.table->pass);
    if (!row.inLook || section == "frame" || section == "colour" || section == "output") continue;
    const bool pair = takesPair(section);
    arrange(pair ? "pair" : "disc", pair ? 2 : 9);
    mask("Fill", frame.sidecar["lights"][1], pair ? "pair" : "disc", pair ? 2 : 9, 4);
    frame.write();
    for (const Parameter& p : row.table->parameters) {
      const std::string key = section + "." + std::string(p.name);
      const auto companion = companions.find(key);
      const std::string with = companion == companions.end() ? "" : companion->second;
      const std::string look = with + contextOf(section) + "[[light]]\nname = \"*\"\n" + styled;
      for (const std::string& value : candidates(p)) {
        expectSame(look, {key + "=" + value});
        if (actsIn(Scope::light, row, p.name)) expectSame(look, {"light[0]." + key + "=" + value});
        if (actsIn(Scope::style, row, p.name)) expectSame(look, {"style[0]." + key + "=" + value});
      }
      expectSame(look, {});
    }
  }
}

TEST_F(Live, TurningLightsStylesAndOutputsGivesTheBitsOfAWholeFrame) {
  addLight("Fill", {-3, -1, 9}, 4);
  frame.plane("Combined.R", 0.5f);
  frame.plane("Combined.G", 0.25f);
  frame.plane("Combined.B", 0.125f);
  frame.plane("Combined.A", 0.75f);
  frame.write();
  const std::string look = std::string("[[light]]\nname = \"Key\"\n") + styled;
  const std::vector<std::vector<std::string>> turns = {
      {"light[0].on=false"},
      {"light[0].weight=3"},
      {"light[0].position=[1, 2, 7]"},
      {"light[0].position=[1, 2, 8]", "light[0].radius=0.8"},
      {"light[0].shadow.method=places"},
      {"light[0].shadow.method=places", "shadow.places=17", "light[0].shadow.places=17"},
      {"light[0].shadow.strength=0.5"},
      {"light[0].shadow.method=pcf"},
      {"light[0].shadow.method=blob", "light[0].shadow.receiver=Ground"},
      {"light[0].shadow.method=blob", "light[0].shadow.receiver=Ground",
       "light[0].shadow.blob=" + blobFile()},
      {"light[0].shadow.method=planar", "light[0].shadow.receiver=Ground"},
      {"light[0].shadow.method=hard"},
      {"shadow.lights=[\"Fill\"]"},
      {"style[0].object=[\"Ball\"]"},
      {"style[0].index=3"},
      {"style[1].priority=4"},
      {"style[0].strip=builtin:cel"},
      {"style[1].strip=builtin:cel"},
      {"style[0].colour=multiply"},
      {"style[0].reference=[1, 1, 0]"},
      {"style[0].light=Fill"},
      {"style[0].outline_colour=[1, 0, 0]"},
      {"style[0].outline_colour=[]"},
      {"scene.centre=[1, 0, 0]", "scene.radius=9"},
      {"scene.distance=30", "brush.size=screen"},
      {"output.background=transparent"},
      {"output.edges=pixel"},
      {"frame.albedo=\"none\""},
  };
  for (const std::vector<std::string>& turn : turns) {
    expectSame(look, turn);
    expectSame(look, {});
  }
}

TEST_F(Live, APictureThatIsWrittenSmallerIsThatOfAWholeFrame) {
  const std::vector<std::string> set{"output.scale=2"};
  const LivePicture picture = compose(styled, set);
  const FrameResult whole = frame.comp(styled, set);
  const auto none = [](const std::string&) { return View<const float>(); };
  ASSERT_EQ(picture.stages.picture->frame.colour.x.width(), width / 2);
  EXPECT_TRUE(pixelsOf(picture.stages.picture->frame, {}, none) == pixelsOf(whole, {}, none));
}

TEST_F(Live, AChangeMakesOnlyWhatDependsOnIt) {
  using Names = std::vector<std::string>;
  const std::string look = styled;
  EXPECT_EQ(made(look), (Names{"read", "colour", "strips", "surfaces", "shadow of Key",
                               "tone of Key", "styles", "tone", "strokes", "picture"}));
  EXPECT_EQ(made(look), Names{});
  EXPECT_EQ(made(look, {"brush.contrast=0.3"}), (Names{"styles", "strokes", "picture"}));
  made(look);
  EXPECT_EQ(made(look, {"style[0].outline.width=3"}), (Names{"styles", "picture"}));
  made(look);
  EXPECT_EQ(made(look, {"tone.gamma=2"}), (Names{"styles", "tone", "strokes", "picture"}));
  made(look);
  EXPECT_EQ(made(look, {"shade.wrap=0.5"}), (Names{"tone of Key", "tone", "strokes", "picture"}));
  made(look);
  EXPECT_EQ(made(look, {"output.background=transparent"}), Names{"picture"});
  made(look);
  EXPECT_EQ(made(look, {"smooth.all_methods=true"}),
            (Names{"smoothing of Key", "tone of Key", "tone", "strokes", "picture"}));
  EXPECT_EQ(made(look, {"smooth.all_methods=true", "smooth.h=9"}),
            (Names{"smoothing of Key", "tone of Key", "tone", "strokes", "picture"}));
  made(look);
  EXPECT_EQ(made(look, {"style[0].strip=builtin:cel"}),
            (Names{"strips", "styles", "strokes", "picture"}));
  made(look);
  EXPECT_EQ(made(look, {"light_shape.soften=0.5"}),
            (Names{"shadow of Key", "tone of Key", "tone", "strokes", "picture"}));
}

TEST_F(Live, FilesThatChangeOnDiskAreReadAgain) {
  const std::string strip = frame.folder / "strip.png";
  const auto paint = [&](float grey, int width) {
    const Floats plane(width, 8, grey);
    writePng(strip, plane, plane, plane);
  };
  paint(0.25f, 16);
  const std::string look = "[[style]]\nstrip = \"strip.png\"\n";
  expectSame(look, {});
  paint(0.75f, 24);
  expectSame(look, {});
  frame.setVector("Normal", 5, 5, {0, 1, 0});
  frame.sidecar["lights"][0]["energy"] = 0;
  frame.write();
  expectSame(look, {});
}

TEST_F(Live, WhatFailsLeavesTheStagesAsTheyWere) {
  const LivePicture good = compose(styled);
  const std::string before = stagesOf(good);
  EXPECT_THROW(compose(styled, {"style[0].strip=missing.png"}), Error);
  EXPECT_THROW(compose(styled, {"style[0].light=Nobody"}), LookError);
  EXPECT_THROW(compose(styled, {"shadow.method=pair"}), InputError);
  EXPECT_EQ(made(styled), std::vector<std::string>{});
  EXPECT_EQ(stagesOf(good), before);
}

TEST_F(Live, ANewerChangeEndsTheOneBefore) {
  compose(styled);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(live.compose(lookOf(styled, {"brush.contrast=0.3"}), shelf, 0, stop.get_token()),
               Superseded);
  EXPECT_EQ(live.compose(lookOf(styled), shelf, 0, stop.get_token()).made,
            std::vector<std::string>{});
  expectSame(styled, {"brush.contrast=0.3"});
}

TEST_F(Live, OldResultsAreLetGo) {
  std::vector<std::weak_ptr<const BrushResult>> strokes;
  std::vector<std::weak_ptr<const LightVisibility>> shadows;
  for (int i = 0; i < 500; ++i) {
    const LivePicture picture = compose(styled, {fmt::format("brush.contrast={}", 0.001 * i),
                                                 fmt::format("light_shape.soften={}", 0.002 * i)});
    strokes.push_back(picture.stages.strokes.value);
    shadows.push_back(picture.stages.lights[0].shadow.value);
  }
  const auto alive = [](const auto& list) {
    return std::count_if(list.begin(), list.end(), [](const auto& p) { return !p.expired(); });
  };
  EXPECT_EQ(alive(strokes), 1);
  EXPECT_EQ(alive(shadows), 1);
  compose(styled, {"shadow.lights=[\"*\"]", "shadow.method=none"});
  EXPECT_EQ(alive(shadows), 0);
}

}  // namespace
}  // namespace kagefude
