#pragma once

#include <filesystem>
#include <string_view>

namespace kagefude {

/// A suffix says what a file is, so an output of one kind under the suffix of another (or none) is
/// refused: UsageError unless `file` ends in `suffix` (".exr"), in any case. `option` is what the
/// user wrote it after, such as "--output".
void requireSuffix(const std::filesystem::path& file, std::string_view suffix,
                   std::string_view option);

/// For what people go on to work on by hand (looks, strips): UsageError when there is something
/// under the name of `file` already, even a link that leads nowhere, with the two ways out.
/// `option` as above.
void refuseToReplace(const std::filesystem::path& file, std::string_view option);

}  // namespace kagefude
