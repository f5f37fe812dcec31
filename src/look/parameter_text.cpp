#include "look/parameter_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kagefude {

const char* typeName(ValueType type) {
  switch (type) {
    case ValueType::boolean:
      return "true/false";
    case ValueType::integer:
      return "integer";
    case ValueType::number:
      return "number";
    case ValueType::choice:
      return "choice";
    case ValueType::text:
      return "text";
    case ValueType::numbers:
      return "numbers";
    case ValueType::texts:
      return "texts";
  }
  return "";
}

bool hasRange(const Parameter& p) { return p.minimum < p.maximum; }

std::string rangeText(const Parameter& p) {
  if (p.type == ValueType::choice) return fmt::format("{}", fmt::join(p.choices, " | "));
  if (!hasRange(p)) return "";
  return fmt::format("{} to {}{}{}", p.minimum, p.maximum, p.unit.empty() ? "" : " ", p.unit);
}

}  // namespace kagefude
