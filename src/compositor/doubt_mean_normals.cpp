#include "compositor/doubt_mean_normals.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "image/parallel.h"
#include "passes/edges/coverage_blend.h"

namespace kagefude {
namespace {

constexpr auto remedy = "export the frame again";

/// Pixels that show something, and those of them whose mean cannot be.
struct MeanFaults {
  size_t seen = 0, notFinite = 0, tooLong = 0, zero = 0;
  size_t all() const { return notFinite + tooLong + zero; }
  void add(const MeanFaults& other) {
    seen += other.seen;
    notFinite += other.notFinite;
    tooLong += other.tooLong;
    zero += other.zero;
  }
};

float coveredAt(const FramePlanes& planes, int x, int y) {
  float sum = 0;
  for (size_t rank = 0; rank < planes.coverage.ranks(); ++rank)
    if (planes.coverage.id(rank, x, y) != 0) sum += planes.coverage.share(rank, x, y);
  return sum;
}

void checkRow(int y, FramePlanes& planes, MeanFaults& faults) {
  constexpr float longest = 1.25f, unknown = std::numeric_limits<float>::quiet_NaN();
  for (int x = 0; x < planes.width; ++x) {
    const V3f mean = planes.meanNormal.view()(x, y);
    const float square = mean.dot(mean);
    const bool object = planes.objectId(x, y) != 0;
    const bool ordinary = square > 0 && square <= longest * longest;
    if (ordinary && object) ++faults.seen;
    if (ordinary) continue;
    const float covered = coveredAt(planes, x, y);
    const bool seen = object || covered >= smallestShare;
    faults.seen += seen ? 1 : 0;
    const bool zero = square == 0;
    if (zero && !(object && covered >= fullShare)) continue;
    const bool finite = std::isfinite(mean.x) && std::isfinite(mean.y) && std::isfinite(mean.z);
    planes.meanNormal.set(x, y, V3f(unknown));
    if (seen) ++(zero ? faults.zero : finite ? faults.tooLong : faults.notFinite);
  }
}

/// Counted by row, so nothing is shared between threads.
MeanFaults clearImpossible(FramePlanes& planes) {
  std::vector<MeanFaults> rows(static_cast<size_t>(planes.height));
  parallelRows(planes.height, [&](int first, int end) {
    for (int y = first; y < end; ++y) checkRow(y, planes, rows[static_cast<size_t>(y)]);
  });
  MeanFaults all;
  for (const MeanFaults& row : rows) all.add(row);
  return all;
}

std::string listFaults(const MeanFaults& faults) {
  std::vector<std::string> found;
  const auto note = [&](size_t count, const char* what) {
    if (count) found.push_back(fmt::format("{} in {}", what, count));
  };
  note(faults.notFinite, "NaN, Inf or outside of its part");
  note(faults.tooLong, "longer than a mean of normals");
  note(faults.zero, "0 under things that cover the pixel");
  return fmt::format("{} of the {} pixels that show something", fmt::join(found, ", "),
                     faults.seen);
}

/// Whether one flat thing covers the pixel and those round it.
bool isFlat(const FramePlanes& planes, int x, int y) {
  constexpr float same = 0.1f;
  const uint32_t own = planes.objectId(x, y);
  if (own == 0 || !(planes.coverage.firstShare(x, y) >= fullShare)) return false;
  const V3f normal = planes.normal.view()(x, y);
  for (int qy = y - 1; qy <= y + 1; ++qy)
    for (int qx = x - 1; qx <= x + 1; ++qx) {
      if (planes.objectId(qx, qy) != own) return false;
      const V3f off = planes.normal.view()(qx, qy) - normal;
      if (!(off.dot(off) <= same * same)) return false;
    }
  return true;
}

struct FlatPixels {
  size_t all = 0, off = 0;
};

/// Of some 16,000 places.
FlatPixels compareFlat(const FramePlanes& planes) {
  constexpr double wanted = 16384;
  constexpr float near = 0.25f;
  const double pixels = static_cast<double>(planes.width) * planes.height;
  const int stride = std::max(1, static_cast<int>(std::sqrt(pixels / wanted)));
  FlatPixels flat;
  for (int y = 1; y < planes.height - 1; y += stride)
    for (int x = 1; x < planes.width - 1; x += stride) {
      const V3f off = planes.meanNormal.view()(x, y) - planes.normal.view()(x, y);
      const float square = off.dot(off);
      if (!std::isfinite(square) || !isFlat(planes, x, y)) continue;
      ++flat.all;
      if (square > near * near) ++flat.off;
    }
  return flat;
}

}  // namespace

void checkMeanNormals(const FramePlan& plan, FramePlanes& planes) {
  constexpr size_t fewestFlat = 32;
  std::vector<std::string>& warnings = planes.meanWarnings;
  if (!plan.meanNormalFault.empty())
    warnings.push_back(fmt::format("{}; {}", plan.meanNormalFault, remedy));
  if (planes.meanNormal.empty() || planes.coverage.empty()) return;
  const std::string pass = plan.meanNormal[0].substr(0, plan.meanNormal[0].rfind('.'));
  const MeanFaults faults = clearImpossible(planes);
  if (2 * faults.all() > faults.seen) {
    planes.meanNormal = {};
    warnings.push_back(fmt::format("{} is {}, so edges are mixed without it; {}", pass,
                                   listFaults(faults), remedy));
    return;
  }
  const FlatPixels flat = compareFlat(planes);
  if (flat.all >= fewestFlat && 2 * flat.off > flat.all) {
    planes.meanNormal = {};
    warnings.push_back(
        fmt::format("{} is not the normal on {} of {} flat pixels, so it is of another space or "
                    "frame, and edges are mixed without it; {}",
                    pass, flat.off, flat.all, remedy));
  }
  if (faults.all() && !planes.meanNormal.empty())
    warnings.push_back(fmt::format("{} is {}, where edges are mixed without it; {}", pass,
                                   listFaults(faults), remedy));
}

}  // namespace kagefude
