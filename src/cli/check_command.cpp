#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <ostream>

#include "base/output_name.h"
#include "base/temp_file.h"
#include "cli/commands.h"
#include "sequence/check_sequence.h"
#include "sequence/frame_range.h"
#include "sequence/interrupt.h"

namespace kagefude {
namespace {

struct CheckOptions {
  std::string comped, unstyled, aovs, frames, look, plot, moves, jsonFile;
  std::string tone = "brush.tone";
  std::vector<std::string> overrides;
  bool json = false;
};

void printObjects(std::ostream& out, const std::vector<ObjectMoves>& objects) {
  constexpr size_t most = 8;
  for (size_t i = 0; i < std::min(most, objects.size()); ++i) {
    const ObjectMoves& o = objects[i];
    out << fmt::format(
        "strokes of {}: change {:.5f}, {:.2f} of their own strength (unrelated ones 1.41); worst "
        "frame {} ({:.2f}), there most at pixel {},{}\n",
        o.name.empty() ? fmt::format("{:08x}", o.id) : o.name, o.change, o.ratio, o.worstFrame,
        o.worst, o.worstX, o.worstY);
  }
  if (objects.size() > most)
    out << fmt::format("and of {} more objects, which hold stiller (--json lists them)\n",
                       objects.size() - most);
}

void print(std::ostream& out, const CheckResult& r) {
  out << fmt::format(
      "warp error, mean of {} frames: picture {:.5f}, unstyled tone {:.5f}, excess {:.5f}; "
      "strokes alone {:.5f}, tone itself {:.5f}\n",
      r.frames.size() - 1, r.picture, r.plain, r.excess, r.strokes, r.tone);
  if (std::isfinite(r.jump))
    out << fmt::format("largest jump: {:.2f} times the median, at frame {}\n", r.jump, r.jumpFrame);
  else
    out << fmt::format("largest jump: at frame {}; most frames do not change at all\n",
                       r.jumpFrame);
  out << fmt::format(
      "strokes: contrast {:.4f} ({:+.0f} % to {:+.0f} % over the sequence), grain {:.1f} pixels "
      "({:+.0f} % to {:+.0f} %)\n",
      r.contrast, 100 * (r.contrastLow - 1), 100 * (r.contrastHigh - 1), r.grain,
      100 * (r.grainLow - 1), 100 * (r.grainHigh - 1));
  printObjects(out, r.objects);
  for (const ShotBreak& found : r.breaks) out << "warning: " << found.sentence() << "\n";
}

void check(const CheckOptions& options, Console& console) {
  std::optional<EndsAtOnce> interrupts;
  if (!options.plot.empty() || !options.moves.empty() || !options.jsonFile.empty())
    interrupts.emplace();
  if (!options.plot.empty()) requireSuffix(options.plot, ".png", "--plot");
  if (!options.moves.empty()) requireSuffix(options.moves, ".png", "--moves");
  if (!options.jsonFile.empty()) requireSuffix(options.jsonFile, ".json", "--write-json");
  CheckRequest request;
  request.comped = FramePattern(options.comped);
  request.aovs = FramePattern(options.aovs.empty() ? options.comped : options.aovs);
  if (!options.unstyled.empty()) request.unstyled = FramePattern(options.unstyled);
  if (!options.frames.empty()) request.frames = parseFrames(options.frames);
  request.tone = options.tone;
  request.look = readLook(options.look, options.overrides);
  const CheckResult result = checkSequence(request);
  if (!options.plot.empty()) plotCheck(result, options.plot);
  if (!options.moves.empty()) drawMoves(result, options.moves);
  if (!options.jsonFile.empty()) writeFileAtomically(options.jsonFile, checkJson(result) + "\n");
  if (options.json)
    console.results(checkJson(result));
  else
    print(console.out, result);
}

}  // namespace

void addCheckCommand(CLI::App& app, Console& console, int&) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = app.add_subcommand(
      "check",
      "Measure how still the strokes of a finished sequence hold, along its motion vectors");
  command->add_option("sequence", options->comped, "finished frames, such as out/shot.####.exr")
      ->required();
  command->add_option(
      "--aovs", options->aovs,
      "rendered frames with motion vectors, positions and ids (the sequence itself, "
      "comped with output.passthrough)");
  command->add_option("--unstyled", options->unstyled,
                      "the same frames comped with brush.contrast=0 (found from each object's mean "
                      "colours at each tone)");
  command->add_option("--frames", options->frames, "such as 1-24; without it all that are on disk");
  command->add_option("--tone", options->tone,
                      "layer of the finished frames that holds the tone "
                      "(brush.tone)");
  command->add_option("--look", options->look, "look that names the passes of other renderers");
  command->add_option("--set", options->overrides, "section.key=value, over the look's own");
  command->add_option("--plot", options->plot, "PNG to draw the curves into");
  command->add_option("--moves", options->moves,
                      "PNG to draw where strokes move on the surface: black is still, white as if "
                      "unrelated, grey not compared");
  command->add_option("--write-json", options->jsonFile, "file to write the numbers into");
  command->add_flag("--json", options->json, "print the numbers as JSON");
  command->callback([options, &console] { check(*options, console); });
}

}  // namespace kagefude
