#include "base/printed_json.h"

#include <nlohmann/json.hpp>

namespace kagefude {

std::string printedJson(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', true, nlohmann::json::error_handler_t::replace);
}

}  // namespace kagefude
