#include "compositor/mend_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "image/parallel.h"
#include "passes/edges/coverage_blend.h"

namespace kagefude {
namespace {

bool isCovered(const CoveragePlanes& coverage, int x, int y) {
  for (size_t rank = 0; rank < coverage.ranks(); ++rank)
    if (coverage.id(rank, x, y) != 0 && coverage.share(rank, x, y) >= smallestShare) return true;
  return false;
}

/// Whether the 3x3, as far as it lies in the picture, shows one thing.
template <class Seen>
bool isInside(const Seen& seen, View<const float> picture, int x, int y) {
  const uint32_t own = seen(x, y);
  for (int qy = y - 1; qy <= y + 1; ++qy)
    for (int qx = x - 1; qx <= x + 1; ++qx)
      if (picture.contains(qx, qy) && seen(qx, qy) != own) return false;
  return true;
}

/// Counted by row, so nothing is shared between threads.
template <class Is>
size_t countPixels(View<const float> picture, const Is& is) {
  std::vector<size_t> counts(static_cast<size_t>(picture.height), 0);
  parallelRows(picture.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < picture.width; ++x) counts[static_cast<size_t>(y)] += is(x, y) ? 1 : 0;
  });
  return std::accumulate(counts.begin(), counts.end(), size_t{0});
}

/// `seen` gives what stands at a pixel's centre, 0 for nothing; `named` its id in the ranks.
template <class Seen, class Named>
MendedCoverage mend(CoveragePlanes& coverage, const Seen& seen, const Named& named) {
  MendedCoverage mended;
  if (coverage.empty()) return mended;
  mended.impossible = clearImpossibleCoverage(coverage);
  const View<const float> picture = coverage.firstShare;
  const auto bare = [&](int x, int y) { return seen(x, y) != 0 && !isCovered(coverage, x, y); };
  const auto damaged = [&](int x, int y) {
    return bare(x, y) && isInside(seen, picture, x, y) && named(seen(x, y)) != 0;
  };
  if (countPixels(picture, damaged) == 0) return mended;
  mended.none = countPixels(picture, [&](int x, int y) {
    const uint32_t id = bare(x, y) ? named(seen(x, y)) : 0;
    if (id == 0) return false;
    coverage.firstId(x, y) = id;
    coverage.firstShare(x, y) = 1.0f;
    return true;
  });
  return mended;
}

}  // namespace

MendedCoverage mendCoverage(const FramePlan& plan, FramePlanes& planes) {
  return mend(
      planes.coverage, [&](int x, int y) { return planes.objectId(x, y); },
      [&](uint32_t object) { return plan.cryptomatteIdOf(object); });
}

MendedCoverage mendNamed(const Vec3Plane& normal, CoveragePlanes& matte) {
  return mend(
      matte,
      [&](int x, int y) { return normal.view()(x, y) == V3f(0.0f) ? 0u : matte.firstId(x, y); },
      [](uint32_t id) { return id; });
}

void noteMended(const std::string& name, const MendedCoverage& mended,
                std::vector<std::string>& warnings) {
  const auto note = [&](size_t count, const char* what) {
    std::string sentence = fmt::format(fmt::runtime(what), name, count, count == 1 ? "" : "s");
    // Ids and edges are read from one Cryptomatte, and say the same.
    if (count && std::find(warnings.begin(), warnings.end(), sentence) == warnings.end())
      warnings.push_back(std::move(sentence));
  };
  note(mended.impossible,
       "the coverage of {} is NaN, Inf, or far from 0 to 1 in {} pixel{}, taken as wholly its "
       "first id; export the frame again");
  note(mended.none,
       "{} covers nothing in {} pixel{} where things are seen, taken as wholly theirs; export the "
       "frame again");
}

}  // namespace kagefude
