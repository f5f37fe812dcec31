#include "passes/light_shape/light_shape.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"
#include "passes/light_shape/horizon.h"
#include "passes/light_shape/light_share.h"
#include "passes/light_shape/mask_distance.h"
#include "passes/light_shape/shadow_follow.h"
#include "passes/require_size.h"
#include "passes/search/classes.h"
#include "passes/tone/smooth.h"

namespace kagefude {
namespace {

constexpr int bandRows = 32;
constexpr auto background = static_cast<uint8_t>(ShadowClass::background);
constexpr auto penumbra = static_cast<uint8_t>(ShadowClass::penumbra);
constexpr auto umbra = static_cast<uint8_t>(ShadowClass::umbra);

void requireInputs(std::span<const View<const uint8_t>> masks, std::span<const V2f> places,
                   View<const uint32_t> labels) {
  if (masks.size() != places.size())
    throw InputError(
        fmt::format("{} shadow masks have {} places on the light", masks.size(), places.size()));
  if (masks.size() < 2 || masks.size() > mostMasks)
    throw InputError(fmt::format(
        "a light's shape needs 2 to {} shadow masks, not {}; export it with --masks disc:9",
        mostMasks, masks.size()));
  if (!placesOnLine(places) && masks.size() < 5)
    throw InputError(fmt::format(
        "a disc light needs 5 or more shadow masks, its centre and a ring, not {}; export it with "
        "--masks disc:9",
        masks.size()));
  const auto falls = [](const V2f& a, const V2f& b) { return a.x > b.x; };
  if (placesOnLine(places) &&
      std::adjacent_find(places.begin(), places.end(), falls) != places.end())
    throw InputError("the places of a line light's masks must rise along it");
  for (const View<const uint8_t>& mask : masks)
    requireSize("a shadow mask", mask, labels.width, labels.height);
}

bool hasStyle(const LightShapeParams& p) { return p.grow != 0 || p.soften > 0 || p.abstract > 0; }

/// Where distances are wanted: where masks disagree, or with a style, wherever a surface is.
PixelSet wantedPixels(View<const uint8_t> classes, bool everywhere) {
  constexpr auto lit = static_cast<uint8_t>(ShadowClass::lit);
  return everywhere ? PixelSet(classes, umbra, lit) : PixelSet(classes, penumbra, penumbra);
}

/// Labels for searches that are bound by nothing: only background is told apart.
Labels onlySurfaces(View<const uint32_t> labels) {
  Labels result(labels.width, labels.height);
  parallelRows(labels.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < labels.width; ++x) result(x, y) = labels(x, y) != 0;
  });
  return result;
}

/// Contours simplified: every distance becomes its mean over a window of the label.
void simplify(Distances& distances, const PixelSet& wanted, View<const uint32_t> labels,
              int reach) {
  const SmoothParams window{reach};
  Floats plane(labels.width, labels.height, 0.0f);
  const auto eachPixel = [&](int16_t* of, const auto& visit) {
    for (int y = 0; y < labels.height; ++y)
      for (int x = 0; x < labels.width; ++x)
        if (wanted.contains(x, y)) visit(x, y, *of++);
  };
  for (int k = 0; k < distances.height(); ++k) {
    eachPixel(distances.row(k), [&](int x, int y, int16_t& d) { plane(x, y) = d; });
    const Floats mean = smoothWithinSurfaces(plane, labels, window);
    eachPixel(distances.row(k), [&](int x, int y, int16_t& d) {
      d = static_cast<int16_t>(std::floor(mean(x, y) + 0.5f));
    });
  }
}

/// A pixel's distances, with stand-ins where a mask has no edge in the label.
class PixelDistances {
 public:
  PixelDistances(const Distances& distances, uint32_t number, float grow)
      : count_(static_cast<size_t>(distances.height())) {
    float largest = 0;
    for (size_t k = 0; k < count_; ++k) {
      const int16_t d = distances.row(static_cast<int>(k))[number];
      known_[k] = d != farLit && d != farDark;
      s_[k] = static_cast<float>(d) * distanceUnit;
      if (known_[k]) largest = std::max(largest, std::fabs(s_[k]));
    }
    if (!(largest > 0)) largest = 1.0f;
    for (size_t k = 0; k < count_; ++k) {
      if (!known_[k]) s_[k] = s_[k] > 0 ? largest : -largest;
      s_[k] -= grow;
    }
    farthest_ = largest + std::fabs(grow);
  }

  const float* values() const { return s_; }

  /// Share of masks with an edge, each less where the frame's edge is nearer than the shadow's.
  float confidence(float toFrame) const {
    float sum = 0;
    for (size_t k = 0; k < count_; ++k) sum += known_[k] ? 1.0f : 0.0f;
    if (toFrame > farthest_) return sum / static_cast<float>(count_);
    sum = 0;
    for (size_t k = 0; k < count_; ++k)
      if (known_[k]) sum += std::min(1.0f, toFrame / std::max(std::fabs(s_[k]), 0.5f));
    return sum / static_cast<float>(count_);
  }

 private:
  size_t count_;
  bool known_[mostMasks];
  float s_[mostMasks];
  float farthest_;  ///< no distance is larger
};

float toFrameEdge(int x, int y, int width, int height) {
  return static_cast<float>(std::min({x, y, width - 1 - x, height - 1 - y})) + 0.5f;
}

struct Inputs {
  std::span<const View<const uint8_t>> masks;
  View<const uint8_t> classes;
  const PixelSet& wanted;
  View<const uint32_t> labels;
  const Distances& distances;
  const LightShare& share;
  const LightShare& horizonShare;  ///< heights are linear over the light: by the closed form
  const ShadowFollow* follow;
  const Horizon* horizon;
  float grow;
};

void resolvePixel(const Inputs& in, const ShadowFollow::Band* follow, int x, int y,
                  float& visibility, float* confidence, uint8_t* unsure) {
  const uint8_t kind = in.classes(x, y);
  if (kind == background) return;
  float height[mostMasks];
  if (in.horizon && kind == penumbra && in.horizon->explains(in.masks, x, y, height)) {
    visibility = in.horizonShare.of(height);
    return;
  }
  const ShadowFollow::Answer answer =
      follow && follow->mayAnswer(x, y) ? follow->at(x, y) : ShadowFollow::Answer{};
  if (in.wanted.contains(x, y)) {
    const PixelDistances s(in.distances, in.wanted.indexOf(x, y), in.grow);
    if (answer.trust < 1) visibility = in.share.of(s.values());
    if (confidence)
      *confidence = s.confidence(toFrameEdge(x, y, in.labels.width, in.labels.height));
  }
  if (answer.trust > 0 && unsure) *unsure = 1;
  visibility += answer.trust * (answer.visibility - visibility);
}

void resolveRows(const Inputs& in, int y0, int y1, LightShapeResult& result) {
  std::optional<ShadowFollow::Band> band;
  if (in.follow) band.emplace(*in.follow, y0, y1);
  const ShadowFollow::Band* const follow = band ? &*band : nullptr;
  const int width = in.labels.width;
  for (int y = y0; y < y1; ++y) {
    const uint8_t* const kinds = in.classes.row(y);
    float* const visibility = result.visibility.row(y);
    float* const confidence = result.confidence.empty() ? nullptr : result.confidence.row(y);
    if (confidence) std::fill_n(confidence, width, 1.0f);
    uint8_t* const unsure = result.unsure.empty() ? nullptr : result.unsure.row(y);
    for (int x = 0; x < width; ++x) visibility[x] = kinds[x] == umbra ? 0.0f : 1.0f;
    for (int x = 0; unsure && x < width; ++x) unsure[x] = kinds[x] == penumbra;
    for (int from = 0; from < width; from += ShadowFollow::run) {
      const int end = std::min(from + ShadowFollow::run, width);
      const auto [first, last] = in.wanted.ends(from, end, y);
      const bool all = follow && follow->mayAnswer(from, y);
      for (int x = all ? from : first; x < (all ? end : last); ++x)
        resolvePixel(in, follow, x, y, visibility[x], confidence ? confidence + x : nullptr,
                     unsure ? unsure + x : nullptr);
    }
  }
}

LightShapeResult resolve(const Inputs& in, const LightShapeWanted& wanted) {
  const int width = in.labels.width, height = in.labels.height;
  LightShapeResult result{{width, height}, {}, {}};
  if (wanted.confidence) result.confidence = Floats(width, height);
  if (wanted.unsure) result.unsure = Bytes(width, height);
  parallelRows(in.labels.height, bandRows,
               [&](int y0, int y1) { resolveRows(in, y0, y1, result); });
  return result;
}

}  // namespace

LightShapeResult lightShapeVisibility(std::span<const View<const uint8_t>> masks,
                                      std::span<const V2f> places, View<const uint32_t> labels,
                                      Vec3View position, Vec3View normal,
                                      const std::optional<LightGeometry>& geometry,
                                      const LightShapeParams& params,
                                      const LightShapeWanted& asked) {
  requireInputs(masks, places, labels);
  const bool style = hasStyle(params), linear = params.disc == DiscIntegral::linear;
  const float radius = params.lightSize + params.soften;
  const Bytes classes = classifyShadow(masks, labels);
  const PixelSet wanted = wantedPixels(classes, style);
  const Labels unbound = params.bound == SearchBound::none ? onlySurfaces(labels) : Labels{};
  Distances distances = maskDistances(masks, wanted, unbound.empty() ? labels : unbound.view());
  if (params.abstract > 0) simplify(distances, wanted, labels, params.abstract);
  std::optional<ShadowFollow> follow;
  std::optional<Horizon> horizon;
  if (params.follow && geometry && !position.empty() && !normal.empty() && !style) {
    requireSize("the position pass", position, labels.width, labels.height);
    requireSize("the normal pass", normal, labels.width, labels.height);
    horizon.emplace(*geometry, places, position, normal);
    if (!linear && !placesOnLine(places) && masks.size() <= ShadowFollow::mostMasks)
      follow.emplace(masks, places, distances, wanted, labels, position, normal, *geometry, radius);
  }
  const LightShare share(places, linear, radius), horizonShare(places, true, radius);
  return resolve({masks, classes, wanted, labels, distances, share, horizonShare,
                  follow ? &*follow : nullptr, horizon ? &*horizon : nullptr, params.grow},
                 {asked.confidence, asked.unsure && !style});
}

}  // namespace kagefude
