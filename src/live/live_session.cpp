#include "live/live_session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "base/error.h"
#include "base/files_read.h"
#include "live/page_paths.h"
#include "live/stage_keys.h"
#include "look/write_look.h"

namespace kagefude {
namespace {

LiveSession::Settings completed(LiveSession::Settings settings) {
  if (settings.memory == 0)
    settings.memory = static_cast<size_t>(sysconf(_SC_PHYS_PAGES)) *
                      static_cast<size_t>(sysconf(_SC_PAGESIZE)) / 4;
  return settings;
}

EntriesOnDisk entriesOf(const Look& look) {
  EntriesOnDisk entries;
  for (const StyleLook& style : look.styles)
    entries.styles.push_back(fmt::format("{} / {}", fmt::join(style.style.object, ", "),
                                         fmt::join(style.style.material, ", ")));
  for (const LightLook& light : look.lights) entries.lights.push_back(light.light.name);
  return entries;
}

/// The names of those overrides that are in one list alone, each once, in alphabetical order.
std::string namesOfDifferent(const std::vector<std::string>& before,
                             const std::vector<std::string>& now) {
  const std::set<std::string> a(before.begin(), before.end()), b(now.begin(), now.end());
  std::set<std::string> names;
  for (const auto* list : {&a, &b})
    for (const std::string& text : *list)
      if (!a.contains(text) || !b.contains(text)) names.insert(text.substr(0, text.find('=')));
  return fmt::format("{}", fmt::join(names, " "));
}

/// A light that moves is traced anew, which takes seconds at full size.
bool movesLight(const std::string& turned) {
  return turned.find("].position") != std::string::npos ||
         turned.find("].direction") != std::string::npos;
}
constexpr int coarserOfLights = 4;

/// The lights that are moved, as their entries name them.
std::vector<std::string> movedLights(const std::string& turned, const Look& look) {
  std::vector<std::string> names;
  for (size_t i = 0; i < look.lights.size(); ++i)
    for (const char* key : {"position", "direction"})
      if (turned.find(fmt::format("light[{}].{}", i, key)) != std::string::npos)
        names.push_back(look.lights[i].light.name);
  return names;
}

/// Whether something was made for it that a turn of the knob would not make again.
bool madeFirst(const LivePicture& picture) {
  const auto has = [&](const char* stage) {
    return std::find(picture.made.begin(), picture.made.end(), stage) != picture.made.end();
  };
  return has("read") || has("sample") || has("colour");
}

}  // namespace

LiveSession::LiveSession(Settings settings) : settings_(completed(std::move(settings))) {
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

std::vector<std::string> LiveSession::save(const std::vector<std::string>& overrides,
                                           const EntriesOnDisk* seen) const {
  const AskedLook look = readAsked(overrides);
  if (seen && entriesOf(look.onDisk) != *seen)
    throw LookError(
        "the look's file has got or lost entries since; look at the picture, then save again");
  return saveLook(settings_.look, overrides);
}

LiveView LiveSession::view(uint64_t seen, std::chrono::milliseconds most) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, most, [&] { return ended_ || view_.version > seen; });
  return view_;
}

void LiveSession::run() {
  std::unique_lock lock(mutex_);
  for (Work work; (work = waitForWork(lock)) != Work::end;) {
    if (waiting_) {
      turned_ = namesOfDifferent(now_.overrides, waiting_->overrides);
      prepared_.clear();
      now_ = *std::exchange(waiting_, std::nullopt);
      nowChange_ = changes_;
    }
    sharpening_ = std::stop_source();
    lock.unlock();
    if (work == Work::prepare)
      prepare();
    else
      answer(work == Work::sharpen);
    lock.lock();
  }
}

LiveSession::Work LiveSession::waitForWork(std::unique_lock<std::mutex>& lock) {
  const auto wanted = [this] { return ended_ || waiting_; };
  if (!sharp_ && !changed_.wait_for(lock, rest_, wanted)) return Work::sharpen;
  while (!changed_.wait_for(lock, settings_.watch, wanted)) {
    lock.unlock();
    const bool same = filesNow() == files_;
    lock.lock();
    if (!same && !waiting_) waiting_ = now_;
    if (!waiting_ && !ended_ && (proxyToPrepare() || frameToPrepare())) return Work::prepare;
  }
  return ended_ ? Work::end : Work::answer;
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
  const LiveInput& source = settings_.inputs[input];
  if (!frame.second)
    frame.second = std::make_unique<LiveFrame>(source.path, source.frame, source.view);
  return *frames_.emplace_front(std::move(frame)).second;
}

/// Those that were not seen for the longest go first, but for the one that is.
void LiveSession::letFramesGo() {
  size_t bytes = 0;
  for (size_t i = 0; i < frames_.size(); ++i) {
    bytes += frames_[i].second->bytes();
    if (i == 0 || bytes <= settings_.memory) continue;
    frames_.resize(i);
    break;
  }
}

/// The next frame, then the one before, where another one like this fits into the memory.
std::optional<size_t> LiveSession::frameToPrepare() const {
  if (!sharp_ || frames_.empty()) return std::nullopt;
  size_t bytes = frames_.front().second->bytes();
  for (const auto& frame : frames_) bytes += frame.second->bytes();
  if (bytes > settings_.memory) return std::nullopt;
  for (const size_t input : {now_.input + 1, now_.input - 1}) {
    const bool kept = std::any_of(frames_.begin(), frames_.end(),
                                  [&](const auto& frame) { return frame.first == input; });
    if (input < settings_.inputs.size() && !kept && !unfit_.contains(input)) return input;
  }
  return std::nullopt;
}

/// The coarsest first, which a hand that moves a light wants.
std::optional<int> LiveSession::proxyToPrepare() const {
  if (!sharp_ || frames_.empty()) return std::nullopt;
  for (auto coarser = proxies_.rbegin(); coarser != proxies_.rend(); ++coarser)
    if (!prepared_.contains(*coarser)) return *coarser;
  return std::nullopt;
}

/// Makes what may be looked at next. What is wrong with it is said when it is.
void LiveSession::prepare() {
  std::stop_token stop;
  {
    const std::lock_guard lock(mutex_);
    stop = sharpening_.get_token();
  }
  if (const std::optional<int> coarser = proxyToPrepare())
    prepareProxy(*coarser, stop);
  else
    prepareFrame(*frameToPrepare(), stop);
}

/// The stages before those that a knob turns are made while the hand rests.
void LiveSession::prepareProxy(int coarser, const std::stop_token& stop) {
  prepared_.insert(coarser);
  try {
    const Look look = readAsked(now_.overrides).asked;
    frames_.front().second->compose(look, shelf_, settings_.size, stop, coarser);
  } catch (const std::exception&) {  // also Superseded: what was made until then is kept
  }
}

void LiveSession::prepareFrame(size_t input, const std::stop_token& stop) {
  const LiveInput& source = settings_.inputs[input];
  auto frame = std::make_unique<LiveFrame>(source.path, source.frame, source.view);
  try {
    frame->compose(readAsked(now_.overrides).asked, shelf_, settings_.size, stop);
  } catch (const Superseded&) {  // what was made until then is kept
  } catch (const std::exception&) {
    unfit_.insert(input);
    return;
  }
  frames_.emplace_back(input, std::move(frame));
  letFramesGo();
}

/// Every how many samples in both ways are shown of what is turned now.
int LiveSession::coarserNow() const {
  const auto known = coarser_.find(turned_);
  return known != coarser_.end() ? known->second : movesLight(turned_) ? coarserOfLights : 1;
}

/// Learns from a picture of every `coarser`-th sample (0: the whole frame) that took so long.
void LiveSession::keepPace(const LivePicture& picture, int coarser, Milliseconds took) {
  constexpr int coarsest = 8;
  rest_ = std::clamp(took * coarser * coarser, Milliseconds(settings_.rest),
                     Milliseconds(5 * settings_.rest));
  if (picture.plan->hasCasters) proxies_.insert(coarserOfLights);
  if (madeFirst(picture)) return;
  if (coarser == 0) {
    // At rest it has the machine for itself, so it must be well within the pace.
    if (2 * took <= settings_.pace) coarser_[turned_] = 1;
    return;
  }
  // Half as many samples in both ways take about a quarter; all samples of a light that moves also
  // have all of its places. The fewer there are, the longer may they take, for those that are left
  // out cost the eye something as well.
  const int finer = coarser == 2 && movesLight(turned_) ? 8 : 4;
  if (coarser > 1 && finer * took <= settings_.pace * (coarser / 2)) coarser /= 2;
  for (; took > settings_.pace * coarser && coarser < coarsest; took /= 4) coarser *= 2;
  coarser_[turned_] = coarser;
  if (coarser > 1) proxies_.insert(coarser);
}

void LiveSession::answer(bool whole) {
  LiveView made;
  sharp_ = true;  // after an error there is nothing to sharpen
  unfit_.clear();
  files_ = filesNow();
  try {
    const auto [onDisk, look] = readAsked(now_.overrides);
    made.onDisk = entriesOf(onDisk);
    strips_.clear();
    for (const std::string& name : paintedFiles(look))
      if (!isBuiltinStrip(name)) strips_.push_back(look.resolve(name));
    files_ = filesNow();
    std::stop_token stop;
    {
      const std::lock_guard lock(mutex_);
      if (whole) stop = sharpening_.get_token();
    }
    const auto start = std::chrono::steady_clock::now();
    const int coarser = coarserNow();
    const auto moving = coarser > 1 ? movedLights(turned_, look) : std::vector<std::string>();
    made.picture = std::make_shared<const LivePicture>(
        frameOf(now_.input)
            .compose(look, shelf_, whole ? 0 : settings_.size, stop, coarser, moving));
    keepPace(*made.picture, whole ? 0 : coarser, std::chrono::steady_clock::now() - start);
    sharp_ = made.picture->step == 1;
    letFramesGo();
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
