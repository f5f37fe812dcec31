#include "passes/light_shape/shadow_taps.h"

#include <cmath>
#include <cstring>

#include "image/clones.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

constexpr int alike = 6;  ///< steps of 1/127 that packed normals may differ by
constexpr int lanes = 8;  ///< sums that run side by side, on any machine
using Lanes = float __attribute__((vector_size(4 * lanes)));

/// Floor of a pixel coordinate not far outside the frame; std::floor is a call on plain x86-64.
inline int floorOf(float v) { return static_cast<int>(v + 4096.0f) - 4096; }

using Source = ShadowTaps::Source;

ShadowTaps::Ring ringOf(std::span<const V2f> places) {
  ShadowTaps::Ring ring;
  for (size_t k = 1; k < places.size(); ++k)
    for (const bool outward : {true, false}) {
      const V2f move = outward ? places[k] : -places[k];
      ring.x[ring.count] = move.x;
      ring.y[ring.count] = move.y;
      ring.from[ring.count] = static_cast<int32_t>(outward ? 0 : k);
      ring.to[ring.count++] = static_cast<int32_t>(outward ? k : 0);
    }
  return ring;
}

struct Sums {
  float visibility, cost, count;
};

constexpr int inLower = 16;  ///< masks whose bits lie beside the normal

/// 1 when mask k sees the light, by a pixel's lower and upper bits.
template <bool wide>
inline __attribute__((always_inline)) uint32_t bitOf(uint32_t lower, uint64_t upper, int32_t k) {
  if constexpr (wide) {
    return static_cast<uint32_t>((k < inLower ? lower >> k : upper >> (k - inLower)) & 1);
  } else {
    return lower >> k & 1;
  }
}

/// Weight that counts, and lit weight, of every place. `uniform`: every tap is in the frame and on
/// the label. `wide`: more masks than the lower bits hold.
template <bool uniform, bool wide>
inline __attribute__((always_inline)) void gather(const Source& from, const ShadowPlaces& places,
                                                  float* weight, float* lit) {
  const int width = from.labels.width, height = from.labels.height;
  const uint32_t *const labels = from.labels.data, *const pixels = from.pixels.data;
  const uint32_t label = from.label;
  const int u = static_cast<int>(from.pixel >> 24), v = static_cast<int>(from.pixel >> 16 & 255);
  const float x = from.x, y = from.y, ux = from.ux, uy = from.uy, vx = from.vx, vy = from.vy;
  const int count = places.count;
  for (int i = 0; i < count; ++i) weight[i] = lit[i] = 0;
  for (int t = 0; t < 3; ++t) {
    const float *const ox = places.x[t], *const oy = places.y[t], *const share = places.weight[t];
    const int32_t* const mask = places.mask[t];
    for (int i = 0; i < count; ++i) {
      const int qx = floorOf(x + ux * ox[i] + vx * oy[i]);
      const int qy = floorOf(y + uy * ox[i] + vy * oy[i]);
      const int cx = uniform ? qx : std::min(std::max(qx, 0), width - 1);
      const int cy = uniform ? qy : std::min(std::max(qy, 0), height - 1);
      const int at = cy * width + cx;
      const uint32_t pixel = pixels[at];
      const int du = static_cast<int>(pixel >> 24) - u;
      const int dv = static_cast<int>(pixel >> 16 & 255) - v;
      bool counts = (du <= alike) & (du >= -alike) & (dv <= alike) & (dv >= -alike);
      if (!uniform) counts = counts & (qx == cx) & (qy == cy) & (labels[at] == label);
      const float w = counts ? share[i] : 0.0f;
      weight[i] += w;
      lit[i] += bitOf<wide>(pixel, wide ? from.upperPixels[at] : 0, mask[i]) ? w : 0.0f;
    }
  }
}

/// Sums over the places that have taps enough, in lanes that do not depend on the machine.
inline __attribute__((always_inline)) Sums sumUp(const float* weight, const float* lit, int count) {
  Lanes visibility{}, cost{}, places{};
  for (int i = 0; i < count; i += lanes) {
    Lanes w, l;
    std::memcpy(&w, weight + i, sizeof w);
    std::memcpy(&l, lit + i, sizeof l);
    const Lanes none{}, one = none + 1.0f;
    const auto enough = w > 0.05f;
    const Lanes seen = enough ? l / (enough ? w : one) : none;
    visibility += seen;
    cost += seen * (1.0f - seen);
    places += enough ? one : none;
  }
  Sums sums{0, 0, 0};
  for (int j = 0; j < lanes; ++j) {
    sums.visibility += visibility[j];
    sums.cost += cost[j];
    sums.count += places[j];
  }
  return sums;
}

KAGEFUDE_CLONES void sumAnywhere(const Source& from, const ShadowPlaces& places, Sums& sums) {
  float weight[ShadowPlaces::most], lit[ShadowPlaces::most];
  gather<false, false>(from, places, weight, lit);
  sums = sumUp(weight, lit, places.count);
}

KAGEFUDE_CLONES void sumOnOneLabel(const Source& from, const ShadowPlaces& places, Sums& sums) {
  float weight[ShadowPlaces::most], lit[ShadowPlaces::most];
  gather<true, false>(from, places, weight, lit);
  sums = sumUp(weight, lit, places.count);
}

/// Of the ring's taps, how many count and how many of those do not show what they foretell.
template <bool wide>
inline __attribute__((always_inline)) void compare(const Source& from, const ShadowTaps::Ring& ring,
                                                   int& wrong, int& count) {
  const int width = from.labels.width, height = from.labels.height;
  const uint32_t *const labels = from.labels.data, *const pixels = from.pixels.data;
  const uint32_t label = from.label, here = from.pixel;
  const float x = from.x, y = from.y, ux = from.ux, uy = from.uy, vx = from.vx, vy = from.vy;
  int counted = 0, differ = 0;
  for (int i = 0; i < ring.count; ++i) {
    const int qx = floorOf(x + ux * ring.x[i] + vx * ring.y[i]);
    const int qy = floorOf(y + uy * ring.x[i] + vy * ring.y[i]);
    const int cx = std::min(std::max(qx, 0), width - 1);
    const int cy = std::min(std::max(qy, 0), height - 1);
    const int at = cy * width + cx;
    const int counts = (qx == cx) & (qy == cy) & (labels[at] == label);
    counted += counts;
    const uint32_t there = bitOf<wide>(pixels[at], wide ? from.upperPixels[at] : 0, ring.from[i]);
    differ += counts & static_cast<int>(there ^ bitOf<wide>(here, from.upper, ring.to[i]));
  }
  count = counted;
  wrong = differ;
}

KAGEFUDE_CLONES void compareRing(const Source& from, const ShadowTaps::Ring& ring, int& wrong,
                                 int& count) {
  compare<false>(from, ring, wrong, count);
}

KAGEFUDE_CLONES void compareWideRing(const Source& from, const ShadowTaps::Ring& ring, int& wrong,
                                     int& count) {
  compare<true>(from, ring, wrong, count);
}

KAGEFUDE_CLONES void sumWide(const Source& from, const ShadowPlaces& places, Sums& sums) {
  float weight[ShadowPlaces::most], lit[ShadowPlaces::most];
  gather<false, true>(from, places, weight, lit);
  sums = sumUp(weight, lit, places.count);
}

/// Octahedral, a byte each for u and v in the upper half; a normal of length 0 gives 0.
KAGEFUDE_CLONES void packNormals(const float* nx, const float* ny, const float* nz, int count,
                                 uint32_t* out) {
  for (int i = 0; i < count; ++i) {
    const float sum = std::fabs(nx[i]) + std::fabs(ny[i]) + std::fabs(nz[i]);
    const float by = sum > 0 ? sum : 1.0f;
    const float u = nx[i] / by, v = ny[i] / by;
    const float foldedU = (1 - std::fabs(v)) * (u < 0 ? -1.0f : 1.0f);
    const float foldedV = (1 - std::fabs(u)) * (v < 0 ? -1.0f : 1.0f);
    const float s = nz[i] < 0 ? foldedU : u, t = nz[i] < 0 ? foldedV : v;
    // Negated so that normals that are not numbers become 0, too.
    const bool known = sum > 0 && sum < 1e30f;
    const int high = static_cast<int>(known ? s * 127.0f + 127.5f : 0.0f);
    const int low = static_cast<int>(known ? t * 127.0f + 127.5f : 0.0f);
    out[i] = static_cast<uint32_t>(high << 24 | low << 16);
  }
}

void addUpperBit(const uint8_t* mask, int count, uint64_t bit, uint64_t* out) {
  for (int i = 0; i < count; ++i) out[i] |= mask[i] ? bit : 0;
}

KAGEFUDE_CLONES void addBit(const uint8_t* mask, int count, uint32_t bit, uint32_t* out) {
  for (int i = 0; i < count; ++i) out[i] |= mask[i] ? bit : 0;
}

}  // namespace

ShadowTaps::ShadowTaps(std::span<const View<const uint8_t>> masks, std::span<const V2f> places,
                       View<const uint32_t> labels, Vec3View normal)
    : labels_(labels),
      ring_(ringOf(places)),
      lower_((uint32_t{1} << std::min<size_t>(masks.size(), inLower)) - 1),
      upper_(masks.size() > inLower ? (uint64_t{1} << (masks.size() - inLower)) - 1 : 0),
      pixels_(labels.width, labels.height),
      upperPixels_(upper_ ? Plane<uint64_t>(labels.width, labels.height, 0) : Plane<uint64_t>()),
      uniform_(labels) {
  parallelRows(labels.height, [&](int y0, int y1) { pack(masks, normal, y0, y1); });
}

void ShadowTaps::pack(std::span<const View<const uint8_t>> masks, Vec3View normal, int y0, int y1) {
  const int width = labels_.width;
  for (int y = y0; y < y1; ++y) {
    packNormals(normal.x.row(y), normal.y.row(y), normal.z.row(y), width, pixels_.row(y));
    for (size_t k = 0; k < masks.size(); ++k)
      if (k < inLower)
        addBit(masks[k].row(y), width, uint32_t{1} << k, pixels_.row(y));
      else
        addUpperBit(masks[k].row(y), width, uint64_t{1} << (k - inLower), upperPixels_.row(y));
  }
}

ShadowTaps::Source ShadowTaps::sourceAt(int x, int y, const ShadowShift& along, float shift) const {
  return {labels_,
          pixels_,
          upper_ ? upperPixels_.row(0) : nullptr,
          labels_(x, y),
          pixels_(x, y),
          upper_ ? upperPixels_(x, y) : 0,
          static_cast<float>(x) + 0.5f,
          static_cast<float>(y) + 0.5f,
          -along.ux * shift,
          -along.uy * shift,
          -along.vx * shift,
          -along.vy * shift};
}

ShadowTaps::Mean ShadowTaps::mean(const ShadowPlaces& places, int x, int y,
                                  const ShadowShift& along, float shift) const {
  const Source from = sourceAt(x, y, along, shift);
  Sums sums;
  if (upper_) {
    sumWide(from, places, sums);
  } else if (shift * places.reach + 1.0f < static_cast<float>(uniform_.margin(x, y))) {
    sumOnOneLabel(from, places, sums);
  } else {
    sumAnywhere(from, places, sums);
  }
  if (!(sums.count > 0.85f * static_cast<float>(places.count))) return {0, 0, false};
  return {sums.visibility / sums.count, sums.cost / sums.count, true};
}

float ShadowTaps::mismatch(int x, int y, const ShadowShift& along, float shift) const {
  const Source from = sourceAt(x, y, along, shift);
  int wrong = 0, count = 0;
  if (upper_)
    compareWideRing(from, ring_, wrong, count);
  else
    compareRing(from, ring_, wrong, count);
  return count > 0 ? static_cast<float>(wrong) / static_cast<float>(count) : 1.0f;
}

}  // namespace kagefude
