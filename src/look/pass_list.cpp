#include "look/pass_list.h"

#include <array>

#include "frame/aov_resolver.h"
#include "look/sections.h"

namespace kagefude {
namespace {

template <auto Member>
constexpr PassEntry entry(const ParameterTable& table) {
  return {&table, [](PassParams& params) -> void* { return &(params.*Member); }};
}

constexpr std::array passes{
    entry<&PassParams::surfaces>(surfacesTable),
    entry<&PassParams::pair>(pairTable),
    entry<&PassParams::lightShape>(lightShapeTable),
    entry<&PassParams::pcf>(pcfTable),
    entry<&PassParams::pcss>(pcssTable),
    entry<&PassParams::coverage>(coverageTable),
    entry<&PassParams::volume>(volumeTable),
    entry<&PassParams::planar>(planarTable),
    entry<&PassParams::blob>(blobTable),
    entry<&PassParams::smooth>(smoothTable),
    entry<&PassParams::shade>(shadeTable),
    entry<&PassParams::merge>(mergeTable),
    entry<&PassParams::tone>(toneTable),
    entry<&PassParams::brush>(brushTable),
    entry<&PassParams::outline>(outlineTable),
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

}  // namespace

std::span<const PassEntry> passList() { return passes; }

std::span<const ParameterTable* const> allTables() { return tables; }

}  // namespace kagefude
