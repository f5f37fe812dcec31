#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <condition_variable>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <ostream>

#include "base/files_read.h"
#include "cli/commands.h"
#include "live/live.h"
#include "sequence/frame_jobs.h"
#include "sequence/frame_range.h"
#include "sequence/interrupt.h"

namespace kagefude {
namespace {

struct LiveOptions {
  std::string look, input, frames;
  std::vector<std::string> views;
  uint16_t port = 0;
  int size = 1024;
  bool noOpen = false, untilClosed = false;
};

std::vector<LiveInput> inputsOf(const LiveOptions& options) {
  PlanRequest request;
  request.inputs = {FramePattern(options.input)};
  if (!options.frames.empty()) request.frames = parseFrames(options.frames);
  request.views = options.views;
  std::vector<LiveInput> inputs;
  for (const FrameJob& job : planJobs(request))
    inputs.push_back({job.inputs.front(), job.frame, job.view});
  return inputs;
}

/// In the user's browser, where there is a desktop to show it on; else the printed address must do.
void openInBrowser(const std::string& url) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
  std::string program = "xdg-open", address = url;
  char* arguments[] = {program.data(), address.data(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ) == 0)
    std::thread([child] { waitpid(child, nullptr, 0); }).detach();
}

/// Until whoever started the program has closed its end of the standard input, however it ended.
void waitForEnd(const std::stop_token& stop) {
  constexpr int lookAgain = 200;  // milliseconds
  pollfd input{STDIN_FILENO, POLLIN, 0};
  while (!stop.stop_requested()) {
    if (::poll(&input, 1, lookAgain) <= 0) continue;
    char said[256];  // which means nothing
    if (::read(STDIN_FILENO, said, sizeof said) <= 0) return;
  }
}

void waitFor(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any stopped;
  std::unique_lock lock(mutex);
  stopped.wait(lock, stop, [] { return false; });
}

int serve(const LiveOptions& options, Console& console) {
  const Interrupts interrupts([](int code) { std::_Exit(code); });
  LiveSession::Settings settings;
  settings.look = options.look;
  settings.inputs = inputsOf(options);
  settings.size = options.size;
  {
    const LooksAtOutputs looking;  // it may be saved
    readLook(options.look, {});    // a look that is wrong from the start ends the call
  }
  LiveSession session(std::move(settings));
  const HttpServer server(options.port, randomToken(),
                          [&](const HttpRequest& request) { return answerPage(session, request); });
  console.result(server.address().url());
  console.out.flush();
  if (!options.noOpen) openInBrowser(server.address().url());
  if (options.untilClosed)
    waitForEnd(interrupts.token());
  else
    waitFor(interrupts.token());
  session.end();
  return interrupts.exitCode();
}

}  // namespace

void addLiveCommand(CLI::App& app, Console& console, int& exit) {
  auto options = std::make_shared<LiveOptions>();
  CLI::App* command = app.add_subcommand(
      "live", "Serve a page on this machine where the look's knobs show at once what they do");
  command->add_option("look", options->look, "look file (TOML)")->required();
  command->add_option("input", options->input, "frames (EXR); #### stands for the frame number")
      ->required();
  command->add_option("--frames", options->frames, "frames to choose from, such as 1-24 (all)");
  command->add_option("--views", options->views, "views for %V (left right)");
  command->add_option("--port", options->port, "port on 127.0.0.1 (any that is free)");
  command
      ->add_option("--size", options->size,
                   "longer side of the picture while a knob turns, 64 to 16384 pixels (1024)")
      ->check(CLI::Range(64, 16384));
  command->add_flag("--no-open", options->noOpen, "only print the address");
  command->add_flag("--until-closed", options->untilClosed,
                    "end when standard input does: with the program that started this one");
  command->callback([options, &console, &exit] { exit = serve(*options, console); });
}

}  // namespace kagefude
