#include "base/nearest_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace kagefude {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) above[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                           lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(above);
    above.swap(row);
  }
  return above[b.size()];
}

}  // namespace

std::optional<std::string> nearestName(std::string_view name,
                                       const std::vector<std::string>& candidates) {
  std::optional<std::string> best;
  size_t fewest = std::min(name.size(), std::max<size_t>(name.size() / 3, 1) + 1);
  for (const std::string& candidate : candidates) {
    const size_t edits = editDistance(name, candidate);
    if (edits < fewest) {
      fewest = edits;
      best = candidate;
    }
  }
  return best;
}

std::string didYouMean(std::string_view name, const std::vector<std::string>& candidates) {
  const auto near = nearestName(name, candidates);
  return near ? fmt::format(" (did you mean {}?)", *near) : std::string();
}

std::string listNames(const std::vector<std::string>& names, size_t most) {
  if (names.empty()) return "none";
  if (names.size() > most) {
    const std::vector<std::string> first(names.begin(), names.begin() + static_cast<long>(most));
    return fmt::format("{} and {} more", fmt::join(first, ", "), names.size() - most);
  }
  if (names.size() == 1) return names.front();
  const std::vector<std::string> butLast(names.begin(), names.end() - 1);
  return fmt::format("{} and {}", fmt::join(butLast, ", "), names.back());
}

}  // namespace kagefude
