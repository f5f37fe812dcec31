#pragma once

#include <toml++/toml.h>

#include <string>

namespace kagefude {

/// Sets one "key.path=value" in a look that is already parsed; "style[1].brush.key=value" reaches
/// into a list. The value is TOML; what is not TOML is taken as a text. Throws LookError when the
/// text has no '=', the path is malformed, or it leads through something that is no section.
void applyOverride(toml::table& look, const std::string& text);

/// The same for a single section: "key=value".
void setValue(toml::table& section, const std::string& text);

}  // namespace kagefude
