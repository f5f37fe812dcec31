#include "live/live_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "base/error.h"
#include "base/files_read.h"
#include "live/page_paths.h"
#include "live/stage_keys.h"
#include "look/write_look.h"

namespace kagefude {
LiveSession::LiveSession(Settings settings) : settings_(std::move(settings)) {
  if (settings_.inputs.empty()) throw InputError("there is no frame to show");
  waiting_ = LiveChange{};
  thread_ = std::thread([this] { run(); });
}

LiveSession::~LiveSession() {
  end();
  thread_.join();
}

void LiveSession::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  sharpening_.request_stop();
  changed_.notify_all();
}

uint64_t LiveSession::change(LiveChange wanted) {
  if (wanted.input >= settings_.inputs.size())
    throw InputError(
        fmt::format("there is no input {}; there are {}", wanted.input, settings_.inputs.size()));
  const std::lock_guard lock(mutex_);
  waiting_ = std::move(wanted);
  sharpening_.request_stop();
  changed_.notify_all();
  return ++changes_;
}

AskedLook LiveSession::readAsked(const std::vector<std::string>& overrides) const {
  const LooksAtOutputs looking;
  AskedLook look{readLook(settings_.look, {}), readLook(settings_.look, overrides)};
  refuseForeignPaths(look.onDisk, look.asked);
  return look;
}

std::vector<std::string> LiveSession::save(const std::vector<std::string>& overrides) const {
  readAsked(overrides);
  return saveLook(settings_.look, overrides);
}

LiveView LiveSession::view(uint64_t seen, std::chrono::milliseconds most) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, most, [&] { return ended_ || view_.version > seen; });
  return view_;
}

void LiveSession::run() {
  std::unique_lock lock(mutex_);
  while (waitForWork(lock)) {
    const bool whole = !waiting_;
    if (waiting_) {
      now_ = *std::exchange(waiting_, std::nullopt);
      nowChange_ = changes_;
    }
    sharpening_ = std::stop_source();
    lock.unlock();
    answer(whole);
    lock.lock();
  }
}

/// True when there is a change to answer or a picture to sharpen, false at the end.
bool LiveSession::waitForWork(std::unique_lock<std::mutex>& lock) {
  const auto wanted = [this] { return ended_ || waiting_; };
  if (!sharp_ && !changed_.wait_for(lock, settings_.rest, wanted)) return true;
  while (!changed_.wait_for(lock, settings_.watch, wanted)) {
    lock.unlock();
    const bool same = filesNow() == files_;
    lock.lock();
    if (!same && !waiting_) waiting_ = now_;
  }
  return !ended_;
}

/// What the page's state is made of on disk.
StageKey LiveSession::filesNow() const {
  StageKey key;
  if (!settings_.look.empty()) addFile(key, settings_.look);
  const std::filesystem::path& frame = settings_.inputs[now_.input].path;
  addFile(key, frame);
  addFile(key, std::filesystem::path(frame).replace_extension(".json"));
  for (const std::filesystem::path& strip : strips_) addFile(key, strip);
  return key;
}

LiveFrame& LiveSession::frameOf(size_t input) {
  const auto kept = std::find_if(frames_.begin(), frames_.end(),
                                 [&](const auto& frame) { return frame.first == input; });
  auto frame = kept != frames_.end() ? std::move(*kept) : std::pair(input, nullptr);
  if (kept != frames_.end()) frames_.erase(kept);
  while (frames_.size() >= std::max<size_t>(settings_.keptFrames, 1)) frames_.pop_back();
  const LiveInput& source = settings_.inputs[input];
  if (!frame.second)
    frame.second = std::make_unique<LiveFrame>(source.path, source.frame, source.view);
  return *frames_.emplace_front(std::move(frame)).second;
}

void LiveSession::answer(bool whole) {
  LiveView made;
  sharp_ = true;  // after an error there is nothing to sharpen
  files_ = filesNow();
  try {
    const auto [onDisk, look] = readAsked(now_.overrides);
    made.stylesOnDisk = onDisk.styles.size();
    made.lightsOnDisk = onDisk.lights.size();
    strips_.clear();
    for (const std::string& name : paintedFiles(look))
      if (!isBuiltinStrip(name)) strips_.push_back(look.resolve(name));
    files_ = filesNow();
    std::stop_token stop;
    {
      const std::lock_guard lock(mutex_);
      if (whole) stop = sharpening_.get_token();
    }
    made.picture = std::make_shared<const LivePicture>(
        frameOf(now_.input).compose(look, shelf_, whole ? 0 : settings_.size, stop));
    sharp_ = made.picture->step == 1;
  } catch (const Superseded&) {
    sharp_ = false;
    return;
  } catch (const std::bad_alloc&) {
    made.error = "out of memory";
  } catch (const std::exception& problem) {
    made.error = problem.what();
  }
  publish(std::move(made));
}

/// An error leaves the last good picture with what belongs to it.
void LiveSession::publish(LiveView made) {
  const std::lock_guard lock(mutex_);
  made.version = view_.version + 1;
  made.change = nowChange_;
  made.input = now_.input;
  if (made.picture) {
    view_ = std::move(made);
  } else {
    view_.version = made.version;
    view_.change = made.change;
    view_.error = std::move(made.error);
  }
  changed_.notify_all();
}

}  // namespace kagefude
