#include "frame/casters.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include "base/error.h"
#include "base/plain_file.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

constexpr uintmax_t largestFile = uintmax_t{1} << 30;

}  // namespace

CasterMesh readObj(const fs::path& path) {
  tinyobj::ObjReaderConfig config;
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  if (!reader.ParseFromString(readPlainFile(path, largestFile), "", config)) {
    std::string reason = reader.Error();
    while (!reason.empty() && reason.back() == '\n') reason.pop_back();
    throw InputError(fmt::format("{}: not a readable OBJ mesh{}{}", path.string(),
                                 reason.empty() ? "" : ": ", reason));
  }
  CasterMesh mesh;
  const std::vector<float>& numbers = reader.GetAttrib().vertices;
  for (size_t i = 0; i + 2 < numbers.size(); i += 3)
    mesh.vertices.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  for (const tinyobj::shape_t& shape : reader.GetShapes()) {
    const std::vector<tinyobj::index_t>& indices = shape.mesh.indices;
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
      mesh.triangles.push_back({static_cast<uint32_t>(indices[i].vertex_index),
                                static_cast<uint32_t>(indices[i + 1].vertex_index),
                                static_cast<uint32_t>(indices[i + 2].vertex_index)});
  }
  return mesh;
}

FrameCasters readCasters(const Sidecar& sidecar, const std::map<std::string, uint32_t>& idOf) {
  FrameCasters result;
  std::map<fs::path, CasterMesh> files;
  size_t faulty = 0;
  std::string warning;
  for (const SidecarCaster& entry : sidecar.casters) {
    const auto [place, isNew] = files.try_emplace(entry.file);
    if (isNew) place->second = readObj(entry.file);
    CasterMesh world = placed(place->second, entry.worldFromObject);
    world.object = entry.object;
    const auto id = idOf.find(entry.object);
    world.id = id == idOf.end() ? 0 : id->second;
    // After placing: a matrix may flatten a mesh or throw it out of range.
    const CasterFaults faults = cleanCasterMesh(world);
    if (faults.dropped() > 0 && faulty++ == 0) warning = faultWarning(world, faults);
    result.meshes.push_back(std::move(world));
  }
  if (faulty > 1) warning += fmt::format(", and so have others ({} in all)", faulty);
  if (faulty > 0) result.warnings.push_back(fmt::format("{}: {}", sidecar.path.string(), warning));
  return result;
}

}  // namespace kagefude
