#include "compositor/frame_tint.h"

#include <algorithm>

#include "image/parallel.h"

namespace kagefude {
namespace {

/// A light's colour at luminance 1; white for a black one.
V3f colourOf(const FramePlan& plan, const std::string& name) {
  if (!plan.sidecar) return V3f(1.0f);
  for (const SidecarLight& light : plan.sidecar->lights) {
    if (light.name != name) continue;
    const V3f colour(static_cast<float>(light.color[0]), static_cast<float>(light.color[1]),
                     static_cast<float>(light.color[2]));
    const float own = luminanceOf(colour);
    return own > 0.0f ? colour / own : V3f(1.0f);
  }
  return V3f(1.0f);
}

}  // namespace

bool lightsTint(const Look& look) {
  return look.passes.tint.light > 0.0f ||
         std::any_of(look.styles.begin(), look.styles.end(),
                     [](const StyleLook& style) { return style.passes.tint.light > 0.0f; });
}

Vec3Plane lightColour(const FramePlan& plan, const std::vector<View<const float>>& tones,
                      const std::vector<float>& weights) {
  std::vector<V3f> colours;
  for (const FrameLight& light : plan.lights) colours.push_back(colourOf(plan, light.name));
  const int width = tones.front().width, height = tones.front().height;
  Vec3Plane result(width, height);
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        V3f sum(0.0f);
        float all = 0;
        for (size_t i = 0; i < tones.size(); ++i) {
          const float share = weights[i] * tones[i](x, y);
          sum += colours[i] * share;
          all += share;
        }
        result.set(x, y, all > 0.0f ? sum / all : V3f(1.0f));
      }
  });
  return result;
}

void tintPaint(const StyledSurfaces& styled, View<const float> tone, const Vec3Plane* light,
               BrushResult& brush) {
  if (std::none_of(styled.tints.begin(), styled.tints.end(),
                   [](const TintParams& tint) { return tint.acts(); }))
    return;
  parallelRows(tone.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < tone.width; ++x) {
        const uint16_t anchor = styled.anchorIndex(x, y);
        if (anchor == 0 || !styled.tints[anchor - 1u].acts()) continue;
        const V3f lit = light ? light->view()(x, y) : V3f(1.0f);
        const V3f colour = tinted({brush.r(x, y), brush.g(x, y), brush.b(x, y)}, lit, tone(x, y),
                                  styled.tints[anchor - 1u]);
        brush.r(x, y) = colour.x;
        brush.g(x, y) = colour.y;
        brush.b(x, y) = colour.z;
      }
  });
}

}  // namespace kagefude
