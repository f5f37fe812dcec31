#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace kagefude {

/// Every key that a look's text sets, as overrides name them ("brush.contrast",
/// "style[2].tone.gamma"), in the order of the file's sections; without `kagefude`. Throws
/// LookError where the text is no TOML. `path` is its name in messages.
std::vector<std::string> keysOf(std::string_view text, const std::filesystem::path& path);

/// The text of the same look without a key that keysOf gave, which then has its default. Comments
/// and order are lost.
std::string withoutKey(std::string_view text, const std::filesystem::path& path,
                       const std::string& key);

/// Where each key of a look that is parsed stands, by the names of keysOf: its file and line, or
/// "--set" where an override gave it.
std::map<std::string, std::string> placesOf(toml::table& look);

}  // namespace kagefude
