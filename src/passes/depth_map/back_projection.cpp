#include "passes/depth_map/back_projection.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <list>
#include <vector>

#include "image/parallel.h"
#include "passes/depth_map/back_projector.h"
#include "passes/require_size.h"

namespace kagefude {
namespace {

constexpr float sameShade = 0.1f;  ///< spread of corners between which is interpolated

/// Pixels between the coarsest answers of a frame: shadows are as much wider as frames are.
int coarsestStep(size_t pixels) {
  return pixels > size_t{1} << 22 ? 8 : (pixels > size_t{1} << 18 ? 4 : 1);
}

/// 1 for each pixel of a row that wants an answer, else 0.
void markWanted(const Receivers& in, int y, uint8_t* wants) {
  const uint32_t* const labels = in.labels.row(y);
  const uint8_t* const wanted = in.wanted.empty() ? nullptr : in.wanted.row(y);
  for (int x = 0; x < in.labels.width; ++x)
    wants[x] = (labels[x] != 0) & (wanted ? wanted[x] != 0 : true);
}

/// The first byte from `at` on that is not 0, or `end`. Most of a row is not asked for: eight at a
/// time.
const uint8_t* nextMarked(const uint8_t* at, const uint8_t* end) {
  for (uint64_t eight; end - at >= 8; at += 8) {
    std::memcpy(&eight, at, 8);
    if (eight != 0) break;
  }
  return std::find_if(at, end, [](uint8_t mark) { return mark != 0; });
}

/// Squares of 2, 4 and 8 pixels in which a pixel wants an answer.
class WantedCells {
 public:
  WantedCells(const Receivers& in, int coarsest) {
    if (coarsest < 2) return;
    levels_.reserve(static_cast<size_t>(std::countr_zero(unsigned(coarsest))));
    levels_.push_back(joined(in.labels.width, in.labels.height,
                             [&](int y, uint8_t* wants) { markWanted(in, y, wants); }));
    for (int side = 4; side <= coarsest; side *= 2)
      levels_.push_back(joined(levels_.back().width(), levels_.back().height(),
                               [&finer = levels_.back()](int y, uint8_t* wants) {
                                 std::copy_n(finer.row(y), finer.width(), wants);
                               }));
  }

  /// Whether a pixel less than `step` from one of the answers of that step wants one.
  bool near(int step, int i, int j) const {
    const Bytes& cells = levels_[static_cast<size_t>(std::countr_zero(unsigned(step))) - 1];
    for (int row = std::max(0, j - 1); row <= j; ++row)
      for (int column = std::max(0, i - 1); column <= i; ++column)
        if (cells(column, row)) return true;
    return false;
  }

 private:
  static void halve(const uint8_t* upper, const uint8_t* lower, int count, uint8_t* out) {
    for (int x = 0; x < count; ++x)
      out[x] = upper[2 * x] | upper[2 * x + 1] | lower[2 * x] | lower[2 * x + 1];
  }
  /// Halves a plane of 0 and 1, of which read(y, row) gives a row; what any of the four wants is
  /// wanted.
  template <class Read>
  static Bytes joined(int width, int height, const Read& read) {
    Bytes cells((width + 1) / 2, (height + 1) / 2);
    parallelRows(cells.height(), [&](int y0, int y1) {
      const auto wide = static_cast<size_t>(2 * cells.width());
      std::vector<uint8_t> upper(wide, uint8_t{0}), lower(wide, uint8_t{0});
      for (int y = y0; y < y1; ++y) {
        read(2 * y, upper.data());
        read(std::min(2 * y + 1, height - 1), lower.data());
        halve(upper.data(), lower.data(), cells.width(), cells.row(y));
      }
    });
    return cells;
  }

  std::vector<Bytes> levels_;
};

/// Answers at every step-th pixel of every step-th row. Finer ones ask coarser ones first: a
/// penumbra that is wide there is interpolated.
class AnswerGrid {
 public:
  /// coarser: of twice the step or nullptr. All but `wanted` must outlive this.
  AnswerGrid(const BackProjector& projector, const Receivers& in, const WantedCells& wanted,
             int step, const AnswerGrid* coarser)
      : projector_(projector),
        in_(in),
        step_(step),
        answers_((in.labels.width - 1) / step + 1, (in.labels.height - 1) / step + 1),
        known_(answers_.width(), answers_.height(), uint8_t{0}) {
    parallelRows(answers_.height(), 4, [&](int y0, int y1) {
      for (int j = y0; j < y1; ++j)
        for (int i = 0; i < answers_.width(); ++i) {
          const int x = i * step, y = j * step;
          if (in.labels(x, y) == 0 || !wanted.near(step, i, j)) continue;
          answers_(i, j) = coarser ? coarser->at(x, y) : projector.at(in, x, y);
          known_(i, j) = 1;
        }
    });
  }

  /// Interpolated where the pixels around are of the same surface and shade, else the projector's.
  PixelAnswer at(int x, int y) const {
    const int i = x / step_, j = y / step_;
    if (x % step_ == 0 && y % step_ == 0) return answers_(i, j);
    if (i + 1 >= answers_.width() || j + 1 >= answers_.height()) return projector_.at(in_, x, y);
    const PixelAnswer* const corners[] = {&answers_(i, j), &answers_(i + 1, j), &answers_(i, j + 1),
                                          &answers_(i + 1, j + 1)};
    float least = 1, most = 0;
    for (const PixelAnswer* corner : corners) {
      least = std::min(least, corner->visibility);
      most = std::max(most, corner->visibility);
    }
    const bool flat = least == most && (least == 0 || least == 1);
    if (most - least > sameShade || !isSameSurface(i, j, in_.labels(x, y)) ||
        (flat && projector_.masksDisagree(x, y)))
      return projector_.at(in_, x, y);
    const float across = static_cast<float>(x % step_) / static_cast<float>(step_);
    const float down = static_cast<float>(y % step_) / static_cast<float>(step_);
    const auto mix = [&](const auto& of) {
      const float upper = of(*corners[0]) + (of(*corners[1]) - of(*corners[0])) * across;
      const float lower = of(*corners[2]) + (of(*corners[3]) - of(*corners[2])) * across;
      return upper + (lower - upper) * down;
    };
    return {
        mix([](const PixelAnswer& a) { return a.visibility; }),
        static_cast<uint8_t>(
            mix([](const PixelAnswer& a) { return static_cast<float>(a.contradicted); }) + 0.5f)};
  }

 private:
  /// Whether the four answers from (i, j) on are known and of the surface.
  bool isSameSurface(int i, int j, uint32_t label) const {
    for (int row = j; row <= j + 1; ++row)
      for (int column = i; column <= i + 1; ++column)
        if (!known_(column, row) || in_.labels(column * step_, row * step_) != label) return false;
    return true;
  }

  const BackProjector& projector_;
  const Receivers& in_;
  int step_;
  Plane<PixelAnswer> answers_;
  Bytes known_;
};

}  // namespace

BackProjection backProject(Vec3View position, Vec3View normal, View<const uint32_t> labels,
                           const ShadowMap& map, float lightRadius, float bias,
                           std::span<const PlacedMask> masks, View<const uint8_t> wanted) {
  const int width = labels.width, height = labels.height;
  if (map.depth.empty()) throw InputError("the light's depth map is empty");
  if (masks.size() > mostMasks)
    throw InputError(
        fmt::format("a light has at most {} shadow masks, not {}", mostMasks, masks.size()));
  requireSize("the position pass", position, width, height);
  requireSize("the normal pass", normal, width, height);
  for (const PlacedMask& mask : masks) requireSize("a mask", mask.mask, width, height);
  if (!wanted.empty()) requireSize("the wanted pixels", wanted, width, height);
  const BackProjector projector(map, lightRadius, bias, masks);
  const Receivers in{position, normal, labels, wanted};
  const int coarsest = coarsestStep(labels.pixels());
  const WantedCells cells(in, coarsest);
  std::list<AnswerGrid> grids;
  for (int step = coarsest; step > 1; step /= 2)
    grids.emplace_back(projector, in, cells, step, grids.empty() ? nullptr : &grids.back());
  BackProjection result{Floats(width, height), Bytes(width, height)};
  parallelRows(height, [&](int y0, int y1) {
    std::vector<uint8_t> asked(static_cast<size_t>(width));
    for (int y = y0; y < y1; ++y) {
      markWanted(in, y, asked.data());
      std::fill_n(result.visibility.row(y), width, 1.0f);
      std::fill_n(result.contradicted.row(y), width, uint8_t{0});
      const uint8_t* const end = asked.data() + width;
      for (const uint8_t* at = nextMarked(asked.data(), end); at != end;
           at = nextMarked(at + 1, end)) {
        const auto x = static_cast<int>(at - asked.data());
        const PixelAnswer answer = grids.empty() ? projector.at(in, x, y) : grids.back().at(x, y);
        result.visibility(x, y) = answer.visibility;
        result.contradicted(x, y) = answer.contradicted;
      }
    }
  });
  return result;
}

}  // namespace kagefude
