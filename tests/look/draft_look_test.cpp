#include "look/draft_look.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/glob.h"
#include "image/oklab.h"
#include "look/look.h"
#include "look/look_keys.h"
#include "look/toml_text.h"
#include "passes/strip/strip_check.h"

namespace kagefude {
namespace {

DraftThing thing(const std::string& object, const std::string& material, size_t pixels,
                 const V3f& colour) {
  DraftThing result;
  result.object = object;
  result.material = material;
  result.pixels = pixels;
  result.rimPixels = pixels / 50;
  result.colour = colour;
  result.pixelWidth = 0.01f;
  return result;
}

DraftFrame frameOf(std::vector<DraftThing> things) {
  return {"f.exr", 400, 200, 1, 1, true, things};
}

Look lookOf(const DraftLook& draft) { return readLookText(draft.text, "look.toml", {}); }

TEST(DraftLook, EveryPresetIsALookWithItsStrips) {
  const DraftFrame frame = frameOf({thing("Cup", "Glaze", 9000, {0.1f, 0.2f, 0.5f}),
                                    thing("Table", "Wood", 40000, {0.4f, 0.3f, 0.1f})});
  for (const LookPreset& preset : lookPresets()) {
    const DraftLook draft = draftLook(preset, frame, "look_strips");
    const Look look = lookOf(draft);
    ASSERT_EQ(look.styles.size(), 3u) << preset.name;
    EXPECT_EQ(look.styles[0].style.material, std::vector<std::string>{"Wood"});
    EXPECT_EQ(look.styles[0].style.strip, "look_strips/wood.png");
    EXPECT_EQ(look.styles[2].style.object, std::vector<std::string>{"*"});
    EXPECT_LT(look.styles[2].style.priority, 0);
    ASSERT_EQ(draft.strips.size(), 3u);
    EXPECT_EQ(draft.strips[1].file, "glaze.png");
    EXPECT_EQ(look.styles[0].style.outlineColour.empty(), preset.outlineLightness < 0);
  }
  EXPECT_THROW(lookPreset("gouash"), UsageError);
}

TEST(DraftLook, WhatWouldDoNothingIsNotWritten) {
  DraftFrame frame = frameOf({thing("Cup", "Glaze", 9000, {0.1f, 0.2f, 0.5f})});
  const auto textOf = [&](const char* preset) {
    return draftLook(lookPreset(preset), frame, "s").text;
  };
  EXPECT_NE(textOf("oil").find("[smooth]"), std::string::npos);
  EXPECT_NE(textOf("oil").find("brush.mapping_distance"), std::string::npos);
  EXPECT_EQ(textOf("cel").find("brush.mapping_distance"), std::string::npos) << "it has no strokes";
  frame.smooths = false;
  for (const LookPreset& preset : lookPresets())
    EXPECT_EQ(draftLook(preset, frame, "s").text.find("smooth"), std::string::npos) << preset.name;
}

TEST(DraftLook, LengthsStayInTheirRangesOnSmallFrames) {
  // A paper's grain has at least 1.5 pixels, which 0.6 % of few rows are not.
  for (const LookPreset& preset : lookPresets()) {
    DraftFrame frame = frameOf({thing("A", "", 9000, V3f(0.2f))});
    frame.height = 16;
    EXPECT_NO_THROW(lookOf(draftLook(preset, frame, "s"))) << preset.name;
  }
}

TEST(DraftLook, StrokesFitTheThingsOnTheScreen) {
  LookPreset preset = lookPreset("oil");
  preset.strokeSize = 0.5f;
  preset.followsSize = 0.5f;
  // 10,000 pixels are 100 a side, the whole of half the height: 100 pixels of 0.01 round once.
  const auto distance = [&](size_t pixels) {
    const DraftLook draft = draftLook(preset, frameOf({thing("A", "", pixels, V3f(0.5f))}), "s");
    return lookOf(draft).styles[0].passes.brush.mappingDistance;
  };
  EXPECT_NEAR(distance(10000), 1.0 / 6.2831853, 1e-3);
  EXPECT_NEAR(distance(625), 0.5 / 6.2831853, 1e-3) << "a quarter as wide, half the brush";
}

TEST(DraftLook, AMaterialOfTwoColoursHasAStyleForEach) {
  const DraftLook draft = draftLook(
      lookPreset("cel"),
      frameOf({thing("Leaf Red", "Leaf", 500, {0.5f, 0.05f, 0.02f}),
               thing("Leaf Gold", "Leaf", 400, {0.6f, 0.4f, 0.05f}),
               thing("Left", "Stone", 350, V3f(0.3f)), thing("Right", "Stone", 200, V3f(0.31f))}),
      "s");
  const Look look = lookOf(draft);
  ASSERT_EQ(look.styles.size(), 4u);
  EXPECT_EQ(look.styles[0].style.material, std::vector<std::string>{"Stone"})
      << "its 550 pixels on two objects come as one";
  EXPECT_TRUE(look.styles[0].style.object.empty());
  EXPECT_EQ(look.styles[1].style.object, std::vector<std::string>{"Leaf Red"});
  EXPECT_EQ(look.styles[1].style.material, std::vector<std::string>{"Leaf"});
}

TEST(DraftLook, HundredsOfSmallThingsShareStrips) {
  std::vector<DraftThing> things;
  for (int i = 0; i < 600; ++i)
    things.push_back(thing("Part " + std::to_string(i), "", 1000 - static_cast<size_t>(i),
                           {0.1f + 0.001f * static_cast<float>(i % 300), 0.2f, 0.3f}));
  const DraftLook draft = draftLook(lookPreset("gouache"), frameOf(things), "s");
  const Look look = lookOf(draft);
  EXPECT_LE(draft.strips.size(), 65u);
  size_t named = 0;
  for (const StyleLook& style : look.styles) named += style.style.object.size();
  EXPECT_EQ(named, 601u) << "every one of them, and *";
}

TEST(DraftLook, ThinThingsHaveThinOutlinesOrNone) {
  DraftThing twig = thing("Twig", "", 1000, V3f(0.1f)), grass = thing("Grass", "", 900, V3f(0.1f));
  twig.rimPixels = 500;   // 4 pixels wide
  grass.rimPixels = 880;  // 2
  DraftFrame frame = frameOf({thing("Rock", "", 5000, V3f(0.2f)), twig, grass});
  frame.height = 1000;  // lines of 3.4 pixels
  const Look look = lookOf(draftLook(lookPreset("ink"), frame, "s"));
  EXPECT_FALSE(look.styles[0].style.outlineColour.empty());
  EXPECT_FLOAT_EQ(look.styles[0].passes.outline.width, 3.4f);
  EXPECT_FALSE(look.styles[1].style.outlineColour.empty());
  EXPECT_FLOAT_EQ(look.styles[1].passes.outline.width, 0.8f);
  EXPECT_TRUE(look.styles[2].style.outlineColour.empty());
}

TEST(DraftLook, LargerFramesAreWrittenAtTheShotsSize) {
  DraftFrame frame = frameOf({thing("A", "", 9000, V3f(0.2f))});
  frame.height = 2000;
  frame.scale = 2;
  const Look look = lookOf(draftLook(lookPreset("ink"), frame, "s"));
  EXPECT_EQ(look.output.scale, 2);
  EXPECT_FLOAT_EQ(look.passes.outline.width, 3.4f) << "of the 1000 rows that are written";
}

TEST(DraftLook, SmallThingsHaveSmallStrips) {
  DraftFrame frame =
      frameOf({thing("Big", "", 1000000, V3f(0.5f)), thing("Small", "", 500, V3f(0.1f))});
  frame.height = 1000;
  const DraftLook draft = draftLook(lookPreset("oil"), frame, "s");
  EXPECT_EQ(draft.strips[0].params.width, 512);
  EXPECT_EQ(draft.strips[1].params.width, 256);
  EXPECT_FLOAT_EQ(draft.strips[1].params.strokeWidth, 0.5f * draft.strips[0].params.strokeWidth);
}

TEST(DraftLook, ExposesForWhatIsLit) {
  DraftThing sky = thing("Sky", "", 40000, V3f(0.5f)), rock = thing("Rock", "", 5000, V3f(0.2f));
  sky.brightTone = 0.4f;
  rock.brightTone = 0.8f;
  DraftFrame frame = frameOf({sky, rock});
  frame.brightTone = 0.8f;
  const Look look = lookOf(draftLook(lookPreset("oil"), frame, "s"));
  EXPECT_FLOAT_EQ(look.passes.tone.white, 0.92f) << "1.15 times as much";
  EXPECT_FLOAT_EQ(look.styles[0].passes.tone.white, 0.46f) << "half the frame, lit half as much";
  EXPECT_FLOAT_EQ(look.styles[1].passes.tone.white, 0.92f);
}

TEST(DraftLook, NamesAreQuotedSoThatTheyFitThemselves) {
  for (const std::string& name :
       {std::string("a \"b\" \\ c"), std::string("line\nbreak\x01"), std::string("Vögel 鳥"),
        std::string("bad\xff\xfe utf"), std::string("cut \xe9\xb3"), std::string("x]=[#")}) {
    const DraftLook draft =
        draftLook(lookPreset("cel"), frameOf({thing(name, "", 500, V3f(0.5f))}), "s");
    const Look look = lookOf(draft);
    ASSERT_EQ(look.styles.size(), 2u);
    ASSERT_EQ(look.styles[0].style.object.size(), 1u);
    EXPECT_TRUE(matchesGlob(name, look.styles[0].style.object[0])) << name;
  }
  EXPECT_EQ(tomlString("a\"b\n\xff"), "\"a\\\"b\\u000A?\"");
}

TEST(LookPreset, ColoursAreTheThingsOwn) {
  // The lit tones of a red thing are red and those of a blue one blue, in every preset of colours.
  for (const LookPreset& preset : lookPresets()) {
    if (!preset.inColour) continue;
    const auto lit = [&](const V3f& colour) {
      const StripPaintParams strip = presetStrip(preset, colour, 1);
      const size_t last = strip.stops.size() - 8;
      return oklabOfSrgb({strip.stops[last + 1], strip.stops[last + 2], strip.stops[last + 3]});
    };
    EXPECT_GT(lit({0.6f, 0.05f, 0.03f}).y, 0.05f) << preset.name;
    EXPECT_LT(lit({0.03f, 0.1f, 0.6f}).z, -0.04f) << preset.name;
  }
}

TEST(LookPreset, CelTonesAreFlat) {
  const PaintedStrip strip = paintStrip(presetStrip(lookPreset("cel"), {0.02f, 0.2f, 0.25f}, 1));
  for (const auto& [from, to] : {std::pair(0.05f, 0.28f), std::pair(0.33f, 0.95f)})
    for (const Floats* plane : {&strip.r, &strip.g, &strip.b})
      EXPECT_NEAR((*plane)(7, static_cast<int>(512 * (1 - from))),
                  (*plane)(300, static_cast<int>(512 * (1 - to))), 1e-3f);
}

TEST(LookPreset, StripsPassTheirCheck) {
  for (const LookPreset& preset : lookPresets())
    for (const V3f& colour : {V3f(0.5f, 0.5f, 0.08f), V3f(0.02f, 0.2f, 0.25f),
                              V3f(0.6f, 0.05f, 0.03f), V3f(0.8f), V3f(0.02f)}) {
      const StripPaintParams strip = presetStrip(preset, colour, 6);
      const PaintedStrip painted = paintStrip(strip);
      const StripReport report = checkStrip(painted.r, painted.g, painted.b);
      EXPECT_TRUE(report.problems.empty()) << preset.name << ": " << report.problems.front();
    }
}

TEST(LookKeys, ListsAndTakesAwayKeys) {
  const std::string text =
      "kagefude = 1\nbrush.contrast = 2\n[smooth]\nh = 3\n[[style]]\nobject = \"A\"\ntone.gamma = "
      "2\n"
      "[[style]]\nobject = [\"B\"]\n[style.brush]\npoints = 2\n";
  EXPECT_EQ(keysOf(text, "l.toml"),
            (std::vector<std::string>{"brush.contrast", "smooth.h", "style[0].object",
                                      "style[0].tone.gamma", "style[1].brush.points",
                                      "style[1].object"}));
  const Look look = readLookText(withoutKey(text, "l.toml", "style[1].brush.points"), "l.toml", {});
  EXPECT_EQ(look.styles[1].passes.brush.points, 0);
  EXPECT_EQ(look.styles[0].passes.tone.gamma, 2.0f);
  EXPECT_EQ(look.passes.smooth.h, 3);
  EXPECT_EQ(keysOf("[style]\nobject = \"A\"\n", "l.toml"),
            std::vector<std::string>{"style[0].object"});
  EXPECT_THROW(keysOf("[", "l.toml"), LookError);
}

}  // namespace
}  // namespace kagefude
