#pragma once

#include <string>
#include <string_view>

namespace kagefude {

/// A name as a TOML string that, taken as a glob, fits the name: quotes, backslashes and control
/// characters are escaped; bytes that are no UTF-8, which TOML cannot hold, become ?, which fits
/// any byte. A * or ? of the name stands for itself among others.
std::string tomlString(std::string_view name);

}  // namespace kagefude
