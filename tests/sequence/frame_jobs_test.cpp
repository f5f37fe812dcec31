#include "sequence/frame_jobs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "test_folder.h"

namespace kagefude {
namespace {

class FrameJobs : public testing::Test {
 protected:
  void make(const std::string& name, const std::vector<int>& frames, const char* view = "") {
    for (const int frame : frames) folder.write(FramePattern(name).path(frame, view).string());
  }
  PlanRequest request(const std::string& input, const std::string& output) const {
    PlanRequest result;
    result.inputs.emplace_back(folder / input);
    result.outputs.emplace_back(folder / output);
    return result;
  }
  template <class ErrorType>
  static void expectError(const PlanRequest& request, const std::vector<std::string>& parts) {
    const std::string message = messageOf<ErrorType>([&] { planJobs(request); });
    EXPECT_FALSE(message.empty()) << "no such error was thrown";
    for (const std::string& part : parts)
      EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
  }
  static std::vector<int> frames(const std::vector<FrameJob>& jobs) {
    std::vector<int> result;
    for (const FrameJob& job : jobs) result.push_back(job.frame);
    return result;
  }

  TestFolder folder;
};

TEST_F(FrameJobs, ScansWithoutFrames) {
  make("in.####.exr", {3, 1, 2});
  const auto jobs = planJobs(request("in.####.exr", "out.####.exr"));
  EXPECT_EQ(frames(jobs), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(jobs[2].inputs[0].string(), folder / "in.0003.exr");
  EXPECT_EQ(jobs[2].outputs[0].string(), folder / "out.0003.exr");
  EXPECT_EQ(jobs[2].name(), "frame 3");
}

TEST_F(FrameJobs, TakesFramesInTheOrderAsked) {
  make("in.####.exr", {1, 2, 3});
  PlanRequest asked = request("in.####.exr", "out.####.exr");
  asked.frames = {3, 1};
  EXPECT_EQ(frames(planJobs(asked)), (std::vector<int>{3, 1}));
}

TEST_F(FrameJobs, NamesMissingFramesCompactly) {
  make("in.####.exr", {1, 2, 6});
  PlanRequest asked = request("in.####.exr", "out.####.exr");
  asked.frames = parseFrames("1-6");
  expectError<InputError>(asked, {"lacks 3 of 6 frames (1-6): 3-5", "it has 1-2,6"});
}

TEST_F(FrameJobs, GapsInAScannedSequenceAreMissingFrames) {
  make("in.####.exr", {1, 2, 4});
  expectError<InputError>(request("in.####.exr", "out.####.exr"), {"lacks 1 of 4 frames", ": 3;"});
  make("twos.####.exr", {1, 3, 5});
  EXPECT_EQ(planJobs(request("twos.####.exr", "out.####.exr")).size(), 3u);
}

TEST_F(FrameJobs, FarApartFramesAreNotEnumerated) {
  make("in.####.exr", {1, 2, 2000000000});
  expectError<InputError>(request("in.####.exr", "out.####.exr"), {"too far apart", "--frames"});
}

TEST_F(FrameJobs, MissingFramesBecomeBadFramesWhenSkipping) {
  make("in.####.exr", {1, 3});
  PlanRequest asked = request("in.####.exr", "out.####.exr");
  asked.frames = parseFrames("1-3");
  asked.skipBadFrames = true;
  const auto jobs = planJobs(asked);
  ASSERT_EQ(jobs.size(), 3u);
  EXPECT_FALSE(jobs[0].missing);
  EXPECT_EQ(jobs[1].missing->string(), folder / "in.0002.exr");
}

TEST_F(FrameJobs, CountsThatDifferNameBothSides) {
  make("in.####.exr", {1, 2, 3});
  make("bg.####.exr", {1, 2});
  PlanRequest asked = request("in.####.exr", "out.####.exr");
  asked.inputs.emplace_back(folder / "bg.####.exr");
  expectError<InputError>(asked,
                          {"in.####.exr has 3 frames (1-3)", "bg.####.exr has 2 frames (1-2)"});
}

TEST_F(FrameJobs, OneFileServesEveryFrame) {
  make("in.####.exr", {1, 2, 3});
  folder.write("bg.exr");
  PlanRequest asked = request("in.####.exr", "out.####.exr");
  asked.inputs.emplace_back(folder / "bg.exr");
  const auto jobs = planJobs(asked);
  ASSERT_EQ(jobs.size(), 3u);
  EXPECT_EQ(jobs[2].inputs[1].string(), folder / "bg.exr");
}

TEST_F(FrameJobs, NothingFits) {
  folder.write("shot_0001.exr");
  expectError<InputError>(request("in.####.exr", "out.####.exr"),
                          {"no file fits", "in.####.exr", "shot_0001.exr"});
  expectError<InputError>(request("none/in.####.exr", "out.####.exr"), {"does not exist"});
  expectError<InputError>(request("in.exr", "out.exr"), {"in.exr does not exist"});
  PlanRequest asked = request("in.####.exr", "out.####.exr");
  asked.frames = {1, 2};
  expectError<InputError>(asked, {"no file fits"});
}

TEST_F(FrameJobs, OutputWithoutAPlaceForSeveralFrames) {
  make("in.####.exr", {1, 2});
  expectError<UsageError>(request("in.####.exr", "out.exr"),
                          {"in.####.exr stands for 2 frames (1-2)", "out.exr has no place"});
  PlanRequest asked = request("in.####.exr", "out.exr");
  asked.frames = {2};
  EXPECT_EQ(planJobs(asked).size(), 1u);
}

TEST_F(FrameJobs, OneInputForSeveralFrames) {
  folder.write("in.exr");
  PlanRequest asked = request("in.exr", "out.####.exr");
  asked.frames = {1, 2};
  expectError<UsageError>(asked, {"in.exr has no place for the frame", "2 frames"});
}

TEST_F(FrameJobs, SingleFileTakesItsNumberFromItsName) {
  folder.write("in.0012.exr");
  const auto jobs = planJobs(request("in.0012.exr", "out.####.exr"));
  ASSERT_EQ(jobs.size(), 1u);
  EXPECT_EQ(jobs[0].frame, 12);
  EXPECT_EQ(jobs[0].outputs[0].string(), folder / "out.0012.exr");
}

TEST_F(FrameJobs, OutputsNeverOverwriteInputs) {
  make("in.####.exr", {1, 2});
  expectError<UsageError>(request("in.####.exr", "in.####.exr"), {"would overwrite an input"});
  expectError<UsageError>(request("in.####.exr", "./in.%04d.exr"), {"would overwrite an input"});
  std::filesystem::create_symlink(folder / "in.0001.exr", folder / "link.0001.exr");
  expectError<UsageError>(request("in.####.exr", "link.####.exr"), {"would overwrite an input"});
}

TEST_F(FrameJobs, TwoOutputsOfOneNameAreRefused) {
  make("in.####.exr", {1, 2});
  PlanRequest asked = request("in.####.exr", "out.####.exr");
  asked.outputs.emplace_back(folder / "out.%04d.exr");
  expectError<UsageError>(asked, {"two outputs have one name"});
}

TEST_F(FrameJobs, ViewsFollowEachOther) {
  make("in.%V.####.exr", {1, 2}, "left");
  make("in.%V.####.exr", {1, 2}, "right");
  const auto jobs = planJobs(request("in.%V.####.exr", "out.%v.####.exr"));
  ASSERT_EQ(jobs.size(), 4u);
  EXPECT_EQ(jobs[1].name(), "frame 1 right");
  EXPECT_EQ(jobs[1].outputs[0].string(), folder / "out.r.0001.exr");
  expectError<UsageError>(request("in.%V.####.exr", "out.####.exr"),
                          {"left and right", "no place for the view"});
}

TEST_F(FrameJobs, ViewsWithDifferentFramesNameBothSides) {
  make("in.%V.####.exr", {1, 2}, "left");
  make("in.%V.####.exr", {1}, "right");
  expectError<InputError>(request("in.%V.####.exr", "out.%V.####.exr"),
                          {"(left) has 2 frames (1-2)", "(right) has 1 frame (1)"});
}

TEST_F(FrameJobs, ChunksTogetherAreTheWhole) {
  make("in.####.exr", parseFrames("1-24"));
  PlanRequest asked = request("in.####.exr", "out.####.exr");
  std::vector<int> together;
  for (size_t i = 1; i <= 5; ++i) {
    asked.chunk = {i, 5};
    for (const FrameJob& job : planJobs(asked)) together.push_back(job.frame);
  }
  EXPECT_EQ(together, parseFrames("1-24"));
  asked.frames = {7};
  asked.chunk = {2, 5};
  EXPECT_TRUE(planJobs(asked).empty());
}

// A job for each of them took minutes and gigabytes before the first missing one was known.
TEST_F(FrameJobs, MillionsOfMissingFramesAreSaidAtOnce) {
  make("in.####.exr", {1, 2, 3});
  PlanRequest asked = request("in.####.exr", "out.####.exr");
  for (const char* frames : {"1-10000000", "1,2-9999999", "-5000000-4999999"}) {
    asked.frames = parseFrames(frames);
    asked.skipBadFrames = false;
    expectError<InputError>(asked, {"lacks", "it has 1-3"});
  }
}

// A run that goes on after bad frames makes what is there, whatever else is asked for, and each
// part of it takes the same frames whatever is missing.
TEST_F(FrameJobs, MillionsOfMissingFramesStopNoRunThatSkipsThem) {
  make("in.####.exr", {1, 2, 5000001, 9999999});
  PlanRequest asked = request("in.####.exr", "out.####.exr");
  asked.skipBadFrames = true;
  asked.frames = parseFrames("1-10000000");
  std::vector<std::string> notes;
  const auto present = [](const FrameJob& job) { return !job.missing; };
  const auto jobs = planJobs(asked, &notes);
  EXPECT_EQ(std::count_if(jobs.begin(), jobs.end(), present), 4);
  EXPECT_EQ(jobs.size(), 1004u);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("1003-5000000,5000002-9999998,10000000"), std::string::npos) << notes[0];
  asked.chunk = {2, 2};
  const auto second = planJobs(asked);
  ASSERT_EQ(std::count_if(second.begin(), second.end(), present), 2);
  EXPECT_EQ(second.front().frame, 5000001);
  asked.inputs = {FramePattern(folder / "other.####.exr")};
  expectError<InputError>(asked, {"no file fits"});
}

TEST_F(FrameJobs, FramesWiderApartThanOneAreSaid) {
  std::vector<std::string> notes;
  make("a.####.exr", {1, 3});
  planJobs(request("a.####.exr", "out.####.exr"), &notes);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes.front().find("the frames 1,3 and none between"), std::string::npos) << notes[0];
  notes.clear();
  make("b.####.exr", {1, 2, 3});
  planJobs(request("b.####.exr", "out.####.exr"), &notes);
  PlanRequest asked = request("a.####.exr", "out.####.exr");
  asked.frames = {1, 3};
  planJobs(asked, &notes);
  EXPECT_TRUE(notes.empty());
}

TEST_F(FrameJobs, AHoleIsABadFrame) {
  make("in.####.exr", {1, 2, 4});
  PlanRequest asked = request("in.####.exr", "out.####.exr");
  expectError<InputError>(asked, {"lacks 1 of 4 frames (1-4): 3"});
  asked.skipBadFrames = true;
  const auto jobs = planJobs(asked);
  ASSERT_EQ(jobs.size(), 4u);
  EXPECT_TRUE(jobs[2].missing);
}

TEST_F(FrameJobs, HardLinksAreTheSameFile) {
  make("in.####.exr", {1});
  std::filesystem::create_hard_link(folder / "in.0001.exr", folder / "hard.0001.exr");
  expectError<UsageError>(request("in.####.exr", "hard.####.exr"), {"would overwrite an input"});
}

}  // namespace
}  // namespace kagefude
