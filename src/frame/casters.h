#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "frame/sidecar.h"
#include "passes/casters/caster_mesh.h"

namespace kagefude {

/// Reads a Wavefront OBJ file (v and f lines; all else is skipped, polygons are cut into fans) as
/// one mesh without a name, in the file's own space, not yet cleaned. No other file is opened on
/// its behalf. OBJ because it is the one mesh format that Debian both writes from Blender and reads
/// with a small, fuzzed library (tinyobjloader): its Blender has neither Alembic nor USD, and it
/// has no PLY library but assimp. Throws InputError when the file is missing, larger than 1 GiB, or
/// not OBJ.
CasterMesh readObj(const std::filesystem::path& path);

/// All casters that a frame's JSON names, in world space, cleaned, with `idOf(object)` as their ID,
/// and one warning for each with faults. A file that several entries name is read once.
struct FrameCasters {
  std::vector<CasterMesh> meshes;
  std::vector<std::string> warnings;
};
FrameCasters readCasters(const Sidecar& sidecar, const std::map<std::string, uint32_t>& idOf);

}  // namespace kagefude
