#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace kagefude {

/// How a table came to be in a text.
enum class TableKind {
  root,
  header,   ///< [name] or [[name]]
  inlined,  ///< name = { ... }
  dotted,   ///< by a key: name.key = value
  implied,  ///< by the header of something in it: [name.other]
};

/// Where a place of toml++ lies in its text: lines and columns (characters of UTF-8) from 1.
size_t offsetOf(std::string_view text, const toml::source_position& place);

/// `table` is one of the parse of `text`; `root` the whole of it.
TableKind kindOf(std::string_view text, const toml::table& root, const toml::table& table);

/// Behind the last value of the table itself, or behind its header when it has none.
toml::source_position endOfValues(std::string_view text, const toml::table& root,
                                  const toml::table& table);

}  // namespace kagefude
