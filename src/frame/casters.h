#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "passes/casters/caster_mesh.h"

namespace kagefude {

/// One entry of the sidecar's `casters`: an object, its mesh's file, and where it stands.
///   "casters": [{"object": "Cup", "file": "shot.casters/4f0c….obj", "world_from_object": M}]
/// Paths are relative to the JSON. Files are named by their content, so a mesh that does not deform
/// is written once for the whole shot and instances share one file.
struct CasterEntry {
  std::string object;
  std::string file;
  Transform worldFromObject;
};

/// The `casters` list of a sidecar; empty when it has none. Throws InputError that names the
/// sidecar when the JSON or an entry is malformed, a number is not finite, or a path is absolute or
/// leaves the sidecar's folder.
std::vector<CasterEntry> readCasterEntries(const std::filesystem::path& sidecar);

/// Reads a Wavefront OBJ file (v and f lines; all else is skipped, polygons are cut into fans) as
/// one mesh without a name, in the file's own space, not yet cleaned. No other file is opened on
/// its behalf. OBJ because it is the one mesh format that Debian both writes from Blender and reads
/// with a small, fuzzed library (tinyobjloader): its Blender has neither Alembic nor USD, and it
/// has no PLY library but assimp. Throws InputError when the file is missing, larger than 1 GiB, or
/// not OBJ.
CasterMesh readObj(const std::filesystem::path& path);

/// All casters of a frame in world space, cleaned, with `idOf(object)` as their ID, and one warning
/// for each with faults. A file that several entries name is read once.
struct FrameCasters {
  std::vector<CasterMesh> meshes;
  std::vector<std::string> warnings;
};
FrameCasters readCasters(const std::filesystem::path& sidecar,
                         const std::map<std::string, uint32_t>& idOf);

}  // namespace kagefude
