#include <CLI/CLI.hpp>
#include <new>
#include <ostream>

#include "base/error.h"
#include "cli/commands.h"

namespace kagefude {
namespace {

int report(Console& console, const std::exception& error, int code) {
  console.err << "ERROR: " << error.what() << std::endl;
  return code;
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

}  // namespace

int runProgram(int argc, const char* const* argv, Console& console) {
  int exit = allGood;
  CLI::App app{"kagefude: soft shadows and brush touch for rendered frames", "kagefude"};
  app.set_version_flag("--version", "kagefude " KAGEFUDE_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  addCompCommand(app, commandLine(argc, argv), console, exit);
  addInspectCommand(app, console, exit);
  addSheetCommand(app, console, exit);
  addPassesCommand(app, console, exit);
  addStripCommand(app, console, exit);
  addCompareCommand(app, console, exit);
  addBenchCommand(app, console, exit);
  addCheckCommand(app, console, exit);
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

}  // namespace kagefude
