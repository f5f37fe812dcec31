#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/folder_bound.h"
#include "base/plain_file.h"
#include "frame/cryptomatte.h"
#include "frame/json_text.h"

namespace kagefude {
namespace {

constexpr uint64_t largestManifest = uint64_t{256} << 20;
constexpr size_t mostNames = size_t{4} << 20;

std::optional<uint32_t> parseId(const nlohmann::json& value) {
  if (!value.is_string()) return std::nullopt;
  const auto& text = value.get_ref<const std::string&>();
  uint32_t id = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), id, 16);
  const bool whole = problem == std::errc() && end == text.data() + text.size();
  return whole && !text.empty() ? std::optional(id) : std::nullopt;
}

void parseManifest(const std::string& text, const std::string& where, Manifest& manifest) {
  const std::string beyond = detail::beyondBounds(text, {4, mostNames});
  if (!beyond.empty()) {
    manifest.warnings.push_back(fmt::format("{}: {}; names are not known", where, beyond));
    return;
  }
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
  try {
    parseManifest(readPlainFile(path, largestManifest), where, manifest);
  } catch (const InputError&) {
    manifest.warnings.push_back(where + " cannot be read; names are not known");
  }
}

std::optional<std::string> describedBy(const ImageFile& file, const Cryptomatte& cryptomatte,
                                       const char* what) {
  if (cryptomatte.key.empty()) return std::nullopt;
  return file.textOfPart(cryptomatte.part, cryptomatte.key + what);
}

}  // namespace

std::optional<std::filesystem::path> manifestFile(const ImageFile& file,
                                                  const Cryptomatte& cryptomatte) {
  const auto beside = describedBy(file, cryptomatte, "/manif_file");
  if (!beside || beside->empty() || describedBy(file, cryptomatte, "/manifest") ||
      !staysInFolder(*beside))
    return std::nullopt;
  return file.path.parent_path() / *beside;
}

Manifest readManifest(const ImageFile& file, const Cryptomatte& cryptomatte) {
  Manifest manifest;
  const auto inHeader = describedBy(file, cryptomatte, "/manifest");
  const auto beside = describedBy(file, cryptomatte, "/manif_file");
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
