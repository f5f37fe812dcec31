#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "base/error.h"
#include "base/frame_pattern.h"
#include "base/output_name.h"
#include "cli/commands.h"
#include "compositor/compose_frame.h"
#include "compositor/contact_sheet.h"
#include "compositor/look_colour.h"
#include "compositor/read_frame.h"
#include "sequence/interrupt.h"

namespace kagefude {
namespace {

struct SheetOptions {
  std::string look, input, output, looks;
  std::vector<std::string> overrides;
  int tile = 480;
};

FrameResult compFrame(const Look& look, const Colour& colour, const std::string& input,
                      StageSink* sink) {
  const StripSet strips(look, colour);
  const FramePlan plan = planFrame(look, input, frameNumberOf(input).value_or(1));
  return composeFrame(look, strips, plan, readFramePlanes(plan), sink);
}

void drawStages(const SheetOptions& options, Console& console) {
  const Look look = readLook(options.look, options.overrides);
  const Colour colour = colourOf(look);
  ContactSheet sheet(options.tile);
  sheet.showThrough(colour, look.colour);
  const FrameResult result = compFrame(look, colour, options.input, &sheet);
  sheet.write(options.output);
  for (const std::string& warning : result.warnings)
    console.message("warning: " + options.input + ": " + warning);
}

/// The looks of a folder, by name.
std::vector<std::filesystem::path> looksIn(const std::filesystem::path& folder) {
  std::error_code failed;
  std::vector<std::filesystem::path> looks;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
    if (entry.path().extension() == ".toml") looks.push_back(entry.path());
  if (failed)
    throw UsageError(
        fmt::format("--looks: {} cannot be listed: {}", folder.string(), failed.message()));
  if (looks.empty())
    throw UsageError(fmt::format("--looks: there is no look (.toml) in {}", folder.string()));
  std::sort(looks.begin(), looks.end());
  return looks;
}

void compareLooks(const SheetOptions& options, Console& console) {
  ContactSheet sheet(options.tile);
  std::set<std::string> said;
  for (const std::filesystem::path& path : looksIn(options.looks)) {
    const Look look = readLook(path, options.overrides);
    const Colour colour = colourOf(look);
    const FrameResult result = compFrame(look, colour, options.input, nullptr);
    sheet.showThrough(colour, look.colour);
    sheet.picture(path.stem().string(), result.colour);
    for (const std::string& warning : result.warnings)
      if (said.insert(warning).second)
        console.message("warning: " + options.input + ": " + warning);
  }
  sheet.write(options.output);
}

void drawSheet(SheetOptions options, Console& console) {
  const EndsAtOnce interrupts;
  requireSuffix(options.output, ".png", "--output");
  if (options.looks.empty()) {
    if (options.input.empty())
      throw UsageError("sheet needs a look and a frame, or --looks with a folder and a frame");
    return drawStages(options, console);
  }
  // The frame is the only one left then, and stands where the look would.
  if (!options.input.empty())
    throw UsageError("--looks: the folder's looks are compared, so leave the look out");
  std::swap(options.look, options.input);
  compareLooks(options, console);
}

}  // namespace

void addSheetCommand(CLI::App& app, Console& console, int&) {
  auto options = std::make_shared<SheetOptions>();
  CLI::App* command = app.add_subcommand(
      "sheet", "Draw one frame's intermediate pictures, or many looks of it, as a contact sheet");
  command->add_option("look", options->look, "look file (TOML); with --looks the frame")
      ->required();
  command->add_option("input", options->input, "frame (EXR)");
  command->add_option("-o,--output", options->output, "picture to write (PNG)")->required();
  command->add_option("--looks", options->looks,
                      "folder: compares the finished pictures of all looks in it");
  command->add_option("--set", options->overrides, "section.key=value, over the looks' own");
  command->add_option("--tile", options->tile, "width of a tile, 64 to 4096 pixels (480)")
      ->check(CLI::Range(64, 4096));
  command->callback([options, &console] { drawSheet(*options, console); });
}

}  // namespace kagefude
