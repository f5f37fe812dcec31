#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compositor/light_weight.h"
#include "frame/aov_resolver.h"
#include "frame/sidecar.h"
#include "look/look.h"
#include "passes/light_shape/light_shape.h"
#include "passes/tone/light.h"

namespace kagefude {

/// What the JSON says of a depth map, which the file and the matrix say too.
struct SaidOfDepthMap {
  int width = 0, height = 0;
  bool perspective = true;
};

/// Where a light's depth map is, and its camera.
struct DepthMapSource {
  std::filesystem::path file;
  std::string channel;  ///< empty: the depth pass found by name
  Transform lightFromWorld;
  Transform clipFromLight;
  std::string named;  ///< the look's key that names it, with its place; "" where the JSON does
  std::optional<SaidOfDepthMap> said{};
};

/// One light of one frame: what the sidecar and the look together say of it.
struct FrameLight {
  std::string name;
  Light light;
  V3f subjectCentre{0, 0, 0};
  float subjectRadius = 0;                   ///< 0: unknown
  LightWeight weight;                        ///< how much of the tone is its
  ShadowMethod method = ShadowMethod::none;  ///< never `automatic`
  bool automatic = false;                    ///< whether `auto` chose the method
  float strength = 1;
  PassParams passes;
  std::vector<std::string> maskChannels;  ///< of the masks that the method needs
  std::vector<V2f> places;                ///< of the same masks on the light, in radii
  std::optional<LightGeometry> geometry;  ///< what moves the light from mask to mask
  V3f towardsFar{0, 0, 0};                ///< a pair's farther mask, from the light's centre
  std::string tracedChannel;              ///< method traced: the visibility itself
  std::optional<DepthMapSource> depthMap;
  bool readsDepthMap = false;    ///< the method needs or uses it
  bool tellsConfidence = false;  ///< whether its layer is asked for
  int castPlaces = 0;            ///< method places: masks that are cut from the casters
  std::string receiver;          ///< methods planar and blob
  std::filesystem::path blob;    ///< picture of the blob; empty: a soft round one
  std::string blobNamed;         ///< the key that names it, with its place
};

/// The lights that take part in a frame, in the sidecar's order, then those that only the look
/// describes. `hasCasters` says whether the frame brings casters. Throws InputError when a light
/// lacks what its method needs, naming what to export; LookError when [shadow] lights or a
/// [[light]] match nothing.
std::vector<FrameLight> gatherLights(const Look& look, const Sidecar* sidecar,
                                     const ImageFile& image, int frame, bool hasCasters);

}  // namespace kagefude
