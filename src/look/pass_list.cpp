#include "look/pass_list.h"

#include <array>

#include "frame/aov_resolver.h"
#include "look/sections.h"

namespace kagefude {
namespace {

template <auto Member>
constexpr PassEntry entry(const ParameterTable& table, Scope finest) {
  return {&table, [](PassParams& params) -> void* { return &(params.*Member); }, finest};
}

constexpr std::array passes{
    entry<&PassParams::surfaces>(surfacesTable, Scope::look),
    entry<&PassParams::pair>(pairTable, Scope::light),
    entry<&PassParams::lightShape>(lightShapeTable, Scope::light),
    entry<&PassParams::pcf>(pcfTable, Scope::light),
    entry<&PassParams::pcss>(pcssTable, Scope::light),
    entry<&PassParams::coverage>(coverageTable, Scope::light),
    entry<&PassParams::volume>(volumeTable, Scope::light),
    entry<&PassParams::planar>(planarTable, Scope::light),
    entry<&PassParams::blob>(blobTable, Scope::light),
    entry<&PassParams::smooth>(smoothTable, Scope::light),
    entry<&PassParams::shade>(shadeTable, Scope::light),
    entry<&PassParams::merge>(mergeTable, Scope::light),
    entry<&PassParams::tone>(toneTable, Scope::style),
    entry<&PassParams::brush>(brushTable, Scope::style),
    entry<&PassParams::outline>(outlineTable, Scope::style),
};

constexpr std::array ownSections{&aovNamesTable, &shadowTable, &sceneTable, &lightTable,
                                 &styleTable,    &colourTable, &outputTable};

constexpr auto joined() {
  std::array<const ParameterTable*, passes.size() + ownSections.size()> all{};
  size_t n = 0;
  for (const PassEntry& pass : passes) all[n++] = pass.table;
  for (const ParameterTable* section : ownSections) all[n++] = section;
  return all;
}
constexpr auto tables = joined();

/// Keys that hold for the whole look though others of their section can differ.
struct Key {
  std::string_view section, name;
};
constexpr Key wholeLookKeys[] = {{"shadow", "lights"}, {"merge", "lights"}, {"tone", "light"}};

}  // namespace

std::span<const PassEntry> passList() { return passes; }

bool actsIn(Scope scope, std::string_view section) {
  if (scope == Scope::look) return true;
  for (const PassEntry& pass : passes)
    if (pass.table->pass == section) return pass.finest == scope;
  return true;
}

bool actsIn(Scope scope, std::string_view section, std::string_view key) {
  if (scope == Scope::look) return true;
  for (const Key& own : wholeLookKeys)
    if (own.section == section && own.name == key) return false;
  return actsIn(scope, section);
}

std::span<const ParameterTable* const> allTables() { return tables; }

}  // namespace kagefude
