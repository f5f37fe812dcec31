#include "frame/casters.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/folder_bound.h"
#include "base/plain_file.h"
#include "frame/json_reader.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr uintmax_t largestFile = uintmax_t{1} << 30;

Transform transformOf(const Json& rows) {
  Transform result;
  if (!rows.is_array() || rows.size() != 4) throw InputError("");
  for (size_t i = 0; i < 4; ++i) {
    if (!rows[i].is_array() || rows[i].size() != 4) throw InputError("");
    for (size_t j = 0; j < 4; ++j) {
      result.m[i][j] = rows[i][j].is_number() ? rows[i][j].get<double>() : NAN;
      if (!std::isfinite(result.m[i][j])) throw InputError("");
    }
  }
  return result;
}

CasterEntry entryOf(const Json& json, const fs::path& sidecar, size_t index) {
  const auto wrong = [&](const char* what) {
    return InputError(fmt::format("{}: casters[{}] {}", sidecar.string(), index, what));
  };
  const auto text = [&](const char* key) {
    if (!json.is_object() || !json.contains(key) || !json[key].is_string())
      throw wrong("needs the texts \"object\" and \"file\"");
    return json[key].get<std::string>();
  };
  CasterEntry entry{text("object"), text("file"), {}};
  if (!staysInFolder(entry.file)) throw wrong("names a file outside of the sidecar's folder");
  try {
    entry.worldFromObject = transformOf(json.value("world_from_object", Json()));
  } catch (const InputError&) {
    throw wrong("needs \"world_from_object\" as 4 rows of 4 finite numbers");
  }
  return entry;
}

}  // namespace

std::vector<CasterEntry> readCasterEntries(const fs::path& sidecar) {
  const Json json = detail::JsonPlace::parseFile(sidecar);
  if (!json.is_object())
    throw InputError(fmt::format("{}: the sidecar is not a JSON object", sidecar.string()));
  std::vector<CasterEntry> entries;
  if (!json.contains("casters")) return entries;
  const Json& list = json["casters"];
  if (!list.is_array())
    throw InputError(fmt::format("{}: \"casters\" is not a list", sidecar.string()));
  for (size_t i = 0; i < list.size(); ++i) entries.push_back(entryOf(list[i], sidecar, i));
  return entries;
}

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

FrameCasters readCasters(const fs::path& sidecar, const std::map<std::string, uint32_t>& idOf) {
  FrameCasters result;
  std::map<std::string, CasterMesh> files;
  size_t faulty = 0;
  std::string warning;
  for (const CasterEntry& entry : readCasterEntries(sidecar)) {
    const auto [place, isNew] = files.try_emplace(entry.file);
    if (isNew) place->second = readObj(sidecar.parent_path() / entry.file);
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
  if (faulty > 0) result.warnings.push_back(fmt::format("{}: {}", sidecar.string(), warning));
  return result;
}

}  // namespace kagefude
