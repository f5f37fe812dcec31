#include "compositor/frame_ground.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "compositor/frame_edges.h"
#include "image/parallel.h"
#include "passes/ground/behind_things.h"
#include "passes/ground/fitted_picture.h"
#include "passes/ground/painted_sky.h"
#include "passes/ground/paper_deposit.h"
#include "passes/search/nearest_site.h"

namespace kagefude {
namespace {

SkyView skyView(const FinishInput& in) {
  const Window& data = in.plan.image.dataWindow;
  const Window& display = in.plan.image.displayWindow;
  SkyView view{in.planes.width,    in.planes.height, data.x - display.x,
               data.y - display.y, display.width,    display.height};
  view.rays = in.planes.rays ? &*in.planes.rays : nullptr;
  view.upIsY = in.look.frame.up == WorldUp::y;
  return view;
}

/// One colour, with the paper's light and shade where there is paper.
class FlatGround : public PaintGround {
 public:
  /// `surface` and `paper` must outlive it.
  FlatGround(const std::vector<float>& colour, const PaperSurface& surface,
             const PaperParams& paper)
      : colour_(colour[0], colour[1], colour[2]), surface_(surface), paper_(paper) {}

  void read(int x, int y, int count, ColourRun& run) const override {
    ToothRun tooth;
    if (surface_.empty())
      std::fill_n(tooth.slope, count, 0.0f);
    else
      surface_.read(x, y, count, tooth);
    shadeFlat(colour_, tooth.slope, count, paper_, run);
  }

 private:
  const V3f colour_;
  const PaperSurface& surface_;
  const PaperParams& paper_;
};

/// Whether no painted thing has a part of the pixel.
bool isOpen(const FinishInput& in, View<const float> alpha, int x, int y) {
  return in.styled.anchorIndex(x, y) == 0 && alpha(x, y) == 0.0f;
}

ColourViews beautyOf(const FinishInput& in) {
  const Vec3Plane& beauty = in.planes.beauty;
  return {beauty.x, beauty.y, beauty.z, in.planes.alpha};
}

/// The beauty where nothing is painted, and beside what is.
ColourPlanes openBeauty(const FinishInput& in, View<const float> alpha) {
  Bytes open(in.planes.width, in.planes.height);
  parallelRows(in.planes.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < in.planes.width; ++x) open(x, y) = isOpen(in, alpha, x, y) ? 1 : 0;
  });
  return extendBehindThings(beautyOf(in), open);
}

/// What differs from a whole pixel by less is rounding.
constexpr float wholly = 1.0f - 1.0f / 65536.0f;

/// Share of each pixel that painted things cover.
float coveredShare(const FinishInput& in, int x, int y) {
  const CoveragePlanes& coverage = in.planes.coverage;
  if (coverage.empty()) return in.styled.anchorIndex(x, y) != 0 ? 1.0f : 0.0f;
  float sum = 0;
  for (size_t rank = 0; rank < coverage.ranks() && sum < 1.0f; ++rank)
    if (coverage.id(rank, x, y) != 0) sum += coverage.share(rank, x, y);
  return std::min(sum, 1.0f);
}

/// The beauty, and paper under the things that stand before it, by what of them the paint leaves
/// open. Most of a picture is the one or the other; only what is in between is kept.
class PaperedBeauty : public PaintGround {
 public:
  /// `in` and `paper` must outlive it.
  PaperedBeauty(const FinishInput& in, View<const float> alpha, const PaintGround& paper)
      : beauty_(beautyOf(in)),
        paper_(paper),
        kinds_(in.planes.width, in.planes.height),
        between_(static_cast<size_t>(in.planes.height)) {
    std::vector<int> counts(between_.size(), 0);
    parallelRows(kinds_.height(), [&](int first, int end) {
      for (int y = first; y < end; ++y) {
        judgeRow(in, alpha, y);
        const uint8_t* const row = kinds_.row(y);
        counts[static_cast<size_t>(y)] =
            static_cast<int>(std::count(row, row + kinds_.width(), between));
      }
    });
    if (std::any_of(counts.begin(), counts.end(), [](int count) { return count > 0; }))
      fillBetween(in, alpha, counts);
  }

  void read(int x, int y, int count, ColourRun& run) const override {
    const uint8_t* const kinds = kinds_.row(y) + x;
    const uint8_t* const end = kinds + count;
    if (std::find_if(kinds, end, [](uint8_t kind) { return kind != covered; }) == end)
      return paper_.read(x, y, count, run);
    if (std::find(kinds, end, covered) != end) paper_.read(x, y, count, run);
    const std::vector<Pixel>& row = between_[static_cast<size_t>(y)];
    auto next = std::lower_bound(row.begin(), row.end(), x,
                                 [](const Pixel& pixel, int column) { return pixel.x < column; });
    for (int i = 0; i < count; ++i) {
      if (kinds[i] == open)
        set(run, i, beauty_.r(x + i, y), beauty_.g(x + i, y), beauty_.b(x + i, y),
            beauty_.a.empty() ? 1.0f : beauty_.a(x + i, y));
      else if (kinds[i] == between) {
        set(run, i, next->r, next->g, next->b, next->a);
        ++next;
      }
    }
  }

 private:
  enum Kind : uint8_t { open = 1, covered = 2, between = 3 };
  struct Pixel {
    int x;
    float r, g, b, a;
  };

  static void set(ColourRun& run, int i, float r, float g, float b, float a) {
    run.r[i] = r;
    run.g[i] = g;
    run.b[i] = b;
    run.a[i] = a;
  }

  /// Most pixels show one thing wholly, or none: the first rank tells.
  void judgeRow(const FinishInput& in, View<const float> alpha, int y) {
    const CoveragePlanes& coverage = in.planes.coverage;
    const bool ranked = !coverage.empty();
    const uint16_t* const things = in.styled.anchorIndex.row(y);
    const uint32_t* const ids = ranked ? coverage.firstId.row(y) : nullptr;
    const float* const shares = ranked ? coverage.firstShare.row(y) : nullptr;
    const float* const alphas = alpha.row(y);
    uint8_t* const kinds = kinds_.row(y);
    const int width = kinds_.width();
    for (int x = 0; x < width; ++x) {
      const bool isCovered = ranked ? (ids[x] != 0) & (shares[x] >= wholly) : things[x] != 0;
      const bool isOpen = (things[x] == 0) & (alphas[x] == 0.0f);
      kinds[x] = isOpen ? open : isCovered ? covered : between;
    }
    if (ranked)
      for (int x = 0; x < kinds_.width(); ++x)
        if (kinds[x] == between && coveredShare(in, x, y) >= wholly) kinds[x] = covered;
  }

  void fillBetween(const FinishInput& in, View<const float> alpha, const std::vector<int>& counts) {
    std::atomic<bool> someFar = false;
    eachBetween([&](int y, std::vector<Pixel>& row) {
      row.reserve(static_cast<size_t>(counts[static_cast<size_t>(y)]));
      for (int x = 0; x < kinds_.width(); ++x) {
        if (kinds_(x, y) != between) continue;
        const uint32_t nearest = openNearby(kinds_, open, x, y);
        if (nearest == noSite) someFar = true;
        row.push_back(behindAt(nearest, x));
      }
    });
    const Labels nearest = someFar ? nearestOpen(kinds_, open, between) : Labels();
    eachBetween([&](int y, std::vector<Pixel>& row) {
      ColourRun paper;
      for (Pixel& pixel : row) {
        if (someFar) pixel = behindAt(nearest(pixel.x, y), pixel.x);
        const float share = paperShare(in, alpha(pixel.x, y), pixel.x, y);
        if (share <= 0.0f) continue;
        paper_.read(pixel.x, y, 1, paper);
        pixel.r += (paper.r[0] - pixel.r) * share;
        pixel.g += (paper.g[0] - pixel.g) * share;
        pixel.b += (paper.b[0] - pixel.b) * share;
        pixel.a += (paper.a[0] - pixel.a) * share;
      }
    });
  }

  /// Calls body(y, pixels) for every row.
  template <class Body>
  void eachBetween(const Body& body) {
    parallelRows(kinds_.height(), [&](int first, int end) {
      for (int y = first; y < end; ++y) body(y, between_[static_cast<size_t>(y)]);
    });
  }

  /// The open pixel `index`, as it stands behind one in the column x.
  Pixel behindAt(uint32_t index, int x) const {
    if (index == noSite) return {x, 0, 0, 0, 0};
    return {x, beauty_.r.data[index], beauty_.g.data[index], beauty_.b.data[index],
            beauty_.a.empty() ? 1.0f : beauty_.a.data[index]};
  }

  static float paperShare(const FinishInput& in, float alpha, int x, int y) {
    const float covered = coveredShare(in, x, y);
    if (covered <= 0.0f) return 0.0f;
    const float beside = 1.0f - covered, gaps = std::max(covered - alpha, 0.0f);
    return beside + gaps > 0.0f ? gaps / (beside + gaps) : 1.0f;
  }

  const ColourViews beauty_;
  const PaintGround& paper_;
  Bytes kinds_;
  std::vector<std::vector<Pixel>> between_;  ///< by rows, from left to right
};

bool paintHasGaps(const FinishInput& in) {
  return in.look.passes.paper.strength > 0.0f ||
         std::any_of(in.styled.edges.begin(), in.styled.edges.end(),
                     [](const PaintedEdgeParams& edges) { return edges.dry > 0.0f; });
}

/// A painted sky is paint as well, and lies on the paper.
ColourPlanes skyGround(const FinishInput& in, View<const float> alpha, const PaperSurface& surface,
                       const PaintGround& paper) {
  const GroundParams& params = in.look.passes.ground;
  const SkyView view = skyView(in);
  ColourPlanes beauty;
  if (params.row == GroundParams::Row::beauty && !in.planes.beauty.empty())
    beauty = openBeauty(in, alpha);
  const Floats tone = skyTone(view, params, {beauty.r, beauty.g, beauty.b});
  const Strip& strip = in.strips.strips()[static_cast<size_t>(in.strips.indexOf(params.strip))];
  ColourPlanes sky = paintSky(strip, tone, view, params);
  const float strength = in.look.passes.paper.strength;
  if (!(strength > 0.0f) && strip.opaque) return sky;
  const PaintViews views{sky.r, sky.g, sky.b, sky.a};
  if (strength > 0.0f) depositPaint(views, tone, {}, surface, in.look.passes.paper);
  layOver(views, paper);
  return sky;
}

}  // namespace

bool usesGround(const Look& look, const StyledSurfaces& styled) {
  const Background background = look.output.background;
  return (background != Background::beauty && background != Background::transparent) ||
         look.passes.paper.strength > 0.0f || paintsEdges(styled);
}

bool keepsGrain(const Look& look, const StyledSurfaces& styled) {
  return look.passes.paper.strength > 0.0f || paintsEdges(styled);
}

PaperSurface framePaper(const FinishInput& in) {
  const PaperParams& paper = in.look.passes.paper;
  if (!(paper.strength > 0.0f) && in.look.output.background != Background::paper) return {};
  ToothTile tile(paper);
  const SkyView view = skyView(in);
  if (paper.fixed == PaperParams::Fixed::screen || !view.rays)
    return {std::move(tile), view.offsetX, view.offsetY};
  ToothPlaces places{in.planes.position, in.planes.normal, in.styled.rest, in.styled.anchorIndex,
                     in.styled.anchors};
  places.rays = view.rays;
  places.upIsY = view.upIsY;
  return PaperSurface(worldTooth(tile, places));
}

FrameGround::FrameGround(const FinishInput& in, View<const float> alpha,
                         const PaperSurface& surface) {
  const PassParams& passes = in.look.passes;
  const auto flat = [&](const std::vector<float>& colour) {
    return std::make_unique<FlatGround>(colour, surface, passes.paper);
  };
  paper_ = flat(passes.paper.colour);
  const auto picture = [](ColourPlanes planes) {
    return std::make_unique<PictureGround>(std::move(planes));
  };
  switch (in.look.output.background) {
    case Background::beauty:
      if (in.planes.beauty.empty()) break;
      if (paintHasGaps(in))
        ground_ = std::make_unique<PaperedBeauty>(in, alpha, *paper_);
      else
        ground_ = picture(openBeauty(in, alpha));
      break;
    case Background::transparent:
      break;
    case Background::colour:
      ground_ = flat(passes.ground.colour);
      break;
    case Background::paper:
      ground_ = flat(passes.paper.colour);
      break;
    case Background::picture:
      ground_ = picture(fitPicture(*in.strips.picture(), skyView(in)));
      break;
    case Background::strip:
      ground_ = picture(skyGround(in, alpha, surface, *paper_));
      break;
  }
}

}  // namespace kagefude
