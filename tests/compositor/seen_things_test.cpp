#include "compositor/seen_things.h"

#include "compositor/check_look.h"
#include "compositor/read_frame.h"
#include "compositor/test_frame.h"

namespace kagefude {
namespace {

using namespace testing;

/// 8 x 4 pixels: five columns of Thing, two of Other, one of nothing.
void showTwoThings(TestFrame& frame) {
  frame.sidecar["lights"] = {lightJson("Key", "point", {2, 3, 4}, {0, 0, -1}, 100)};
  frame.addObject("Other", 2, {-1, -1, -1}, {1, 1, 1});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) {
      frame.setVector("Position", x, y,
                      {0.5f * static_cast<float>(x), 0.25f * static_cast<float>(y), 0});
      if (x >= 5) frame.plane("IndexOB.X")(x, y) = 2;
      if (x == 7) frame.plane("IndexOB.X")(x, y) = 0;
    }
}

void setAlbedo(TestFrame& frame, int x, int y, const V3f& c) {
  frame.plane("DiffCol.R")(x, y) = c.x;
  frame.plane("DiffCol.G")(x, y) = c.y;
  frame.plane("DiffCol.B")(x, y) = c.z;
}

std::vector<DraftThing> thingsOf(const TestFrame& frame) {
  const FramePlan plan = planWithMaterials(readLook("", {}), frame.write(), 1);
  const FramePlanes planes = readFramePlanes(plan);
  return seenThings(plan, planes, Floats(planes.width, planes.height, 0.5f));
}

TEST(SeenThings, MediansOfAlbedoByHand) {
  TestFrame frame(8, 4);
  showTwoThings(frame);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x)
      setAlbedo(frame, x, y, x == 0 ? V3f(9, 9, 9) : V3f(0.2f, 0.4f, x < 5 ? 0.6f : 0.1f));
  const auto things = thingsOf(frame);
  ASSERT_EQ(things.size(), 2u);
  EXPECT_EQ(things[0].object, "Thing");
  EXPECT_EQ(things[0].pixels, 20u);
  EXPECT_EQ(things[0].rimPixels, 4u);
  EXPECT_EQ(things[0].colour, V3f(0.2f, 0.4f, 0.6f)) << "a few odd pixels do not matter";
  EXPECT_FALSE(things[0].fromBeauty);
  EXPECT_FLOAT_EQ(things[0].pixelWidth, 0.25f) << "the smaller of both ways";
  EXPECT_FLOAT_EQ(things[0].brightTone, 0.5f);
  EXPECT_EQ(things[1].object, "Other");
  EXPECT_EQ(things[1].pixels, 8u);
  EXPECT_EQ(things[1].rimPixels, 8u);
}

TEST(SeenThings, BlackAlbedoTakesTheBrighterHalfOfTheBeauty) {
  TestFrame frame(8, 4);
  showTwoThings(frame);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) {
      setAlbedo(frame, x, y, V3f(x < 5 ? 0.3f : 0.0f));
      for (const char* channel : {"Combined.R", "Combined.G", "Combined.B", "Combined.A"})
        frame.plane(channel)(x, y) = y < 2 ? 0.7f : 0.1f;
    }
  const auto things = thingsOf(frame);
  EXPECT_FALSE(things[0].fromBeauty);
  EXPECT_TRUE(things[1].fromBeauty);
  EXPECT_EQ(things[1].colour, V3f(0.7f));
}

TEST(CheckLook, TellsWhatDoesNothing) {
  TestFrame frame(8, 8);
  frame.sidecar["lights"] = {lightJson("Key", "point", {2, 3, 4}, {0, 0, -1}, 100)};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      frame.setVector("Position", x, y,
                      {0.1f * static_cast<float>(x), 0.1f * static_cast<float>(y), 0});
  const std::string look =
      "[tone]\ngamma = 2\n[brush]\npole_fade = 1\ncontrast = 1\n"
      "[[style]]\nobject = \"Thing\"\nstrip = \"builtin:soft\"\ntone.black = 0.1\n"
      "[[style]]\nobject = \"Thng\"\ntone.black = 0.2\n";
  const std::filesystem::path path = frame.write();
  size_t calls = 0;
  const LookCheck check = checkLook(look, frame.folder / "look.toml", std::vector{path},
                                    [&](size_t, size_t) { ++calls; });
  ASSERT_EQ(check.problems.size(), 2u) << check.problems.front();
  EXPECT_NE(check.problems[0].find("style 2 fits nothing"), std::string::npos);
  EXPECT_NE(check.problems[0].find("did you mean Thing?"), std::string::npos);
  EXPECT_EQ(check.problems[1], "brush.pole_fade changes nothing in this frame")
      << "of polar strokes only";
  EXPECT_EQ(check.defaults, std::vector<std::string>{"brush.contrast"});
  EXPECT_GE(calls, 3u);
}

TEST(CheckLook, StylesThatWaitForOtherFramesAreNoProblem) {
  TestFrame frame(8, 4);
  showTwoThings(frame);
  frame.addObject("Hat", 3, {-1, -1, -1}, {1, 1, 1});  // is not seen
  const auto checkOf = [&](const std::string& look) {
    return checkLook(look, frame.folder / "look.toml", std::vector{frame.write()},
                     [](size_t, size_t) {});
  };
  const std::string style = "[[style]]\nstrip = \"builtin:soft\"\ntone.black = 0.1\nobject = ";
  const LookCheck fresh = checkOf(style + "\"Thing\"\n" + style + "\"Other\"\n" + style +
                                  "\"Hat\"\n" + style + "\"*\"\npriority = -1\n");
  EXPECT_EQ(fresh.problems, std::vector<std::string>());
  EXPECT_EQ(fresh.waiting,
            (std::vector<std::string>{
                "style 3 (object Hat): its things are not seen",
                "style 4 (object *): styles of higher priority paint all that is seen of it"}));
  // Other lies behind Thing, which is on both sides of it, and has no line of its own.
  for (int y = 0; y < 4; ++y) {
    for (int x = 5; x < 7; ++x) frame.plane("Position.Z")(x, y) = -5;
    frame.plane("IndexOB.X")(7, y) = 1;
  }
  const std::string lines = "outline_colour = [1, 0, 0]\n";
  const LookCheck lined = checkOf(style + "\"Thing\"\n" + lines + style + "\"Other\"\n" + lines);
  EXPECT_EQ(lined.problems, std::vector<std::string>());
  EXPECT_EQ(lined.waiting,
            std::vector<std::string>{"style[1].outline_colour changes nothing in this frame, as it "
                                     "does for others"});
  const LookCheck hidden = checkOf(style + "\"Thing\"\n" + style + "\"Thi*\"\n");
  EXPECT_EQ(hidden.problems,
            std::vector<std::string>{"style 2 (object Thi*) paints nothing: styles of the same "
                                     "priority come first wherever it fits"});
  EXPECT_TRUE(hidden.waiting.empty());
  // What paints Thing has its priority, but what paints Other, which it fits, a higher one.
  const LookCheck outranked =
      checkOf(style + "\"Thing\"\n" + style +
              "\"Other\"\n[[style]]\nstrip = \"builtin:soft\"\ntone.black = 0.3\n"
              "object = \"Oth*\"\npriority = 1\n");
  EXPECT_EQ(outranked.problems, std::vector<std::string>());
  EXPECT_EQ(outranked.waiting,
            std::vector<std::string>{
                "style 2 (object Other): styles of higher priority paint all that is seen of it"});
}

}  // namespace
}  // namespace kagefude
