#include "compositor/own_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "base/error.h"
#include "base/glob.h"
#include "base/nearest_name.h"
#include "base/place_error.h"
#include "compositor/paint_styles.h"
#include "image/parallel.h"
#include "look/light_strip.h"
#include "passes/tone/merge.h"

namespace kagefude {
namespace {

std::vector<std::string> lightNames(const Look& look, const FramePlan& plan) {
  std::vector<std::string> names;
  if (plan.sidecar)
    for (const SidecarLight& light : plan.sidecar->lights) names.push_back(light.name);
  for (const LightLook& light : look.lights) names.push_back(light.light.name);
  return names;
}

void refuseStrangeLights(const StyleParams& style, const std::vector<std::string>& names) {
  checkLightStrips(style);
  for (const LightStrip& own : lightStripsOf(style))
    if (std::none_of(names.begin(), names.end(),
                     [&](const std::string& name) { return matchesGlob(name, own.light); }))
      throw LookError(fmt::format(
          "style.light_strips gives {} a strip, which is no light of the frame{}; there are {}",
          own.light, didYouMean(own.light, names), listNames(names)));
}

/// Per anchor, which lights do not count in its own strip.
std::vector<std::vector<bool>> ownLightsOf(const StyledSurfaces& styled, size_t lights) {
  std::vector<std::vector<bool>> own(styled.anchors.size(), std::vector<bool>(lights, false));
  for (const OwnLight& light : styled.ownLights)
    for (size_t anchor = 0; anchor < own.size(); ++anchor)
      own[anchor][light.light] = light.paints[anchor];
  return own;
}

/// The tone of all lights but those in `left`.
Floats toneWithout(const Look& look, const std::vector<View<const float>>& tones,
                   const std::vector<float>& weights, const std::vector<bool>& left) {
  std::vector<View<const float>> others;
  std::vector<float> otherWeights;
  for (size_t i = 0; i < tones.size(); ++i) {
    if (left[i]) continue;
    others.push_back(tones[i]);
    otherWeights.push_back(weights[i]);
  }
  Floats sum(tones.front().width, tones.front().height);
  combineTones(others, otherWeights, look.passes.merge, sum);
  return sum;
}

Plane<uint16_t> onlyPainted(View<const uint16_t> index, const std::vector<bool>& paints) {
  Plane<uint16_t> own(index.width, index.height);
  parallelRows(index.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < index.width; ++x) {
        const uint16_t anchor = index(x, y);
        own(x, y) = anchor != 0 && paints[anchor - 1u] ? anchor : uint16_t{0};
      }
  });
  return own;
}

/// A light's tone as rows of its strip; 0 everywhere where `factor` is 0.
Floats rowsOf(View<const float> tone, float factor, View<const uint16_t> index,
              const StyledSurfaces& styled) {
  Floats rows(tone.width, tone.height);
  parallelRows(tone.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < tone.width; ++x) rows(x, y) = factor > 0.0f ? tone(x, y) * factor : 0.0f;
  });
  adjustTone(rows, index, styled.tones);
  return rows;
}

}  // namespace

bool paintsOwnLights(const Look& look, const FramePlan& plan) {
  return std::any_of(plan.lights.begin(), plan.lights.end(), [&](const FrameLight& light) {
    return !stripOfLight(look, {}, light.name).empty() ||
           std::any_of(look.styles.begin(), look.styles.end(), [&](const StyleLook& style) {
             return !stripOfLight(look, style.style, light.name).empty();
           });
  });
}

void checkLightStrips(const Look& look, const FramePlan& plan) {
  const std::vector<std::string> names = lightNames(look, plan);
  for (size_t i = 0; i < look.styles.size(); ++i)
    withPlace(look.placeOf(fmt::format("style[{}].light_strips", i)),
              [&] { refuseStrangeLights(look.styles[i].style, names); });
}

OwnLights::OwnLights(const Look& look, const StripSet& strips, const FramePlan& plan)
    : look_(look), strips_(strips), plan_(plan) {
  if (!paintsOwnLights(look, plan)) return;
  lights_.resize(plan.lights.size());
  for (size_t i = 0; i < lights_.size(); ++i) lights_[i].light = i;
}

void OwnLights::add(const StyleParams& style, const BrushSubject& subject, const BrushAnchor& own,
                    const BrushParams& brush) {
  for (OwnLight& light : lights_) {
    const FrameLight& of = plan_.lights[light.light];
    const std::string strip = stripOfLight(look_, style, of.name);
    light.paints.push_back(!strip.empty());
    light.multiplies.push_back(!strip.empty() && multipliesColour(style, strip));
    light.anchors.push_back(own);
    if (strip.empty()) continue;
    BrushAnchor& anchor = light.anchors.back();
    anchor.points = makeBrushAnchor(subject, of.light, brush).points;
    anchor.strip = strips_.indexOf(strip);
  }
}

std::vector<OwnLight> OwnLights::take() {
  std::erase_if(lights_, [](const OwnLight& light) {
    return std::none_of(light.paints.begin(), light.paints.end(), std::identity());
  });
  return std::move(lights_);
}

Floats sharedTone(const Look& look, const FramePlan& plan, const StyledSurfaces& styled,
                  const std::vector<View<const float>>& tones) {
  const std::vector<float> weights = toneWeights(look, plan.lights);
  const std::vector<std::vector<bool>> own = ownLightsOf(styled, tones.size());
  std::map<std::vector<bool>, Floats> sums;
  for (const std::vector<bool>& left : own)
    if (!sums.contains(left)) sums.emplace(left, toneWithout(look, tones, weights, left));
  if (sums.size() == 1) return std::move(sums.begin()->second);
  std::vector<View<const float>> perAnchor;
  for (const std::vector<bool>& left : own) perAnchor.push_back(sums.at(left));
  Floats shared(tones.front().width, tones.front().height, 0.0f);
  parallelRows(shared.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < shared.width(); ++x)
        if (const uint16_t anchor = styled.anchorIndex(x, y); anchor != 0)
          shared(x, y) = perAnchor[anchor - 1u](x, y);
  });
  return shared;
}

BrushResult paintOwnLights(const Look& look, const StripSet& strips, const FramePlan& plan,
                           const FramePlanes& planes, const StyledSurfaces& styled,
                           View<const uint32_t> surfaces,
                           const std::vector<View<const float>>& tones) {
  if (styled.ownLights.empty()) return {};
  const std::vector<LightPart> parts = lightParts(look, plan.lights);
  const ToneFloor floor = toneFloor(look, plan, planes);
  const int width = planes.width, height = planes.height;
  BrushResult sum;
  for (Floats* plane : {&sum.r, &sum.g, &sum.b, &sum.a}) *plane = Floats(width, height, 0.0f);
  for (const OwnLight& light : styled.ownLights) {
    const Plane<uint16_t> index = onlyPainted(styled.anchorIndex, light.paints);
    const auto painted = [&](float factor) {
      const Floats rows = rowsOf(tones[light.light], factor, index, styled);
      return paintLayer(strips, planes, {index, light.anchors, rows}, styled, surfaces);
    };
    const LightPart& part = parts[light.light];
    const BrushResult lit = painted(part.toOwnTone), dark = painted(0.0f);
    parallelRows(height, [&](int first, int end) {
      for (int y = first; y < end; ++y)
        for (int x = 0; x < width; ++x) {
          const uint16_t anchor = index(x, y);
          if (anchor == 0) continue;
          const float share =
              part.share * (1.0f - worldShare(styled.tones[anchor - 1u], floor.world));
          const bool multiplies = light.multiplies[anchor - 1u] && !planes.albedo.empty();
          const V3f own = multiplies ? planes.albedo.view()(x, y) * share : V3f(share);
          sum.r(x, y) += own.x * (lit.r(x, y) - dark.r(x, y));
          sum.g(x, y) += own.y * (lit.g(x, y) - dark.g(x, y));
          sum.b(x, y) += own.z * (lit.b(x, y) - dark.b(x, y));
          sum.a(x, y) += share * (lit.a(x, y) - dark.a(x, y));
        }
    });
  }
  return sum;
}

void addOwnLights(const BrushResult& added, BrushResult& brush) {
  if (added.r.empty()) return;
  const auto clamped = [](float v) { return v > 0.0f ? v : 0.0f; };
  parallelRows(brush.r.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < brush.r.width(); ++x) {
        brush.r(x, y) = clamped(brush.r(x, y) + added.r(x, y));
        brush.g(x, y) = clamped(brush.g(x, y) + added.g(x, y));
        brush.b(x, y) = clamped(brush.b(x, y) + added.b(x, y));
        brush.a(x, y) = std::min(clamped(brush.a(x, y) + added.a(x, y)), 1.0f);
      }
  });
}

}  // namespace kagefude
