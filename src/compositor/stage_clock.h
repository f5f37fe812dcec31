#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace kagefude {

/// Times the stages of a frame: each lap ends the stage that it names.
class StageClock {
 public:
  struct Lap {
    std::string stage;
    double seconds = 0;
  };

  void lap(std::string stage) {
    const Clock::time_point now = Clock::now();
    laps_.push_back({std::move(stage), std::chrono::duration<double>(now - last_).count()});
    last_ = now;
  }
  const std::vector<Lap>& laps() const { return laps_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
  std::vector<Lap> laps_;
};

/// lap() of a clock that may be absent.
inline void lap(StageClock* clock, const std::string& stage) {
  if (clock) clock->lap(stage);
}

}  // namespace kagefude
