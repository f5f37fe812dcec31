#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "look/look.h"

namespace kagefude {

/// Median time of one stage of a frame.
struct StageTime {
  std::string stage;
  double seconds = 0;
};

struct FrameBench {
  int width = 0, height = 0, channels = 0;  ///< of the input
  std::vector<StageTime> stages;            ///< in order; their sum is a frame's time
  size_t peakBytes = 0;                     ///< resident memory of the process at its largest
};

/// Comps one frame `rounds` times, and once before that, and takes each stage's median: reading,
/// every pass, writing to `output`, which is removed. Throws as comp does, and UsageError for fewer
/// than one round.
FrameBench benchFrame(const Look& look, const std::filesystem::path& input,
                      const std::filesystem::path& output, int rounds);

}  // namespace kagefude
