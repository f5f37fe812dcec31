#include "frame/foreign_json.h"

#include <fmt/format.h>

namespace kagefude {

std::string foreignJson(const std::filesystem::path& imagePath) {
  std::filesystem::path path = imagePath;
  path.replace_extension(".json");
  std::error_code problem;
  if (!std::filesystem::exists(path, problem)) return "";
  return fmt::format("{} beside the frame is none of kagefude's: it has no key \"kagefude\"",
                     path.filename().string());
}

}  // namespace kagefude
