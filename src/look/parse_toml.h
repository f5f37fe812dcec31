#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>

namespace kagefude {

/// Sections in sections, keys in dotted keys and lists in lists together. A look needs four; the
/// parser and everything behind it go one call deeper at each. The deepest look, 64 inline tables
/// in each other, was measured to need a stack of 97 to 100 KiB (g++ 12, -O2, x86-64; 160 to 192
/// KiB without optimisation); it is read on the main thread, whose stack is 8 MiB where nobody
/// changed it.
constexpr size_t mostNesting = 64;

/// Parses a text as TOML. `source` is its name in messages. LookError when it nests deeper than
/// mostNesting, naming the line; toml::parse_error as the library.
toml::table parseToml(std::string_view text, const std::string& source);

}  // namespace kagefude
