#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "cli/commands.h"
#include "cli/manual_page.h"

namespace kagefude {

void addDocumentCommand(CLI::App& app, Console& console, int&) {
  auto what = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "document", "Print a manual page or the completion, as they are installed");
  command->group("");  // for the build, and not in --help
  command->add_option("what", *what, "program, look or bash")
      ->required()
      ->check(CLI::IsMember({"program", "look", "bash"}));
  command->callback([what, &app, &console] {
    if (*what == "program") console.out << programPage(app);
    if (*what == "look") console.out << lookPage();
    if (*what == "bash") console.out << bashCompletion(app);
  });
}

}  // namespace kagefude
