#include "frame/coverage_planes.h"

#include <algorithm>
#include <numeric>

#include "image/parallel.h"

namespace kagefude {
namespace {

constexpr float least = -0.5f, most = 1.5f;

bool isPossible(float share) { return share >= least && share <= most; }

bool isPossible(const CoveragePlanes& coverage, int x, int y) {
  for (size_t rank = 0; rank < coverage.ranks(); ++rank)
    if (!isPossible(coverage.share(rank, x, y))) return false;
  return true;
}

/// Asked of whole rows, which is faster than by pixel; what a rank does not keep is 0.
bool isPossible(const CoveragePlanes& coverage, int y) {
  int wrong = 0;
  const float* const first = coverage.firstShare.row(y);
  for (int x = 0; x < coverage.firstShare.width(); ++x) wrong += !isPossible(first[x]);
  for (const SparsePlane& shares : coverage.otherShares)
    for (const uint32_t word : shares.keptOf(y)) wrong += !isPossible(std::bit_cast<float>(word));
  return wrong == 0;
}

size_t clearImpossible(CoveragePlanes& coverage, int y) {
  if (isPossible(coverage, y)) return 0;
  size_t count = 0;
  for (int x = 0; x < coverage.firstShare.width(); ++x) {
    if (isPossible(coverage, x, y)) continue;
    coverage.firstShare(x, y) = 1.0f;
    for (SparsePlane& shares : coverage.otherShares) shares.clear(x, y);
    ++count;
  }
  return count;
}

/// The id that covers most of a pixel.
uint32_t dominantAt(const CoveragePlanes& coverage, int x, int y) {
  float largest = 0.0f;
  uint32_t id = 0;
  for (size_t rank = 0; rank < coverage.ranks(); ++rank) {
    const float share = coverage.share(rank, x, y);
    if (!(share > largest)) continue;
    largest = share;
    id = coverage.id(rank, x, y);
  }
  return id;
}

}  // namespace

size_t clearImpossibleCoverage(CoveragePlanes& coverage) {
  // Counted by row, so nothing is shared between threads.
  std::vector<size_t> counts(static_cast<size_t>(coverage.firstShare.height()), 0);
  parallelRows(coverage.firstShare.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y) counts[static_cast<size_t>(y)] = clearImpossible(coverage, y);
  });
  return std::accumulate(counts.begin(), counts.end(), size_t{0});
}

Labels dominantIds(const CoveragePlanes& coverage) {
  if (coverage.empty()) return {};
  Labels dominant(coverage.firstId.width(), coverage.firstId.height());
  parallelRows(dominant.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < dominant.width(); ++x) dominant(x, y) = dominantAt(coverage, x, y);
  });
  return dominant;
}

}  // namespace kagefude
