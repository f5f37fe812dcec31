#include "passes/light_shape/shadow_need.h"

#include <algorithm>
#include <cmath>

namespace kagefude {
namespace {

constexpr float straight =
    0.03f;                     ///< departure from one straight edge up to which nothing is followed
constexpr float bent = 0.08f;  ///< and from which on all is; RMS, as a share of the shift
constexpr int within = 12;     ///< pixels in which an edge that all masks show counts as near

}  // namespace

bool ShadowNeed::besideOpposite(int x, int y, ShadowTaps::Seen opposite) const {
  constexpr int steps[8][2] = {{1, 0}, {-1, 0},  {0, 1},  {0, -1},
                               {1, 1}, {-1, -1}, {1, -1}, {-1, 1}};
  const uint32_t label = taps_.label(x, y);
  for (const auto& step : steps)
    for (int i = 1; i <= within; ++i) {
      const int nx = x + i * step[0], ny = y + i * step[1];
      if (!taps_.labels().contains(nx, ny)) break;
      if (taps_.seen(nx, ny) == opposite && taps_.label(nx, ny) == label) return true;
    }
  return false;
}

float ShadowNeed::at(int x, int y) const {
  using Seen = ShadowTaps::Seen;
  const Seen seen = taps_.seen(x, y);
  // Where the masks agree, only a shadow thinner than its shift can be missed by all of them;
  // beside one that all masks show, there is nothing to follow.
  if (seen != Seen::some)
    return besideOpposite(x, y, seen == Seen::all ? Seen::none : Seen::all) ? 0.0f : 1.0f;
  const auto masks = places_.size();
  const uint32_t number = edges_.indexOf(x, y);
  float s[ShadowTaps::mostMasks], mean = 0;
  for (size_t k = 0; k < masks; ++k) {
    const int16_t d = distances_.row(static_cast<int>(k))[number];
    if (d == farLit || d == farDark) return 1;
    s[k] = static_cast<float>(d) * distanceUnit;
    mean += s[k];
  }
  mean /= static_cast<float>(masks);
  // Places lie evenly round the centre, so u and v do not mix; a grid's are not as many each way.
  float u = 0, v = 0, moment = 0, momentU = 0, momentV = 0;
  for (size_t k = 1; k < masks; ++k) {
    u += s[k] * places_[k].x;
    v += s[k] * places_[k].y;
    moment += 0.5f * (places_[k].x * places_[k].x + places_[k].y * places_[k].y);
    momentU += places_[k].x * places_[k].x;
    momentV += places_[k].y * places_[k].y;
  }
  u /= rectangle_ ? momentU : moment;
  v /= rectangle_ ? momentV : moment;
  float off = 0;
  for (size_t k = 0; k < masks; ++k) {
    const float d = s[k] - mean - u * places_[k].x - v * places_[k].y;
    off += d * d;
  }
  const float shift = std::sqrt(u * u + v * v);
  const float departure = std::sqrt(off / static_cast<float>(masks));
  return std::clamp((departure - straight * shift) / ((bent - straight) * shift + 1e-6f), 0.0f,
                    1.0f);
}

}  // namespace kagefude
