#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kagefude {

/// Whether the whole of `name` matches `glob`, in which * stands for any run of characters and ?
/// for any one byte; all else stands for itself. Cost: at most length x length.
bool matchesGlob(std::string_view name, std::string_view glob);

/// Whether `name` matches one of `globs`; false for an empty list.
bool matchesAny(std::string_view name, const std::vector<std::string>& globs);

}  // namespace kagefude
