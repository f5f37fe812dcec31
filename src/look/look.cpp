#include "look/look.h"

#include <fmt/format.h>

#include "base/error.h"
#include "look/override.h"
#include "look/read_section.h"

namespace kagefude {
namespace {

constexpr int64_t formatVersion = 1;

toml::table parseFile(const std::filesystem::path& path) {
  if (path.empty()) return {};
  try {
    return toml::parse_file(path.string());
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

void readPasses(const toml::table& root, PassParams& params) {
  for (const PassEntry& pass : passList())
    if (const toml::table* section = findSection(root, pass.table->pass))
      readSection(*section, *pass.table, pass.in(params));
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
    if (const toml::table* shadow = findSection(*section, shadowTable.pass))
      readSection(*shadow, shadowTable, &light.shadow);
    readPasses(*section, light.passes);
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
    readPasses(*section, style.passes);
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

void spellPasses(std::string& text, const std::string& prefix, PassParams params) {
  for (const PassEntry& pass : passList()) {
    text += fmt::format("[{}{}]\n", prefix, pass.table->pass);
    const void* values = pass.in(params);
    for (const Parameter& p : pass.table->parameters)
      text += fmt::format("{} = {}\n", p.name, spellValue(p, p.get(values)));
    text += "\n";
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
  readPasses(root, look.passes);
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
  spellPasses(text, "", look.passes);
  for (const LightLook& light : look.lights) {
    spell(text, "[[light]]", lightTable, light.light);
    spell(text, "[light.shadow]", shadowTable, light.shadow);
    spellPasses(text, "light.", light.passes);
  }
  for (const StyleLook& style : look.styles) {
    spell(text, "[[style]]", styleTable, style.style);
    spellPasses(text, "style.", style.passes);
  }
  return text;
}

}  // namespace kagefude
