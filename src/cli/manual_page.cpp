#include "cli/manual_page.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>

#include "look/look_sections.h"
#include "look/parameter_text.h"
#include "look/read_section.h"
#include "passes/strip/strip_paint.h"

namespace kagefude {
namespace {

/// Words as roff prints them: no command, no escape, hyphens that can be copied.
std::string roff(std::string_view words) {
  std::string text;
  for (const char c : words) {
    if (c == '\\')
      text += "\\e";
    else if (c == '-')
      text += "\\-";
    else
      text += c;
  }
  if (text.starts_with('.') || text.starts_with('\'')) text.insert(0, "\\&");
  return text;
}

std::string head(std::string_view name, int section, std::string_view summary) {
  return fmt::format(".TH {} {} \"\" \"kagefude {}\"\n.SH NAME\n{} \\- {}\n", name, section,
                     KAGEFUDE_VERSION, roff(name), roff(summary));
}

std::string optionTerm(const CLI::Option& option) {
  std::string term;
  for (const std::string& name : option.get_snames()) term += fmt::format("\\fB\\-{}\\fR, ", name);
  for (const std::string& name : option.get_lnames())
    term += fmt::format("\\fB\\-\\-{}\\fR, ", roff(name));
  if (term.empty()) return fmt::format("\\fI{}\\fR", roff(option.get_name(true)));
  term.resize(term.size() - 2);
  return option.get_items_expected_max() > 0 ? term + " \\fIvalue\\fR" : term;
}

std::string commandText(const CLI::App& command, const std::string& name) {
  std::string text = fmt::format(".SS \"{}\"\n{}.\n", roff(name), roff(command.get_description()));
  for (const CLI::Option* option : command.get_options())
    text += fmt::format(".TP\n{}\n{}\n", optionTerm(*option), roff(option->get_description()));
  for (const CLI::App* part : command.get_subcommands({}))
    text += commandText(*part, name + " " + part->get_name());
  return text;
}

std::string tableText(const ParameterTable& table) {
  std::string text = fmt::format(".SH [{}]\n{}.\n", roff(table.pass), roff(table.summary));
  for (const Parameter& p : table.parameters) {
    const std::string range = rangeText(p);
    text += fmt::format(".TP\n\\fB{}\\fR = {}\n{}{}{}. {}.\n", roff(p.name),
                        roff(spellValue(p, p.defaultValue())), roff(typeName(p.type)),
                        range.empty() ? "" : ", ", roff(range), roff(p.help));
  }
  return text;
}

}  // namespace

std::string programPage(const CLI::App& program) {
  std::string text = head("kagefude", 1, "soft shadows and brush touch for rendered frames");
  text +=
      ".SH SYNOPSIS\n\\fBkagefude\\fR \\fIcommand\\fR [\\fIargument\\fR ...]\n"
      ".SH DESCRIPTION\nTurns rendered frames into frames that look painted by hand, by the passes "
      "that a renderer writes beside the picture and a look (see \\fBkagefude\\-look\\fR(5)).\n"
      ".SH COMMANDS\n";
  for (const CLI::App* command : program.get_subcommands({}))
    if (!command->get_group().empty()) text += commandText(*command, command->get_name());
  text +=
      ".SH EXIT STATUS\n.TP\n0\nall frames are there\n.TP\n1\nat least one frame failed, or a "
      "result could not be written; lines that begin with ERROR: say which and why\n.TP\n2\nthe "
      "call or the look is wrong; nothing was touched\n.TP\n130, 143\ninterrupted by SIGINT, "
      "SIGTERM\n.SH ENVIRONMENT\n.TP\nOCIO\nthe OpenColorIO configuration, unless the look names "
      "one\n.SH SEE ALSO\n\\fBkagefude\\-look\\fR(5), \\fBoiiotool\\fR(1)\n";
  return text;
}

std::string lookPage() {
  std::string text = head("kagefude-look", 5, "looks of kagefude");
  text +=
      ".SH DESCRIPTION\nA look is a TOML file; every key has a default, and an empty look already "
      "paints. \\fBkagefude comp \\-\\-set\\fR \\fIsection.key=value\\fR goes before the file. "
      "Below, each section with its keys, defaults, types and ranges.\n";
  for (const LookSection& section : lookSections) text += tableText(*section.table);
  return text + tableText(stripTable) + ".SH SEE ALSO\n\\fBkagefude\\fR(1)\n";
}

}  // namespace kagefude
