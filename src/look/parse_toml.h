#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>

namespace kagefude {

/// Sections in sections, keys in dotted keys and lists in lists together. A look needs four; the
/// parser and everything behind it go one call deeper at each, and 64 were measured to take less
/// than the 128 KiB that are the smallest stack in use (musl's threads); tried with a stack of 256 KiB.
constexpr size_t mostNesting = 64;

/// Parses a text as TOML. `source` is its name in messages. LookError when it nests deeper than
/// mostNesting, naming the line; toml::parse_error as the library.
toml::table parseToml(std::string_view text, const std::string& source);

}  // namespace kagefude
