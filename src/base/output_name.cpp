#include "base/output_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/error.h"

namespace kagefude {

void requireSuffix(const std::filesystem::path& file, std::string_view suffix,
                   std::string_view option) {
  std::string own = file.extension().string();
  std::transform(own.begin(), own.end(), own.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (own == suffix) return;
  throw UsageError(fmt::format("{} {}: the name should end in {}, for that is what is written",
                               option, file.string(), suffix));
}

void refuseToReplace(const std::filesystem::path& file, std::string_view option) {
  std::error_code failed;
  if (std::filesystem::exists(std::filesystem::symlink_status(file, failed)))
    throw UsageError(
        fmt::format("{} is there already; another name for {} keeps it, --force writes over it",
                    file.string(), option));
}

}  // namespace kagefude
