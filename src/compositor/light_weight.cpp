#include "compositor/light_weight.h"

#include <algorithm>

namespace kagefude {
namespace {

const ShotLight* findLight(const WholeShot* shot, const std::string& name) {
  if (!shot) return nullptr;
  for (const ShotLight& light : shot->lights)
    if (light.name == name) return &light;
  return nullptr;
}

double powerOf(const SidecarLight& light) {
  const double luminance =
      0.2126 * light.color[0] + 0.7152 * light.color[1] + 0.0722 * light.color[2];
  return std::max(light.energy * luminance, 0.0);
}

/// Multiplies everything that says how bright the light is.
void scaleTo(float asked, LightWeight& weight) {
  const float scale = weight.subject > 0 ? asked / weight.subject : 0.0f;
  weight.power.watts *= scale;
  weight.axis = weight.subject > 0 ? weight.axis * scale : asked;
  weight.subject = weight.lead = asked;
}

}  // namespace

LightWeight weighLight(const SidecarLight& source, const WholeShot* shot, const Light& placed,
                       bool moved, float asked) {
  const ShotLight* const known = findLight(shot, source.name);
  const double now = powerOf(source);
  const double largest = known ? known->largestPower.value_or(now) : now;
  LightWeight weight;
  weight.power = {static_cast<float>(now), true};
  weight.dimming = largest > 0 ? static_cast<float>(now / largest) : 0.0f;

  const V3f subject(source.subjectCenter);
  const LightPower most{static_cast<float>(largest), true};
  weight.axis = irradianceOnAxis(placed, most, subject);
  const bool area = placed.type == Light::Type::area;
  weight.subject = area ? weight.axis * emissionCosine(placed, subject) : weight.axis;
  weight.lead = weight.subject;
  if (known && !moved) {
    weight.lead = static_cast<float>(known->irradiance);
    // A spot weighs as in the middle of its cone: what it lights may be elsewhere.
    weight.axis = static_cast<float>(known->largestOnAxis.value_or(known->largestIrradiance));
    weight.subject = area ? static_cast<float>(known->largestIrradiance) : weight.axis;
  }
  if (asked >= 0) scaleTo(asked, weight);
  return weight;
}

LightWeight weighOwnLight(float asked) {
  LightWeight weight;
  weight.known = asked >= 0;
  if (weight.known) weight.subject = weight.axis = weight.lead = asked;
  weight.power = {weight.subject, false};
  return weight;
}

void weighUnknown(const std::vector<LightWeight*>& weights) {
  float sum = 0, lead = 0;
  int count = 0;
  for (const LightWeight* weight : weights)
    if (weight->known) {
      sum += weight->subject;
      lead += weight->lead;
      ++count;
    }
  if (count == 0) return;
  const auto n = static_cast<float>(count);
  for (LightWeight* weight : weights)
    if (!weight->known) {
      weight->subject = weight->axis = weight->power.watts = sum / n;
      weight->lead = lead / n;
    }
}

}  // namespace kagefude
