#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "look/help_text.h"

namespace kagefude {

struct LightVisibility;
struct ShadowWork;

/// Finds one light's visibility; the compositor's (compositor/light_visibility.h). The look only
/// holds the pointer.
using ShadowFunction = LightVisibility (*)(const ShadowWork&);

LightVisibility noShadow(const ShadowWork&);
LightVisibility pairShadow(const ShadowWork&);
LightVisibility pairDepthShadow(const ShadowWork&);
LightVisibility lightShapeShadow(const ShadowWork&);
LightVisibility tracedShadow(const ShadowWork&);
LightVisibility pcfShadow(const ShadowWork&);
LightVisibility pcssShadow(const ShadowWork&);
LightVisibility coverageShadow(const ShadowWork&);
LightVisibility volumeShadow(const ShadowWork&);
LightVisibility placesShadow(const ShadowWork&);
LightVisibility planarShadow(const ShadowWork&);
LightVisibility blobShadow(const ShadowWork&);
LightVisibility hardShadow(const ShadowWork&);

enum class ShadowMethod {
  automatic,
  none,
  pair,
  pairDepth,
  line,
  disc,
  traced,
  pcf,
  pcss,
  coverage,
  volume,
  places,
  planar,
  blob,
  hard
};

/// Hard masks that were rendered with the frame.
struct MaskNeed {
  size_t fewest = 0;               ///< 0: the method reads no masks
  size_t most = 0;                 ///< 0: any number
  std::string_view exportAs = "";  ///< what to tell the exporter's --masks
};

/// What a method cannot do without; a light that lacks it is an error that says how to get it.
struct ShadowNeeds {
  MaskNeed masks = {};
  bool traced = false;  ///< the visibility itself, traced by the renderer
  bool depthMap = false;
  bool depthMapHelps = false;  ///< read where the light is round and has one, unless switched off
  bool casters = false;        ///< the shapes that cast shadows
  bool camera = false;         ///< the sidecar's camera; comes with the casters
  bool receiver = false;       ///< shadow.receiver
};

enum class Smoothing {
  never,
  whereAsked,  ///< smooth.all_methods: the method is smooth of itself, and a window blurs contacts
  always       ///< 002 section 4.2.2
};

/// Memory at work, beyond what every method takes.
struct ShadowBytes {
  size_t perPixel = 0;
  size_t perMask = 0;  ///< and pixel; of masks that are read, or cut from the casters
};

/// One shadow method, whole: `shadow.method`, the checks, what is read, smoothing, the memory bound
/// and the call all come from this row.
struct ShadowMethodEntry {
  ShadowMethod method;
  std::string_view name;
  std::string_view sentence;
  ShadowFunction function;  ///< null: chosen anew for each light
  Smoothing smoothing = Smoothing::never;
  ShadowNeeds needs = {};
  ShadowBytes bytes = {};
  bool cutsMasks = false;  ///< masks at shadow.places places of the light are cut from the casters
};

inline constexpr ShadowNeeds needCasters{.casters = true, .camera = true};

/// All methods, in the order of their values.
inline constexpr std::array shadowMethods{
    ShadowMethodEntry{
        ShadowMethod::automatic, "auto",
        "the masks' own arrangement (a pair with its depth map: pair_depth), then what was "
        "traced, then the depth map, then the casters, then none",
        nullptr},
    ShadowMethodEntry{ShadowMethod::none, "none", "no shadow", noShadow},
    ShadowMethodEntry{ShadowMethod::pair,
                      "pair",
                      "soft, from two masks along the light's axis",
                      pairShadow,
                      Smoothing::always,
                      {.masks = {2, 2, "pair"}},
                      {.perMask = 4}},
    ShadowMethodEntry{ShadowMethod::pairDepth,
                      "pair_depth",
                      "soft, from the depth map thrown back on the light, held to two masks",
                      pairDepthShadow,
                      Smoothing::whereAsked,
                      {.masks = {2, 2, "pair"}, .depthMap = true},
                      {.perPixel = 8, .perMask = 4}},
    ShadowMethodEntry{ShadowMethod::line,
                      "line",
                      "soft, from masks along a line across the light",
                      lightShapeShadow,
                      Smoothing::whereAsked,
                      {.masks = {2, 0, "line:5"}},
                      {.perMask = 4}},
    ShadowMethodEntry{ShadowMethod::disc,
                      "disc",
                      "soft, from masks on the light's disc",
                      lightShapeShadow,
                      Smoothing::whereAsked,
                      {.masks = {5, 0, "disc:9"}, .depthMapHelps = true},
                      {.perPixel = 10, .perMask = 4}},
    ShadowMethodEntry{ShadowMethod::traced,
                      "traced",
                      "soft, as the renderer traced it",
                      tracedShadow,
                      Smoothing::whereAsked,
                      {.traced = true},
                      {.perPixel = 4}},
    ShadowMethodEntry{ShadowMethod::pcf,
                      "pcf",
                      "the depth map, filtered over a fixed window",
                      pcfShadow,
                      Smoothing::always,
                      {.depthMap = true}},
    ShadowMethodEntry{ShadowMethod::pcss,
                      "pcss",
                      "the depth map, filtered as wide as light and blocker ask for",
                      pcssShadow,
                      Smoothing::always,
                      {.depthMap = true}},
    ShadowMethodEntry{ShadowMethod::coverage, "coverage",
                      "hard, from the casters: the share of each pixel that they hide",
                      coverageShadow, Smoothing::whereAsked, needCasters},
    ShadowMethodEntry{ShadowMethod::volume, "volume", "hard, from the casters' shadow volumes",
                      volumeShadow, Smoothing::whereAsked, needCasters},
    ShadowMethodEntry{ShadowMethod::places,
                      "places",
                      "soft, from masks that are cut from the casters at shadow.places places",
                      placesShadow,
                      Smoothing::whereAsked,
                      needCasters,
                      {.perMask = 4},
                      true},
    ShadowMethodEntry{ShadowMethod::planar,
                      "planar",
                      "the casters thrown on one flat receiver",
                      planarShadow,
                      Smoothing::whereAsked,
                      {.casters = true, .camera = true, .receiver = true}},
    ShadowMethodEntry{ShadowMethod::blob,
                      "blob",
                      "a painted spot under each object on one flat receiver",
                      blobShadow,
                      Smoothing::whereAsked,
                      {.camera = true, .receiver = true}},
    ShadowMethodEntry{ShadowMethod::hard,
                      "hard",
                      "hard, from the first mask, that of the light's middle",
                      hardShadow,
                      Smoothing::whereAsked,
                      {.masks = {1, 0, "disc:9"}}},
};

constexpr const ShadowMethodEntry& entryOf(ShadowMethod method) {
  return shadowMethods[static_cast<size_t>(method)];
}

namespace detail {

constexpr bool shadowMethodsAreInOrder() {
  for (size_t i = 0; i < shadowMethods.size(); ++i)
    if (shadowMethods[i].method != static_cast<ShadowMethod>(i)) return false;
  return true;
}
static_assert(shadowMethodsAreInOrder());

constexpr auto namesOfShadowMethods() {
  std::array<std::string_view, shadowMethods.size()> names;
  for (size_t i = 0; i < names.size(); ++i) names[i] = shadowMethods[i].name;
  return names;
}

}  // namespace detail

/// What `shadow.method` takes, and its help: from the rows above.
inline constexpr auto shadowMethodNames = detail::namesOfShadowMethods();
inline constexpr JoinedText shadowMethodHelp([](auto put) {
  put("where the visibility comes from");
  for (size_t i = 0; i < shadowMethods.size(); ++i) {
    put(i == 0 ? ". " : "; ");
    put(shadowMethods[i].name);
    put(": ");
    put(shadowMethods[i].sentence);
  }
});

}  // namespace kagefude
