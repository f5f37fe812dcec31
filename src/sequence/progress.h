#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>

namespace kagefude {

/// How a run tells of its progress: a bar on a terminal and plain lines elsewhere (automatic),
/// plain lines, lines as OpenJD reads them, or nothing.
enum class ProgressKind { automatic, plain, openjd, none };

/// "auto", "plain", "openjd", "none". UsageError names the nearest.
ProgressKind parseProgressKind(std::string_view name);

/// One finished frame, as progress shows it.
struct FrameProgress {
  std::string name;     ///< "frame 12 left"
  bool kept = false;    ///< it was there already
  std::string failure;  ///< why it failed; empty when it did not
  double seconds = 0;
};

/// Listens to a run. Calls come one at a time. Warnings and failures are shown by every kind.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  virtual void begin(size_t frames) = 0;
  virtual void frame(const FrameProgress& progress) = 0;
  virtual void warning(const std::string& text) = 0;
  /// Ends the display, with one line of summary. `failed` says whether the run as a whole did.
  virtual void end(const std::string& summary, bool failed) = 0;
};

/// Seconds from some fixed moment; tests give their own.
using ProgressClock = std::function<double()>;

/// Makes the sink for a kind. Every line is flushed at once. `terminal` says whether `out` is one;
/// `width` is its number of columns.
///
/// plain: `frame 12 done in 0.93 s (3 of 24)`, and `Progress: 12%` (Deadline) whenever it changes.
/// openjd: `openjd_progress: 12`, `openjd_status: frame 12 done (3 of 24)`, and `openjd_fail: …`
/// for the summary of a failed run. A frame that fails is `frame 12 failed: …`: the words "error:"
/// are never printed here, since farms take them for the end of the task.
std::unique_ptr<ProgressSink> makeProgress(ProgressKind kind, std::ostream& out, bool terminal,
                                           int width = 80, ProgressClock clock = {});

/// "0:07", "12:30", "3:05:00"; "?" for nothing known (negative or not finite).
std::string formatDuration(double seconds);

}  // namespace kagefude
