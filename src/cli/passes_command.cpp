#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/printed_json.h"
#include "cli/commands.h"
#include "look/look_sections.h"
#include "look/parameter_json.h"
#include "look/parameter_text.h"
#include "look/read_section.h"
#include "passes/strip/strip_paint.h"

namespace kagefude {
namespace {

using Json = nlohmann::ordered_json;

void printTable(std::ostream& out, const ParameterTable& table) {
  out << fmt::format("[{}]  {}  ({})\n", table.pass, table.summary, table.source);
  for (const Parameter& p : table.parameters) {
    out << fmt::format("  {} = {}    {}", p.name, spellValue(p, p.defaultValue()),
                       typeName(p.type));
    const std::string range = rangeText(p);
    if (!range.empty()) out << ", " << range;
    out << fmt::format("\n      {}\n", p.help);
  }
  out << "\n";
}

/// The look's tables, or the one of that name, which may be `strip make`'s own.
std::vector<const ParameterTable*> chosenTables(const std::string& name) {
  std::vector<const ParameterTable*> chosen;
  std::vector<std::string> names;
  for (const LookSection& section : lookSections) {
    names.emplace_back(section.table->pass);
    if (name.empty() || name == section.table->pass) chosen.push_back(section.table);
  }
  names.emplace_back(stripTable.pass);
  if (name == stripTable.pass) chosen = {&stripTable};
  if (chosen.empty())
    throw UsageError(fmt::format("there is no pass {}{}; there are {}", name,
                                 didYouMean(name, names), listNames(names, names.size())));
  return chosen;
}

void printPasses(std::ostream& out, const std::string& name, bool json) {
  Json list = Json::array();
  for (const ParameterTable* table : chosenTables(name)) {
    if (json)
      list.push_back(jsonOf(*table));
    else
      printTable(out, *table);
  }
  if (json) out << printedJson(list) << "\n";
}

}  // namespace

void addPassesCommand(CLI::App& app, Console& console, int&) {
  struct Options {
    std::string name;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "passes", "Print every pass and parameter: type, default, range, unit, meaning");
  command->add_option("name", options->name, "only this pass or section");
  command->add_flag("--json", options->json, "as JSON");
  command->callback(
      [options, &console] { printPasses(console.out, options->name, options->json); });
}

}  // namespace kagefude
