#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/output_name.h"
#include "base/printed_json.h"
#include "cli/commands.h"
#include "exr/write_image.h"
#include "image/oklab.h"
#include "look/override.h"
#include "look/read_section.h"
#include "passes/strip/strip_check.h"
#include "passes/strip/strip_from_picture.h"
#include "passes/strip/strip_paint.h"
#include "passes/strip/strip_tones.h"
#include "picture/palette_file.h"
#include "picture/strip_file.h"
#include "sequence/interrupt.h"

namespace kagefude {
namespace {

struct MakeOptions {
  std::string output, preset = "soft", from, palette;
  std::vector<int> patch;
  std::vector<std::string> settings;
  bool force = false;
};

/// A file of a palette, or its colours themselves.
std::vector<V3f> paletteOf(const std::string& text) {
  const std::string suffix = std::filesystem::path(text).extension().string();
  if (suffix.empty()) return paletteFromText(text);
  return readPalette(text);
}

StripPaintParams paramsFrom(const MakeOptions& options) {
  StripPaintParams params = stripPreset(options.preset);
  if (!options.palette.empty()) params.stops = stopsOfPalette(paletteOf(options.palette));
  toml::table section;
  for (const std::string& text : options.settings) setValue(section, text);
  readSection(section, stripTable, &params);
  return params;
}

/// The patch of a picture that is asked for, all of it without one; UsageError where it reaches
/// beyond.
PicturePatch patchOf(const MakeOptions& options, const StripPicture& picture) {
  if (options.patch.empty()) return {0, 0, picture.width(), picture.height()};
  const PicturePatch patch{options.patch[0], options.patch[1], options.patch[2], options.patch[3]};
  if (patch.x < 0 || patch.y < 0 || patch.width < 1 || patch.height < 1 ||
      patch.width > picture.width() - patch.x || patch.height > picture.height() - patch.y)
    throw UsageError(fmt::format("--patch {}x{} at {},{} is not inside {}, which is {} x {} pixels",
                                 patch.width, patch.height, patch.x, patch.y, options.from,
                                 picture.width(), picture.height()));
  return patch;
}

Floats cutOut(const Floats& plane, const PicturePatch& patch) {
  Floats cut(patch.width, patch.height);
  for (int y = 0; y < patch.height; ++y)
    std::copy_n(plane.row(patch.y + y) + patch.x, patch.width, cut.row(y));
  return cut;
}

/// In display-encoded sRGB, as strips are; other colours than those two would come out wrong.
void encode(const std::string& file, StripPicture& picture) {
  if (picture.sceneLinear) {
    for (Floats* plane : {&picture.red, &picture.green, &picture.blue})
      for (size_t i = 0; i < plane->view().pixels(); ++i)
        plane->row(0)[i] = srgbOfLinear(plane->row(0)[i]);
  } else if (!picture.space.empty() && picture.space != "sRGB") {
    throw InputError(
        fmt::format("{} says that its colours are {}; save it as sRGB, or as "
                    "scene-linear floats",
                    file, picture.space));
  }
}

PaintedStrip stripOfPicture(const MakeOptions& options) {
  // What a picture's strip has of the painted ones' parameters.
  StripPaintParams given;
  toml::table section;
  for (const std::string& text : options.settings) setValue(section, text);
  for (const auto& [key, value] : section)
    if (key != "width" && key != "height" && key != "hue_shift")
      throw UsageError(
          fmt::format("--set {}: strokes and tones come from the picture; width, height and "
                      "hue_shift can be set",
                      key.str()));
  readSection(section, stripTable, &given);
  StripPicture picture = readStrip(options.from);
  const PicturePatch patch = patchOf(options, picture);
  encode(options.from, picture);
  try {
    return stripFromPicture(cutOut(picture.red, patch), cutOut(picture.green, patch),
                            cutOut(picture.blue, patch),
                            {given.width, given.height, given.hueShift});
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", options.from, error.what()));
  }
}

void makeStripFile(const MakeOptions& options, Console& console) {
  const EndsAtOnce interrupts;
  requireSuffix(options.output, ".png", "output");
  if (!options.force) refuseToReplace(options.output, "output");  // it may be painted by hand
  const PaintedStrip strip =
      options.from.empty() ? paintStrip(paramsFrom(options)) : stripOfPicture(options);
  writePng(options.output, strip.r, strip.g, strip.b, {}, 16);
  console.result(fmt::format("{}: {} x {}", options.output, strip.r.width(), strip.r.height()));
  for (const std::string& problem : checkStrip(strip.r, strip.g, strip.b).problems)
    console.message(fmt::format("warning: {}: {}", options.output, problem));
}

nlohmann::ordered_json toJson(const StripReport& report) {
  return {{"width", report.width},
          {"height", report.height},
          {"seam_error", report.seamError},
          {"interior_error", report.interiorError},
          {"seam_ratio", report.seamRatio},
          {"bottom_brightness", report.bottomBrightness},
          {"top_brightness", report.topBrightness},
          {"disorder", report.disorder},
          {"problems", report.problems}};
}

void printReport(const std::string& file, const StripReport& report, Console& console) {
  console.result(fmt::format("{}: {} x {}", file, report.width, report.height));
  console.result(fmt::format("seam {:.4f}, {:.2f} times the difference of columns inside",
                             report.seamError, report.seamRatio));
  console.result(fmt::format("brightness {:.3f} at the bottom, {:.3f} at the top, disorder {:.3f}",
                             report.bottomBrightness, report.topBrightness, report.disorder));
  for (const std::string& problem : report.problems) console.result("problem: " + problem);
  if (report.problems.empty()) console.result("ready to paint with");
}

int checkStripFile(const std::string& file, bool json, Console& console) {
  const StripPicture picture = readStrip(file);
  const StripReport report = checkStrip(picture.red, picture.green, picture.blue);
  if (json)
    console.results(printedJson(toJson(report)));
  else
    printReport(file, report, console);
  if (report.problems.empty()) return allGood;
  console.message(fmt::format("ERROR: {} is not fit to paint with: {}", file,
                              fmt::join(report.problems, "; ")));
  return someFailed;
}

void addMake(CLI::App& strip, Console& console) {
  auto options = std::make_shared<MakeOptions>();
  CLI::App* command = strip.add_subcommand(
      "make", "Paint a seamless strip; its parameters are those of `kagefude passes strip`");
  command->add_option("output", options->output, "picture to write (PNG, 16 bit)")->required();
  command->add_option("--preset", options->preset, "neutral, soft, fine or cel (soft)")
      ->check(CLI::IsMember(
          std::vector<std::string>(std::begin(stripPresets), std::end(stripPresets))));
  CLI::Option* const from = command->add_option(
      "--from", options->from, "picture whose tones and strokes the strip takes, of any format");
  command->add_option("--patch", options->patch, "of --from only the patch at x,y of w,h pixels")
      ->delimiter(',')
      ->expected(4)
      ->needs(from);
  command
      ->add_option("--palette", options->palette,
                   "tones of a palette, from dark to bright: GIMP's (.gpl), Adobe's (.ase), or "
                   "colours such as #2b1d38,#8a3324,#f2e3c2")
      ->excludes(from);
  command->add_option("--set", options->settings, "key=value, over the preset's own");
  command->add_flag("--force", options->force, "write over a file that is there");
  command->callback([options, &console] { makeStripFile(*options, console); });
}

void addCheck(CLI::App& strip, Console& console, int& exit) {
  struct Options {
    std::string file;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = strip.add_subcommand(
      "check", "Tell whether a strip's edges join and its rows run from bright to dark");
  command->add_option("file", options->file, "picture of the strip")->required();
  command->add_flag("--json", options->json, "as JSON");
  command->callback(
      [options, &console, &exit] { exit = checkStripFile(options->file, options->json, console); });
}

}  // namespace

void addStripCommand(CLI::App& app, Console& console, int& exit) {
  CLI::App* strip = app.add_subcommand("strip", "Make or check the strips that are painted with");
  strip->require_subcommand(1);
  addMake(*strip, console);
  addCheck(*strip, console, exit);
}

}  // namespace kagefude
