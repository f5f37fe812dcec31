#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/output_name.h"
#include "base/printed_json.h"
#include "cli/commands.h"
#include "exr/write_image.h"
#include "look/override.h"
#include "look/read_section.h"
#include "passes/strip/strip_check.h"
#include "passes/strip/strip_paint.h"
#include "picture/strip_file.h"

namespace kagefude {
namespace {

struct MakeOptions {
  std::string output, preset = "soft";
  std::vector<std::string> settings;
};

StripPaintParams paramsFrom(const MakeOptions& options) {
  StripPaintParams params = stripPreset(options.preset);
  toml::table section;
  for (const std::string& text : options.settings) setValue(section, text);
  readSection(section, stripTable, &params);
  return params;
}

void makeStripFile(const MakeOptions& options, Console& console) {
  requireSuffix(options.output, ".png", "output");
  const PaintedStrip strip = paintStrip(paramsFrom(options));
  writePng(options.output, strip.r, strip.g, strip.b, {}, 16);
  console.result(fmt::format("{}: {} x {}", options.output, strip.r.width(), strip.r.height()));
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
  command->add_option("--preset", options->preset, "soft, fine or cel (soft)")
      ->check(CLI::IsMember(
          std::vector<std::string>(std::begin(stripPresets), std::end(stripPresets))));
  command->add_option("--set", options->settings, "key=value, over the preset's own");
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
