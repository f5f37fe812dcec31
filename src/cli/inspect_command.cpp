#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/nearest_name.h"
#include "base/printed_json.h"
#include "cli/commands.h"
#include "compositor/inspect_lights.h"
#include "frame/foreign_json.h"
#include "frame/inspect_frame.h"
#include "look/look.h"

namespace kagefude {
namespace {

std::string spell(const Window& w) {
  return fmt::format("{}x{}{:+}{:+}", w.width, w.height, w.x, w.y);
}

void printLayers(Console& out, const Inspection& found) {
  out.result("layers");
  for (const InspectedLayer& layer : found.layers) {
    std::vector<std::string> passes;
    for (const InspectedPass& pass : layer.passes)
      passes.push_back(fmt::format("{} ({})", pass.name.empty() ? "RGBA" : pass.name, pass.type));
    out.result(fmt::format("  {}: {}", layer.name.empty() ? "(no layer)" : layer.name,
                           fmt::join(passes, ", ")));
  }
}

void printLights(Console& out, const Inspection& found) {
  if (found.lights.empty()) return;
  out.result("lights");
  for (const InspectedLight& light : found.lights) {
    size_t masks = 0;
    for (const InspectedMask& mask : light.masks) masks += mask.found;
    std::string line = fmt::format("  {} ({})", light.name, light.type);
    if (!light.masks.empty())
      line += fmt::format(", {} of {} masks ({})", masks, light.masks.size(), light.arrangement);
    if (!light.depthMap.empty())
      line +=
          fmt::format(", depth map {}{}", light.depthMap, light.depthMapFound ? "" : " (missing)");
    if (!light.truthLayer.empty()) line += ", truth " + light.truthLayer;
    out.result(line);
  }
}

void printNames(Console& out, const Inspection& found) {
  for (const InspectedCryptomatte& matte : found.cryptomattes)
    out.result(fmt::format("cryptomatte {} ({} ranks): {}", matte.name, matte.ranks,
                           listNames(matte.names, 40)));
  if (found.objects.empty()) return;
  out.result("objects");
  for (const InspectedObject& object : found.objects)
    out.result(
        fmt::format("  {} (index {}): {}", object.name, object.index, listNames(object.materials)));
}

void printFindings(Console& out, const Inspection& found) {
  for (const Finding& finding : found.findings) {
    const char* kind = finding.kind == FindingKind::missing   ? "missing"
                       : finding.kind == FindingKind::warning ? "warning"
                                                              : "error";
    out.result(fmt::format("{}: {}{}{}", kind, finding.what, finding.remedy.empty() ? "" : "; ",
                           finding.remedy));
  }
}

void printInspection(Console& out, const Inspection& found) {
  out.result(fmt::format("{}: data window {}, display window {}, pixel aspect {}, {} channels",
                         found.path.string(), spell(found.dataWindow), spell(found.displayWindow),
                         found.pixelAspect, found.channelCount));
  for (const Part& part : found.parts)
    out.result(
        fmt::format("part {}: {}, {}{}", part.name.empty() ? "(unnamed)" : part.name,
                    part.compression, part.tiled ? "tiled" : "scanlines",
                    part.dataWindow == found.dataWindow ? "" : ", " + spell(part.dataWindow)));
  if (!found.views.empty())
    out.result(fmt::format("views {}; shown: {}", listNames(found.views), found.view));
  if (found.sidecar.empty())
    out.result(foreignJson(found.path).empty() ? "no sidecar" : "no sidecar of kagefude's");
  else
    out.result(fmt::format("sidecar {}: frame {}, {} fps", found.sidecar, found.frame.value_or(0),
                           found.fps.value_or(0)));
  printLayers(out, found);
  out.result("passes");
  for (const InspectedAov& aov : found.aovs)
    out.result(fmt::format("  {}: {}", aov.purpose, aov.pass.empty() ? "not found" : aov.pass));
  printLights(out, found);
  printNames(out, found);
  printFindings(out, found);
}

/// A frame that is wrong is no success; what is missing or doubted may be meant.
int exitCodeFor(const Inspection& found, Console& console) {
  std::vector<std::string> errors;
  for (const Finding& finding : found.findings)
    if (finding.kind == FindingKind::error) errors.push_back(finding.what);
  if (errors.empty()) return allGood;
  console.message(
      fmt::format("ERROR: {} cannot be used as it is: {}{}", found.path.string(), errors.front(),
                  errors.size() > 1 ? fmt::format("; and {} more", errors.size() - 1) : ""));
  return someFailed;
}

}  // namespace

void addInspectCommand(CLI::App& app, Console& console, int& exit) {
  struct Options {
    std::string input, look;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "inspect", "Show what a frame holds, what is missing, and what to do about it");
  command->add_option("input", options->input, "frame (EXR)")->required();
  command->add_option("--look", options->look, "look file whose [frame] names the passes");
  command->add_flag("--json", options->json, "as JSON");
  command->callback([options, &console, &exit] {
    const Look look = readLook(options->look, {});
    Inspection found = inspectFrame(options->input, look.frame);
    inspectLights(look.frame, found);
    if (options->json)
      console.results(printedJson(toJson(found)));
    else
      printInspection(console, found);
    exit = exitCodeFor(found, console);
  });
}

}  // namespace kagefude
