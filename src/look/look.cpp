#include "look/look.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/plain_file.h"
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

toml::table parseFile(const std::filesystem::path& path) {
  if (path.empty() || isNullDevice(path)) return {};
  try {
    return parseToml(readPlainFile(path, largestLook), path.string());
  } catch (const InputError& error) {
    throw LookError(fmt::format("the look {}", error.what()));
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

std::vector<std::string> passNames() {
  std::vector<std::string> names;
  for (const PassEntry& pass : passList()) names.emplace_back(pass.table->pass);
  return names;
}

/// Where a section that does nothing in a scope would act.
std::string remedyFor(const std::string& section) {
  for (const Scope scope : {Scope::light, Scope::style})
    if (actsIn(scope, section))
      return fmt::format("give it in [{}] or under [[{}]]", section,
                         scopeNames[static_cast<size_t>(scope)]);
  return fmt::format("give it in [{}]", section);
}

/// Settings that would be taken and do nothing are refused by name.
void refuseIdle(const toml::table& section, std::string_view name, Scope scope) {
  const std::string pass(name), under(scopeNames[static_cast<size_t>(scope)]);
  if (!actsIn(scope, pass))
    throw LookError(fmt::format("{}: {} does nothing under [[{}]]; {}", placeOf(section), pass,
                                under, remedyFor(pass)));
  for (const auto& [key, node] : section)
    if (!actsIn(scope, pass, key.str()))
      throw LookError(
          fmt::format("{}: {}.{} does nothing under [[{}]], for it holds for the whole look; give "
                      "it in [{}]",
                      placeOf(node), pass, key.str(), under, pass));
}

void readPasses(const toml::table& root, PassParams& params, Scope scope) {
  for (const PassEntry& pass : passList())
    if (const toml::table* section = findSection(root, pass.table->pass)) {
      refuseIdle(*section, pass.table->pass, scope);
      readSection(*section, *pass.table, pass.in(params));
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

void readOwnSections(const toml::table& root, Look& look) {
  const auto read = [&](const ParameterTable& table, void* params) {
    if (const toml::table* section = findSection(root, table.pass))
      readSection(*section, table, params);
  };
  read(aovNamesTable, &look.frame);
  read(shadowTable, &look.shadow);
  read(sceneTable, &look.scene);
  read(colourTable, &look.colour);
  read(outputTable, &look.output);
}

void readLights(const toml::table& root, Look& look) {
  std::vector<std::string> nested = passNames();
  nested.emplace_back(shadowTable.pass);
  for (const toml::table* section : tablesOf(root, "light")) {
    LightLook light{{}, look.shadow, look.passes};
    readSection(*section, lightTable, &light.light, nested);
    if (light.light.name.empty())
      throw LookError(fmt::format("{}: a [[light]] wants a name", placeOf(*section)));
    for (const LightLook& other : look.lights)
      if (other.light.name == light.light.name)
        throw LookError(fmt::format("{}: there are two [[light]] named {}", placeOf(*section),
                                    light.light.name));
    if (const toml::table* shadow = findSection(*section, shadowTable.pass)) {
      refuseIdle(*shadow, shadowTable.pass, Scope::light);
      readSection(*shadow, shadowTable, &light.shadow);
    }
    readPasses(*section, light.passes, Scope::light);
    look.lights.push_back(std::move(light));
  }
}

void readStyles(const toml::table& root, Look& look) {
  const std::vector<std::string> nested = passNames();
  for (const toml::table* section : tablesOf(root, "style")) {
    StyleLook style{{}, look.passes};
    readSection(*section, styleTable, &style.style, nested);
    const size_t numbers = style.style.reference.size();
    if (numbers != 0 && numbers != 3)
      throw LookError(fmt::format("{}: style.reference wants three numbers", placeOf(*section)));
    readPasses(*section, style.passes, Scope::style);
    look.styles.push_back(std::move(style));
  }
}

template <class Params>
void spell(std::string& text, const std::string& heading, const ParameterTable& table,
           const Params& params) {
  text += heading + "\n";
  for (const Parameter& p : table.parameters)
    text += fmt::format("{} = {}\n", p.name, spellValue(p, p.get(&params)));
  text += "\n";
}

/// Without the keys that would be refused there.
void spellScoped(std::string& text, const std::string& heading, const ParameterTable& table,
                 Scope scope, const void* values) {
  text += heading + "\n";
  for (const Parameter& p : table.parameters)
    if (actsIn(scope, table.pass, p.name))
      text += fmt::format("{} = {}\n", p.name, spellValue(p, p.get(values)));
  text += "\n";
}

void spellPasses(std::string& text, Scope scope, PassParams params) {
  const std::string prefix =
      scope == Scope::look ? "" : fmt::format("{}.", scopeNames[static_cast<size_t>(scope)]);
  for (const PassEntry& pass : passList()) {
    const std::string_view section = pass.table->pass;
    if (!actsIn(scope, section)) continue;
    spellScoped(text, fmt::format("[{}{}]", prefix, section), *pass.table, scope, pass.in(params));
  }
}

}  // namespace

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

Look readLook(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  toml::table root = parseFile(path);
  for (const std::string& text : overrides) applyOverride(root, text);
  checkVersion(root);
  std::vector<std::string> known{"kagefude"};
  for (const ParameterTable* table : allTables()) known.emplace_back(table->pass);
  refuseOtherKeys(root, "the look", known);

  Look look;
  look.folder = path.parent_path();
  readOwnSections(root, look);
  readPasses(root, look.passes, Scope::look);
  readLights(root, look);
  readStyles(root, look);
  return look;
}

std::string resolvedText(const Look& look) {
  std::string text = fmt::format("kagefude = {}\n\n", formatVersion);
  spell(text, "[frame]", aovNamesTable, look.frame);
  spell(text, "[shadow]", shadowTable, look.shadow);
  spell(text, "[scene]", sceneTable, look.scene);
  spell(text, "[colour]", colourTable, look.colour);
  spell(text, "[output]", outputTable, look.output);
  spellPasses(text, Scope::look, look.passes);
  for (const LightLook& light : look.lights) {
    spell(text, "[[light]]", lightTable, light.light);
    spellScoped(text, "[light.shadow]", shadowTable, Scope::light, &light.shadow);
    spellPasses(text, Scope::light, light.passes);
  }
  for (const StyleLook& style : look.styles) {
    spell(text, "[[style]]", styleTable, style.style);
    spellPasses(text, Scope::style, style.passes);
  }
  return text;
}

}  // namespace kagefude
