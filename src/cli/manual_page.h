#pragma once

#include <string>

namespace CLI {
class App;
}

namespace kagefude {

/// kagefude(1) as man(7) source: every command with its options, from the parser itself.
std::string programPage(const CLI::App& program);

/// kagefude-look(5): every section and key of a look, from the parameter tables.
std::string lookPage();

/// Completion for bash: commands, options, their choices, and the keys that --set takes.
std::string bashCompletion(const CLI::App& program);

}  // namespace kagefude
