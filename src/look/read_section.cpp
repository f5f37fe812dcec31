#include "look/read_section.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.h"
#include "base/nearest_name.h"

namespace kagefude {
namespace {

[[noreturn]] void fail(const toml::node& node, const std::string& sentence) {
  throw LookError(fmt::format("{}: {}", placeOf(node), sentence));
}

std::string spellNumber(double value) { return fmt::format("{}", value); }

std::string rangeOf(const Parameter& p) {
  const std::string unit = p.unit.empty() ? "" : fmt::format(" {}", p.unit);
  return fmt::format("{} to {}{}", spellNumber(p.minimum), spellNumber(p.maximum), unit);
}

double checkedNumber(const toml::node& node, const std::string& key, const Parameter& p) {
  const auto value = node.value<double>();
  if (!value || node.is_boolean())
    fail(node, fmt::format("{} wants a number from {}", key, rangeOf(p)));
  // Written so that NaN fails too.
  if (!(*value >= p.minimum && *value <= p.maximum))
    fail(node, fmt::format("{} is {}, outside its range {}", key, spellNumber(*value), rangeOf(p)));
  return *value;
}

Value integerFrom(const toml::node& node, const std::string& key, const Parameter& p) {
  const double value = checkedNumber(node, key, p);
  if (value != static_cast<double>(static_cast<int>(value)))
    fail(node, fmt::format("{} wants a whole number from {}", key, rangeOf(p)));
  return static_cast<int>(value);
}

Value choiceFrom(const toml::node& node, const std::string& key, const Parameter& p) {
  const std::vector<std::string> names(p.choices.begin(), p.choices.end());
  const auto text = node.value<std::string>();
  if (!text) fail(node, fmt::format("{} wants one of {}", key, listNames(names)));
  const auto found = std::find(names.begin(), names.end(), *text);
  if (found == names.end())
    fail(node, fmt::format("{} cannot be \"{}\"{}; it is one of {}", key, *text,
                           didYouMean(*text, names), listNames(names)));
  return static_cast<int>(found - names.begin());
}

Value numbersFrom(const toml::node& node, const std::string& key, const Parameter& p) {
  const toml::array* array = node.as_array();
  // An empty list is how a look says "none" where that is the default.
  const bool none =
      array && array->empty() && std::get<std::vector<double>>(p.defaultValue()).empty();
  if (!array || (p.count != 0 && array->size() != p.count && !none))
    fail(node, p.count ? fmt::format("{} wants a list of {} numbers", key, p.count)
                       : fmt::format("{} wants a list of numbers", key));
  std::vector<double> result;
  for (const toml::node& element : *array) result.push_back(checkedNumber(element, key, p));
  return result;
}

Value textsFrom(const toml::node& node, const std::string& key) {
  std::vector<std::string> result;
  if (const auto single = node.value<std::string>()) return std::vector<std::string>{*single};
  const toml::array* array = node.as_array();
  if (!array) fail(node, fmt::format("{} wants a text or a list of texts", key));
  for (const toml::node& element : *array) {
    const auto text = element.value<std::string>();
    if (!text) fail(element, fmt::format("{} wants a text or a list of texts", key));
    result.push_back(*text);
  }
  return result;
}

Value valueFrom(const toml::node& node, const std::string& key, const Parameter& p) {
  switch (p.type) {
    case ValueType::boolean:
      if (!node.is_boolean()) fail(node, fmt::format("{} wants true or false", key));
      return *node.value<bool>();
    case ValueType::integer:
      return integerFrom(node, key, p);
    case ValueType::number:
      return checkedNumber(node, key, p);
    case ValueType::choice:
      return choiceFrom(node, key, p);
    case ValueType::text:
      if (!node.is_string()) fail(node, fmt::format("{} wants a text in quotes", key));
      return *node.value<std::string>();
    case ValueType::numbers:
      return numbersFrom(node, key, p);
    case ValueType::texts:
      return textsFrom(node, key);
  }
  return {};
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    const auto byte = static_cast<unsigned char>(c);
    const bool control = byte < 0x20 || byte == 0x7f;
    result += control ? fmt::format("\\u{:04x}", byte) : std::string(1, c);
  }
  return result + "\"";
}

std::string placeOf(const toml::node& node) {
  const toml::source_region& source = node.source();
  const std::string file = source.path ? *source.path : std::string("look");
  if (file.starts_with("--set ")) return file;  // its one line needs no number
  return source.begin.line ? fmt::format("{}:{}", file, source.begin.line) : file;
}

void readSection(const toml::table& section, const ParameterTable& table, void* params,
                 const std::vector<std::string>& others) {
  std::vector<std::string> known(others);
  for (const Parameter& p : table.parameters) known.emplace_back(p.name);
  refuseOtherKeys(section, fmt::format("[{}]", table.pass), known);
  for (const Parameter& p : table.parameters)
    if (const toml::node* node = section.get(p.name))
      p.set(params, valueFrom(*node, fmt::format("{}.{}", table.pass, p.name), p));
}

const toml::table* findSection(const toml::table& root, std::string_view name) {
  const toml::node* node = root.get(name);
  if (!node) return nullptr;
  if (!node->is_table()) fail(*node, fmt::format("{} must be a section, [{}]", name, name));
  return node->as_table();
}

void refuseOtherKeys(const toml::table& table, const std::string& where,
                     const std::vector<std::string>& known) {
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (std::find(known.begin(), known.end(), name) == known.end())
      fail(node, fmt::format("{} has no key {}{}", where, name, didYouMean(name, known)));
  }
}

std::string spellValue(const Parameter& parameter, const Value& value) {
  switch (parameter.type) {
    case ValueType::boolean:
      return std::get<bool>(value) ? "true" : "false";
    case ValueType::integer:
      return fmt::format("{}", std::get<int>(value));
    case ValueType::number:
      // As float: the number that the user wrote, not the tail of its double.
      return fmt::format("{}", static_cast<float>(std::get<double>(value)));
    case ValueType::choice:
      return quoted(std::string(parameter.choices[static_cast<size_t>(std::get<int>(value))]));
    case ValueType::text:
      return quoted(std::get<std::string>(value));
    case ValueType::numbers: {
      std::vector<float> list;
      for (const double v : std::get<std::vector<double>>(value))
        list.push_back(static_cast<float>(v));
      return fmt::format("[{}]", fmt::join(list, ", "));
    }
    case ValueType::texts: {
      std::vector<std::string> list;
      for (const auto& v : std::get<std::vector<std::string>>(value)) list.push_back(quoted(v));
      return fmt::format("[{}]", fmt::join(list, ", "));
    }
  }
  return {};
}

}  // namespace kagefude
