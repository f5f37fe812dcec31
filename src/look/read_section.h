#pragma once

#include <toml++/toml.h>

#include <string>

#include "base/parameter.h"

namespace kagefude {

/// "look.toml:12" for a node that was parsed from a file, "--set" for one that came from an
/// override; what every LookError begins with.
std::string placeOf(const toml::node& node);

/// Reads the keys of `section` that `table` knows into `params` (the struct that the table
/// describes). Keys named in `others` are left to the caller. Throws LookError for an unknown key
/// (naming the nearest), a wrong type, a number outside its range, an unknown choice.
void readSection(const toml::table& section, const ParameterTable& table, void* params,
                 const std::vector<std::string>& others = {});

/// The section's table node, or null when the look has none. Throws LookError when `name` is there
/// but is no table.
const toml::table* findSection(const toml::table& root, std::string_view name);

/// Throws LookError naming the nearest of `known` when `table` has any other key.
void refuseOtherKeys(const toml::table& table, const std::string& where,
                     const std::vector<std::string>& known);

/// A text as TOML spells it, on one line.
std::string quoted(const std::string& text);

/// A value as TOML spells it, for the resolved look and for `passes`.
std::string spellValue(const Parameter& parameter, const Value& value);

}  // namespace kagefude
