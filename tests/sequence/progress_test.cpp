#include "sequence/progress.h"

#include <gtest/gtest.h>

#include <sstream>

#include "base/error.h"
#include "test_folder.h"

namespace kagefude {
namespace {

struct Recorded {
  std::ostringstream out;
  double now = 0;
  std::unique_ptr<ProgressSink> sink;

  explicit Recorded(ProgressKind kind, bool terminal = false, int width = 80)
      : sink(makeProgress(kind, out, terminal, width, [this] { return now; })) {}

  void frame(int number, const std::string& failure = "", bool kept = false) {
    now += kept ? 0 : 2;
    sink->frame({"frame " + std::to_string(number), kept, failure, 2});
  }
};

TEST(Progress, KindsByName) {
  EXPECT_EQ(parseProgressKind("auto"), ProgressKind::automatic);
  EXPECT_EQ(parseProgressKind("none"), ProgressKind::none);
  EXPECT_NE(messageOf<UsageError>([] { parseProgressKind("plian"); }).find("did you mean plain?"),
            std::string::npos);
}

TEST(Progress, PlainLines) {
  Recorded run(ProgressKind::plain);
  run.sink->begin(4);
  run.frame(1);
  run.sink->warning("3 pixels are NaN");
  run.frame(2, "shot.0002.exr is truncated");
  run.frame(3, "", true);
  run.frame(4);
  run.sink->end("3 of 4 frames are right", true);
  EXPECT_EQ(run.out.str(),
            "frame 1 done in 2.00 s (1 of 4)\n"
            "Progress: 25%\n"
            "warning: 3 pixels are NaN\n"
            "frame 2 failed: shot.0002.exr is truncated\n"
            "Progress: 50%\n"
            "frame 3 kept (3 of 4)\n"
            "Progress: 75%\n"
            "frame 4 done in 2.00 s (4 of 4)\n"
            "Progress: 100%\n"
            "3 of 4 frames are right\n");
}

TEST(Progress, AutomaticIsPlainAwayFromATerminal) {
  Recorded run(ProgressKind::automatic, false);
  run.sink->begin(1);
  run.frame(1);
  EXPECT_NE(run.out.str().find("Progress: 100%\n"), std::string::npos);
}

TEST(Progress, SamePercentageIsSaidOnce) {
  Recorded run(ProgressKind::plain);
  run.sink->begin(1000);
  for (int i = 1; i <= 10; ++i) run.frame(i);
  const std::string text = run.out.str();
  EXPECT_NE(text.find("Progress: 0%\n"), std::string::npos);
  EXPECT_EQ(text.find("Progress: 0%\n"), text.rfind("Progress: 0%\n"));
}

TEST(Progress, OpenJdLines) {
  Recorded run(ProgressKind::openjd);
  run.sink->begin(2);
  run.frame(1);
  run.frame(2, "no Position pass");
  run.sink->end("1 of 2 frames failed", true);
  EXPECT_EQ(run.out.str(),
            "openjd_status: frame 1 done in 2.00 s (1 of 2)\n"
            "openjd_progress: 50\n"
            "frame 2 failed: no Position pass\n"
            "openjd_status: frame 2 failed (2 of 2)\n"
            "openjd_progress: 100\n"
            "openjd_fail: 1 of 2 frames failed\n");
}

TEST(Progress, NoneStillSaysWhatIsWrong) {
  Recorded run(ProgressKind::none);
  run.sink->begin(2);
  run.frame(1);
  EXPECT_EQ(run.out.str(), "");
  run.frame(2, "bad");
  run.sink->end("1 of 2 frames failed", true);
  EXPECT_EQ(run.out.str(), "frame 2 failed: bad\n1 of 2 frames failed\n");
}

TEST(Progress, BarShowsFramesRateAndTimeLeft) {
  Recorded run(ProgressKind::automatic, true);
  run.sink->begin(10);
  for (int i = 1; i <= 4; ++i) run.frame(i);
  const std::string text = run.out.str();
  const std::string last = text.substr(text.rfind('\r'));
  EXPECT_NE(last.find(" 4/10  2.0 s/frame  left 0:12  frame 4"), std::string::npos) << last;
  EXPECT_NE(last.find("############...."), std::string::npos) << last;
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(Progress, KeptFramesDoNotFlatterTheRate) {
  Recorded run(ProgressKind::automatic, true);
  run.sink->begin(10);
  for (int i = 1; i <= 8; ++i) run.frame(i, "", true);
  run.frame(9);
  const std::string text = run.out.str();
  EXPECT_NE(text.find("9/10  2.0 s/frame  left 0:02"), std::string::npos) << text;
}

TEST(Progress, BarNeverWrapsAndPutsFailuresAboveItself) {
  for (const int width : {20, 40, 80, 200}) {
    Recorded run(ProgressKind::automatic, true, width);
    run.sink->begin(1000000);
    for (int i = 1; i <= 3; ++i) run.frame(i, i == 2 ? "bad" : "");
    run.sink->end("over", true);
    std::istringstream lines(run.out.str());
    bool failureSeen = false;
    for (std::string piece; std::getline(lines, piece, '\r');) {
      if (piece.starts_with("\033[K")) piece = piece.substr(3);
      if (piece.ends_with('\n')) piece.pop_back();
      EXPECT_LT(static_cast<int>(piece.size()), width) << piece;
      failureSeen |= piece == "frame 2 failed: bad";
    }
    EXPECT_TRUE(failureSeen);
  }
}

TEST(Progress, BarIsNotRedrawnTooOften) {
  Recorded run(ProgressKind::automatic, true);
  run.sink->begin(1000);
  const size_t before = run.out.str().size();
  for (int i = 0; i < 500; ++i) run.sink->frame({"frame", true, "", 0});
  EXPECT_LT(run.out.str().size() - before, 300u);
}

TEST(Progress, NoLineLooksLikeAFatalOne) {
  for (const auto kind : {ProgressKind::plain, ProgressKind::openjd, ProgressKind::none}) {
    Recorded run(kind);
    run.sink->begin(1);
    run.frame(1, "broken");
    run.sink->warning("odd");
    std::string text = run.out.str();
    for (char& c : text) c = static_cast<char>(std::tolower(c));
    EXPECT_EQ(text.find("error:"), std::string::npos);
  }
}

TEST(Progress, Durations) {
  EXPECT_EQ(formatDuration(0), "0:00");
  EXPECT_EQ(formatDuration(59.6), "1:00");
  EXPECT_EQ(formatDuration(754), "12:34");
  EXPECT_EQ(formatDuration(3600 * 27 + 61), "27:01:01");
  EXPECT_EQ(formatDuration(-1), "?");
  EXPECT_EQ(formatDuration(1e300), "?");
}

}  // namespace
}  // namespace kagefude
