#include "passes/shadow_follow.h"

#include <cmath>

#include "image/clones.h"
#include "image/parallel.h"
#include "image/real_math.h"

namespace kagefude {
namespace {

constexpr float mismatchWeight = 0.1f;
constexpr int coarsePlaces = 40, finePlaces = 72;
constexpr float goldenTurn = 0.38196601125f;
constexpr int alike = 6;             ///< steps of 1/127 that packed normals may differ by
constexpr float trusted = 0.02f;     ///< mean disagreement up to which a match is trusted fully
constexpr float distrusted = 0.07f;  ///< and from which on not at all
constexpr float grazing = 0.12f;     ///< cosine to the light up to which nothing is followed
constexpr float facingWell = 0.3f;   ///< and from which on shifts are trusted fully
constexpr float straight =
    0.03f;                     ///< departure from one straight edge up to which nothing is followed
constexpr float bent = 0.08f;  ///< and from which on all is; RMS, as a share of the shift
constexpr float shortest = 4.0f;    ///< shift in pixels from which on answers are interpolated
constexpr float softness = 0.005f;  ///< disagreement that halves a tile's say, about

uint32_t packNormal(const V3f& n) {
  const float sum = std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z);
  if (!(sum > 0)) return 0;
  float u = n.x / sum, v = n.y / sum;
  if (n.z < 0) {
    const float folded = (1 - std::fabs(v)) * (u < 0 ? -1.0f : 1.0f);
    v = (1 - std::fabs(u)) * (v < 0 ? -1.0f : 1.0f);
    u = folded;
  }
  const auto byte = [](float t) { return static_cast<uint32_t>(t * 127.0f + 127.5f); };
  return byte(u) << 8 | byte(v);
}

/// Floor of a pixel coordinate not far outside the frame; std::floor is a call on plain x86-64.
int floorOf(float v) { return static_cast<int>(v + 4096.0f) - 4096; }

struct Taps {
  View<const uint32_t> labels, pixels;
  uint32_t label, pixel;  ///< of the pixel looked from
  float x, y;             ///< its centre
  float ux, uy, vx, vy;   ///< pixels that a unit of place moves a tap
};

/// The share of weight that counts, and of lit weight, of every place: no sums across places, so
/// that vectors of any length give the same bits.
KAGEFUDE_CLONES void gatherTaps(const Taps& from, const ShadowFollow::Places& places, float* weight,
                                float* lit) {
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
      const int cx = std::min(std::max(qx, 0), width - 1);
      const int cy = std::min(std::max(qy, 0), height - 1);
      const int at = cy * width + cx;
      const uint32_t pixel = pixels[at];
      const int du = static_cast<int>(pixel >> 24) - u;
      const int dv = static_cast<int>(pixel >> 16 & 255) - v;
      const bool counts = (qx == cx) & (qy == cy) & (labels[at] == label) & (du <= alike) &
                          (du >= -alike) & (dv <= alike) & (dv >= -alike);
      const float w = counts ? share[i] : 0.0f;
      weight[i] += w;
      lit[i] += (pixel >> mask[i] & 1) ? w : 0.0f;
    }
  }
}

}  // namespace

ShadowFollow::ShadowFollow(std::span<const View<const uint8_t>> masks, std::span<const V2f> places,
                           const std::vector<Distances>& distances, View<const uint32_t> labels,
                           Vec3View position, Vec3View normal, const LightGeometry& geometry,
                           float radius)
    : distances_(distances),
      labels_(labels),
      position_(position),
      normal_(normal),
      geometry_(geometry),
      maskCount_(masks.size()),
      masks_(places.begin(), places.end()),
      tile_(labels.height > 1200 ? 8 : 4),
      tilesX_((labels.width + tile_ - 1) / tile_),
      tilesY_((labels.height + tile_ - 1) / tile_),
      coarse_(placesOf(places, coarsePlaces, 1.0f)),
      fine_(placesOf(places, finePlaces, radius)),
      pixels_(labels.width, labels.height) {
  const float longest = std::clamp(static_cast<float>(labels.width) / 4, 8.0f, 192.0f);
  for (float r = 1.0f; shifts_ < mostShifts && r <= longest; r *= 1.41421356f)
    length_[shifts_++] = r;
  pack(masks, normal);
  measure();
  choose();
  if (tile_ > 4) fillSparse();
}

ShadowFollow::Places ShadowFollow::placesOf(std::span<const V2f> masks, int count,
                                            float radius) const {
  const int ring = static_cast<int>(masks.size()) - 1;
  Places result;
  result.count = count;
  for (int i = 0; i < count; ++i) {
    const float r = radius * std::sqrt((static_cast<float>(i) + 0.5f) / static_cast<float>(count));
    const float turn = static_cast<float>(i) * goldenTurn;
    const SinCos angle = sinCosTurns(turn - std::floor(turn));
    const V2f p(r * angle.cos, r * angle.sin);
    const int wedge =
        std::min(static_cast<int>(turnsOf(p.y, p.x) * static_cast<float>(ring)), ring - 1);
    const int a = 1 + wedge, b = 1 + (wedge + 1) % ring;
    const V2f &pa = masks[static_cast<size_t>(a)], &pb = masks[static_cast<size_t>(b)];
    const float det = pa.x * pb.y - pa.y * pb.x;
    const float wa = std::max(0.0f, (p.x * pb.y - p.y * pb.x) / det);
    const float wb = std::max(0.0f, (pa.x * p.y - pa.y * p.x) / det);
    const V2f offset[3] = {p - masks[0], p - pa, p - pb};
    const float weight[3] = {std::max(0.0f, 1.0f - wa - wb), wa, wb};
    const int mask[3] = {0, a, b};
    for (int t = 0; t < 3; ++t) {
      result.x[t][i] = offset[t].x;
      result.y[t][i] = offset[t].y;
      result.weight[t][i] = weight[t];
      result.mask[t][i] = mask[t];
    }
  }
  return result;
}

void ShadowFollow::pack(std::span<const View<const uint8_t>> masks, Vec3View normal) {
  parallelRows(labels_.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < labels_.width; ++x) {
        uint32_t bits = 0;
        for (size_t k = 0; k < maskCount_; ++k)
          bits |= static_cast<uint32_t>(masks[k](x, y) != 0) << k;
        pixels_(x, y) = packNormal(normal(x, y)) << 16 | bits;
      }
  });
}

/// Change of position along x and y on the surface at a pixel, from the neighbour that lies closer
/// to the tangent plane, turned into the shift that a unit of place makes.
ShadowFollow::Basis ShadowFollow::basisAt(int x, int y) const {
  const uint32_t label = labels_(x, y);
  const V3f p = position_(x, y), n = normal_(x, y);
  const auto step = [&](int dx, int dy) {
    V3f best(0, 0, 0);
    float off = INFINITY;
    for (const int sign : {1, -1}) {
      const int qx = x + sign * dx, qy = y + sign * dy;
      if (!labels_.contains(qx, qy) || labels_(qx, qy) != label) continue;
      const V3f d = (position_(qx, qy) - p) * static_cast<float>(sign);
      if (std::fabs(d.dot(n)) < off) {
        off = std::fabs(d.dot(n));
        best = d - n * d.dot(n);
      }
    }
    return best;
  };
  const V3f px = step(1, 0), py = step(0, 1);
  const float xx = px.dot(px), xy = px.dot(py), yy = py.dot(py), det = xx * yy - xy * xy;
  const V3f travel = geometry_.sun ? geometry_.direction : (p - geometry_.position).normalized();
  const float facing = n.dot(travel);
  Basis b{};
  if (!(det > 1e-4f * xx * yy) || !(facing < -grazing)) return b;
  b.trust = std::min((-facing - grazing) / (facingWell - grazing), 1.0f);
  const auto onPicture = [&](const V3f& move, float& outX, float& outY) {
    const V3f shift = travel * (n.dot(move) / facing) - move;
    const float sx = shift.dot(px), sy = shift.dot(py);
    outX = (yy * sx - xy * sy) / det;
    outY = (xx * sy - xy * sx) / det;
  };
  onPicture(geometry_.u, b.ux, b.uy);
  onPicture(geometry_.v, b.vx, b.vy);
  // The longest shift of the unit circle: the larger singular value.
  const float sum = b.ux * b.ux + b.uy * b.uy + b.vx * b.vx + b.vy * b.vy;
  const float cross = b.ux * b.vy - b.uy * b.vx;
  const float most =
      std::sqrt(0.5f * (sum + std::sqrt(std::max(0.0f, sum * sum - 4.0f * cross * cross))));
  if (!(most > 0) || !std::isfinite(most)) return b;
  for (float* const v : {&b.ux, &b.uy, &b.vx, &b.vy}) *v /= most;
  b.valid = true;
  return b;
}

ShadowFollow::Mean ShadowFollow::meanAt(const Places& places, int x, int y, const Basis& b,
                                        float shift) const {
  const Taps from{labels_,
                  pixels_,
                  labels_(x, y),
                  pixels_(x, y),
                  static_cast<float>(x) + 0.5f,
                  static_cast<float>(y) + 0.5f,
                  -b.ux * shift,
                  -b.uy * shift,
                  -b.vx * shift,
                  -b.vy * shift};
  float weight[Places::most], lit[Places::most];
  gatherTaps(from, places, weight, lit);
  float visibility = 0, cost = 0, count = 0;
  for (int i = 0; i < places.count; ++i) {
    if (!(weight[i] > 0.05f)) continue;
    const float seen = lit[i] / weight[i];
    visibility += seen;
    cost += seen * (1.0f - seen);
    count += 1;
  }
  if (!(count > 0.85f * static_cast<float>(places.count))) return {0, 0, false};
  return {visibility / count, cost / count, true};
}

float ShadowFollow::mismatchAt(int x, int y, const Basis& b, float shift) const {
  const uint32_t here = pixels_(x, y), label = labels_(x, y);
  float wrong = 0, count = 0;
  const auto check = [&](const V2f& move, size_t from, size_t to) {
    const int qx = floorOf(static_cast<float>(x) + 0.5f - shift * (b.ux * move.x + b.vx * move.y));
    const int qy = floorOf(static_cast<float>(y) + 0.5f - shift * (b.uy * move.x + b.vy * move.y));
    if (!labels_.contains(qx, qy) || labels_(qx, qy) != label) return;
    count += 1;
    wrong += static_cast<float>((pixels_(qx, qy) >> from & 1) != (here >> to & 1));
  };
  for (size_t k = 1; k < maskCount_; ++k) {
    check(masks_[k], 0, k);
    check(-masks_[k], k, 0);
  }
  return count > 0 ? wrong / count : 1.0f;
}

bool ShadowFollow::besideOpposite(int x, int y, uint32_t opposite, uint32_t all) const {
  constexpr int within = 12;
  constexpr int steps[8][2] = {{1, 0}, {-1, 0},  {0, 1},  {0, -1},
                               {1, 1}, {-1, -1}, {1, -1}, {-1, 1}};
  const uint32_t label = labels_(x, y);
  for (const auto& step : steps)
    for (int i = 1; i <= within; ++i) {
      const int nx = x + i * step[0], ny = y + i * step[1];
      if (!labels_.contains(nx, ny)) break;
      if (labels_(nx, ny) == label && (pixels_(nx, ny) & all) == opposite) return true;
    }
  return false;
}

float ShadowFollow::needAt(int x, int y) const {
  const uint32_t all = (uint32_t{1} << maskCount_) - 1, bits = pixels_(x, y) & all;
  // Where the masks agree, only a shadow thinner than its shift can be missed by all of them;
  // beside one that all masks show, there is nothing to follow.
  if (bits == 0 || bits == all) return besideOpposite(x, y, all & ~bits, all) ? 0.0f : 1.0f;
  float s[mostMasks], mean = 0;
  for (size_t k = 0; k < maskCount_; ++k) {
    const int16_t d = distances_[k](x, y);
    if (d == farLit || d == farDark) return 1;
    s[k] = static_cast<float>(d) * distanceUnit;
    mean += s[k];
  }
  mean /= static_cast<float>(maskCount_);
  // The places are a centre and a ring of radius 1: their moments are known.
  const float moment = 0.5f * static_cast<float>(maskCount_ - 1);
  float u = 0, v = 0;
  for (size_t k = 1; k < maskCount_; ++k) {
    u += s[k] * masks_[k].x;
    v += s[k] * masks_[k].y;
  }
  u /= moment;
  v /= moment;
  float off = 0;
  for (size_t k = 0; k < maskCount_; ++k) {
    const float d = s[k] - mean - u * masks_[k].x - v * masks_[k].y;
    off += d * d;
  }
  const float shift = std::sqrt(u * u + v * v);
  const float departure = std::sqrt(off / static_cast<float>(maskCount_));
  return std::clamp((departure - straight * shift) / ((bent - straight) * shift + 1e-6f), 0.0f,
                    1.0f);
}

void ShadowFollow::measure() {
  tiles_.resize(static_cast<size_t>(tilesX_) * static_cast<size_t>(tilesY_));
  parallelRows(tilesY_, 2, [&](int t0, int t1) {
    for (int ty = t0; ty < t1; ++ty)
      for (int tx = 0; tx < tilesX_; ++tx) measureTile(tx, ty);
  });
}

void ShadowFollow::measureTile(int tx, int ty) {
  const uint32_t all = (uint32_t{1} << maskCount_) - 1;
  Tile& tile =
      tiles_[static_cast<size_t>(ty) * static_cast<size_t>(tilesX_) + static_cast<size_t>(tx)];
  const int step = tile_ / 2;
  for (int y = ty * tile_ + step / 2; y < std::min((ty + 1) * tile_, labels_.height); y += step)
    for (int x = tx * tile_ + step / 2; x < std::min((tx + 1) * tile_, labels_.width); x += step) {
      const uint32_t bits = pixels_(x, y) & all;
      const uint32_t label = labels_(x, y);
      // Large tiles: every other sample, as on a chessboard.
      if (step > 2 && ((x + y) / step & 1)) continue;
      if (label == 0 || bits == 0 || bits == all || !(needAt(x, y) > 0)) continue;
      Sums* sums = nullptr;
      for (Sums& s : tile.sums)
        if (!sums && (s.label == label || s.label == 0)) sums = &s;
      if (!sums) continue;
      const Basis b = basisAt(x, y);
      if (!b.valid) continue;
      sums->label = label;
      sums->count += 1;
      for (int i = 0; i < shifts_; ++i) {
        const Mean mean = meanAt(coarse_, x, y, b, length_[i]);
        sums->cost[i] +=
            (mean.valid ? mean.cost : 0.25f) + mismatchWeight * mismatchAt(x, y, b, length_[i]);
      }
    }
}

ShadowFollow::Choice ShadowFollow::chooseFor(int tx, int ty, uint32_t label) const {
  Choice choice{label, 0, 1};
  float cost[mostShifts];
  int best = -1;
  for (int i = 0; i < shifts_; ++i) {
    const int reach =
        std::max(1, static_cast<int>(0.5f * length_[i] / static_cast<float>(tile_) + 0.5f));
    // Wide windows look at every other tile or fewer: their sums are smooth.
    const int stride = std::max(1, reach / 3);
    float sum = 0, count = 0;
    for (int dy = -reach; dy <= reach; dy += stride)
      for (int dx = -reach; dx <= reach; dx += stride) {
        const int qx = tx + dx, qy = ty + dy;
        if (qx < 0 || qy < 0 || qx >= tilesX_ || qy >= tilesY_) continue;
        const Tile& tile = tiles_[static_cast<size_t>(qy) * static_cast<size_t>(tilesX_) +
                                  static_cast<size_t>(qx)];
        for (const Sums& s : tile.sums)
          if (s.label == label) {
            sum += s.cost[i];
            count += s.count;
          }
      }
    cost[i] = count > 0 ? sum / count : 1.0f;
    if (best < 0 || cost[i] < cost[best]) best = i;
  }
  choice.cost = cost[best];
  choice.level = static_cast<float>(best);
  if (best > 0 && best + 1 < shifts_) {
    const float left = cost[best - 1] - cost[best], right = cost[best + 1] - cost[best];
    if (left + right > 0) choice.level += 0.5f * (left - right) / (left + right);
  }
  return choice;
}

/// Also for tiles beside those with an edge, which take their neighbours' labels: thin shadows that
/// no mask holds pass there too.
void ShadowFollow::choose() {
  choices_.resize(tiles_.size());
  parallelRows(tilesY_, 2, [&](int t0, int t1) {
    for (int ty = t0; ty < t1; ++ty)
      for (int tx = 0; tx < tilesX_; ++tx) {
        Choices& mine = choices_[static_cast<size_t>(ty) * static_cast<size_t>(tilesX_) +
                                 static_cast<size_t>(tx)];
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const int qx = tx + dx, qy = ty + dy;
            if (qx < 0 || qy < 0 || qx >= tilesX_ || qy >= tilesY_) continue;
            const Tile& tile = tiles_[static_cast<size_t>(qy) * static_cast<size_t>(tilesX_) +
                                      static_cast<size_t>(qx)];
            for (const Sums& s : tile.sums) {
              if (s.label == 0 || s.label == mine.of[0].label || s.label == mine.of[1].label)
                continue;
              Choice& slot = mine.of[0].label == 0 ? mine.of[0] : mine.of[1];
              if (slot.label == 0) slot = chooseFor(tx, ty, s.label);
            }
          }
      }
  });
}

void ShadowFollow::fillSparse() {
  sparse_ = Plane<Answer>((labels_.width + 1) / 2, (labels_.height + 1) / 2);
  parallelRows(sparse_.view().height, 2, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < sparse_.view().width; ++x) sparse_(x, y) = measured(2 * x, 2 * y);
  });
}

ShadowFollow::Answer ShadowFollow::between(int x, int y) const {
  if ((x & 1) == 0 && (y & 1) == 0) return sparse_(x / 2, y / 2);
  const uint32_t label = labels_(x, y);
  float visibility = 0, trust = 0, count = 0;
  for (int j = y / 2; j <= (y + 1) / 2; ++j)
    for (int i = x / 2; i <= (x + 1) / 2; ++i) {
      if (i >= sparse_.view().width || j >= sparse_.view().height) continue;
      if (labels_(2 * i, 2 * j) != label) continue;
      const Answer& a = sparse_(i, j);
      if (a.trust > 0 && a.shift < shortest) return measured(x, y);
      visibility += a.trust * a.visibility;
      trust += a.trust;
      count += 1;
    }
  if (count == 0) return measured(x, y);
  return trust > 0 ? Answer{visibility / trust, trust / count, shortest} : Answer{};
}

ShadowFollow::Answer ShadowFollow::measured(int x, int y) const {
  const uint32_t label = labels_(x, y);
  const float gx = (static_cast<float>(x) + 0.5f) / static_cast<float>(tile_) - 0.5f;
  const float gy = (static_cast<float>(y) + 0.5f) / static_cast<float>(tile_) - 0.5f;
  const int x0 = static_cast<int>(std::floor(gx)), y0 = static_cast<int>(std::floor(gy));
  float lowest = 1;
  const Choice* near[4] = {};
  float weight[4] = {};
  for (int i = 0; i < 4; ++i) {
    const int tx = x0 + (i & 1), ty = y0 + (i >> 1);
    if (tx < 0 || ty < 0 || tx >= tilesX_ || ty >= tilesY_) continue;
    for (const Choice& c :
         choices_[static_cast<size_t>(ty) * static_cast<size_t>(tilesX_) + static_cast<size_t>(tx)]
             .of)
      if (c.label == label) {
        near[i] = &c;
        lowest = std::min(lowest, c.cost);
      }
    const float wx = gx - static_cast<float>(x0), wy = gy - static_cast<float>(y0);
    weight[i] = ((i & 1) ? wx : 1 - wx) * ((i >> 1) ? wy : 1 - wy);
  }
  float level = 0, cost = 0, sum = 0;
  for (int i = 0; i < 4; ++i) {
    if (!near[i]) continue;
    const float w = (weight[i] + 1e-3f) * exp2Of((lowest - near[i]->cost) / softness);
    level += w * near[i]->level;
    cost += w * near[i]->cost;
    sum += w;
  }
  if (!(sum > 0)) return {};
  float trust = std::clamp((distrusted - cost / sum) / (distrusted - trusted), 0.0f, 1.0f);
  if (trust > 0) trust *= needAt(x, y);
  if (trust <= 0) return {};
  const Basis b = basisAt(x, y);
  if (!b.valid) return {};
  const float shift = exp2Of(0.5f * level / sum);
  const Mean mean = meanAt(fine_, x, y, b, shift);
  return mean.valid ? Answer{mean.visibility, trust * b.trust, shift} : Answer{};
}

}  // namespace kagefude
