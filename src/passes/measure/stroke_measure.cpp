#include "passes/measure/stroke_measure.h"

#include <cmath>

#include "image/parallel.h"
#include "image/real_math.h"

namespace kagefude {
namespace {

struct TonePlace {
  size_t lower = 0;
  float upperShare = 0;
};

TonePlace tonePlace(float tone, int places) {
  const float last = static_cast<float>(places - 1);
  const float at = tone > 0.0f ? (tone < 1.0f ? tone * last : last) : 0.0f;
  const int lower = std::min(static_cast<int>(at), places - 2);
  return {static_cast<size_t>(lower), at - static_cast<float>(lower)};
}

float luminance(const V3f& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

bool sameAround(View<const uint32_t> ids, int x, int y) {
  const uint32_t id = ids(x, y);
  if (x == 0 || y == 0 || x + 1 == ids.width || y + 1 == ids.height) return false;
  return ids(x - 1, y) == id && ids(x + 1, y) == id && ids(x, y - 1) == id && ids(x, y + 1) == id;
}

}  // namespace

void ToneColours::add(View<const uint32_t> ids, View<const float> tone, Vec3View picture) {
  uint32_t last = 0;
  Colours* colours = nullptr;
  for (int y = 0; y < ids.height; ++y)
    for (int x = 0; x < ids.width; ++x) {
      const uint32_t id = ids(x, y);
      const V3f c = picture(x, y);
      const float all = c.x + c.y + c.z + tone(x, y);
      if (id == 0 || !std::isfinite(all)) continue;
      if (id != last) colours = &objects_[id];
      last = id;
      const TonePlace place = tonePlace(tone(x, y), places);
      for (size_t k = 0; k < 2; ++k) {
        Sum& sum = (*colours)[place.lower + k];
        const double weight = k == 0 ? 1.0 - double(place.upperShare) : double(place.upperShare);
        sum.r += weight * double(c.x);
        sum.g += weight * double(c.y);
        sum.b += weight * double(c.z);
        sum.weight += weight;
      }
    }
}

Vec3Plane ToneColours::plain(View<const uint32_t> ids, View<const float> tone) const {
  Vec3Plane result(ids.width, ids.height);
  parallelRows(ids.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < ids.width; ++x) {
        V3f colour(0.0f);
        const auto found = objects_.find(ids(x, y));
        if (ids(x, y) != 0 && found != objects_.end()) {
          const TonePlace place = tonePlace(tone(x, y), places);
          double weight = 0;
          V3d sum(0.0);
          for (size_t k = 0; k < 2; ++k) {
            const Sum& at = found->second[place.lower + k];
            const double share = k == 0 ? 1.0 - double(place.upperShare) : double(place.upperShare);
            if (!(at.weight > 0)) continue;
            sum += V3d(at.r, at.g, at.b) * (share / at.weight);
            weight += share;
          }
          if (weight > 0) colour = V3f(sum / weight);
        }
        result.set(x, y, colour);
      }
  });
  return result;
}

StrokeMeasure measureStrokes(View<const uint32_t> ids, Vec3View picture, Vec3View plain) {
  StrokeMeasure measure;
  double values = 0, slopes = 0, plains = 0;
  const auto stroke = [&](int x, int y) { return double(luminance(picture(x, y) - plain(x, y))); };
  for (int y = 0; y < ids.height; ++y)
    for (int x = 0; x < ids.width; ++x) {
      if (ids(x, y) == 0 || !sameAround(ids, x, y)) continue;
      const double here = stroke(x, y), across = 0.5 * (stroke(x + 1, y) - stroke(x - 1, y)),
                   down = 0.5 * (stroke(x, y + 1) - stroke(x, y - 1));
      const double below = double(luminance(plain(x, y)));
      const double all = here + across + down + below;
      if (!std::isfinite(all)) continue;
      values += here * here;
      slopes += across * across + down * down;
      plains += below * below;
      ++measure.pixels;
    }
  if (plains > 0) measure.contrast = std::sqrt(values / plains);
  if (slopes > 0) measure.grain = 2.0 * double(pi) * std::sqrt(values / slopes);
  return measure;
}

}  // namespace kagefude
