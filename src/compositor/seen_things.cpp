#include "compositor/seen_things.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "compositor/frame_tone.h"
#include "passes/tone/surfaces.h"

namespace kagefude {
namespace {

constexpr float black = 0.004f;  ///< albedo below which a thing has no diffuse colour
constexpr size_t mostSamples = 40000;

struct Pixels {
  std::vector<uint32_t> places;  ///< in raster order
};

using Key = std::pair<uint32_t, uint32_t>;  ///< object, material

std::map<Key, Pixels> pixelsOfThings(const FramePlanes& planes) {
  std::map<Key, Pixels> things;
  const bool materials = !planes.materialId.empty();
  const uint32_t count = static_cast<uint32_t>(planes.objectId.view().pixels());
  Pixels* last = nullptr;
  Key lastKey{};
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t object = planes.objectId.row(0)[i];
    if (object == 0) continue;
    const Key key{object, materials ? planes.materialId.row(0)[i] : 0};
    if (!last || key != lastKey) last = &things[lastKey = key];
    last->places.push_back(i);
  }
  return things;
}

float median(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The value that a twentieth exceed; 1 of none.
float brightShare(std::vector<float>& values) {
  if (values.empty()) return 1;
  const auto place = values.begin() + static_cast<ptrdiff_t>(values.size() * 19 / 20);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Every n-th of many pixels: a median needs no more.
std::vector<uint32_t> samplesOf(const Pixels& pixels) {
  const size_t step = std::max<size_t>(1, pixels.places.size() / mostSamples);
  std::vector<uint32_t> samples;
  for (size_t i = 0; i < pixels.places.size(); i += step) samples.push_back(pixels.places[i]);
  return samples;
}

V3f medianColour(const Vec3View& picture, const std::vector<uint32_t>& places) {
  V3f colour(0.0f);
  const std::array<const View<const float>*, 3> planes = {&picture.x, &picture.y, &picture.z};
  std::vector<float> values;
  for (int c = 0; c < 3; ++c) {
    values.clear();
    for (const uint32_t place : places)
      values.push_back(planes[static_cast<size_t>(c)]->data[place]);
    colour[c] = median(values);
  }
  return colour;
}

float brightness(const Vec3View& picture, uint32_t place) {
  return 0.2126f * picture.x.data[place] + 0.7152f * picture.y.data[place] +
         0.0722f * picture.z.data[place];
}

std::vector<uint32_t> brighterHalf(const Vec3View& picture, std::vector<uint32_t> places) {
  const auto middle = places.begin() + static_cast<ptrdiff_t>(places.size() / 2);
  std::nth_element(places.begin(), middle, places.end(), [&](uint32_t a, uint32_t b) {
    const float of_a = brightness(picture, a), of_b = brightness(picture, b);
    return of_a != of_b ? of_a > of_b : a < b;
  });
  places.resize(std::max<size_t>(1, places.size() / 2));
  return places;
}

void takeColour(const FramePlanes& planes, const std::vector<uint32_t>& places, DraftThing& thing) {
  if (!planes.albedo.empty()) thing.colour = medianColour(planes.albedo, places);
  const V3f& c = thing.colour;
  if (std::max({c.x, c.y, c.z}) >= black) return;
  if (planes.beauty.empty()) {
    thing.colour = V3f(0.18f);
    return;
  }
  thing.fromBeauty = true;
  thing.colour = medianColour(planes.beauty, brighterHalf(planes.beauty, places));
}

/// Pixels with another object, or nothing, beside them.
size_t rimPixels(const FramePlanes& planes, const std::vector<uint32_t>& places) {
  const int width = planes.width;
  size_t count = 0;
  for (const uint32_t place : places) {
    const int x = static_cast<int>(place) % width, y = static_cast<int>(place) / width;
    const uint32_t own = planes.objectId(x, y);
    count += (x > 0 && planes.objectId(x - 1, y) != own) ||
             (x + 1 < width && planes.objectId(x + 1, y) != own) ||
             (y > 0 && planes.objectId(x, y - 1) != own) ||
             (y + 1 < planes.height && planes.objectId(x, y + 1) != own);
  }
  return count;
}

float pixelWidth(const FramePlanes& planes, const std::vector<uint32_t>& places) {
  const Vec3View position = planes.position;
  const int width = planes.width;
  std::vector<float> steps;
  for (const uint32_t place : places) {
    const int x = static_cast<int>(place) % width, y = static_cast<int>(place) / width;
    if (x + 1 >= width || y + 1 >= planes.height) continue;
    const uint32_t own = planes.objectId(x, y);
    if (planes.objectId(x + 1, y) != own || planes.objectId(x, y + 1) != own) continue;
    const V3f here = position(x, y);
    steps.push_back(
        std::min((position(x + 1, y) - here).length(), (position(x, y + 1) - here).length()));
  }
  const float step = median(steps);
  return std::isfinite(step) ? step : 0.0f;
}

}  // namespace

FramePlan planWithMaterials(Look look, const std::filesystem::path& path, int frame) {
  FramePlan plan = planFrame(look, path, frame);
  AovNames names = look.frame;
  if (plan.sidecar && names.layer.empty()) names.layer = plan.sidecar->dataLayer;
  const bool indexed = plan.sidecar && !plan.sidecar->materials.empty() &&
                       findAov(plan.image, names, AovKind::materialIndex);
  if (!indexed && !findAov(plan.image, names, AovKind::cryptoMaterial)) return plan;
  StyleLook style{{}, look.passes};
  style.style.material = {"*"};
  look.styles.push_back(style);
  return planFrame(look, path, frame);
}

Floats plainTone(const Look& look, const FramePlan& plan, const FramePlanes& planes) {
  const Labels surfaces =
      labelSurfaces(planes.objectId, planes.normal, planes.position, look.passes.surfaces);
  FrameResult unused;
  return frameTone(look, plan, planes, surfaces, unused, nullptr, nullptr);
}

float brightTone(View<const float> tone, View<const uint32_t> objects) {
  std::vector<float> values;
  const size_t step = std::max<size_t>(1, tone.pixels() / mostSamples);
  for (size_t i = 0; i < tone.pixels(); i += step)
    if (objects.data[i] != 0) values.push_back(tone.data[i]);
  return brightShare(values);
}

std::vector<DraftThing> seenThings(const FramePlan& plan, const FramePlanes& planes,
                                   View<const float> tone) {
  std::vector<DraftThing> things;
  for (const auto& [key, pixels] : pixelsOfThings(planes)) {
    const auto [object, material] = key;
    DraftThing thing;
    thing.object = plan.objectName(object);
    if (const auto name = plan.materialNames.find(material); name != plan.materialNames.end())
      thing.material = name->second;
    if (plan.idSource != IdSource::cryptomatte && object <= 1u << 24) thing.index = object;
    thing.pixels = pixels.places.size();
    thing.rimPixels = rimPixels(planes, pixels.places);
    const std::vector<uint32_t> samples = samplesOf(pixels);
    takeColour(planes, samples, thing);
    thing.pixelWidth = pixelWidth(planes, samples);
    std::vector<float> tones;
    for (const uint32_t place : samples) tones.push_back(tone.data[place]);
    thing.brightTone = brightShare(tones);
    things.push_back(std::move(thing));
  }
  std::stable_sort(things.begin(), things.end(),
                   [](const DraftThing& a, const DraftThing& b) { return a.pixels > b.pixels; });
  return things;
}

}  // namespace kagefude
