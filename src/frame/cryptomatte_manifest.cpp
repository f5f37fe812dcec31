#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/folder_bound.h"
#include "frame/cryptomatte.h"

namespace kagefude {
namespace {

constexpr uint64_t largestManifest = uint64_t{256} << 20;

std::optional<uint32_t> parseId(const nlohmann::json& value) {
  if (!value.is_string()) return std::nullopt;
  const auto& text = value.get_ref<const std::string&>();
  uint32_t id = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), id, 16);
  const bool whole = problem == std::errc() && end == text.data() + text.size();
  return whole && !text.empty() ? std::optional(id) : std::nullopt;
}

void parseManifest(const std::string& text, const std::string& where, Manifest& manifest) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) {
    manifest.warnings.push_back(fmt::format("{} is not a JSON object; names are not known", where));
    return;
  }
  size_t bad = 0;
  for (const auto& [name, value] : json.items()) {
    const auto id = parseId(value);
    if (id) {
      manifest.names.emplace(*id, name);
    } else {
      ++bad;
    }
  }
  if (bad > 0) {
    manifest.warnings.push_back(
        fmt::format("{} has {} entries without a hexadecimal id", where, bad));
  }
}

void readManifestFile(const ImageFile& file, const std::string& relative, Manifest& manifest) {
  const std::string where = fmt::format("the manifest {} of {}", relative, file.path.string());
  if (!staysInFolder(relative)) {
    manifest.warnings.push_back(where + " leaves the image's folder and was not opened");
    return;
  }
  const auto path = file.path.parent_path() / relative;
  std::error_code problem;
  const uint64_t bytes = std::filesystem::file_size(path, problem);
  std::ifstream input(path, std::ios::binary);
  if (problem || !input || bytes > largestManifest) {
    manifest.warnings.push_back(where + " cannot be read; names are not known");
    return;
  }
  std::ostringstream text;
  text << input.rdbuf();
  parseManifest(text.str(), where, manifest);
}

}  // namespace

Manifest readManifest(const ImageFile& file, const Cryptomatte& cryptomatte) {
  Manifest manifest;
  const std::string base = "cryptomatte/" + cryptomatte.key;
  const auto inHeader = cryptomatte.key.empty() ? std::nullopt : file.text(base + "/manifest");
  const auto beside = cryptomatte.key.empty() ? std::nullopt : file.text(base + "/manif_file");
  if (inHeader) {
    parseManifest(*inHeader,
                  fmt::format("the manifest of {} in {}", cryptomatte.name, file.path.string()),
                  manifest);
  } else if (beside && !beside->empty()) {
    readManifestFile(file, *beside, manifest);
  } else {
    manifest.warnings.push_back(
        fmt::format("Cryptomatte {} in {} has no manifest; its names are not known",
                    cryptomatte.name, file.path.string()));
  }
  return manifest;
}

}  // namespace kagefude
