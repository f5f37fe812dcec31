#include <CLI/CLI.hpp>
#include <memory>

#include "base/frame_pattern.h"
#include "base/output_name.h"
#include "cli/commands.h"
#include "compositor/compose_frame.h"
#include "compositor/contact_sheet.h"
#include "compositor/read_frame.h"

namespace kagefude {
namespace {

struct SheetOptions {
  std::string look, input, output;
  std::vector<std::string> overrides;
  int tile = 480;
};

void drawSheet(const SheetOptions& options, Console& console) {
  requireSuffix(options.output, ".png", "--output");
  const Look look = readLook(options.look, options.overrides);
  const Colour colour(look.colourConfig());
  const StripSet strips(look, colour);
  const int frame = frameNumberOf(options.input).value_or(1);
  const FramePlan plan = planFrame(look, options.input, frame);
  ContactSheet sheet(colour, look.colour, options.tile);
  const FrameResult result = composeFrame(look, strips, plan, readFramePlanes(plan), &sheet);
  sheet.write(options.output);
  for (const std::string& warning : result.warnings)
    console.message("warning: " + options.input + ": " + warning);
}

}  // namespace

void addSheetCommand(CLI::App& app, Console& console, int&) {
  auto options = std::make_shared<SheetOptions>();
  CLI::App* command =
      app.add_subcommand("sheet", "Draw one frame's intermediate pictures as a contact sheet");
  command->add_option("look", options->look, "look file (TOML)")->required();
  command->add_option("input", options->input, "frame (EXR)")->required();
  command->add_option("-o,--output", options->output, "picture to write (PNG)")->required();
  command->add_option("--set", options->overrides, "section.key=value, over the look's own");
  command->add_option("--tile", options->tile, "width of a tile, 64 to 4096 pixels (480)")
      ->check(CLI::Range(64, 4096));
  command->callback([options, &console] { drawSheet(*options, console); });
}

}  // namespace kagefude
