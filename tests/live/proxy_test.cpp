#include "live/proxy.h"

#include "compositor/sweep_frame.h"
#include "live/live_frame.h"

namespace kagefude {
namespace {

TEST(ProxyStep, MakesTheLongerSideFit) {
  EXPECT_EQ(proxyStep(1024, 576, 1024), 1);
  EXPECT_EQ(proxyStep(1025, 576, 1024), 2);
  EXPECT_EQ(proxyStep(576, 4096, 1024), 4);
  EXPECT_EQ(proxyStep(3, 2, 1), 3);
}

class Proxy : public ::testing::Test, protected testing::SweepFrame {
 protected:
  Look look(const std::vector<std::string>& set = {}) const { return readLook("", set); }
};

TEST_F(Proxy, TakesPixelsAndMixesNone) {
  const FramePlan plan = planFrame(look(), frame.write(), 1);
  const FramePlanes whole = readFramePlanes(plan);
  for (const int step : {2, 3, 5, 40}) {
    const FramePlanes samples = sampleFrame(whole, step);
    ASSERT_EQ(samples.position.x.width(), samples.width);
    ASSERT_EQ(samples.lights[0].masks.size(), whole.lights[0].masks.size());
    for (int y = 0; y < samples.height; ++y)
      for (int x = 0; x < samples.width; ++x) {
        const int wx = std::min(x * step + step / 2, whole.width - 1);
        const int wy = std::min(y * step + step / 2, whole.height - 1);
        ASSERT_EQ(samples.position.view()(x, y), whole.position.view()(wx, wy)) << step;
        ASSERT_EQ(samples.objectId(x, y), whole.objectId(wx, wy)) << step;
        ASSERT_EQ(samples.lights[0].masks[3](x, y), whole.lights[0].masks[3](wx, wy)) << step;
      }
  }
}

TEST_F(Proxy, RaysGoThroughTheSampledPixels) {
  const FramePlan plan = planFrame(look({"shadow.method=coverage"}), frame.write(), 1);
  const FramePlanes whole = readFramePlanes(plan);
  for (const int step : {2, 3}) {
    const FramePlanes samples = sampleFrame(whole, step);
    for (const int at : {0, 4}) {
      const double there = at * step + step / 2 + 0.5;
      EXPECT_LT(
          (samples.rays->origin(at + 0.5, at + 0.5) - whole.rays->origin(there, there)).length(),
          1e-12);
      EXPECT_LT((samples.rays->direction(at + 0.5, at + 0.5) - whole.rays->direction(there, there))
                    .length(),
                1e-12);
    }
  }
}

TEST_F(Proxy, LengthsInPixelsShrinkWithTheFrame) {
  const Look small =
      sampleLook(look({"smooth.h=12", "outline.width=3", "light_shape.abstract=9"}), 3);
  EXPECT_EQ(small.passes.smooth.h, 4);
  EXPECT_FLOAT_EQ(small.passes.outline.width, 1);
  EXPECT_EQ(small.passes.lightShape.abstract, 3);
  // Painted at twice the size and looked at through every third pixel.
  EXPECT_FLOAT_EQ(sampleLook(look({"outline.width=3", "output.scale=2"}), 3).passes.outline.width,
                  2);
}

TEST_F(Proxy, LeavesTheWholePictureAsItWas) {
  LiveFrame live(frame.write(), 1);
  StripShelf shelf;
  const LivePicture proxy = live.compose(look(), shelf, 16);
  EXPECT_EQ(proxy.step, 2);
  EXPECT_EQ(proxy.stages.picture->frame.colour.x.width(), 16);
  EXPECT_EQ(proxy.plan->image.dataWindow.width, 16);
  live.compose(look(), shelf, 0);
  // Each size keeps its own stages, and the frame is read once for both.
  EXPECT_TRUE(live.compose(look(), shelf, 16).made.empty());
  EXPECT_TRUE(live.compose(look(), shelf, 0).made.empty());
}

}  // namespace
}  // namespace kagefude
