#include <gtest/gtest.h>

#include "compositor/sweep_frame.h"
#include "live/live_session.h"

namespace kagefude {
namespace {

using namespace std::chrono_literals;

/// A session of which each picture takes longer than the pace, unless told otherwise.
class LivePace : public ::testing::Test, protected testing::SweepFrame {
 protected:
  LiveSession::Settings settings(std::chrono::milliseconds pace = 0ms) const {
    LiveSession::Settings all;
    all.look = frame.folder.write("look.toml", "");
    all.inputs = {{frame.write(), 1}};
    all.rest = 300ms;
    all.watch = 10ms;
    all.pace = pace;
    return all;
  }

  /// The picture that a change shows, the hand still moving.
  static std::shared_ptr<const LivePicture> turned(LiveSession& session,
                                                   std::vector<std::string> overrides) {
    return seen(session, session.change({std::move(overrides)}), 0);
  }
  /// The one that is shown of it at a step; 0: at any.
  static std::shared_ptr<const LivePicture> seen(const LiveSession& session, uint64_t change,
                                                 int step) {
    const auto end = std::chrono::steady_clock::now() + 30s;
    LiveView view;
    while (std::chrono::steady_clock::now() < end) {
      view = session.view(view.version, 1000ms);
      if (view.change == change && view.picture && (step == 0 || view.picture->step == step))
        return view.picture;
    }
    ADD_FAILURE() << "no such picture came; the last: " << view.error;
    return std::make_shared<LivePicture>();
  }
  static void first(const LiveSession& session) { seen(session, 0, 0); }

  /// Moves the light sideways by `x`.
  static std::vector<std::string> light(int x) {
    return {"light[0].name=Key", "light[0].shadow.method=places",
            fmt::format("light[0].position=[{}, 1, 9]", x)};
  }
};

TEST_F(LivePace, WhatTakesLongerShowsFewerPixelsUntilTheHandRests) {
  LiveSession session(settings());
  first(session);
  EXPECT_EQ(turned(session, {"brush.contrast=0.1"})->step, 1);  // not yet known to be slow
  const auto coarse = turned(session, {"brush.contrast=0.2"});
  EXPECT_EQ(coarse->step, 8);
  EXPECT_EQ(coarse->stages.planes->width, (width - 4 + 7) / 8);

  const auto whole = seen(session, 2, 1);
  const FrameResult wanted = frame.comp("[brush]\ncontrast = 0.2\n");
  const Vec3Plane& got = whole->stages.picture->frame.colour;
  ASSERT_EQ(got.x.width(), width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      ASSERT_EQ(got.x(x, y), wanted.colour.x(x, y));
      ASSERT_EQ(got.y(x, y), wanted.colour.y(x, y));
      ASSERT_EQ(got.z(x, y), wanted.colour.z(x, y));
    }
}

TEST_F(LivePace, EachKnobHasItsOwn) {
  LiveSession session(settings());
  first(session);
  turned(session, {"brush.contrast=0.1"});
  EXPECT_EQ(turned(session, {"brush.contrast=0.2"})->step, 8);
  EXPECT_EQ(turned(session, {"brush.contrast=0.2", "tone.gamma=1.1"})->step, 1);
  EXPECT_EQ(turned(session, {"brush.contrast=0.2", "tone.gamma=1.2"})->step, 8);
  EXPECT_EQ(turned(session, {"brush.contrast=0.3", "tone.gamma=1.2"})->step, 8);
}

TEST_F(LivePace, WhatIsQuickIsShownWhole) {
  LiveSession session(settings(60s));
  first(session);
  for (const char* contrast : {"0.1", "0.2", "0.3"})
    EXPECT_EQ(turned(session, {fmt::format("brush.contrast={}", contrast)})->step, 1);
}

TEST_F(LivePace, AMovedLightBeginsCoarseAndGetsFinerWhereThatIsQuick) {
  LiveSession session(settings(60s));
  first(session);
  EXPECT_EQ(turned(session, light(0))->step, 4);  // a new entry, so not the same knobs
  EXPECT_EQ(turned(session, light(1))->step, 4);
  EXPECT_EQ(turned(session, light(2))->step, 2);  // sampled for the first time: nothing is learnt
  EXPECT_EQ(turned(session, light(3))->step, 2);
  EXPECT_EQ(turned(session, light(4))->step, 1);
}

TEST_F(LivePace, AMovedLightHasFewerPlacesUntilTheHandRests) {
  LiveSession session(settings());
  first(session);
  turned(session, light(0));
  const auto places = [](const LivePicture& picture) {
    return picture.plan->lights.at(0).castPlaces;
  };
  EXPECT_EQ(places(*turned(session, light(1))), 5);
  const auto whole = seen(session, 2, 1);
  EXPECT_EQ(places(*whole), 9);
  const FrameResult wanted =
      frame.comp("[[light]]\nname = \"Key\"\nshadow.method = \"places\"\nposition = [1, 1, 9]\n");
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      ASSERT_EQ(whole->stages.picture->frame.colour.x(x, y), wanted.colour.x(x, y));
  // What else is turned has all of them, also where it is sampled.
  std::vector<std::string> other = light(1);
  for (const char* contrast : {"brush.contrast=0.1", "brush.contrast=0.2"}) {
    other.resize(3);
    other.emplace_back(contrast);
    EXPECT_EQ(places(*turned(session, other)), 9);
  }
}

TEST_F(LivePace, AFrameThatIsSampledAnywayIsSampledFurther) {
  LiveSession::Settings small = settings();
  small.size = 16;
  LiveSession session(small);
  first(session);
  EXPECT_EQ(turned(session, {"brush.contrast=0.1"})->step, 2);
  EXPECT_EQ(turned(session, {"brush.contrast=0.2"})->step, 16);
}

TEST_F(LivePace, ProxiesAreUpToDateWhenTheHandComesBack) {
  LiveSession session(settings());
  first(session);
  turned(session, {"brush.contrast=0.1"});
  turned(session, {"brush.contrast=0.2"});
  seen(session, 2, 1);
  std::this_thread::sleep_for(1500ms);
  const auto again = turned(session, {"brush.contrast=0.3"});
  EXPECT_EQ(again->step, 8);
  EXPECT_EQ(again->made, (std::vector<std::string>{"styles", "strokes", "picture"}));
}

}  // namespace
}  // namespace kagefude
