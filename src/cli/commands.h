#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace kagefude {

/// Where commands print: results go to `out`, progress, warnings and errors to `err`. Whatever may
/// hold a name from a file goes through these three, which let no control character out.
struct Console {
  void result(std::string_view line);    ///< one line to `out`
  void results(std::string_view lines);  ///< several, such as JSON; ends the last one
  void message(std::string_view line);   ///< one line to `err`, flushed

  std::ostream& out;
  std::ostream& err;
  bool terminal = false;  ///< whether `err` is a terminal that can redraw a line
  int columns = 80;       ///< of that terminal
};

/// How a command ended, as farms read it.
enum ExitCode {
  allGood = 0,
  someFailed = 1,
  wrongUse = 2,
  interruptedBySigint = 130,
  interruptedBySigterm = 143,
};

/// Each adds one subcommand to the program; its callback runs it and stores an ExitCode in `exit`.
void addCompCommand(CLI::App& app, const std::string& commandLine, Console& console, int& exit);
void addInspectCommand(CLI::App& app, Console& console, int& exit);
void addSheetCommand(CLI::App& app, Console& console, int& exit);
void addPassesCommand(CLI::App& app, Console& console, int& exit);
void addLookCommand(CLI::App& app, Console& console, int& exit);
void addStripCommand(CLI::App& app, Console& console, int& exit);
void addCompareCommand(CLI::App& app, Console& console, int& exit);
void addBenchCommand(CLI::App& app, Console& console, int& exit);
void addCheckCommand(CLI::App& app, Console& console, int& exit);
void addLiveCommand(CLI::App& app, Console& console, int& exit);
/// Comes last, for it describes the others.
void addDocumentCommand(CLI::App& app, Console& console, int& exit);

/// Parses the command line and runs one command. Every error ends here as one line on `err` that
/// begins with "ERROR:".
int runProgram(int argc, const char* const* argv, Console& console);

}  // namespace kagefude
