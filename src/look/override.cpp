#include "look/override.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "base/error.h"
#include "look/parse_toml.h"

namespace kagefude {
namespace {

struct Step {
  std::string key;
  std::optional<size_t> index;
};

[[noreturn]] void fail(const std::string& text, const std::string& why) {
  throw LookError(fmt::format("--set {}: {}", text, why));
}

Step parseStep(const std::string& text, const std::string& part) {
  const size_t bracket = part.find('[');
  Step step{part.substr(0, bracket), std::nullopt};
  if (step.key.empty()) fail(text, "expected section.key=value");
  if (bracket == std::string::npos) return step;
  const std::string digits = part.substr(bracket + 1, part.size() - bracket - 2);
  const bool whole = part.back() == ']' && !digits.empty() && digits.size() < 6 &&
                     digits.find_first_not_of("0123456789") == std::string::npos;
  if (!whole) fail(text, fmt::format("{} wants a whole number in brackets", part));
  step.index = std::stoul(digits);
  return step;
}

std::vector<Step> parsePath(const std::string& text, const std::string& path) {
  std::vector<Step> steps;
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

toml::table& descend(toml::table& at, const Step& step, const std::string& text) {
  toml::node* node = at.get(step.key);
  if (step.index) {
    toml::array* list = node ? node->as_array() : nullptr;
    if (!list || *step.index >= list->size())
      fail(text, fmt::format("the look has no {}[{}]", step.key, *step.index));
    node = list->get(*step.index);
  } else if (!node) {
    node = &at.insert(step.key, toml::table{}).first->second;
  }
  if (!node->is_table()) fail(text, fmt::format("{} is no section", step.key));
  return *node->as_table();
}

void insertValue(toml::table& section, const std::string& key, const std::string& value) {
  const std::string source = "--set " + key;
  try {
    toml::table parsed = parseToml("value = " + value, source);
    section.insert_or_assign(key, std::move(*parsed.get("value")));
  } catch (const toml::parse_error&) {
    section.insert_or_assign(key, value);
  }
}

}  // namespace

void setValue(toml::table& section, const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) fail(text, "expected key=value");
  insertValue(section, text.substr(0, equals), text.substr(equals + 1));
}

void applyOverride(toml::table& look, const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos) fail(text, "expected section.key=value");
  const std::vector<Step> steps = parsePath(text, text.substr(0, equals));
  toml::table* section = &look;
  for (size_t i = 0; i + 1 < steps.size(); ++i) section = &descend(*section, steps[i], text);
  insertValue(*section, steps.back().key, text.substr(equals + 1));
}

}  // namespace kagefude
