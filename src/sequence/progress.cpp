#include "sequence/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/printable.h"

namespace kagefude {
namespace {

double steadySeconds() {
  const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
  return now.count();
}

/// Counts that every kind needs. Warnings and failures go out as lines of their own.
class CountingSink : public ProgressSink {
 public:
  CountingSink(std::ostream& out, ProgressClock clock) : out_(out), clock_(std::move(clock)) {}

  void begin(size_t frames) override {
    total_ = frames;
    start_ = clock_();
  }

  void frame(const FrameProgress& progress) override {
    ++finished_;
    if (!progress.failure.empty()) {
      ++failed_;
      line(fmt::format("{} failed: {}", progress.name, progress.failure));
    } else if (progress.kept) {
      ++kept_;
    }
    show(progress);
  }

  void warning(const std::string& text) override { line("warning: " + text); }

  void end(const std::string& summary, bool) override { line(summary); }

 protected:
  virtual void show(const FrameProgress& progress) = 0;
  virtual void line(const std::string& text) { out_ << printable(text) << '\n' << std::flush; }

  int percent() const { return total_ == 0 ? 100 : static_cast<int>(finished_ * 100 / total_); }
  std::string count() const { return fmt::format("{} of {}", finished_, total_); }
  /// Seconds per frame really made; frames kept cost next to nothing and would make it look fast.
  double pace() const {
    const size_t made = finished_ - kept_;
    return made == 0 ? -1 : (clock_() - start_) / static_cast<double>(made);
  }

  std::ostream& out_;
  ProgressClock clock_;
  double start_ = 0;
  size_t total_ = 0;
  size_t finished_ = 0;
  size_t kept_ = 0;
  size_t failed_ = 0;
};

std::string outcome(const FrameProgress& progress) {
  if (!progress.failure.empty()) return "failed";
  if (progress.kept) return "kept";
  return fmt::format("done in {:.2f} s", progress.seconds);
}

class PlainSink : public CountingSink {
 public:
  using CountingSink::CountingSink;

 protected:
  void show(const FrameProgress& progress) override {
    if (progress.failure.empty())
      line(fmt::format("{} {} ({})", progress.name, outcome(progress), count()));
    if (percent() != shown_) line(fmt::format("Progress: {}%", percent()));
    shown_ = percent();
  }

 private:
  int shown_ = -1;
};

class OpenJdSink : public CountingSink {
 public:
  using CountingSink::CountingSink;

  void end(const std::string& summary, bool failed) override {
    line(fmt::format("{} {}", failed ? "openjd_fail:" : "openjd_status:", summary));
  }

 protected:
  void show(const FrameProgress& progress) override {
    line(fmt::format("openjd_status: {} {} ({})", progress.name, outcome(progress), count()));
    if (percent() != shown_) line(fmt::format("openjd_progress: {}", percent()));
    shown_ = percent();
  }

 private:
  int shown_ = -1;
};

class SilentSink : public CountingSink {
 public:
  using CountingSink::CountingSink;

 protected:
  void show(const FrameProgress&) override {}
};

/// One line that is drawn over itself. Longer texts go above it.
class BarSink : public CountingSink {
 public:
  BarSink(std::ostream& out, int width, ProgressClock clock)
      : CountingSink(out, std::move(clock)), width_(std::max(width, 20)) {}

  void begin(size_t frames) override {
    CountingSink::begin(frames);
    draw("");
  }

  void end(const std::string& summary, bool) override {
    erase();
    out_ << printable(summary) << '\n' << std::flush;
  }

 protected:
  void show(const FrameProgress& progress) override {
    const bool last = finished_ == total_;
    if (!last && clock_() - drawn_ < kRedrawSeconds) return;
    draw(progress.name);
  }

  void line(const std::string& text) override {
    erase();
    out_ << printable(text) << '\n';
    draw(last_);
  }

 private:
  static constexpr double kRedrawSeconds = 0.1;

  void erase() { out_ << "\r\033[K"; }

  void draw(const std::string& name) {
    const double each = pace();
    const double left = each * static_cast<double>(total_ - finished_);
    std::string text = fmt::format(" {}/{}", finished_, total_);
    if (each > 0)
      text += each < 1 ? fmt::format("  {:.1f} frames/s", 1 / each)
                       : fmt::format("  {:.1f} s/frame", each);
    text += fmt::format("  left {}", formatDuration(total_ == finished_ ? 0 : left));
    if (failed_ > 0) text += fmt::format("  {} failed", failed_);
    if (!name.empty()) text += "  " + printable(name);
    const int room = std::min(width_ - 3 - static_cast<int>(text.size()), 32);
    if (room >= 4) {
      const int full = total_ == 0 ? room : static_cast<int>(finished_ * room / total_);
      text = fmt::format("[{:#<{}}{:.<{}}]{}", "", full, "", room - full, text);
    }
    erase();
    out_ << text.substr(0, static_cast<size_t>(width_ - 1)) << std::flush;
    drawn_ = clock_();
    last_ = name;
  }

  int width_;
  double drawn_ = -1;
  std::string last_;
};

}  // namespace

ProgressKind parseProgressKind(std::string_view name) {
  const std::vector<std::string> names = {"auto", "plain", "openjd", "none"};
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw UsageError(fmt::format("progress '{}' is not one of {}{}", name, listNames(names),
                                 didYouMean(name, names)));
  return static_cast<ProgressKind>(found - names.begin());
}

std::unique_ptr<ProgressSink> makeProgress(ProgressKind kind, std::ostream& out, bool terminal,
                                           int width, ProgressClock clock) {
  if (!clock) clock = steadySeconds;
  switch (kind) {
    case ProgressKind::none:
      return std::make_unique<SilentSink>(out, std::move(clock));
    case ProgressKind::openjd:
      return std::make_unique<OpenJdSink>(out, std::move(clock));
    case ProgressKind::automatic:
      if (terminal) return std::make_unique<BarSink>(out, width, std::move(clock));
      [[fallthrough]];
    case ProgressKind::plain:
      break;
  }
  return std::make_unique<PlainSink>(out, std::move(clock));
}

std::string formatDuration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0 || seconds > 3.6e8) return "?";
  const auto whole = static_cast<int64_t>(std::llround(seconds));
  const int64_t hours = whole / 3600;
  if (hours == 0) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", hours, whole / 60 % 60, whole % 60);
}

}  // namespace kagefude
