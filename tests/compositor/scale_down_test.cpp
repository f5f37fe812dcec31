#include "compositor/scale_down.h"

#include <cstring>

#include "compositor/test_frame.h"
#include "exr/read_channels.h"
#include "frame/cryptomatte.h"
#include "frame/frame_view.h"
#include "frame/part_fixtures.h"
#include "look/look_sections.h"

namespace kagefude {
namespace {

using testing::lightJson;
using testing::TestFrame;

constexpr char plain[] = "output.edges = \"pixel\"\n";

/// 4 x 4 pixels of a thing under one sun; beauty that counts up, background in the last column.
class ScaleDown : public ::testing::Test {
 protected:
  ScaleDown() {
    frame.sidecar["scale"] = 2;
    frame.sidecar["lights"].push_back(lightJson("Sun", "sun", {0, 0, 5}, {0, 0, -1}, 1));
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) {
        frame.setVector("Position", x, y, {0.2f * float(x) - 0.3f, 0.3f - 0.2f * float(y), 0.5f});
        for (const char* name : {"Combined.R", "Combined.G", "Combined.B", "Combined.A"})
          frame.plane(name)(x, y) = float(4 * y + x) / 16;
        frame.plane("Vector.X")(x, y) = float(x);
        frame.plane("Vector.Y")(x, y) = float(y);
        frame.plane("Vector.Z")(x, y) = 6;
        frame.plane("Vector.W")(x, y) = -2;
        if (x < 3) continue;
        frame.plane("Normal.Z")(x, y) = 0;
        frame.plane("IndexOB.X")(x, y) = 0;
      }
  }

  /// What the file holds after a comp with passthrough.
  ImageFile written(const std::string& settings) const {
    const std::filesystem::path path = frame.write();
    frame.folder.write("look.toml", std::string(plain) + settings);
    const Look look = readLook(frame.folder / "look.toml", {"output.passthrough=true"});
    const Colour colour(look.colourConfig());
    const StripSet strips(look, colour);
    const FramePlan plan = planFrame(look, path, 1);
    const FrameResult result = composeFrame(look, strips, plan, readFramePlanes(plan));
    writeFrame(look, plan, result, frame.folder / "out.exr", {});
    return openImage(frame.folder / "out.exr");
  }
  static Floats channel(const ImageFile& file, const std::string& name) {
    return std::move(readFloats(file, std::vector<std::string>{name}).at(0));
  }

  TestFrame frame{4, 4};
};

TEST_F(ScaleDown, ThePictureIsTheMeanOfTheLargeOne) {
  const FrameResult large = frame.comp(plain), small = frame.comp(plain, {"output.scale=2"});
  ASSERT_EQ(small.colour.x.width(), 2);
  ASSERT_EQ(small.alpha.height(), 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) {
      double sum = 0, alpha = 0;
      for (int v = 2 * y; v < 2 * y + 2; ++v)
        for (int u = 2 * x; u < 2 * x + 2; ++u) {
          sum += large.colour.x(u, v);
          alpha += large.alpha(u, v);
        }
      EXPECT_EQ(small.colour.x(x, y), static_cast<float>(sum / 4));
      EXPECT_EQ(small.alpha(x, y), static_cast<float>(alpha / 4));
    }
}

TEST_F(ScaleDown, LayersOfNumbersAreFilteredAndOthersStand) {
  const char look[] = "output.layers = [\"*\"]\noutput.edges = \"pixel\"\n";
  // Lines are as wide in the picture that is written, so twice as wide in the large one.
  const FrameResult large = frame.comp(look, {"outline.width=2"}),
                    small = frame.comp(look, {"output.scale=2", "outline.width=1"});
  ASSERT_EQ(large.layers.size(), small.layers.size());
  for (size_t i = 0; i < large.layers.size(); ++i) {
    const std::string& name = large.layers[i].name;
    const LayerPlane &from = large.layers[i].plane, &to = small.layers[i].plane;
    if (name == "surface.id") {
      EXPECT_EQ(to.labels(0, 0), from.labels(0, 0));
      EXPECT_EQ(to.labels(1, 1), 0u) << "of two equal shares the background stands";
    } else if (name == "brush.angle" || name == "brush.repeat") {
      EXPECT_EQ(to.floats(0, 1), from.floats(0, 2)) << name;
    } else {
      const View<const float> f = from.floats;
      EXPECT_FLOAT_EQ(to.floats(1, 0), (f(2, 0) + f(3, 0) + f(2, 1) + f(3, 1)) / 4) << name;
    }
  }
}

TEST_F(ScaleDown, PassedChannelsKeepTheirMeaning) {
  const ImageFile file = written("output.scale = 2\n");
  EXPECT_EQ(file.dataWindow, (Window{0, 0, 2, 2}));
  EXPECT_EQ(file.displayWindow, (Window{0, 0, 2, 2}));
  EXPECT_EQ(channel(file, "ViewLayer.Combined.R")(0, 0), 2.5f / 16);
  EXPECT_EQ(channel(file, "ViewLayer.IndexOB.X")(0, 0), 1);
  EXPECT_EQ(channel(file, "ViewLayer.Normal.Z")(0, 1), 1);
  EXPECT_EQ(channel(file, "ViewLayer.Normal.Z")(1, 0), 0);
  EXPECT_EQ(channel(file, "ViewLayer.Vector.Z")(0, 0), 3);
  EXPECT_EQ(channel(file, "ViewLayer.Vector.W")(1, 1), -1);
}

TEST_F(ScaleDown, SizesThatDoNotDivideAreRefused) {
  TestFrame odd(5, 4);
  odd.sidecar["lights"] = frame.sidecar["lights"];
  const std::string message = messageOf<InputError>([&] { odd.comp(plain, {"output.scale=2"}); });
  EXPECT_NE(message.find("shows 5x4 pixels"), std::string::npos) << message;
}

TEST_F(ScaleDown, AnotherScaleThanTheExportersIsSaid) {
  const auto warned = [&] {
    for (const std::string& warning : frame.comp(plain, {"output.scale=2"}).warnings)
      if (warning.find("output.scale is 2") != std::string::npos) return true;
    return false;
  };
  EXPECT_FALSE(warned());
  frame.sidecar["scale"] = 1;
  EXPECT_TRUE(warned());
}

TEST_F(ScaleDown, LengthsInPixelsAreThoseOfThePictureThatIsWritten) {
  frame.folder.write(
      "look.toml",
      "[output]\nscale = 2\n[outline]\nwidth = 3\n[smooth]\nh = 5\n[pair]\nstep = 4\n"
      "[[style]]\nobject = \"*\"\n[style.brush]\nstrip_pixels = 100\n");
  const Look look = readLook(frame.folder / "look.toml", {});
  const Look rendered = inRenderedPixels(look);
  EXPECT_EQ(rendered.passes.outline.width, 6);
  EXPECT_EQ(rendered.passes.smooth.h, 10);
  EXPECT_EQ(rendered.passes.pair.step, 4);
  EXPECT_EQ(rendered.styles[0].passes.brush.stripPixels, 200);
  EXPECT_EQ(rendered.styles[0].passes.outline.width, 6);
}

float idFrom(uint32_t id) {
  float value;
  std::memcpy(&value, &id, sizeof value);
  return value;
}

TEST(ScaleChannels, CryptomattesAreRankedAnew) {
  const TestFolder folder;
  const uint32_t a = cryptomatteId("a"), b = cryptomatteId("b"), c = cryptomatteId("c");
  // Two ranks of 2 x 2 pixels: a covers 1, 0.5, 0.4 and 0; b 0, 0.5, 0.6 and 0.25; c 0.75.
  Floats id0(2, 2), share0(2, 2), id1(2, 2), share1(2, 2), ones(2, 2, 1.0f);
  const uint32_t first[] = {a, a, b, c}, second[] = {0, b, a, b};
  const float firsts[] = {1, 0.5f, 0.6f, 0.75f}, seconds[] = {0, 0.5f, 0.4f, 0.25f};
  for (size_t i = 0; i < 4; ++i) {
    id0.view().data[i] = idFrom(first[i]);
    id1.view().data[i] = idFrom(second[i]);
    share0.view().data[i] = firsts[i];
    share1.view().data[i] = seconds[i];
  }
  const testing::Channels channels{{"CryptoObject00.r", id0},
                                   {"CryptoObject00.g", share0},
                                   {"CryptoObject00.b", id1},
                                   {"CryptoObject00.a", share1},
                                   {"Y", ones}};
  testing::writeParts(folder / "a.exr", 2, 2, {{"", "", channels, {}, {}}});
  FramePlan plan;
  plan.image = openFrame(folder / "a.exr");
  std::vector<RawPlane> planes = readRaw(plan.image, plan.image.channelNames());
  const Downscale squares(plan.image.dataWindow, 2);
  const Labels standing(1, 1, 0u);
  scaleDown(squares, 2, standing, plan, planes);
  std::map<std::string, uint32_t> found;
  for (const RawPlane& plane : planes) found[plane.name] = plane.words(0, 0);
  EXPECT_EQ(found["CryptoObject00.r"], a);
  EXPECT_EQ(found["CryptoObject00.b"], b);
  const auto share = [&](const char* name) {
    float value;
    std::memcpy(&value, &found[name], sizeof value);
    return value;
  };
  EXPECT_FLOAT_EQ(share("CryptoObject00.g"), 1.9f / 4);
  EXPECT_FLOAT_EQ(share("CryptoObject00.a"), 1.35f / 4);
  EXPECT_FLOAT_EQ(share("Y"), 1);
}

}  // namespace
}  // namespace kagefude
