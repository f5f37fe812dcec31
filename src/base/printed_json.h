#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace kagefude {

/// JSON as it is printed or written for others to read: indented by two, of ASCII alone. Control
/// characters and direction marks in names leave as \uXXXX, so it stays JSON whatever escapes a
/// terminal's lines need; bytes that are no UTF-8 become U+FFFD.
std::string printedJson(const nlohmann::ordered_json& json);

}  // namespace kagefude
