#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>
#include <set>

#include "base/error.h"
#include "cli/commands.h"
#include "sequence/comp_batch.h"
#include "sequence/frame_range.h"
#include "sequence/frame_thumbnail.h"
#include "sequence/interrupt.h"
#include "sequence/memory_bound.h"
#include "sequence/progress.h"
#include "sequence/report.h"

namespace kagefude {
namespace {

struct CompOptions {
  std::string commandLine, look, input, output, frames, preview, chunk, maxMemory, report;
  std::vector<std::string> overrides, views;
  std::string existing = "overwrite", progress = "auto", previewFormat = "png";
  int threads = 0;
  size_t framesAtOnce = 0;
  bool skipBadFrames = false;
};

ExistingOutputs existingFrom(const std::string& name) {
  if (name == "skip") return ExistingOutputs::skip;
  return name == "update" ? ExistingOutputs::update : ExistingOutputs::overwrite;
}

/// Previews go under the frame's own name, so that one pattern serves both.
std::string previewPattern(const CompOptions& options) {
  const std::filesystem::path name = std::filesystem::path(options.output).filename();
  std::string suffix = options.previewFormat;
  if (!suffix.starts_with('.')) suffix.insert(0, ".");
  if (formatOf("preview" + suffix, "--preview-format").isExr())
    throw UsageError("--preview-format exr: previews are display-ready, and EXRs are scene-linear");
  return (std::filesystem::path(options.preview) / name).replace_extension(suffix).string();
}

CompRequest requestFrom(const CompOptions& options, std::stop_token stop) {
  formatOf(options.output, "--output");
  CompRequest request;
  request.plan.inputs = {FramePattern(options.input)};
  request.plan.outputs = {FramePattern(options.output)};
  if (!options.preview.empty())
    request.plan.outputs.push_back(FramePattern(previewPattern(options)));
  if (!options.frames.empty()) request.plan.frames = parseFrames(options.frames);
  request.plan.views = options.views;
  if (!options.chunk.empty()) request.plan.chunk = parseChunk(options.chunk);
  request.plan.skipBadFrames = options.skipBadFrames;
  request.existing = existingFrom(options.existing);
  request.maxMemory =
      options.maxMemory.empty() ? defaultMemoryBound() : parseMemory(options.maxMemory);
  request.maxFrames = options.framesAtOnce;
  request.skipBadFrames = options.skipBadFrames;
  request.thumbnails = !options.report.empty();
  request.stop = std::move(stop);
  return request;
}

std::string summaryOf(const BatchResult& result) {
  std::string text = fmt::format("{} {} done", result.done, result.done == 1 ? "frame" : "frames");
  if (result.kept) text += fmt::format(", {} kept", result.kept);
  if (!result.failures.empty()) text += fmt::format(", {} failed", result.failures.size());
  if (!result.lost.empty()) text += fmt::format(", {} lost", result.lost.size());
  if (result.untouched) text += fmt::format(", {} not made", result.untouched);
  return text;
}

/// One sentence on frames that were made and are gone.
std::string lostFrames(const std::vector<size_t>& lost, const std::vector<FrameJob>& jobs) {
  std::vector<int> frames;
  for (const size_t index : lost) frames.push_back(jobs[index].frame);
  return fmt::format(
      "frames {} were finished, but are not on the disk any more (the first is {}): "
      "make them again",
      describeFrames(frames), jobs[lost.front()].outputs.front().string());
}

/// Without --skip-bad-frames the first failure is what ended the run; a neighbour that was in
/// flight and failed as well adds nothing.
int finish(const BatchResult& result, const std::vector<FrameJob>& jobs, bool skipBadFrames,
           const Interrupts& interrupts, ProgressSink& progress, Console& console) {
  const bool failed = !result.failures.empty() || !result.lost.empty() || result.stopped;
  progress.end(summaryOf(result), failed);
  for (const FrameFailure& failure : result.failures) {
    console.message(fmt::format("ERROR: {}: {}", jobs[failure.index].name(), failure.message));
    if (!skipBadFrames) break;
  }
  if (!result.lost.empty()) console.message("ERROR: " + lostFrames(result.lost, jobs));
  if (result.stopped) return interrupts.exitCode();
  return failed ? someFailed : allGood;
}

/// The report's folder: a chunk has its own below the given one, so that tasks of one job do not
/// overwrite each other's page.
std::filesystem::path reportFolder(const CompOptions& options) {
  const Chunk chunk = options.chunk.empty() ? Chunk{} : parseChunk(options.chunk);
  if (chunk.count == 1) return options.report;
  return std::filesystem::path(options.report) /
         fmt::format("chunk-{}-of-{}", chunk.index, chunk.count);
}

/// Feeds the page of a run, and writes it anew now and then, so that one may look while it runs.
class RunReport {
 public:
  RunReport(const CompOptions& options, const Look& look) {
    if (options.report.empty()) return;
    report_.emplace(
        reportFolder(options),
        ReportHeader{options.output, options.commandLine, KAGEFUDE_VERSION, resolvedText(look)},
        writeThumbnail);
  }

  void add(const CompEvent& event) {
    const FrameEvent& frame = event.frame;
    attempt([&] {
      report_->add({event.job->frame, event.job->view, frame.outcome == FrameOutcome::kept,
                    frame.readSeconds, frame.computeSeconds, frame.writeSeconds, event.warnings,
                    frame.message},
                   event.thumbnail);
      if (Clock::now() - written_ > std::chrono::seconds(10)) write();
    });
  }

  /// Marks a frame that was finished and is gone.
  void addLost(const FrameJob& job) {
    attempt([&] {
      report_->add({job.frame, job.view, false, 0, 0, 0, {}, "its output is gone"}, {});
    });
  }

  void finish() {
    attempt([&] { write(); });
  }

  /// Why the page is not whole; the frames go on without it.
  const std::string& trouble() const { return trouble_; }

 private:
  using Clock = std::chrono::steady_clock;
  template <class Step>
  void attempt(const Step& step) {
    if (!report_) return;
    try {
      step();
    } catch (const Error& error) {
      if (trouble_.empty()) trouble_ = error.what();
    }
  }

  void write() {
    written_ = Clock::now();
    report_->finish();
  }

  std::string trouble_;
  std::optional<Report> report_;
  Clock::time_point written_ = Clock::now();
};

/// One line a kind of warning and a run: those that differ in numbers only, such as the frame's in
/// a file name, or in what stands in parentheses, such as the objects that a frame shows, are one
/// kind. The report has them all.
class SaidWarnings {
 public:
  bool isNew(const std::string& warning) {
    std::string kind;
    int depth = 0;
    for (const char c : warning) {
      if (c == '(') ++depth;
      if (c == ')') depth = std::max(depth - 1, 0);
      if (depth > 0) continue;
      const bool digit = c >= '0' && c <= '9';
      if (!digit) kind += c;
      if (digit && !kind.ends_with('#')) kind += '#';
    }
    return kinds_.insert(std::move(kind)).second;
  }

 private:
  std::set<std::string> kinds_;
};

int comp(const CompOptions& options, Console& console) {
  Interrupts interrupts([](int code) { std::_Exit(code); });
  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                            static_cast<size_t>(threads));
  const Look look = readLook(options.look, options.overrides);
  CompBatch batch(look, requestFrom(options, interrupts.token()));
  const auto progress = makeProgress(parseProgressKind(options.progress), console.err,
                                     console.terminal, console.columns);

  RunReport report(options, look);
  SaidWarnings said;

  tbb::task_arena arena(threads);
  BatchResult result;
  arena.execute([&] {
    progress->begin(batch.jobs().size());
    for (const std::string& note : batch.notes()) progress->warning(note);
    result = batch.run([&](const CompEvent& event) {
      const std::string name = event.job->name();
      for (const std::string& warning : event.warnings)
        if (said.isNew(warning)) progress->warning(name + ": " + warning);
      report.add(event);
      const FrameEvent& frame = event.frame;
      progress->frame({name, frame.outcome == FrameOutcome::kept, frame.message,
                       frame.readSeconds + frame.computeSeconds + frame.writeSeconds});
    });
  });
  for (const std::string& warning : batch.unused()) progress->warning(warning);
  for (const size_t index : result.lost) report.addLost(batch.jobs()[index]);
  report.finish();
  const int code =
      finish(result, batch.jobs(), options.skipBadFrames, interrupts, *progress, console);
  if (report.trouble().empty()) return code;
  console.message("ERROR: the report is not complete: " + report.trouble());
  return code == allGood ? someFailed : code;
}

}  // namespace

void addCompCommand(CLI::App& app, const std::string& commandLine, Console& console, int& exit) {
  auto options = std::make_shared<CompOptions>();
  options->commandLine = commandLine;
  CLI::App* command = app.add_subcommand("comp", "Composite frames with a look");
  command->add_option("look", options->look, "look file (TOML)")->required();
  command->add_option("input", options->input, "frames (EXR), such as in/shot.####.exr")
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   "frames to write; the suffix says the format: " + listSuffixes())
      ->required();
  command->add_option("--frames", options->frames,
                      "such as 1-24, 1-24x2, 1,5,9; without it all that are on disk");
  command->add_option("--views", options->views, "views that %V stands for (left,right)")
      ->delimiter(',');
  command->add_option("--set", options->overrides, "section.key=value, over the look's own");
  command->add_option("--preview", options->preview, "folder for display-ready pictures");
  command->add_option("--preview-format", options->previewFormat,
                      "suffix of what goes there, any that -o takes but .exr (png)");
  command->add_option("--report", options->report,
                      "folder for a page (index.html) about the run; a chunk makes "
                      "chunk-i-of-n in it");
  command
      ->add_option("--existing", options->existing,
                   "outputs that are there: overwrite, skip, or update what is stale "
                   "(overwrite)")
      ->check(CLI::IsMember({"overwrite", "skip", "update"}));
  command->add_flag("--skip-bad-frames", options->skipBadFrames,
                    "go on after a frame that fails, and exit with 1 at the end");
  command->add_option("--chunk", options->chunk, "only part i of n of the frames, as i/n");
  command->add_option("--max-memory", options->maxMemory,
                      "most memory for frames in flight, such as 8G (three quarters of what is "
                      "free)");
  command->add_option("--threads", options->threads, "threads, 0 to 1024; 0 is one a core (0)")
      ->check(CLI::Range(0, 1024));
  command
      ->add_option("--frames-at-once", options->framesAtOnce,
                   "most frames worked on at a time; 0 is one a thread (0)")
      ->check(CLI::Range(0, 1024));
  command->add_option("--progress", options->progress, "auto, plain, openjd or none (auto)");
  command->callback([options, &console, &exit] { exit = comp(*options, console); });
}

}  // namespace kagefude
