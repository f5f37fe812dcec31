#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

// Contenders take turns inside one benchmark, so that drift hits all alike; only ratios of their
// medians mean anything.
namespace kagefude::bench {

using Contender = std::function<void()>;

/// Median seconds of each contender over the rounds, after one round that is not counted: it is
/// the first to touch memory.
inline std::vector<double> contest(const std::vector<Contender>& contenders, int rounds = 7) {
  using Clock = std::chrono::steady_clock;
  std::vector<std::vector<double>> times(contenders.size());
  for (int round = -1; round < rounds; ++round)
    for (size_t i = 0; i < contenders.size(); ++i) {
      const auto start = Clock::now();
      contenders[i]();
      const std::chrono::duration<double> taken = Clock::now() - start;
      if (round >= 0) times[i].push_back(taken.count());
    }
  std::vector<double> medians;
  for (std::vector<double>& t : times) {
    std::nth_element(t.begin(), t.begin() + rounds / 2, t.end());
    medians.push_back(t[static_cast<size_t>(rounds / 2)]);
  }
  return medians;
}

/// What gates.py prints a line of: our time and the peer's, and the factor by which we are to be
/// faster at least (0: no gate).
inline void record(benchmark::State& state, const std::string& peer, double ours, double theirs,
                   double gate) {
  state.SetLabel(peer);
  state.counters["ours_ms"] = 1e3 * ours;
  state.counters["peer_ms"] = 1e3 * theirs;
  state.counters["ratio"] = theirs / ours;
  state.counters["gate"] = gate;
}

}  // namespace kagefude::bench
