#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "exr/image_file.h"

namespace kagefude {

enum class AovKind {
  position,
  normal,
  depth,
  objectIndex,
  materialIndex,
  vector,
  albedo,
  beauty,
  shadow,
  cryptoObject,
  cryptoMaterial,
  surface,
  rest,
  uv,
  instanceRandom,
  emission
};

/// How a pass of vectors is to be read: `automatic` is world space, and doubted where the
/// positions' slopes and the normals do not agree.
enum class VectorSpace { automatic, world, camera };
inline constexpr std::string_view vectorSpaceNames[] = {"auto", "world", "camera"};
/// `automatic` is world space for names that say so (__WPref), else the object's.
enum class RestSpace { automatic, object, world };
inline constexpr std::string_view restSpaceNames[] = {"auto", "object", "world"};
/// What a depth pass measures: along the camera's axis, or along each pixel's ray.
enum class DepthKind { automatic, planar, ray };
inline constexpr std::string_view depthKindNames[] = {"auto", "planar", "ray"};
/// The world's axis that points up. Of objects that no JSON describes it stands for their own.
enum class WorldUp { z, y };
inline constexpr std::string_view worldUpNames[] = {"z", "y"};
enum class NormalRange { automatic, symmetric, unit };
inline constexpr std::string_view normalRangeNames[] = {"auto", "-1..1", "0..1"};

/// What the look (section `frame`) says about a frame's names; empty means: find it. A pass may be
/// named with its layer ("fg.Position"), without ("Position", then `layer` applies), or by a single
/// channel ("fg.Depth.Z").
struct AovNames {
  std::string layer;               ///< of the data passes
  std::string beautyLayer;         ///< of the beauty pass
  std::string view;                ///< of a multi-view file ("left")
  std::vector<std::string> files;  ///< patterns of the frame's other files, see frame_group.h
  std::string position, normal, depth, objectIndex, materialIndex, vector, albedo, beauty, shadow;
  std::string cryptoObject, cryptoMaterial;
  std::string surface;  ///< surface ids made elsewhere; has no name of its own to be found by
  std::string rest, uv, instanceRandom;
  std::string emission;
  RestSpace restSpace = RestSpace::automatic;
  VectorSpace positionSpace = VectorSpace::automatic;
  VectorSpace normalSpace = VectorSpace::automatic;
  NormalRange normalRange = NormalRange::automatic;
  std::string normalAxes;
  DepthKind depthKind = DepthKind::automatic;
  WorldUp up = WorldUp::z;
  std::vector<float> cameraFromWorld, clipFromCamera;  ///< 16 numbers row by row, or none

  const std::string& of(AovKind kind) const;
};

inline constexpr Parameter aovNamesParameters[] = {
    plain<&AovNames::layer>("layer",
                            "layer of the data passes; empty: found, or as the sidecar says"),
    plain<&AovNames::beautyLayer>("beauty_layer",
                                  "layer of the beauty pass; empty: found, or as the sidecar says"),
    plain<&AovNames::view>("view", "view of a multi-view file, such as left"),
    plain<&AovNames::files>(
        "files",
        "other files of the same frame, relative to it, such as shot.N.####.exr or "
        "N=normals.####.tif "
        "(%V is the view); their channels join the frame's, bare ones under the name before = or "
        "that the file's name adds"),
    plain<&AovNames::position>("position", "world position pass"),
    plain<&AovNames::normal>("normal", "world normal pass"),
    plain<&AovNames::depth>("depth", "camera depth pass"),
    plain<&AovNames::objectIndex>("object_index", "object index pass"),
    plain<&AovNames::materialIndex>("material_index", "material index pass"),
    plain<&AovNames::vector>("vector", "motion vector pass"),
    plain<&AovNames::albedo>("albedo", "diffuse colour pass"),
    plain<&AovNames::beauty>("beauty", "rendered picture"),
    plain<&AovNames::cryptoObject>("crypto_object", "Cryptomatte of objects"),
    plain<&AovNames::cryptoMaterial>("crypto_material", "Cryptomatte of materials"),
    plain<&AovNames::surface>("surface", "surface ids made elsewhere; taken instead of objects"),
    plain<&AovNames::rest>("rest", "positions as they are while nothing deforms the surface"),
    choice<&AovNames::restSpace>("rest_space", restSpaceNames,
                                 "space of the rest positions; auto takes world for names such as "
                                 "__WPref, else the object's"),
    plain<&AovNames::uv>("uv", "UV pass, for brush.ground = \"uv\""),
    plain<&AovNames::instanceRandom>("instance_random",
                                     "a number that differs from instance to instance"),
    plain<&AovNames::emission>("emission", "what surfaces give off themselves, for tone.emission"),
    choice<&AovNames::positionSpace>("position_space", vectorSpaceNames,
                                     "space of the positions; auto takes world and stops where "
                                     "they are seen to be the camera's"),
    choice<&AovNames::normalSpace>("normal_space", vectorSpaceNames,
                                   "space of the normals; auto takes world and stops where they "
                                   "do not fit the positions but the camera's would"),
    choice<&AovNames::normalRange>("normal_range", normalRangeNames,
                                   "values of a normal's components; 0..1 is decoded"),
    plain<&AovNames::normalAxes>("normal_axes",
                                 "which components of the pass are x, y and z, such as x -z y; "
                                 "empty: x y z"),
    choice<&AovNames::depthKind>(
        "depth_kind", depthKindNames,
        "what the depth is measured along, for frames without positions, which are rebuilt from "
        "it: the camera's axis (planar) or each pixel's ray; auto takes planar and stops where ray "
        "fits the normals"),
    choice<&AovNames::up>("up", worldUpNames,
                          "axis of the world that points up: strokes on objects that no JSON "
                          "describes run by it (Maya, Houdini, Nuke: y)"),
    numbers<&AovNames::cameraFromWorld>(
        "camera_from_world", 16, -1e12, 1e12, "",
        "matrix of the frame's camera, row by row, which looks along -z with y up; empty: as the "
        "JSON says, else the header (worldToCamera, or V-Ray's cameraTransform)"),
    numbers<&AovNames::clipFromCamera>(
        "clip_from_camera", 16, -1e12, 1e12, "",
        "projection of the frame's camera, row by row, to -1..1 over the display window; empty: as "
        "the JSON says, else the header (worldToNDC, or V-Ray's cameraFov)"),
};
inline constexpr ParameterTable aovNamesTable{
    "frame", "names the passes of frames from other renderers; empty names are found", "kagefude",
    aovNamesParameters};

/// A pass that was found. `name` is layer.pass. Channels are in the order x y z w, or r g b a; for
/// Cryptomatte: id, coverage, id, coverage ... by rank.
struct Aov {
  std::string name;
  std::vector<std::string> channels;
};

/// A pass as its channel names show it. "Fog.001.Depth.Z" is layer "Fog.001", pass "Depth".
struct PassChannels {
  std::string layer;
  std::string pass;  ///< "" for bare R, G, B, A
  std::string view;
  std::vector<std::string> channels;
};

/// Sorts a file's channels into layers and passes. Names are split from the right, because layer
/// names may contain dots and spaces: a last part that is a component (x y z w, r g b a, u v,
/// red ... in any case) is taken off; then a view that the header lists (or left, right); what is
/// then last is the pass, the rest is the layer. Bare R, G, B, A are the pass "".
std::vector<PassChannels> listPasses(const ImageFile& file);

/// The names of the layers, in file order; "" (channels without a layer) is left out.
std::vector<std::string> listLayers(const std::vector<PassChannels>& passes);

/// Finds a pass: the override if there is one, else by the table of known names (Blender 2.8 to 4,
/// the File Output node, Arnold, V-Ray, Karma, RenderMan), letter case, "_", "-" and spaces
/// ignored; earlier names in the table win over later ones. Where it looks: in the layer that
/// `names` gives; without one, in the one layer that has the pass, and among several in the one
/// that also has Position and Normal. Layers named mask.* and truth.* count only if there is no
/// other. The beauty: in `beautyLayer`, else in `layer`, else bare R G B A, else in a layer named
/// beauty, else as above, else the bare colour of a first part whose name is no pass that we know.
/// Views are no matter here: openFrame has taken one. Nothing when no pass fits. Throws InputError
/// when an override names nothing, when layers stay ambiguous, or when a pass has too few channels.
/// Channels beyond what the kind needs are left out.
std::optional<Aov> findAov(const ImageFile& file, const AovNames& names, AovKind kind);

/// Whether a rest pass of that name (layer.pass) is in world space.
bool isWorldRest(const AovNames& names, std::string_view pass);

/// As findAov, but a missing pass is an InputError that lists layers and passes, names the nearest,
/// and says what to turn on and which key of the look names it.
Aov requireAov(const ImageFile& file, const AovNames& names, AovKind kind);

/// The one channel of a shadow mask or truth layer ("mask.Key.0"): the first of its Shadow pass,
/// else of the pass by that full name, else of its only pass, else the channel of that name
/// ("MultiMatte.R"). Throws InputError naming the nearest layer or channel.
std::string requireMaskChannel(const ImageFile& file, const std::string& layer);

/// Everyday name of a kind as messages use it ("Position"), and the look's key ("frame.position").
std::string_view aovName(AovKind kind);
std::string aovKey(AovKind kind);

}  // namespace kagefude
