#include "sequence/bench_frame.h"

#include <sys/resource.h>

#include <algorithm>

#include "base/error.h"
#include "base/frame_pattern.h"
#include "compositor/compose_frame.h"
#include "compositor/look_colour.h"
#include "compositor/read_frame.h"
#include "compositor/write_frame.h"

namespace kagefude {
namespace {

size_t peakResidentBytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<size_t>(usage.ru_maxrss) * 1024;
}

std::vector<StageClock::Lap> runOnce(const Look& look, const StripSet& strips,
                                     const std::filesystem::path& input,
                                     const std::filesystem::path& output, FrameBench& bench) {
  StageClock clock;
  const FramePlan plan = planFrame(look, input, frameNumberOf(input.string()).value_or(1));
  FramePlanes planes = readFramePlanes(plan);
  bench.width = planes.width;
  bench.height = planes.height;
  bench.channels = static_cast<int>(plan.image.channels.size());
  clock.lap("read");
  const FrameResult result = composeFrame(look, strips, plan, std::move(planes), nullptr, &clock);
  clock.lap("background and layers");
  writeFrame(look, plan, result, output, {});
  clock.lap("write");
  std::filesystem::remove(output);
  return clock.laps();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

FrameBench benchFrame(const Look& look, const std::filesystem::path& input,
                      const std::filesystem::path& output, int rounds) {
  if (rounds < 1) throw UsageError("a benchmark takes at least one round");
  const Colour colour = colourOf(look);
  const StripSet strips(look, colour);
  FrameBench bench;
  std::vector<std::vector<double>> seconds;
  for (int round = -1; round < rounds; ++round) {
    const std::vector<StageClock::Lap> laps = runOnce(look, strips, input, output, bench);
    if (round < 0) {
      for (const StageClock::Lap& lap : laps) bench.stages.push_back({lap.stage, 0});
      seconds.resize(laps.size());
      continue;
    }
    for (size_t i = 0; i < laps.size(); ++i) seconds[i].push_back(laps[i].seconds);
  }
  for (size_t i = 0; i < seconds.size(); ++i) bench.stages[i].seconds = median(seconds[i]);
  bench.peakBytes = peakResidentBytes();
  return bench;
}

}  // namespace kagefude
