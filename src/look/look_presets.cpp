#include "look/look_presets.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "base/nearest_name.h"
#include "image/oklab.h"

namespace kagefude {
namespace {

// Ramps: place, lift, scale, chroma. Flat steps are two points of one tone.

constexpr TonePoint oilRamp[] = {{0.00f, 0.06f, 0.26f, 0.80f},
                                 {0.28f, 0.04f, 0.56f, 1.10f},
                                 {0.62f, 0.02f, 0.93f, 1.20f},
                                 {0.86f, 0.12f, 0.96f, 1.05f},
                                 {1.00f, 0.34f, 0.70f, 0.70f}};
void paintOil(StripPaintParams& p) {
  p.strokeWidth = 64;
  p.strokeLength = 280;
  p.spacing = 0.38f;
  p.opacity = 0.95f;
  p.hardness = 0.85f;
  p.wobble = 0.35f;
  p.bristle = 0.5f;
  p.jitter = 0.1f;
  p.under = -0.08f;
  p.relief = 0.5f;
  p.hueShift = 28;
}
constexpr PresetKey oilKeys[] = {
    {"brush", "contrast", "1.15", 0, "thick paint: strokes stand out"},
    {"smooth", "h", "", 0.006f, "edges of shadows are as soft as the brush"},
    {"edges", "rough", "", 0.0014f, "strokes end where the bristles do, not on the outline"},
    {"edges", "lost", "", 0.015f, "edges melt where both sides are equally bright"},
};

constexpr TonePoint gouacheRamp[] = {{0.00f, 0.13f, 0.36f, 0.85f}, {0.20f, 0.13f, 0.38f, 0.90f},
                                     {0.28f, 0.11f, 0.60f, 0.95f}, {0.48f, 0.11f, 0.63f, 1.00f},
                                     {0.56f, 0.08f, 0.86f, 1.00f}, {0.78f, 0.08f, 0.90f, 1.00f},
                                     {0.86f, 0.22f, 0.78f, 0.90f}, {1.00f, 0.26f, 0.76f, 0.85f}};
void paintGouache(StripPaintParams& p) {
  p.strokeWidth = 60;
  p.strokeLength = 170;
  p.spacing = 0.3f;
  p.opacity = 0.9f;
  p.hardness = 0.9f;
  p.pressure = 0.3f;
  p.wobble = 0.25f;
  p.bristle = 0.2f;
  p.jitter = 0.05f;
  p.tooth = 0.15f;
  p.toothSize = 4;
  p.hueShift = 16;
}
constexpr PresetKey gouacheKeys[] = {
    {"brush", "contrast", "1", 0, "matte paint: strokes show where tones meet"},
    {"smooth", "h", "", 0.008f, "steps are rounded, as a full brush leaves them"},
};

// Flat tones must not change within themselves, so they lean by points and not by hueShift.
constexpr TonePoint celRamp[] = {
    {0.00f, 0.07f, 0.60f, 1.05f, -8},  {0.30f, 0.07f, 0.60f, 1.05f, -8},
    {0.302f, 0.03f, 0.98f, 1.05f, 3},  {0.972f, 0.03f, 0.98f, 1.05f, 3},
    {0.974f, 0.22f, 0.84f, 0.90f, 10}, {1.00f, 0.22f, 0.84f, 0.90f, 10}};
void paintCel(StripPaintParams& p) {
  p.strokeWidth = 2;
  p.strokeLength = 200;
  p.spacing = 2;
  p.bristle = 0;
  p.jitter = 0;
  p.wobble = 0;
  p.pressure = 0;
}
constexpr PresetKey celKeys[] = {
    {"brush", "contrast", "0", 0, "flat colours: no strokes"},
    {"outline", "width", "", 0.0036f, "pixels, of the picture that is written"},
    {"outline", "crease_angle", "42", 0, "lines along edges of the form too"},
};

constexpr TonePoint inkRamp[] = {{0.00f, 0.08f, 0.56f, 0}, {0.30f, 0.22f, 0.62f, 0},
                                 {0.62f, 0.46f, 0.48f, 0}, {0.85f, 0.86f, 0.11f, 0},
                                 {0.93f, 0.97f, 0.00f, 0}, {1.00f, 0.97f, 0.00f, 0}};
void paintInk(StripPaintParams& p) {
  p.strokeWidth = 14;
  p.strokeLength = 160;
  p.wobble = 0.5f;
  p.pressure = 0.5f;
  p.hatch = 2;
}
constexpr PresetKey inkKeys[] = {
    {"brush", "contrast", "1.15", 0, "crisp lines"},
    {"outline", "width", "", 0.0034f, "pixels, of the picture that is written"},
    {"outline", "crease_angle", "35", 0, "lines along edges of the form too"},
};

constexpr TonePoint pastelRamp[] = {{0.00f, 0.26f, 0.36f, 1.00f},
                                    {0.35f, 0.27f, 0.50f, 1.00f},
                                    {0.65f, 0.30f, 0.64f, 0.95f},
                                    {0.88f, 0.46f, 0.52f, 0.75f},
                                    {1.00f, 0.66f, 0.33f, 0.50f}};
void paintPastel(StripPaintParams& p) {
  p.strokeWidth = 30;
  p.strokeLength = 150;
  p.spacing = 0.45f;
  p.opacity = 0.8f;
  p.hardness = 0.6f;
  p.pressure = 0.7f;
  p.wobble = 0.35f;
  p.bristle = 0.5f;
  p.jitter = 0.13f;
  p.under = 0.14f;
  p.tooth = 0.8f;
  p.toothSize = 3;
  p.hueShift = 26;
}
constexpr PresetKey pastelKeys[] = {
    {"brush", "contrast", "1.3", 0, "the grain of the paper shows"},
    {"smooth", "h", "", 0.01f, "chalk is smudged where light turns to shadow"},
    {"shade", "wrap", "0.15", 0, "light reaches a little round the form"},
    {"edges", "rough", "", 0.0015f, "chalk breaks off at its edges"},
    {"paper", "strength", "0.2", 0, "the tooth leaves specks of paper"},
    {"paper", "pressure", "0.95", 0, "as little of it bare as a soft chalk leaves"},
    {"paper", "by_tone", "0", 0, "in light and shadow alike"},
    {"paper", "relief", "0.15", 0, "its grain is seen by its own light"},
    {"paper", "grain", "", 0.006f, "pixels"},
    {"paper", "fixed", "\"world\"", 0, "on the things, so that nothing slides under a moving one"},
};

constexpr TonePoint watercolourRamp[] = {{0.00f, 0.30f, 0.42f, 1.15f},
                                         {0.30f, 0.38f, 0.46f, 1.15f},
                                         {0.55f, 0.50f, 0.44f, 1.00f},
                                         {0.80f, 0.72f, 0.25f, 0.80f},
                                         {1.00f, 0.95f, 0.04f, 0.12f}};
void paintWatercolour(StripPaintParams& p) {
  p.strokeWidth = 150;
  p.strokeLength = 260;
  p.spacing = 0.3f;
  p.opacity = 0.4f;
  p.hardness = 0.75f;
  p.pressure = 0.4f;
  p.wobble = 0.6f;
  p.bristle = 0;
  p.jitter = 0.13f;
  p.under = 0.1f;
  p.tooth = 0.55f;
  p.toothSize = 26;
  p.pool = 0.3f;
  p.hueShift = 26;
}
constexpr PresetKey watercolourKeys[] = {
    {"brush", "contrast", "1.2", 0, "washes that dried over each other"},
    {"smooth", "h", "", 0.012f, "washes run into each other"},
    {"shade", "wrap", "0.1", 0, "light reaches a little round the form"},
    {"edges", "rim", "", 0.0074f, "pigment gathers where a wash dries at its edge"},
    {"edges", "rim_strength", "1", 0, "so that edges are drawn without a line"},
    {"edges", "lost", "", 0.015f, "washes of one tone run into each other"},
    {"paper", "strength", "0.08", 0, "washes settle in the tooth"},
    {"paper", "pressure", "0.95", 0, "and cover nearly all of it"},
    {"paper", "by_tone", "0", 0, ""},
    {"paper", "relief", "0.2", 0, "rough paper under thin paint"},
    {"paper", "grain", "", 0.0074f, "pixels"},
    {"paper", "fixed", "\"world\"", 0, "on the things, so that nothing slides under a moving one"},
};

constexpr LookPreset presets[] = {
    {"oil", "long bristled strokes of thick paint, warm in the light and cool in the shadow",
     paintOil, oilRamp, oilKeys, 0.62f, 0.5f},
    {"gouache", "few matte tones that meet in soft steps, broad flat strokes", paintGouache,
     gouacheRamp, gouacheKeys, 0.62f, 0.5f},
    {"cel", "two flat tones and a light, with dark lines round everything", paintCel, celRamp,
     celKeys, 0.5f, 0.5f, 0.22f, 0.8f},
    {"ink", "black pen lines on paper, hatched by tone", paintInk, inkRamp, inkKeys, 0.5f, 0.15f,
     0.0f, 0.0f, false},
    {"pastel", "chalk on rough paper: light, grainy, with coloured shadows", paintPastel,
     pastelRamp, pastelKeys, 0.55f, 0.4f},
    {"watercolour", "pale transparent washes that leave the paper in the light", paintWatercolour,
     watercolourRamp, watercolourKeys, 0.9f, 0.5f},
};

const V3f paperTint(0.0f, 0.004f, 0.018f);  // Oklab, added

}  // namespace

std::span<const LookPreset> lookPresets() { return presets; }

const LookPreset& lookPreset(std::string_view name) {
  std::vector<std::string> names;
  for (const LookPreset& preset : presets) {
    if (preset.name == name) return preset;
    names.emplace_back(preset.name);
  }
  throw UsageError(fmt::format("no preset is called {}{}; there are {}", name,
                               didYouMean(name, names), listNames(names)));
}

StripPaintParams presetStrip(const LookPreset& preset, const V3f& colour, int seed) {
  StripPaintParams strip;
  preset.paint(strip);
  strip.seed = seed;
  strip.stops = tonesOf(colour, preset.ramp);
  if (preset.inColour) return strip;
  for (size_t i = 0; i + 3 < strip.stops.size(); i += 4) {
    const V3f grey = oklabOfSrgb({strip.stops[i + 1], strip.stops[i + 2], strip.stops[i + 3]});
    const V3f tinted = srgbOfOklab(grey + paperTint * grey.x);
    for (int c = 0; c < 3; ++c) strip.stops[i + 1 + static_cast<size_t>(c)] = tinted[c];
  }
  return strip;
}

V3f presetOutline(const LookPreset& preset, const V3f& colour) {
  const V3f lab = oklabOfLinear(colour);
  const float lightness = 0.1f + preset.outlineLightness * lab.x;
  V3f c = srgbOfOklab({lightness, lab.y * preset.outlineChroma * preset.outlineLightness,
                       lab.z * preset.outlineChroma * preset.outlineLightness});
  for (int i = 0; i < 3; ++i) c[i] = linearOfSrgb(c[i]);
  return c;
}

}  // namespace kagefude
