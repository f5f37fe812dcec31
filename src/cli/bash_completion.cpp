#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "cli/manual_page.h"
#include "look/look_sections.h"
#include "passes/strip/strip_paint.h"

namespace kagefude {
namespace {

/// What is done with the tables below. Bash takes `=` for the end of a word.
constexpr const char* completer = R"bash(
_kagefude() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command='' word i
  local key=''
  for ((i = 1; i < COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    [ -n "$(_kagefude_options "${command:+$command }$word")" ] || break
    command=${command:+$command }$word
  done
  COMPREPLY=()
  if [ "$before" = '=' ]; then
    key=${COMP_WORDS[COMP_CWORD-2]}
  elif [ "$current" = '=' ]; then
    key=$before current=''
  fi
  if [ -n "$key" ]; then
    COMPREPLY=($(compgen -W "$(_kagefude_choices "$key")" -- "$current"))
  elif [ "$before" = --set ]; then
    compopt -o nospace 2>/dev/null
    COMPREPLY=($(compgen -S = -W "$(_kagefude_keys "$command")" -- "$current"))
  elif [ -n "$(_kagefude_values "$command $before")" ]; then
    COMPREPLY=($(compgen -W "$(_kagefude_values "$command $before")" -- "$current"))
  elif [ -z "$command" ] || [[ $current = -* ]]; then
    COMPREPLY=($(compgen -W "$(_kagefude_options "$command")" -- "$current"))
  else
    COMPREPLY=($(compgen -W "$(_kagefude_parts "$command")" -- "$current"))
  fi
}
complete -o bashdefault -o default -F _kagefude kagefude
)bash";

/// A bash function that prints what belongs to its first argument.
std::string table(const std::string& name, const std::string& rows) {
  return fmt::format("{}() {{\n  case $1 in\n{}  esac\n}}\n", name, rows);
}

std::string row(const std::string& key, const std::vector<std::string>& words) {
  return words.empty() ? "" : fmt::format("    '{}') echo '{}' ;;\n", key, fmt::join(words, " "));
}

std::vector<std::string> partsOf(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* part : command.get_subcommands({}))
    if (!part->get_group().empty()) names.push_back(part->get_name());
  return names;
}

/// The members of "{a,b,c}" in what CLI11 calls an option's type.
std::vector<std::string> membersOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const size_t begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

struct Rows {
  std::string options, values, parts;
};

void addCommand(const CLI::App& command, const std::string& name, Rows& rows) {
  std::vector<std::string> options = partsOf(command);
  rows.parts += row(name, options);
  for (const CLI::Option* option : command.get_options())
    for (const std::string& longName : option->get_lnames()) {
      options.push_back("--" + longName);
      rows.values += row(name + " --" + longName, membersOf(*option));
    }
  rows.options += row(name, options);
  for (const CLI::App* part : command.get_subcommands({}))
    if (!part->get_group().empty())
      addCommand(*part, name.empty() ? part->get_name() : name + " " + part->get_name(), rows);
}

}  // namespace

std::string bashCompletion(const CLI::App& program) {
  Rows rows;
  addCommand(program, "", rows);
  std::vector<std::string> keys, stripKeys;
  std::string choices;
  const auto addChoices = [&](const std::string& key, const Parameter& p) {
    std::vector<std::string> words(p.choices.begin(), p.choices.end());
    if (p.type == ValueType::boolean) words = {"true", "false"};
    choices += row(key, words);
  };
  for (const LookSection& section : lookSections) {
    if (section.isList()) continue;  // its keys need an entry's number
    for (const Parameter& p : section.table->parameters) {
      keys.push_back(fmt::format("{}.{}", section.table->pass, p.name));
      addChoices(keys.back(), p);
    }
  }
  for (const Parameter& p : stripTable.parameters) {
    stripKeys.emplace_back(p.name);
    addChoices(stripKeys.back(), p);
  }
  return "# Completion of kagefude for bash, made from its own tables.\n" +
         table("_kagefude_options", rows.options) + table("_kagefude_parts", rows.parts) +
         table("_kagefude_values", rows.values) + table("_kagefude_choices", choices) +
         table("_kagefude_keys", row("strip make", stripKeys) +
                                     fmt::format("    *) echo '{}' ;;\n", fmt::join(keys, " "))) +
         completer;
}

}  // namespace kagefude
