#include "passes/edges/behind_paint.h"

#include <algorithm>
#include <limits>

#include "image/clones.h"
#include "image/parallel.h"
#include "passes/strip/strip.h"

namespace kagefude {
namespace {

class Backdrop {
 public:
  Backdrop(const ColourViews& picture, std::span<const CoverageRank> ranks)
      : picture_(picture), ranks_(ranks) {}

  Rgba at(int x, int y) const {
    return Rgba{picture_.r(x, y), picture_.g(x, y), picture_.b(x, y), alpha(x, y)};
  }

  /// Share of the pixel that painted things cover, 0..1.
  float covered(int x, int y) const {
    float sum = 0;
    for (const CoverageRank& rank : ranks_) {
      const float share = rank.coverage(x, y);
      if (rank.id(x, y) != 0 && share >= smallestShare) sum += share;
    }
    return std::min(sum, 1.0f);
  }

  /// What is seen beside the things that cover the share `covered`, below 1, of the pixel.
  Rgba beside(int x, int y, float covered) const {
    Rgba behind;
    if (!openMean(x, y, 1, behind) && !openMean(x, y, 2, behind)) behind = unmixed(x, y);
    const float known = (alpha(x, y) - covered) / (1.0f - covered);
    return known < behind[3] ? behind * (std::max(known, 0.0f) / behind[3]) : behind;
  }

 private:
  bool contains(int x, int y) const { return picture_.r.contains(x, y); }
  float alpha(int x, int y) const { return picture_.a.empty() ? 1.0f : picture_.a(x, y); }

  /// Mean of the pixels without painted things within `radius`; false when there is none.
  bool openMean(int x, int y, int radius, Rgba& mean) const {
    Rgba sum{};
    int count = 0;
    for (int qy = y - radius; qy <= y + radius; ++qy)
      for (int qx = x - radius; qx <= x + radius; ++qx)
        if (contains(qx, qy) && covered(qx, qy) == 0.0f) {
          sum += at(qx, qy);
          ++count;
        }
    if (count == 0) return false;
    mean = sum / static_cast<float>(count);
    return true;
  }

  /// Least squares of picture = c thing + (1 - c) behind over the 5x5.
  Rgba unmixed(int x, int y) const {
    // Below this the 5x5's coverages differ by less than a tenth, and noise would decide.
    constexpr float leastSpread = 0.01f;
    float cc = 0, co = 0, oo = 0;
    int count = 0;
    Rgba byCovered{}, byOpen{};
    Rgba most = Rgba{} + std::numeric_limits<float>::max();
    for (int qy = y - 2; qy <= y + 2; ++qy)
      for (int qx = x - 2; qx <= x + 2; ++qx) {
        if (!contains(qx, qy)) continue;
        const float c = covered(qx, qy), open = 1.0f - c;
        const Rgba seen = at(qx, qy);
        cc += c * c;
        co += c * open;
        oo += open * open;
        byCovered += seen * c;
        byOpen += seen * open;
        for (int k = 0; k < 4 && open > 0.0f; ++k) most[k] = std::min(most[k], seen[k] / open);
        ++count;
      }
    // The determinant is n² times the variance of the coverages.
    const float spread = cc * oo - co * co;
    if (!(spread > leastSpread * static_cast<float>(count * count))) return at(x, y);
    const Rgba best = (byOpen * cc - byCovered * co) / spread;
    Rgba behind{};
    for (int k = 0; k < 4; ++k) behind[k] = std::max(0.0f, std::min(best[k], most[k]));
    return behind;
  }

  const ColourViews& picture_;
  std::span<const CoverageRank> ranks_;
};

Rgba behindPaint(const Backdrop& backdrop, float alpha, int x, int y) {
  const Rgba picture = backdrop.at(x, y);
  if (!(alpha > 0.0f)) return picture;
  if (alpha >= 1.0f) return Rgba{};
  const float covered = backdrop.covered(x, y);
  if (covered <= 0.0f || covered >= 1.0f) return picture * (1.0f - alpha);
  const float gaps = std::max(covered - alpha, 0.0f);
  return backdrop.beside(x, y, covered) * (1.0f - covered) + picture * gaps;
}

/// What paint leaves open at each pixel; false where it leaves nothing.
KAGEFUDE_CLONES bool leftOpen(const float* alpha, int count, float* behind) {
  int any = 0;
  for (int i = 0; i < count; ++i) {
    behind[i] = 1.0f - alpha[i];
    any |= behind[i] != 0.0f;
  }
  return any != 0;
}

/// Pixels that paint covers keep their bits.
KAGEFUDE_CLONES void layRun(float* paint, const float* under, const float* behind, int count) {
  for (int i = 0; i < count; ++i) {
    const float laid = paint[i] + behind[i] * under[i];
    paint[i] = behind[i] != 0.0f ? laid : paint[i];
  }
}

}  // namespace

void PictureGround::read(int x, int y, int count, ColourRun& run) const {
  std::copy_n(picture_.r.row(y) + x, count, run.r);
  std::copy_n(picture_.g.row(y) + x, count, run.g);
  std::copy_n(picture_.b.row(y) + x, count, run.b);
  std::copy_n(picture_.a.row(y) + x, count, run.a);
}

void layOver(const PaintViews& paint, const PaintGround& ground) {
  const int width = paint.a.width;
  parallelRows(paint.a.height, [&](int first, int end) {
    ColourRun under;
    float behind[ColourRun::most];
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; x += ColourRun::most) {
        const int count = std::min(width - x, ColourRun::most);
        if (!leftOpen(paint.a.row(y) + x, count, behind)) continue;
        ground.read(x, y, count, under);
        layRun(paint.r.row(y) + x, under.r, behind, count);
        layRun(paint.g.row(y) + x, under.g, behind, count);
        layRun(paint.b.row(y) + x, under.b, behind, count);
        layRun(paint.a.row(y) + x, under.a, behind, count);
      }
  });
}

void layOverPicture(const PaintViews& paint, const ColourViews& picture,
                    std::span<const CoverageRank> ranks) {
  const Backdrop backdrop(picture, ranks);
  parallelRows(paint.r.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < paint.r.width; ++x) {
        const Rgba behind = behindPaint(backdrop, paint.a(x, y), x, y);
        paint.r(x, y) += behind[0];
        paint.g(x, y) += behind[1];
        paint.b(x, y) += behind[2];
        paint.a(x, y) += behind[3];
      }
  });
}

}  // namespace kagefude
