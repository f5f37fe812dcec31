#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/nearest_name.h"
#include "cli/commands.h"
#include "frame/inspect_frame.h"
#include "look/look.h"

namespace kagefude {
namespace {

std::string spell(const Window& w) {
  return fmt::format("{}x{}{:+}{:+}", w.width, w.height, w.x, w.y);
}

void printLayers(std::ostream& out, const Inspection& found) {
  out << "layers\n";
  for (const InspectedLayer& layer : found.layers) {
    std::vector<std::string> passes;
    for (const InspectedPass& pass : layer.passes)
      passes.push_back(fmt::format("{} ({})", pass.name.empty() ? "RGBA" : pass.name, pass.type));
    out << fmt::format("  {}: {}\n", layer.name.empty() ? "(no layer)" : layer.name,
                       fmt::join(passes, ", "));
  }
}

void printLights(std::ostream& out, const Inspection& found) {
  if (found.lights.empty()) return;
  out << "lights\n";
  for (const InspectedLight& light : found.lights) {
    size_t masks = 0;
    for (const InspectedMask& mask : light.masks) masks += mask.found;
    out << fmt::format("  {} ({})", light.name, light.type);
    if (!light.masks.empty())
      out << fmt::format(", {} of {} masks ({})", masks, light.masks.size(), light.arrangement);
    if (!light.depthMap.empty())
      out << fmt::format(", depth map {}{}", light.depthMap,
                         light.depthMapFound ? "" : " (missing)");
    if (!light.truthLayer.empty()) out << ", truth " << light.truthLayer;
    out << "\n";
  }
}

void printNames(std::ostream& out, const Inspection& found) {
  for (const InspectedCryptomatte& matte : found.cryptomattes)
    out << fmt::format("cryptomatte {} ({} ranks): {}\n", matte.name, matte.ranks,
                       listNames(matte.names, 40));
  if (found.objects.empty()) return;
  out << "objects\n";
  for (const InspectedObject& object : found.objects)
    out << fmt::format("  {} (index {}): {}\n", object.name, object.index,
                       listNames(object.materials));
}

void printFindings(std::ostream& out, const Inspection& found) {
  for (const Finding& finding : found.findings) {
    const char* kind = finding.kind == FindingKind::missing   ? "missing"
                       : finding.kind == FindingKind::warning ? "warning"
                                                              : "error";
    out << fmt::format("{}: {}{}{}\n", kind, finding.what, finding.remedy.empty() ? "" : "; ",
                       finding.remedy);
  }
}

void printInspection(std::ostream& out, const Inspection& found) {
  out << fmt::format("{}: data window {}, display window {}, pixel aspect {}, {} channels\n",
                     found.path.string(), spell(found.dataWindow), spell(found.displayWindow),
                     found.pixelAspect, found.channelCount);
  for (const Part& part : found.parts)
    out << fmt::format("part {}: {}, {}{}\n", part.name.empty() ? "(unnamed)" : part.name,
                       part.compression, part.tiled ? "tiled" : "scanlines",
                       part.dataWindow == found.dataWindow ? "" : ", " + spell(part.dataWindow));
  if (found.sidecar.empty())
    out << "no sidecar\n";
  else
    out << fmt::format("sidecar {}: frame {}, {} fps\n", found.sidecar, found.frame.value_or(0),
                       found.fps.value_or(0));
  printLayers(out, found);
  out << "passes\n";
  for (const InspectedAov& aov : found.aovs)
    out << fmt::format("  {}: {}\n", aov.purpose, aov.pass.empty() ? "not found" : aov.pass);
  printLights(out, found);
  printNames(out, found);
  printFindings(out, found);
}

}  // namespace

void addInspectCommand(CLI::App& app, Console& console, int&) {
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
  command->callback([options, &console] {
    const Look look = readLook(options->look, {});
    const Inspection found = inspectFrame(options->input, look.frame);
    if (options->json)
      console.out << toJson(found).dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
                  << "\n";
    else
      printInspection(console.out, found);
  });
}

}  // namespace kagefude
