#include "look/look_keys.h"

#include <fmt/format.h>

#include <functional>
#include <sstream>

#include "base/error.h"
#include "look/parse_toml.h"
#include "look/read_section.h"

namespace kagefude {
namespace {

/// Called with each table that holds values, its key there, and the key's full name.
using Visit =
    std::function<void(toml::table& owner, const std::string& key, const std::string& name)>;

void visitTable(toml::table& table, const std::string& prefix, const Visit& visit) {
  // Visits may erase: the keys first.
  std::vector<std::string> keys;
  for (const auto& [key, node] : table) keys.emplace_back(key.str());
  for (const std::string& key : keys) {
    toml::node& node = *table.get(key);
    const std::string name = prefix.empty() ? key : prefix + "." + key;
    if (toml::table* inner = node.as_table()) {
      visitTable(*inner, prefix.empty() && (key == "style" || key == "light") ? key + "[0]" : name,
                 visit);
    } else if (node.is_array_of_tables()) {
      toml::array& entries = *node.as_array();
      for (size_t i = 0; i < entries.size(); ++i)
        visitTable(*entries[i].as_table(), fmt::format("{}[{}]", name, i), visit);
    } else {
      visit(table, key, name);
    }
  }
}

toml::table parse(std::string_view text, const std::filesystem::path& path) {
  try {
    return parseToml(text, path.string());
  } catch (const toml::parse_error& error) {
    throw LookError(
        fmt::format("{}:{}: {}", path.string(), error.source().begin.line, error.description()));
  }
}

}  // namespace

std::vector<std::string> keysOf(std::string_view text, const std::filesystem::path& path) {
  toml::table look = parse(text, path);
  std::vector<std::string> names;
  visitTable(look, "", [&](toml::table&, const std::string&, const std::string& name) {
    if (name != "kagefude") names.push_back(name);
  });
  return names;
}

std::string withoutKey(std::string_view text, const std::filesystem::path& path,
                       const std::string& key) {
  toml::table look = parse(text, path);
  visitTable(look, "", [&](toml::table& owner, const std::string& own, const std::string& name) {
    if (name == key) owner.erase(own);
  });
  std::ostringstream out;
  out << look;
  return out.str();
}

std::map<std::string, std::string> placesOf(toml::table& look) {
  std::map<std::string, std::string> places;
  visitTable(look, "", [&](toml::table& owner, const std::string& own, const std::string& name) {
    const toml::node& node = *owner.get(own);
    const toml::source_region& source = node.source();
    const bool ofFile = source.path && !source.path->starts_with("--set");
    places.emplace(name, ofFile ? placeOf(node) : "--set");
  });
  return places;
}

}  // namespace kagefude
