#include "live/live_session.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "compositor/sweep_frame.h"
#include "live/live_page.h"
#include "live/show_stage.h"

namespace kagefude {
namespace {

using namespace std::chrono_literals;

class Session : public ::testing::Test, protected testing::SweepFrame {
 protected:
  LiveSession::Settings settings() const {
    LiveSession::Settings all;
    all.look = frame.folder / "look.toml";
    all.inputs = {{frame.write(), 1}};
    all.rest = 10ms;
    all.watch = 10ms;
    return all;
  }
  void write(const std::string& look) const { frame.folder.write("look.toml", look); }

  /// The first view that `fits` holds for.
  template <class Fits>
  static LiveView viewWhere(const LiveSession& session, const Fits& fits) {
    const auto end = std::chrono::steady_clock::now() + 30s;
    LiveView view;
    while (std::chrono::steady_clock::now() < end) {
      view = session.view(view.version, 1000ms);
      if (fits(view)) return view;
    }
    ADD_FAILURE() << "no such view came; the last: " << view.error;
    return view;
  }

  static std::string shown(const LiveView& view) {
    return showStage(*view.picture, "result").bytes;
  }
};

TEST_F(Session, OfManyChangesTheLastIsSeenAndNoQueueBuildsUp) {
  write("[[style]]\nstrip = \"builtin:soft\"\n");
  LiveSession session(settings());
  uint64_t last = 0;
  for (int i = 0; i < 500; ++i)
    last = session.change({{fmt::format("brush.contrast={}", 0.002 * i)}});
  EXPECT_EQ(last, 500u);
  const LiveView view = viewWhere(session, [&](const LiveView& v) { return v.change == last; });
  EXPECT_FLOAT_EQ(view.picture->look->passes.brush.contrast, 0.998f);
  // Each was one change and one picture at most; those that waited were replaced.
  EXPECT_LE(view.version, 501u);
}

TEST_F(Session, SharpensWhenTheHandRests) {
  write("");
  LiveSession::Settings small = settings();
  small.size = 8;
  LiveSession session(small);
  const LiveView view =
      viewWhere(session, [](const LiveView& v) { return v.picture && v.picture->step == 1; });
  const FrameResult whole = frame.comp("");
  ASSERT_EQ(view.picture->stages.picture->frame.colour.x.width(), width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      ASSERT_EQ(view.picture->stages.picture->frame.colour.x(x, y), whole.colour.x(x, y));
}

TEST_F(Session, AnEditInTheArtistsEditorShowsByItself) {
  write("brush.contrast = 0.25\n");
  LiveSession session(settings());
  viewWhere(session, [](const LiveView& v) { return v.picture != nullptr; });
  write("brush.contrast = 0.75\n[scene]\n");
  const LiveView view = viewWhere(session, [](const LiveView& v) {
    return v.picture && v.picture->look->passes.brush.contrast == 0.75f;
  });
  EXPECT_EQ(view.error, "");
}

TEST_F(Session, ABrokenLookShowsItsLineOverTheLastGoodPicture) {
  write("[[style]]\nstrip = \"builtin:soft\"\n");
  LiveSession session(settings());
  const LiveView good = viewWhere(session, [](const LiveView& v) { return v.picture != nullptr; });
  write("[[style]]\nstrip = \"builtin:soft\"\n\n[brush]\ncontrst = 1\n");
  const LiveView broken = viewWhere(session, [](const LiveView& v) { return !v.error.empty(); });
  EXPECT_NE(broken.error.find("look.toml:5"), std::string::npos) << broken.error;
  EXPECT_EQ(shown(broken), shown(good));
  write("[[style]]\nstrip = \"builtin:cel\"\n");
  const LiveView mended = viewWhere(session, [](const LiveView& v) { return v.error.empty(); });
  EXPECT_NE(shown(mended), shown(good));
}

TEST_F(Session, ThePageCannotReachOtherFiles) {
  write("[[style]]\nstrip = \"builtin:soft\"\n");
  LiveSession session(settings());
  const uint64_t change = session.change({{"style[0].strip=/etc/passwd"}});
  const LiveView view = viewWhere(session, [&](const LiveView& v) { return v.change == change; });
  EXPECT_NE(view.error.find("not in the look's folder"), std::string::npos) << view.error;
  EXPECT_THROW(session.change({{}, 1}), InputError);
}

TEST_F(Session, EndsWhileSomebodyWaits) {
  write("");
  LiveSession session(settings());
  const LiveView now = viewWhere(session, [](const LiveView& v) { return v.picture != nullptr; });
  std::thread waiter([&] { session.view(now.version + 1000000, 60s); });
  session.end();
  waiter.join();
}

TEST_F(Session, ThePageGetsStateAndPixelsInOneAnswer) {
  write("[[style]]\nobject = [\"Ball\"]\nstrip = \"builtin:soft\"\n");
  LiveSession session(settings());
  viewWhere(session, [](const LiveView& v) { return v.picture != nullptr; });
  const auto get = [&](const std::string& path, std::map<std::string, std::string> query) {
    return answerPage(session, {.method = "GET", .path = path, .query = std::move(query)});
  };
  const auto stateOf = [](const std::string& body) {
    size_t length = 0;
    for (size_t i = 0; i < 4; ++i) length |= size_t{static_cast<unsigned char>(body[i])} << (8 * i);
    return nlohmann::json::parse(body.substr(4, length));
  };
  for (const std::string stage : {"normals", "objects", "surfaces", "visibility.Key", "tone.Key",
                                  "brush.tone", "albedo", "result"}) {
    const HttpResponse answer = get("/picture", {{"stage", stage}});
    ASSERT_EQ(answer.status, 200) << answer.body;
    const nlohmann::json state = stateOf(answer.body);
    EXPECT_EQ(state["size"], (nlohmann::json{width, height})) << stage;
    EXPECT_EQ(answer.body.size(), 4 + state.dump(-1, ' ', true).size() + width * height * 4)
        << stage;
    EXPECT_EQ(state["values"]["style"][0]["style"]["strip"], "builtin:soft");
    EXPECT_EQ(state["onDisk"],
              (nlohmann::json{{"style", {"Ball / "}}, {"light", nlohmann::json::array()}}));
    EXPECT_EQ(state["lights"][0]["name"], "Key");
  }
  EXPECT_EQ(get("/picture", {{"stage", "nothing"}}).status, 400);
  EXPECT_EQ(get("/picture", {{"exposure", "much"}}).status, 400);
  const nlohmann::json ball = nlohmann::json::parse(get("/probe", {{"x", "8"}, {"y", "12"}}).body);
  EXPECT_EQ(ball["object"], "Ball");
  EXPECT_EQ(ball["style"], 0);
  EXPECT_EQ(ball["lights"][0]["name"], "Key");
  const nlohmann::json ground =
      nlohmann::json::parse(get("/probe", {{"x", "20"}, {"y", "12"}}).body);
  EXPECT_EQ(ground["object"], "Ground");
  EXPECT_FALSE(ground.contains("style"));
  EXPECT_EQ(nlohmann::json::parse(get("/probe", {{"x", "-1"}, {"y", "99"}}).body)["object"],
            nullptr);
}

TEST_F(Session, OverridesAreNotSavedIntoOtherEntriesThanWereSeen) {
  write("[[style]]\nobject = \"Ball\"\n");
  LiveSession session(settings());
  const EntriesOnDisk seen =
      viewWhere(session, [](const LiveView& v) { return v.picture != nullptr; }).onDisk;
  const std::string other = "[[style]]\nobject = \"Ground\"\n\n[[style]]\nobject = \"Ball\"\n";
  write(other);
  EXPECT_THROW(session.save({"style[0].brush.contrast=0.5"}, &seen), LookError);
  std::ifstream file(frame.folder / "look.toml");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), other);
  session.save({"style[1].brush.contrast=0.5"});
  EXPECT_FLOAT_EQ(readLook(frame.folder / "look.toml", {}).styles[1].passes.brush.contrast, 0.5f);
}

/// Three frames on disk, of which the first is looked at.
class PreparedFrames : public Session {
 protected:
  LiveSession::Settings threeFrames() const {
    LiveSession::Settings all = settings();
    const std::filesystem::path first = all.inputs[0].path;
    for (const int number : {2, 3}) {
      const std::filesystem::path path = frame.folder / fmt::format("other.{:04d}.exr", number);
      std::filesystem::copy(first, path);
      std::filesystem::path sidecar = first, own = path;
      std::filesystem::copy(sidecar.replace_extension(".json"), own.replace_extension(".json"));
      all.inputs.push_back({path, number});
    }
    return all;
  }
  /// The stages that are made when another frame is asked for, a while after the first was seen.
  std::vector<std::string> madeFor(LiveSession& session, size_t input) const {
    viewWhere(session, [](const LiveView& v) { return v.picture != nullptr; });
    std::this_thread::sleep_for(1500ms);
    const uint64_t change = session.change({{}, input});
    return viewWhere(session, [&](const LiveView& v) { return v.change == change; }).picture->made;
  }
};

TEST_F(PreparedFrames, TheNextOneIsThereWhenItIsAskedFor) {
  write("");
  LiveSession session(threeFrames());
  EXPECT_EQ(madeFor(session, 1), std::vector<std::string>());
}

TEST_F(PreparedFrames, NothingIsPreparedBeyondTheMemory) {
  write("");
  LiveSession::Settings small = threeFrames();
  small.memory = 1;
  LiveSession session(small);
  EXPECT_FALSE(madeFor(session, 1).empty());
  const uint64_t back = session.change({{}, 0});
  EXPECT_FALSE(viewWhere(session, [&](const LiveView& v) {
                 return v.change == back;
               }).picture->made.empty());
}

TEST_F(PreparedFrames, ABrokenOneIsNotSeenBeforeItIsAskedFor) {
  write("");
  const LiveSession::Settings all = threeFrames();
  std::ofstream(all.inputs[1].path) << "no frame";
  LiveSession session(all);
  viewWhere(session, [](const LiveView& v) { return v.picture != nullptr; });
  std::this_thread::sleep_for(500ms);
  EXPECT_EQ(session.view(0, 0ms).error, "");
  const uint64_t change = session.change({{}, 1});
  EXPECT_NE(viewWhere(session, [&](const LiveView& v) { return v.change == change; }).error, "");
}

TEST_F(Session, ThePageIsAnsweredOrRefusedInWords) {
  write("");
  LiveSession session(settings());
  const auto ask = [&](const std::string& method, const std::string& path,
                       const std::string& body) {
    return answerPage(session, {.method = method, .path = path, .body = body}).status;
  };
  for (const char* path :
       {"/", "/main.js", "/link.js", "/viewer.js", "/knobs.js", "/history.js", "/strips.js",
        "/own_entry.js", "/light_drag.js", "/unpack.js", "/control.js", "/easel.js",
        "/strip_drop.js", "/stops.js", "/style.css", "/tables", "/strips", "/paint"})
    EXPECT_EQ(ask("GET", path, ""), 200) << path;
  for (const char* path : {"/look.toml", "/main.js/", "/page/main.js", ""})
    EXPECT_EQ(ask("GET", path, ""), 404) << path;
  EXPECT_EQ(ask("POST", "/main.js", ""), 404);
  EXPECT_EQ(ask("POST", "/change", "{\"overrides\": [\"brush.contrast=0.5\"]}"), 200);
  for (const char* body :
       {"", "{", "[]", "{\"overrides\": 3}", "{\"overrides\": [], \"input\": \"x\"}",
        "{\"overrides\": [], \"input\": 7}"})
    EXPECT_EQ(ask("POST", "/change", body), 400) << body;
}

// 1e30 took frame 0, and -1 was called 18446744073709551615.
TEST_F(Session, NumbersThatAreNoneAreRefusedInWords) {
  write("");
  LiveSession session(settings());
  for (const char* input : {"1e30", "-1", "0.5", "null", "true", "1e400", "18446744073709551616"}) {
    const HttpResponse answer =
        answerPage(session, {.method = "POST",
                             .path = "/change",
                             .body = fmt::format("{{\"overrides\": [], \"input\": {}}}", input)});
    EXPECT_EQ(answer.status, 400) << input;
    EXPECT_EQ(answer.body.find("1844674407370955161"), std::string::npos) << answer.body;
  }
  for (const char* exposure : {"nan", "inf", "-inf", "1e38", "101", "x", ""}) {
    const HttpResponse answer = answerPage(
        session, {.method = "GET", .path = "/picture", .query = {{"exposure", exposure}}});
    EXPECT_EQ(answer.status, 400) << exposure;
    EXPECT_NE(answer.body.find("exposure must be"), std::string::npos) << answer.body;
  }
}

// What came after the line break was dropped without a word.
TEST_F(Session, OverridesOfSeveralLinesAreRefused) {
  write("");
  LiveSession session(settings());
  const std::string lines = "brush.contrast=0.5\nnonsense=7";
  const uint64_t change = session.change({{lines}});
  const LiveView view = viewWhere(session, [&](const LiveView& v) { return v.change == change; });
  EXPECT_NE(view.error.find("brush.contrast: there is more than one value"), std::string::npos)
      << view.error;
  const HttpResponse saved = answerPage(
      session,
      {.method = "POST", .path = "/save", .body = nlohmann::json{{"overrides", {lines}}}.dump()});
  EXPECT_EQ(saved.status, 400);
  EXPECT_NE(saved.body.find("there is more than one value"), std::string::npos) << saved.body;
}

}  // namespace
}  // namespace kagefude
