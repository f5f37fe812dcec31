#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compositor/frame_light.h"
#include "compositor/frame_planes.h"
#include "frame/vector_spaces.h"

namespace kagefude {

/// Ranks of a Cryptomatte that are read: for ids, since they come by falling coverage but for
/// filtered files, and for edges, since a pixel where more things meet shows none to clean.
inline constexpr int dominantRanks = 2, edgeRanks = 4;

/// Where a frame's ids come from.
enum class IdSource { cryptomatte, index, surface };

/// What has to be read for one frame, found out from headers, sidecar and look alone.
struct FramePlan {
  int frame = 0;
  ImageFile image;
  std::optional<Sidecar> sidecar;
  std::vector<FrameLight> lights;
  Aov position, normal;  ///< position: the depth, where `spaces` says that it is rebuilt
  VectorSpaces spaces;
  std::optional<Aov> albedo, beauty;
  std::optional<Aov> rest, uv, instanceRandom;  ///< only where strokes ask for them
  bool restInWorld = false;                     ///< else in each object's own space
  std::optional<Aov> emission;                  ///< only where tone.emission asks for it
  V3f worldRadiance{0, 0, 0};                   ///< only where tone.world asks for it
  std::vector<std::string> lines;       ///< channels R, G, B, A of drawn lines; empty for none
  std::optional<Aov> depth;             ///< only for outlines where no camera is known
  std::optional<Aov> coverage;          ///< Cryptomatte of objects whose coverage draws the edges
  std::vector<std::string> meanNormal;  ///< channels X, Y, Z, only beside `coverage`; or empty
  std::string meanNormalFault;          ///< why there are none although there are some
  IdSource idSource = IdSource::cryptomatte;
  Aov objectId;
  IdSource materialSource = IdSource::cryptomatte;
  std::optional<Aov> materialId;  ///< only when a style asks for materials
  std::map<uint32_t, std::string> objectNames;
  std::map<uint32_t, std::string> materialNames;
  /// Objects and materials that manifest or sidecar name, without those whose names only the look
  /// has.
  std::map<uint32_t, std::string> listedNames, listedMaterials;
  bool hasCasters = false;  ///< whether the sidecar names the shapes that cast shadows
  std::vector<std::string> warnings;

  /// Name of an object id for messages and styles; "" when nothing names it.
  std::string objectName(uint32_t id) const;
  /// The id that the Cryptomatte of objects has for an object id.
  uint32_t cryptomatteIdOf(uint32_t id) const;
  /// The sidecar's object of that id, or null.
  const SidecarObject* findObject(uint32_t id) const;
};

/// Opens a frame, takes its view, and finds every pass that the look needs. `view` is what %V
/// stands for and wins over frame.view; a file without views is then that view's own. Throws
/// InputError or LookError that name what is missing; nothing of the size of the picture is
/// allocated.
FramePlan planFrame(const Look& look, const std::filesystem::path& path, int frame,
                    const std::string& view = "");

/// The same of a frame that is open, in whatever way, and whose view is taken. `sidecar` is what
/// its JSON says, if it has one.
FramePlan planOpenFrame(const Look& look, ImageFile image, std::optional<Sidecar> sidecar,
                        int frame);

}  // namespace kagefude
