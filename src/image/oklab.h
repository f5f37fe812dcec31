#pragma once

#include "image/real_math.h"
#include "image/vec.h"

// Oklab (B. Ottosson, "A perceptual color space for image processing", 2020; his matrices): equal
// steps look about equally large, and hue stays as lightness changes. For choosing colours, not for
// pixels' own. The same bits everywhere.
namespace kagefude {

/// Display-encoded sRGB to linear light and back (IEC 61966-2-1); below 0 goes straight on.
inline float linearOfSrgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : powerOf((encoded + 0.055f) / 1.055f, 2.4f);
}
inline float srgbOfLinear(float linear) {
  return linear <= 0.0031308f ? linear * 12.92f : 1.055f * powerOf(linear, 1.0f / 2.4f) - 0.055f;
}

/// Lightness (x, 0..1), and a (green to red) and b (blue to yellow) of a linear Rec. 709 colour.
/// Components below 0 count as 0.
inline V3f oklabOfLinear(const V3f& c) {
  const auto root = [](float v) { return powerOf(v, 1.0f / 3.0f); };
  const float l = root(0.4122214708f * c.x + 0.5363325363f * c.y + 0.0514459929f * c.z);
  const float m = root(0.2119034982f * c.x + 0.6806995451f * c.y + 0.1073969566f * c.z);
  const float s = root(0.0883024619f * c.x + 0.2817188376f * c.y + 0.6299787005f * c.z);
  return {0.2104542553f * l + 0.7936177850f * m - 0.0040720468f * s,
          1.9779984951f * l - 2.4285922050f * m + 0.4505937099f * s,
          0.0259040371f * l + 0.7827717662f * m - 0.8086757660f * s};
}

/// The linear Rec. 709 colour; outside of 0..1 where no such colour can be shown.
inline V3f linearOfOklab(const V3f& lab) {
  const float l = lab.x + 0.3963377774f * lab.y + 0.2158037573f * lab.z;
  const float m = lab.x - 0.1055613458f * lab.y - 0.0638541728f * lab.z;
  const float s = lab.x - 0.0894841775f * lab.y - 1.2914855480f * lab.z;
  const float l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
  return {4.0767416621f * l3 - 3.3077115913f * m3 + 0.2309699292f * s3,
          -1.2684380046f * l3 + 2.6097574011f * m3 - 0.3413193965f * s3,
          -0.0041960863f * l3 - 0.7034186147f * m3 + 1.7076147010f * s3};
}

/// The display-encoded sRGB colour of that lightness and hue, with as much of its chroma as can be
/// shown. Lightness is clamped to 0..1.
V3f srgbOfOklab(const V3f& lab);
/// Of display-encoded sRGB.
V3f oklabOfSrgb(const V3f& encoded);

/// [ours] The colour with its hue turned by at most `degrees` towards warm (yellow, above 0) or
/// cool (blue, below 0), never beyond it; greys take a tint of 0.0007 chroma a degree.
V3f leanTowardsWarm(const V3f& lab, float degrees);

}  // namespace kagefude
