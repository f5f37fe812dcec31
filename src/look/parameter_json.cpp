#include "look/parameter_json.h"

#include <nlohmann/json.hpp>

#include "look/parameter_text.h"

namespace kagefude {

using Json = nlohmann::ordered_json;

nlohmann::ordered_json jsonOf(const Parameter& parameter, const Value& value) {
  if (parameter.type == ValueType::choice)
    return std::string(parameter.choices[static_cast<size_t>(std::get<int>(value))]);
  return std::visit([](const auto& v) { return Json(v); }, value);
}

nlohmann::ordered_json jsonOf(const ParameterTable& table) {
  Json parameters = Json::array();
  for (const Parameter& p : table.parameters) {
    Json row{
        {"name", p.name}, {"type", typeName(p.type)}, {"default", jsonOf(p, p.defaultValue())}};
    if (hasRange(p)) row["range"] = {p.minimum, p.maximum};
    if (!p.choices.empty())
      row["choices"] = std::vector<std::string>(p.choices.begin(), p.choices.end());
    if (!p.unit.empty()) row["unit"] = p.unit;
    row["help"] = p.help;
    parameters.push_back(std::move(row));
  }
  return {{"pass", table.pass},
          {"summary", table.summary},
          {"source", table.source},
          {"parameters", std::move(parameters)}};
}

}  // namespace kagefude
