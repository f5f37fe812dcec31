#include "look/override.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "look/parse_toml.h"
#include "look/read_section.h"

namespace kagefude {
namespace {

[[noreturn]] void fail(const std::string& text, const std::string& why) {
  throw LookError(fmt::format("--set {}: {}", text, why));
}

OverrideStep parseStep(const std::string& text, const std::string& part) {
  const size_t bracket = part.find('[');
  OverrideStep step{part.substr(0, bracket), std::nullopt};
  if (step.key.empty()) fail(text, "expected section.key=value");
  if (bracket == std::string::npos) return step;
  const std::string digits = part.substr(bracket + 1, part.size() - bracket - 2);
  const bool whole = part.back() == ']' && !digits.empty() && digits.size() < 6 &&
                     digits.find_first_not_of("0123456789") == std::string::npos;
  if (!whole) fail(text, fmt::format("{} wants a whole number in brackets", part));
  step.index = std::stoul(digits);
  return step;
}

std::vector<OverrideStep> parsePath(const std::string& text, const std::string& path) {
  std::vector<OverrideStep> steps;
  for (size_t begin = 0; begin <= path.size();) {
    const size_t dot = std::min(path.find('.', begin), path.size());
    steps.push_back(parseStep(text, path.substr(begin, dot - begin)));
    begin = dot + 1;
  }
  if (steps.size() > mostNesting)
    fail(path.substr(0, 40) + "...", fmt::format("the key has more than {} parts", mostNesting));
  if (steps.size() < 2 || steps.back().index) fail(text, "expected section.key=value");
  return steps;
}

/// The entry of a list; a single section counts as a list of one.
toml::node* entryOf(toml::node* list, size_t index) {
  if (!list) return nullptr;
  if (toml::array* entries = list->as_array())
    return index < entries->size() ? entries->get(index) : nullptr;
  return index == 0 && list->is_table() ? list : nullptr;
}

toml::table& descend(toml::table& at, const OverrideStep& step, const std::string& text) {
  toml::node* node = at.get(step.key);
  if (step.index) {
    node = entryOf(node, *step.index);
    if (!node) fail(text, fmt::format("the look has no {}[{}]", step.key, *step.index));
  } else if (!node) {
    node = &at.insert(step.key, toml::table{}).first->second;
  }
  if (!node->is_table()) fail(text, fmt::format("{} is no section", step.key));
  return *node->as_table();
}

/// Read from TOML as well, so that messages know where it comes from.
void insertText(toml::table& section, const std::string& key, const std::string& text,
                const std::string& source) {
  try {
    toml::table parsed = parseToml("value = " + quoted(text), source);
    section.insert_or_assign(key, std::move(*parsed.get("value")));
  } catch (const toml::parse_error&) {  // no UTF-8, which a file's name may be
    section.insert_or_assign(key, text);
  }
}

/// `name` is the whole key as the user wrote it.
void insertValue(toml::table& section, const std::string& name, const std::string& key,
                 const std::string& value) {
  const std::string source = "--set " + name;
  try {
    toml::table parsed = parseToml("value = " + value, source);
    // What stands after a line break would be set by nobody.
    if (parsed.size() != 1)
      fail(name, "there is more than one value in it, on several lines; set each by itself");
    section.insert_or_assign(key, std::move(*parsed.get("value")));
  } catch (const toml::parse_error&) {
    insertText(section, key, value, source);
  }
}

}  // namespace

void setValue(toml::table& section, const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) fail(text, "expected key=value");
  const std::string key = text.substr(0, equals);
  insertValue(section, key, key, text.substr(equals + 1));
}

Override parseOverride(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos) fail(text, "expected section.key=value");
  return {parsePath(text, text.substr(0, equals)), text.substr(equals + 1)};
}

bool beginsEntry(const toml::table& look, const Override& given) {
  const OverrideStep& list = given.path.front();
  if (given.path.size() != 2 || !list.index) return false;
  const std::string& key = given.path.back().key;
  const bool names = (list.key == "light" && key == "name") ||
                     (list.key == "style" && (key == "object" || key == "material"));
  const toml::node* node = look.get(list.key);
  const bool isList = !node || (node->is_array() && node->as_array()->is_array_of_tables());
  const size_t entries = node && node->is_array() ? node->as_array()->size() : 0;
  return names && isList && *list.index == entries;
}

void applyOverride(toml::table& look, const std::string& text) {
  const Override given = parseOverride(text);
  if (beginsEntry(look, given)) {
    toml::node& list = look.insert(given.path.front().key, toml::array{}).first->second;
    list.as_array()->push_back(toml::table{});
  }
  toml::table* section = &look;
  for (size_t i = 0; i + 1 < given.path.size(); ++i)
    section = &descend(*section, given.path[i], text);
  insertValue(*section, text.substr(0, text.find('=')), given.path.back().key, given.value);
}

}  // namespace kagefude
