#include "base/glob.h"

#include <algorithm>

namespace kagefude {

bool matchesGlob(std::string_view name, std::string_view glob) {
  size_t n = 0, g = 0, star = std::string_view::npos, retry = 0;
  while (n < name.size()) {
    if (g < glob.size() && glob[g] == '*') {
      star = g++;
      retry = n;
    } else if (g < glob.size() && (glob[g] == '?' || glob[g] == name[n])) {
      ++g;
      ++n;
    } else if (star != std::string_view::npos) {
      // Only the last star ever needs to take more: an earlier one gains nothing by it.
      g = star + 1;
      n = ++retry;
    } else {
      return false;
    }
  }
  while (g < glob.size() && glob[g] == '*') ++g;
  return g == glob.size();
}

bool matchesAny(std::string_view name, const std::vector<std::string>& globs) {
  return std::any_of(globs.begin(), globs.end(),
                     [&](const std::string& glob) { return matchesGlob(name, glob); });
}

}  // namespace kagefude
