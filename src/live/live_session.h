#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "live/live_frame.h"

namespace kagefude {

/// One frame that the page can show.
struct LiveInput {
  std::filesystem::path path;
  int frame = 1;
  std::string view{};
};

/// What the page wants to see.
struct LiveChange {
  std::vector<std::string> overrides;  ///< "section.key=value", laid over the look's file
  size_t input = 0;                    ///< which of the inputs
};

/// A look as it lies on disk, and as the page asks for it.
struct AskedLook {
  Look onDisk, asked;
};

/// What each entry of a look's file is for, in their order: an entry is known by it when the file
/// gets or loses others.
struct EntriesOnDisk {
  std::vector<std::string> styles, lights;
  bool operator==(const EntriesOnDisk&) const = default;
};

/// What is to be seen now. `picture` is the last good one, whatever went wrong since.
struct LiveView {
  uint64_t version = 0;  ///< rises with every view
  uint64_t change = 0;   ///< the change that it answers
  std::shared_ptr<const LivePicture> picture;
  size_t input = 0;  ///< of the picture
  /// Of the look's file when the picture was made; what the page added has higher numbers.
  EntriesOnDisk onDisk;
  std::string error;  ///< what is wrong with the change; "" when the picture is its answer
};

/// A look on some frames, composed in a thread of its own whenever the page or a file changes.
/// There is no queue: of changes that wait only the last is kept. A picture that was begun at the
/// viewer's size is finished, so that a hand that never rests sees every picture that there is time
/// for. What is turned and takes longer than `pace` is shown by every 2nd, 4th or 8th of its pixels
/// in both ways, which is learnt for each knob as it is turned; a light that is moved has fewer
/// places meanwhile. Sharpening to full size begins when
/// nothing has changed for `rest`, and gives way to the next change between two stages. Files
/// (look, strips, frame) are looked at four times a second while nothing else is done, which also
/// sees changes on network drives. All functions may be called from any thread.
class LiveSession {
 public:
  struct Settings {
    std::filesystem::path look;     ///< empty: all defaults
    std::vector<LiveInput> inputs;  ///< at least one
    int size = 1024;                ///< longer side of the pictures while the hand moves
    /// Bytes of frames that stay in memory (LiveFrame::bytes), the one that is seen always; 0: a
    /// quarter of what the machine has. Frames beside it are made in advance as far as they fit.
    size_t memory = 0;
    /// How long nothing changes before a picture is sharpened; up to five times as long where that
    /// will take longer, for a pass that was begun is not left.
    std::chrono::milliseconds rest{200};
    /// What making a picture may take while the hand moves: where it takes longer, fewer pixels are
    /// shown until the hand rests. One of every n-th pixel may take n times as long.
    std::chrono::milliseconds pace{25};
    std::chrono::milliseconds watch{250};
  };

  explicit LiveSession(Settings settings);
  ~LiveSession();
  LiveSession(const LiveSession&) = delete;
  LiveSession& operator=(const LiveSession&) = delete;

  /// Asks for a change in place of any that waits, and gives its number (1, 2 ...). Throws
  /// InputError when there is no such input.
  uint64_t change(LiveChange wanted);

  /// The look as its file is now, and with overrides of the page. It may be saved later, so reading
  /// it does not count as reading an input. Throws LookError, also for files that the page may not
  /// name (refuseForeignPaths).
  AskedLook readAsked(const std::vector<std::string>& overrides) const;

  /// Writes overrides into the look's file (saveLook), which is then watched like any edit. Gives
  /// the overrides that bring back what was there. Throws as saveLook, and LookError for files that
  /// the page may not name, and when the file has other entries than `seen` now: overrides name
  /// entries by their number.
  std::vector<std::string> save(const std::vector<std::string>& overrides,
                                const EntriesOnDisk* seen = nullptr) const;

  /// The view as soon as its version is above `seen`, or what there is after `most` or once the
  /// session ends.
  LiveView view(uint64_t seen, std::chrono::milliseconds most) const;

  /// Wakes all that wait in view(), and ends the thread after the stage at hand.
  void end();

  const Settings& settings() const { return settings_; }

 private:
  enum class Work { answer, sharpen, prepare, end };
  using Milliseconds = std::chrono::duration<double, std::milli>;

  void run();
  Work waitForWork(std::unique_lock<std::mutex>& lock);
  void answer(bool whole);
  void prepare();
  void prepareFrame(size_t input, const std::stop_token& stop);
  void prepareProxy(int coarser, const std::stop_token& stop);
  std::optional<size_t> frameToPrepare() const;
  std::optional<int> proxyToPrepare() const;
  int coarserNow() const;
  void keepPace(const LivePicture& picture, int coarser, Milliseconds took);
  LiveFrame& frameOf(size_t input);
  void letFramesGo();
  StageKey filesNow() const;
  void publish(LiveView made);

  const Settings settings_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  // Guarded by mutex_:
  bool ended_ = false;
  std::optional<LiveChange> waiting_;
  uint64_t changes_ = 0;
  LiveView view_;
  std::stop_source sharpening_;
  // The thread's own:
  LiveChange now_;
  uint64_t nowChange_ = 0;
  bool sharp_ = true;
  Milliseconds rest_{0};                ///< how long the hand rests before the picture is sharpened
  std::string turned_;                  ///< the overrides by which the last change differs
  std::map<std::string, int> coarser_;  ///< by what is turned, every how many samples keep the pace
  std::set<int> proxies_{2};            ///< of these steps the stages are kept up to date,
  std::set<int> prepared_;              ///< and of these they are
  StageKey files_;
  std::vector<std::filesystem::path> strips_;
  StripShelf shelf_;
  std::deque<std::pair<size_t, std::unique_ptr<LiveFrame>>> frames_;  ///< the one seen last first
  std::set<size_t> unfit_;  ///< frames that could not be prepared
  std::thread thread_;
};

}  // namespace kagefude
