#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/error.h"
#include "base/output_name.h"
#include "base/printed_json.h"
#include "base/temp_file.h"
#include "cli/commands.h"
#include "frame/sample_frame.h"
#include "sequence/bench_frame.h"
#include "sequence/interrupt.h"

namespace kagefude {
namespace {

struct BenchOptions {
  std::string look, input, size = "3840x2160", save;
  std::vector<std::string> overrides;
  int rounds = 5, threads = 0;
  bool json = false;
};

struct FrameSize {
  int width = 0, height = 0;
};

FrameSize parseSize(const std::string& text) {
  FrameSize size;
  char more = 0;
  const int read = std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &more);
  const auto fits = [](int side) { return side >= 16 && side <= 32767; };
  if (read != 2 || !fits(size.width) || !fits(size.height))
    throw UsageError(fmt::format(
        "--size {}: expected width x height, such as 1920x1080, each 16 to 32767", text));
  return size;
}

/// A folder of this run alone, removed at its end.
class ScratchFolder {
 public:
  ScratchFolder()
      : path_(std::filesystem::temp_directory_path() /
              fmt::format("kagefude-bench-{}", ::getpid())) {
    std::error_code error;
    if (!std::filesystem::create_directory(path_, error))
      throw OutputError(fmt::format("cannot make the folder {}: {}", path_.string(),
                                    error ? error.message() : "it is there already"));
  }
  ~ScratchFolder() { remove(); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  void remove() const {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::filesystem::path path_;
  const CleansAtInterrupt atInterrupt_{[this] { remove(); }};
};

std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

double total(const FrameBench& bench) {
  double sum = 0;
  for (const StageTime& stage : bench.stages) sum += stage.seconds;
  return sum;
}

void printJson(const FrameBench& bench, const BenchOptions& options, int threads,
               std::ostream& out) {
  nlohmann::ordered_json stages = nlohmann::ordered_json::array();
  for (const StageTime& stage : bench.stages)
    stages.push_back({{"stage", stage.stage}, {"seconds", stage.seconds}});
  const nlohmann::ordered_json all = {
      {"version", KAGEFUDE_VERSION}, {"processor", processorName()},
      {"threads", threads},          {"width", bench.width},
      {"height", bench.height},      {"channels", bench.channels},
      {"rounds", options.rounds},    {"stages", stages},
      {"seconds", total(bench)},     {"peak_bytes", bench.peakBytes}};
  out << printedJson(all) << "\n";
}

void printTable(const FrameBench& bench, const BenchOptions& options, int threads,
                std::ostream& out) {
  out << fmt::format("kagefude {}, {}, {} threads\n{}x{} pixels, {} channels; medians of {}\n\n",
                     KAGEFUDE_VERSION, processorName(), threads, bench.width, bench.height,
                     bench.channels, options.rounds);
  const double sum = total(bench), pixels = static_cast<double>(bench.width) * bench.height;
  const auto row = [&](const std::string& stage, double seconds) {
    out << fmt::format("{:<28} {:>9.1f} ms {:>8.1f} ns a pixel {:>5.1f} %\n", stage, seconds * 1e3,
                       seconds * 1e9 / pixels, 100 * seconds / sum);
  };
  for (const StageTime& stage : bench.stages) row(stage.stage, stage.seconds);
  row("a frame", sum);
  out << fmt::format("peak memory {:.0f} MB\n", static_cast<double>(bench.peakBytes) / 1e6);
}

void bench(const BenchOptions& options, Console& console) {
  const EndsAtOnce interrupts;
  const FrameSize size = parseSize(options.size);
  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                            static_cast<size_t>(threads));
  if (!options.save.empty()) {
    requireSuffix(options.save, ".exr", "--save");
    writeSampleFrame(options.save, size.width, size.height);
    return;
  }
  const Look look = readLook(options.look, options.overrides);
  const ScratchFolder scratch;
  std::filesystem::path input = options.input;
  if (input.empty()) {
    input = scratch.path() / "frame.exr";
    writeSampleFrame(input, size.width, size.height);
  }
  tbb::task_arena arena(threads);
  FrameBench result;
  arena.execute(
      [&] { result = benchFrame(look, input, scratch.path() / "comped.exr", options.rounds); });
  (options.json ? printJson : printTable)(result, options, threads, console.out);
}

}  // namespace

void addBenchCommand(CLI::App& app, Console& console, int&) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = app.add_subcommand("bench", "Time every stage of a frame on this machine");
  command->add_option("look", options->look, "look file (TOML); without it the defaults");
  command->add_option("input", options->input, "frame (EXR); without it one is generated");
  command->add_option("--size", options->size, "of the generated frame (3840x2160)");
  command->add_option("--save", options->save,
                      "write the generated frame (EXR and JSON) and stop, to time other programs");
  command->add_option("--set", options->overrides, "section.key=value, over the look's own");
  command->add_option("--rounds", options->rounds, "times that the frame is made, 1 to 1000 (5)")
      ->check(CLI::Range(1, 1000));
  command->add_option("--threads", options->threads, "threads, 0 to 1024; 0 is one a core (0)")
      ->check(CLI::Range(0, 1024));
  command->add_flag("--json", options->json, "as JSON");
  command->callback([options, &console] { bench(*options, console); });
}

}  // namespace kagefude
