#include "sequence/comp_batch.h"

#include <sys/inotify.h>
#include <unistd.h>

#include "compositor/test_frame.h"

namespace kagefude {
namespace {

using namespace testing;

/// Counts how often a file is opened, by whomever. Closing is watched as well, for the kernel joins
/// like events that follow each other.
class OpensOf {
 public:
  explicit OpensOf(const std::string& file) : queue_(inotify_init1(IN_NONBLOCK)) {
    EXPECT_GE(inotify_add_watch(queue_, file.c_str(), IN_OPEN | IN_CLOSE), 0) << file;
  }
  ~OpensOf() { close(queue_); }
  OpensOf(const OpensOf&) = delete;
  OpensOf& operator=(const OpensOf&) = delete;

  int count() const {
    // Events of a watched file, unlike those of a folder, carry no name and are of one size.
    inotify_event event;
    int opens = 0;
    while (read(queue_, &event, sizeof event) == static_cast<ssize_t>(sizeof event))
      opens += (event.mask & IN_OPEN) != 0;
    return opens;
  }

 private:
  int queue_;
};

/// A frame whose light takes its shadow from casters, so that every reader of the JSON has work.
class CompBatchTest : public ::testing::Test {
 protected:
  CompBatchTest() : frame(4, 4) {
    frame.folder.write("card.obj", "v -1 -1 4\nv 1 -1 4\nv 1 1 4\nf 1 2 3\n");
    frame.sidecar["casters"] = {
        {{"object", "Thing"}, {"file", "card.obj"}, {"world_from_object", identityRows()}}};
    frame.sidecar["lights"].push_back(lightJson("Key", "point", {0, 0, 9}, {0, 0, -1}, 100));
  }

  CompRequest request() const {
    CompRequest request;
    request.plan.inputs = {FramePattern(frame.write().string())};
    request.plan.outputs = {FramePattern((frame.folder.path() / "out" / "frame.exr").string())};
    return request;
  }

  TestFrame frame;
};

TEST_F(CompBatchTest, AFramesJsonIsReadOnceToKnowItAndOnceToPlan) {
  const Look look = readLook({}, {"shadow.method=coverage"});
  const CompRequest asked = request();
  const OpensOf json(frame.folder / "frame.json");
  CompBatch batch(look, asked);
  EXPECT_EQ(json.count(), 2) << "planning: its fingerprint, and its contents";
  EXPECT_EQ(batch.run([](const CompEvent&) {}).done, 1u);
  EXPECT_EQ(json.count(), 0) << "memory, reading and composing go by the plan";
}

TEST_F(CompBatchTest, AFrameThatIsUpToDateIsPlannedOnceAsWell) {
  const Look look = readLook({}, {"shadow.method=coverage"});
  CompRequest asked = request();
  CompBatch(look, asked).run([](const CompEvent&) {});
  asked.existing = ExistingOutputs::update;
  const OpensOf obj(frame.folder / "card.obj");
  CompBatch again(look, asked);
  EXPECT_EQ(again.run([](const CompEvent&) {}).kept, 1u);
  EXPECT_EQ(obj.count(), 1) << "for its fingerprint alone";
}

}  // namespace
}  // namespace kagefude
