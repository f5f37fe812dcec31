#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kagefude {

/// The candidate with the fewest edits (insert, delete, replace, swap of neighbours; letter case
/// ignored) to `name`, or nothing when even the best needs more than a third of its length (one at
/// least), or as many as it has letters. Ties go to the earlier candidate. Cost: length x length
/// per candidate.
std::optional<std::string> nearestName(std::string_view name,
                                       const std::vector<std::string>& candidates);

/// " (did you mean X?)" for error messages, or "" when nothing is near.
std::string didYouMean(std::string_view name, const std::vector<std::string>& candidates);

/// "a, b and c"; "none" for an empty list. At most `most` names are spelt out, the rest counted.
std::string listNames(const std::vector<std::string>& names, size_t most = 12);

}  // namespace kagefude
