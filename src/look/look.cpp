#include "look/look.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "base/error.h"
#include "base/plain_file.h"
#include "look/look_keys.h"
#include "look/override.h"
#include "look/parse_toml.h"
#include "look/read_section.h"

namespace kagefude {
namespace {

constexpr int64_t formatVersion = 1;

constexpr uint64_t largestLook = uint64_t{16} << 20;

/// What "nothing" is called where a file must be named; other devices are no looks.
bool isNullDevice(const std::filesystem::path& path) {
  std::error_code missing;
  return std::filesystem::canonical(path, missing) == "/dev/null";
}

toml::table parseText(std::string_view text, const std::filesystem::path& path) {
  try {
    return parseToml(text, path.string());
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    const std::string place =
        line ? fmt::format("{}:{}", path.string(), line) : fmt::format("{}", path.string());
    throw LookError(fmt::format("{}: {}", place, error.description()));
  }
}

void checkVersion(const toml::table& root) {
  const toml::node* node = root.get("kagefude");
  if (!node) return;
  if (node->value<int64_t>() != formatVersion)
    throw LookError(fmt::format("{}: kagefude must be {}, the version of the look format",
                                placeOf(*node), formatVersion));
}

std::string_view nameOf(Scope scope) { return scopeNames[static_cast<size_t>(scope)]; }

/// The sections that may stand among the keys of an entry of a list; a key of its own that is
/// called as one comes first.
std::vector<const LookSection*> sectionsAmong(std::span<const Parameter> keys) {
  std::vector<const LookSection*> sections;
  for (const LookSection& section : lookSections) {
    const bool isKey = std::any_of(keys.begin(), keys.end(), [&](const Parameter& key) {
      return key.name == section.table->pass;
    });
    if (!section.isList() && !isKey) sections.push_back(&section);
  }
  return sections;
}

std::vector<std::string> namesOf(const std::vector<const LookSection*>& sections) {
  std::vector<std::string> names;
  for (const LookSection* section : sections) names.emplace_back(section->table->pass);
  return names;
}

/// Where a section that does nothing in a scope would act.
std::string remedyFor(const LookSection& section) {
  const std::string_view name = section.table->pass;
  for (const Scope scope : {Scope::light, Scope::style})
    if (actsIn(scope, section))
      return fmt::format("give it in [{}] or under [[{}]]", name, nameOf(scope));
  return fmt::format("give it in [{}]", name);
}

/// Settings that would be taken and do nothing are refused by name.
void refuseIdle(const toml::table& given, const LookSection& section, Scope scope) {
  const std::string_view name = section.table->pass, under = nameOf(scope);
  if (!actsIn(scope, section))
    throw LookError(fmt::format("{}: {} does nothing under [[{}]]; {}", placeOf(given), name, under,
                                remedyFor(section)));
  for (const auto& [key, node] : given)
    if (!actsIn(scope, section, key.str()))
      throw LookError(
          fmt::format("{}: {}.{} does nothing under [[{}]], for it holds for the whole look; give "
                      "it in [{}]",
                      placeOf(node), name, key.str(), under, name));
}

void* placeIn(Look& look, const LookSection& section) { return section.inLook(look); }
void* placeIn(LightLook& light, const LookSection& section) { return section.inLight(light); }
void* placeIn(StyleLook& style, const LookSection& section) { return section.inStyle(style); }

template <class Owner>
void readSections(const toml::table& root, const std::vector<const LookSection*>& sections,
                  Scope scope, Owner& owner) {
  for (const LookSection* section : sections)
    if (const toml::table* given = findSection(root, section->table->pass)) {
      refuseIdle(*given, *section, scope);
      readSection(*given, *section->table, placeIn(owner, *section));
    }
}

/// The tables of a list such as [[style]]; a single [style] counts as a list of one.
std::vector<const toml::table*> tablesOf(const toml::table& root, const char* name) {
  std::vector<const toml::table*> result;
  const toml::node* node = root.get(name);
  if (!node) return result;
  if (node->is_table()) result.push_back(node->as_table());
  if (const toml::array* list = node->as_array())
    for (const toml::node& element : *list)
      if (element.is_table()) result.push_back(element.as_table());
  if (result.empty())
    throw LookError(
        fmt::format("{}: {} must be a list of sections, [[{}]]", placeOf(*node), name, name));
  return result;
}

void readLights(const toml::table& root, Look& look) {
  const auto nested = sectionsAmong(lightTable.parameters);
  for (const toml::table* section : tablesOf(root, "light")) {
    LightLook light{{}, look.shadow, look.passes};
    readSection(*section, lightTable, &light.light, namesOf(nested));
    if (light.light.name.empty())
      throw LookError(fmt::format("{}: a [[light]] wants a name", placeOf(*section)));
    for (const LightLook& other : look.lights)
      if (other.light.name == light.light.name)
        throw LookError(fmt::format("{}: there are two [[light]] named {}", placeOf(*section),
                                    light.light.name));
    readSections(*section, nested, Scope::light, light);
    look.lights.push_back(std::move(light));
  }
}

void readStyles(const toml::table& root, Look& look) {
  const auto nested = sectionsAmong(styleTable.parameters);
  for (const toml::table* section : tablesOf(root, "style")) {
    StyleLook style{{}, look.passes};
    readSection(*section, styleTable, &style.style, namesOf(nested));
    const size_t numbers = style.style.reference.size();
    if (numbers != 0 && numbers != 3)
      throw LookError(fmt::format("{}: style.reference wants three numbers", placeOf(*section)));
    readSections(*section, nested, Scope::style, style);
    look.styles.push_back(std::move(style));
  }
}

void spellKey(std::string& text, const Parameter& parameter, const void* values) {
  text += fmt::format("{} = {}\n", parameter.name, spellValue(parameter, parameter.get(values)));
}

void spellEntry(std::string& text, const ParameterTable& list, const void* values) {
  text += fmt::format("[[{}]]\n", list.pass);
  for (const Parameter& parameter : list.parameters) spellKey(text, parameter, values);
  text += "\n";
}

/// Without the sections and keys that would be refused there.
template <class Owner>
void spellSections(std::string& text, Scope scope, Owner owner) {
  const std::string prefix = scope == Scope::look ? "" : fmt::format("{}.", nameOf(scope));
  for (const LookSection& section : lookSections) {
    if (!actsIn(scope, section)) continue;
    text += fmt::format("[{}{}]\n", prefix, section.table->pass);
    for (const Parameter& parameter : section.table->parameters)
      if (actsIn(scope, section, parameter.name))
        spellKey(text, parameter, placeIn(owner, section));
    text += "\n";
  }
}

}  // namespace

std::string Look::placeOf(const std::string& key) const {
  if (!places) return "";
  const auto found = places->find(key);
  return found == places->end() ? "" : found->second;
}

std::string Look::keyWithPlace(const std::string& key) const {
  const std::string place = placeOf(key);
  if (place.empty()) return key;
  return fmt::format("{}{}{}", place, place == "--set" ? " " : ": ", key);
}

std::filesystem::path Look::resolve(const std::string& path) const { return folder / path; }

std::string Look::colourConfig() const {
  return colour.config.empty() ? std::string() : resolve(colour.config).string();
}

const StyleLook* chooseStyle(const std::vector<StyleLook>& styles,
                             const std::function<bool(const StyleParams&)>& matches) {
  const StyleLook* chosen = nullptr;
  for (const StyleLook& style : styles)
    if ((!chosen || style.style.priority > chosen->style.priority) && matches(style.style))
      chosen = &style;
  return chosen;
}

std::string readLookFile(const std::filesystem::path& path) {
  if (path.empty() || isNullDevice(path)) return {};
  try {
    return readPlainFile(path, largestLook);
  } catch (const InputError& error) {
    throw LookError(fmt::format("the look {}", error.what()));
  }
}

Look readLook(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  return readLookText(readLookFile(path), path, overrides);
}

Look readLookText(std::string_view text, const std::filesystem::path& path,
                  const std::vector<std::string>& overrides) {
  toml::table root = parseText(text, path);
  for (const std::string& text : overrides) applyOverride(root, text);
  checkVersion(root);
  std::vector<std::string> known{"kagefude"};
  for (const LookSection& section : lookSections) known.emplace_back(section.table->pass);
  refuseOtherKeys(root, "the look", known);

  Look look;
  look.folder = path.parent_path();
  look.places = std::make_shared<const std::map<std::string, std::string>>(placesOf(root));
  readSections(root, sectionsAmong({}), Scope::look, look);
  readLights(root, look);
  readStyles(root, look);
  return look;
}

std::string resolvedText(const Look& look) {
  std::string text = fmt::format("kagefude = {}\n\n", formatVersion);
  spellSections(text, Scope::look, look);
  for (const LightLook& light : look.lights) {
    spellEntry(text, lightTable, &light.light);
    spellSections(text, Scope::light, light);
  }
  for (const StyleLook& style : look.styles) {
    spellEntry(text, styleTable, &style.style);
    spellSections(text, Scope::style, style);
  }
  return text;
}

}  // namespace kagefude
