#include "base/folder_bound.h"

#include <algorithm>
#include <string>

namespace kagefude {

bool staysInFolder(const std::filesystem::path& path) {
  const std::string text = path.string();
  const bool drive = text.size() > 1 && text[1] == ':';
  if (text.empty() || drive || path.is_absolute()) return false;
  if (text.find('\0') != std::string::npos || text.find('\\') != std::string::npos) return false;
  return std::none_of(path.begin(), path.end(), [](const auto& step) { return step == ".."; });
}

}  // namespace kagefude
