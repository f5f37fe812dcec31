#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <vector>

namespace kagefude {

/// One part of an override's path: "style[1]".
struct OverrideStep {
  std::string key;
  std::optional<size_t> index;
};

/// "style[1].brush.key=value" taken apart.
struct Override {
  std::vector<OverrideStep> path;  ///< two or more; the last has no index
  std::string value;
};

/// Throws LookError when the text has no '=' or its path is malformed.
Override parseOverride(const std::string& text);

/// Whether the override begins a new entry of a list: its index is one past the last, and the key
/// is one that says what the entry is for, a light's name, or a style's object or material.
bool beginsEntry(const toml::table& look, const Override& given);

/// Sets one "key.path=value" in a look that is already parsed; "style[1].brush.key=value" reaches
/// into a list, of whose entries a single [style] is the first, and may begin a new one
/// (beginsEntry). The value is TOML; what is not TOML is taken as a text. Throws LookError when the
/// text has no '=', the path is malformed, or it leads through something that is no section, and
/// when further lines of the value set something else.
void applyOverride(toml::table& look, const std::string& text);

/// The same for a single section: "key=value".
void setValue(toml::table& section, const std::string& text);

}  // namespace kagefude
