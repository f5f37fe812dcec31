#include "live/page_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/folder_bound.h"
#include "compositor/strip_set.h"
#include "look/light_strip.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

/// Every file that a look names but for strips, with its key.
std::set<std::pair<std::string, std::string>> filesNamed(const Look& look) {
  std::set<std::pair<std::string, std::string>> named{
      {"colour.config", look.colour.config},
      {"shadow.blob", look.shadow.blob},
      {"ground.picture", look.passes.ground.picture}};
  for (const LightLook& light : look.lights) {
    named.insert({"light.shadow.blob", light.shadow.blob});
    named.insert({"light.depth_map", light.light.depthMap});
  }
  for (const std::string& file : look.frame.files) named.insert({"frame.files", file});
  return named;
}

/// Every strip that a look names, with its key.
std::vector<std::pair<const char*, std::string>> stripsNamed(const Look& look) {
  std::vector<std::pair<const char*, std::string>> named;
  for (const StyleLook& style : look.styles) {
    named.emplace_back("style.strip", style.style.strip);
    for (const LightStrip& own : lightStripsOf(style.style))
      if (!own.strip.empty()) named.emplace_back("style.light_strips", own.strip);
  }
  for (const LightLook& light : look.lights)
    if (!light.light.strip.empty()) named.emplace_back("light.strip", light.light.strip);
  named.emplace_back("ground.strip", look.passes.ground.strip);
  return named;
}

}  // namespace

bool liesInFolder(const fs::path& folder, const std::string& name) {
  if (!staysInFolder(name)) return false;
  std::error_code error;
  const fs::path root = fs::weakly_canonical(folder.empty() ? "." : folder, error);
  if (error) return false;
  const fs::path file = fs::weakly_canonical(root / name, error);
  if (error) return false;
  const auto [end, at] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  return end == root.end() && at != file.end();
}

std::string nameIn(const Look& look, const fs::path& path) {
  return path.lexically_relative(look.folder).generic_string();
}

void refuseForeignPaths(const Look& onDisk, const Look& asked) {
  const auto known = filesNamed(onDisk);
  for (const auto& [key, file] : filesNamed(asked)) {
    if (file.empty() || known.contains({key, file})) continue;
    throw LookError(fmt::format(
        "{} = \"{}\" cannot be set from the page; write it into the look's file", key, file));
  }
  std::set<std::string> strips;
  for (const auto& [key, strip] : stripsNamed(onDisk)) strips.insert(strip);
  const auto refuse = [&](const char* key, const std::string& strip) {
    if (isBuiltinStrip(strip) || strips.contains(strip)) return;
    if (!liesInFolder(asked.folder, strip))
      throw LookError(fmt::format(
          "{} = \"{}\" is not in the look's folder; the page can only choose strips that lie there",
          key, strip));
  };
  for (const auto& [key, strip] : stripsNamed(asked)) refuse(key, strip);
}

}  // namespace kagefude
