#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>

namespace kagefude {

/// Calls body(firstRow, endRow) over [0, rows) in bands of at most `grain` rows, on the process's
/// one thread pool. The cut into bands is fixed by `grain` alone, never by the number of threads;
/// bodies must write only their own rows, so results are the same whatever the schedule.
template <class Body>
void parallelRows(int rows, int grain, const Body& body) {
  const int bands = (rows + grain - 1) / grain;
  tbb::parallel_for(0, bands, [&](int band) {
    const int first = band * grain;
    body(first, std::min(first + grain, rows));
  });
}

template <class Body>
void parallelRows(int rows, const Body& body) {
  parallelRows(rows, 16, body);
}

}  // namespace kagefude
