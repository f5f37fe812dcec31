#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/vec.h"
#include "passes/tone/light.h"

namespace kagefude {

// The JSON file beside each frame, format version 1: camera, lights, objects. World space is the
// renderer's, lengths are world units, matrices map columns (p' = M p).

struct Camera {
  bool perspective = true;
  V3d position{0, 0, 0};
  V3d direction{0, 0, -1};  ///< unit, the way it looks
  Transform cameraFromWorld;
  Transform clipFromCamera;
};

struct MaskSample {
  std::string layer;      ///< EXR layer that holds the mask
  V3d position{0, 0, 0};  ///< of the point light that cast it; for a sun at a nominal distance
  std::optional<V3d> direction;  ///< sun: the way that sample's light travels
  double u = 0, v = 0;           ///< place on the light in units of the arrangement's offset
};

enum class MaskArrangement { pair, line, disc, hard, grid };

struct LightMasks {
  MaskArrangement arrangement = MaskArrangement::pair;
  double offset = 0;  ///< world units; pair: the seed's l; line: half its length; disc: its radius;
                      ///< grid: half its longer side
  double offsetV = 0;  ///< of a stretched disc or a grid, along v; else as `offset`
  std::vector<MaskSample> samples{};
};

struct LightDepthMap {
  std::filesystem::path file;  ///< beside the JSON; already joined with its folder
  std::string channel;
  int width = 0, height = 0;
  bool perspective = true;
  Transform lightFromWorld;  ///< the light's camera looks along -Z; stored depth is -z there
  Transform clipFromLight;
};

/// Outline of an area light: half its sides in world units, along the light's axes u and v.
struct AreaShape {
  bool ellipse = false;  ///< else a rectangle
  double halfU = 0, halfV = 0;
};

struct SidecarLight {
  std::string name;
  LightType type = LightType::point;
  V3d position{0, 0, 0};
  V3d direction{0, 0, -1};  ///< unit, the way its light travels; point: towards the subject
  double radius = 0;        ///< world units; sun: tangent of half its angle
  std::array<double, 3> color{1, 1, 1};
  double energy = 1;        ///< watts in this frame, sun: per square metre; 0 where it is off
  bool castsShadow = true;  ///< false: shades only
  double coneAngle = 0;     ///< spot: full angle, radians
  double coneBlend = 0;     ///< spot: 0..1
  std::optional<AreaShape> area;
  V3d subjectCenter{0, 0, 0};
  double subjectRadius = 0;            ///< of the bounding sphere of what it lights; 0: not given
  V3d axisU{0, 0, 0}, axisV{0, 0, 0};  ///< world directions of u and v; 0: not given
  std::optional<LightMasks> masks;
  std::optional<LightDepthMap> depthMap;
  std::string tracedLayer;  ///< visibility traced in place of masks; "" when there is none
  std::string truthLayer;   ///< "" when no truth was traced
  int truthSamples = 0;
};

struct SidecarObject {
  std::string name;
  uint32_t index = 0;     ///< IndexOB
  uint32_t cryptoId = 0;  ///< Cryptomatte id; from the name when not given
  Transform worldFromObject;
  V3d boundsMin{0, 0, 0}, boundsMax{0, 0, 0};  ///< object space
  /// Object space, of the surface while nothing deforms it; absent: not given.
  std::optional<std::array<V3d, 2>> restBounds;
  bool instanced = false;            ///< shown more than once, under this one name
  V3d referencePoint{0, 0, 0};       ///< world space; the first of the next, if any
  std::vector<V3d> referencePoints;  ///< world space; all that the artist marked
  std::vector<std::string> materials;
  bool painted = true;  ///< false: cut or see-through, so the beauty stands there
  bool flat = false;    ///< thinnest extent below 2 % of the largest
};

struct SidecarMaterial {
  std::string name;
  uint32_t index = 0;     ///< IndexMA
  uint32_t cryptoId = 0;  ///< from the name when not given
};

/// What a light gives over the whole shot: luminance that arrives at the subject, facing it.
struct ShotLight {
  std::string name;
  double irradiance = 0;                  ///< mean; watts per square metre
  double largestIrradiance = 0;           ///< in any frame that was looked at
  std::optional<double> largestPower{};   ///< luminance of energy times color, in any such frame
  std::optional<double> largestOnAxis{};  ///< irradiance, were the subject on the light's axis
};

/// What holds for the whole shot, the same beside each of its frames.
struct WholeShot {
  int first = 0, last = 0;  ///< the scene's own range
  V3d subjectCenter{0, 0, 0};
  double subjectRadius = 0;
  double distance = 0;  ///< of the subject along the camera's view, world units; 0: not before it
  std::vector<ShotLight> lights;
};

/// One entry of `casters`: an object, its mesh's file, and where it stands.
///   "casters": [{"object": "Cup", "file": "shot.casters/4f0c….obj", "world_from_object": M}]
/// Files are named by their content, so a mesh that does not deform is written once for the whole
/// shot and instances share one file.
struct SidecarCaster {
  std::string object;
  std::filesystem::path file;  ///< beside the JSON; already joined with its folder
  Transform worldFromObject;
};

struct Sidecar {
  std::filesystem::path path;
  int frame = 0;
  double fps = 24;
  std::string image;
  int width = 0, height = 0;
  double pixelAspect = 1;
  int scale = 1;  ///< how many times the shot's own resolution the image has
  std::optional<WholeShot> shot;
  std::string dataLayer, beautyLayer;  ///< "" when not given
  /// Radiance of a world whose light is the same from everywhere, scene-linear; absent: not given.
  std::optional<V3d> worldRadiance;
  std::string linesLayer;  ///< of drawn lines that lie over everything; "" for none
  Camera camera;
  std::vector<SidecarLight> lights;
  std::vector<SidecarObject> objects;
  std::vector<SidecarMaterial> materials;
  std::vector<SidecarCaster> casters;  ///< the shapes that cast shadows

  const SidecarLight* findLight(std::string_view name) const;
  const SidecarObject* findObject(std::string_view name) const;
  const SidecarObject* findObject(uint32_t index) const;
};

/// Reads and validates a sidecar. Unknown keys are ignored. Throws InputError with the file, the
/// place in it ("lights[0].masks.samples[2].position") and what was expected, when the file is
/// unreadable, above 64 MiB or not JSON, when its version is not 1, when a needed key is missing or
/// of another type, a number is not finite or out of range, a list is too long, a name is used
/// twice, a mask arrangement has the wrong number of samples, or a path leaves the folder.
Sidecar readSidecar(const std::filesystem::path& path);

/// The sidecar of a frame: the same path with .json in place of the extension; nothing without such
/// a file, or when it is someone else's JSON (no key "kagefude"). Throws as readSidecar does.
std::optional<Sidecar> findSidecar(const std::filesystem::path& imagePath);

}  // namespace kagefude
