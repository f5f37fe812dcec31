// One frame in two worlds, z up and y up, without a JSON: the same picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compositor/compose_frame.h"
#include "compositor/read_frame.h"
#include "compositor/rendered_eye.h"
#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

using namespace testing;

class UpAxis : public ::testing::Test {
 protected:
  UpAxis() : eye(renderEye(0)), rest(eye.width, eye.height) {
    for (int y = 0; y < eye.height; ++y)
      for (int x = 0; x < eye.width; ++x)
        rest.set(x, y, eye.position.view()(x, y) * 0.75f + V3f(0.25f, 0, 0.125f));
  }

  static V3f placed(bool yUp, const V3f& v) { return yUp ? V3f(v.x, v.z, -v.y) : v; }
  Vec3Plane placed(bool yUp, Vec3View planes) const {
    Vec3Plane result(eye.width, eye.height);
    for (int y = 0; y < eye.height; ++y)
      for (int x = 0; x < eye.width; ++x) result.set(x, y, placed(yUp, planes(x, y)));
    return result;
  }

  // The lamp is behind the ball, to the left of it.
  FrameResult comp(bool yUp, const std::string& lookText) {
    RenderedEye seen = renderEye(0);
    seen.position = placed(yUp, eye.position.view());
    seen.normal = placed(yUp, eye.normal.view());
    const Vec3Plane own = placed(yUp, rest.view());
    Channels channels = channelsOf(seen);
    channels.insert_or_assign("Pref.X", own.x);
    channels.insert_or_assign("Pref.Y", own.y);
    channels.insert_or_assign("Pref.Z", own.z);
    writeParts(folder / "f.exr", eye.width, eye.height,
               {{"", "", channels, {}, manifestOf("crypto_object")}});
    const V3f place = placed(yUp, V3f(-1, 6, 3));
    writeText(folder / "look.toml",
              lookText + "[[light]]\nname = \"Lamp\"\nmasks = [\"mask.0\", \"mask.1\"]\n" +
                  fmt::format("position = [{}, {}, {}]\n", place.x, place.y, place.z));
    const Look look = readLook(folder / "look.toml", {});
    const Colour colour(look.colourConfig());
    const StripSet strips(look, colour);
    const FramePlan plan = planFrame(look, folder / "f.exr", 1);
    return composeFrame(look, strips, plan, readFramePlanes(plan));
  }

  float largestDifference(const std::string& lookText, const std::string& up) {
    const FrameResult z = comp(false, lookText), y = comp(true, up + lookText);
    float largest = 0;
    for (int row = 0; row < eye.height; ++row)
      for (int column = 0; column < eye.width; ++column)
        largest = std::max(largest, std::fabs(z.colour.x(column, row) - y.colour.x(column, row)));
    return largest;
  }

  void expectSamePicture(const std::string& lookText) {
    // Sums of three products are rounded in another order.
    EXPECT_LT(largestDifference(lookText, "frame.up = \"y\"\n"), 2e-3f);
    EXPECT_GT(largestDifference(lookText, ""), 0.02f) << "the axis would not matter";
  }

  TemporaryFolder folder;
  RenderedEye eye;
  Vec3Plane rest;
};

const std::string whole = "scene.centre = [0.0, 0.0, 0.0]\nscene.radius = 3.0\n";

TEST_F(UpAxis, TurnsStrokes) { expectSamePicture(whole); }

TEST_F(UpAxis, TurnsStrokesThatAreSizedByWhatIsSeen) { expectSamePicture(""); }

TEST_F(UpAxis, TurnsStrokesOfEveryMapping) {
  for (const char* mapping : {"polar", "held"})
    expectSamePicture(whole + "brush.mapping = \"" + mapping + "\"\n");
}

TEST_F(UpAxis, TurnsStrokesThatLieAtRest) {
  for (const char* space : {"object", "world"})
    expectSamePicture(whole + "brush.ground = \"rest\"\nbrush.mapping = \"held\"\n" +
                      "frame.rest = \"Pref\"\nframe.rest_space = \"" + space + "\"\n");
}

}  // namespace
}  // namespace kagefude
