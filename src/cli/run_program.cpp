#include <CLI/CLI.hpp>
#include <new>
#include <ostream>

#include "base/error.h"
#include "base/files_read.h"
#include "base/printable.h"
#include "cli/commands.h"

namespace kagefude {
namespace {

int report(Console& console, const std::exception& error, int code) {
  console.message(std::string("ERROR: ") + error.what());
  return code;
}

/// An empty value is a script's unset variable more often than a wish, and would be taken for "not
/// given". An empty look is one, though: all defaults.
void refuseEmptyValues(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands({})) {
    for (CLI::Option* option : command->get_options())
      if (option->get_name() != "look" && option->get_expected_max() > 0 &&
          option->get_items_expected_max() > 0)
        option->check([](const std::string& value) {
          return value.empty() ? std::string("the value is empty") : std::string();
        });
    refuseEmptyValues(*command);
  }
}

/// A result that cannot be printed (a full disk) is no success.
int finishPrinting(Console& console, int exit) {
  console.out.flush();
  if (console.out || exit != allGood) return exit;
  return report(console, OutputError("the result cannot be printed: is the disk full?"),
                someFailed);
}

/// The call as a shell would take it again.
std::string commandLine(int argc, const char* const* argv) {
  constexpr const char* plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./,:=@%+";
  std::string line;
  for (int i = 0; i < argc; ++i) {
    std::string word = argv[i];
    if (word.empty() || word.find_first_not_of(plain) != std::string::npos) {
      for (size_t at = 0; (at = word.find('\'', at)) != std::string::npos; at += 4)
        word.replace(at, 1, "'\\''");
      word = "'" + word + "'";
    }
    line += (i > 0 ? " " : "") + word;
  }
  return line;
}

int run(int argc, const char* const* argv, Console& console) {
  const FilesReadGuard guard;
  int exit = allGood;
  CLI::App app{"kagefude: soft shadows and brush touch for rendered frames", "kagefude"};
  app.set_version_flag("--version", "kagefude " KAGEFUDE_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  addCompCommand(app, commandLine(argc, argv), console, exit);
  addInspectCommand(app, console, exit);
  addSheetCommand(app, console, exit);
  addLiveCommand(app, console, exit);
  addPassesCommand(app, console, exit);
  addLookCommand(app, console, exit);
  addStripCommand(app, console, exit);
  addCompareCommand(app, console, exit);
  addBenchCommand(app, console, exit);
  addCheckCommand(app, console, exit);
  addDocumentCommand(app, console, exit);
  refuseEmptyValues(app);
  try {
    app.parse(argc, argv);
    return exit;
  } catch (const CLI::Success& success) {
    return app.exit(success, console.out, console.err);
  } catch (const CLI::ParseError& error) {
    return report(console, error, wrongUse);
  } catch (const LookError& error) {
    return report(console, error, wrongUse);
  } catch (const UsageError& error) {
    return report(console, error, wrongUse);
  } catch (const Error& error) {
    return report(console, error, someFailed);
  } catch (const std::bad_alloc&) {
    return report(console,
                  OutputError("out of memory; fewer frames at once need less, see "
                              "--max-memory"),
                  someFailed);
  } catch (const std::exception& error) {
    return report(console, error, someFailed);
  }
}

}  // namespace

void Console::result(std::string_view line) { out << printable(line) << '\n'; }

void Console::results(std::string_view lines) { out << printableLines(lines) << '\n'; }

void Console::message(std::string_view line) { err << printable(line) << std::endl; }

int runProgram(int argc, const char* const* argv, Console& console) {
  return finishPrinting(console, run(argc, argv, console));
}

}  // namespace kagefude
