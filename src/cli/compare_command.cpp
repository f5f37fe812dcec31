#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

#include "base/output_name.h"
#include "base/printed_json.h"
#include "cli/commands.h"
#include "exr/write_image.h"
#include "frame/compared_planes.h"
#include "passes/measure/compare_planes.h"
#include "sequence/interrupt.h"

namespace kagefude {
namespace {

struct CompareOptions {
  std::string file, truthFile, channel, truthChannel, where, picture;
  int truthSamples = 0;
  float gain = 2.0f;
  bool json = false;
};

nlohmann::ordered_json toJson(const PlaneDifference& d, const ComparedPlanes& planes) {
  return {{"pixels", d.pixels},
          {"background", planes.background},
          {"outside", planes.outside},
          {"rmse", d.rmse},
          {"maximum", d.maximum},
          {"penumbra",
           {{"pixels", d.penumbraPixels},
            {"rmse", d.penumbraRmse},
            {"bias", d.penumbraBias},
            {"median", d.median},
            {"p90", d.p90},
            {"p99", d.p99},
            {"truth_noise", d.truthNoise}}}};
}

void print(std::ostream& out, const PlaneDifference& d, const ComparedPlanes& planes,
           int truthSamples) {
  out << fmt::format("all {} pixels: RMSE {:.4f}, maximum {:.4f}\n", d.pixels, d.rmse, d.maximum);
  if (planes.background > 0)
    out << fmt::format("not counted: {} pixels of background, where no object is\n",
                       planes.background);
  if (planes.outside > 0)
    out << fmt::format("not counted: {} pixels that only one of the files covers\n",
                       planes.outside);
  if (d.penumbraPixels == 0) {
    out << "no penumbra (truth between 0.02 and 0.98)\n";
    return;
  }
  out << fmt::format(
      "penumbra {} pixels: RMSE {:.4f}, bias {:+.4f}; absolute error: median {:.4f}, 90 % {:.4f}, "
      "99 % {:.4f}\n",
      d.penumbraPixels, d.penumbraRmse, d.penumbraBias, d.median, d.p90, d.p99);
  if (truthSamples > 0)
    out << fmt::format("noise of the truth itself, {} samples: up to {:.4f}\n", truthSamples,
                       d.truthNoise);
}

void compare(const CompareOptions& options, Console& console) {
  std::optional<EndsAtOnce> interrupts;
  if (!options.picture.empty()) {
    interrupts.emplace();
    requireSuffix(options.picture, ".png", "--picture");
  }
  const ComparedPlanes planes = readCompared(
      openImage(options.file), options.channel, openImage(options.truthFile),
      options.truthChannel.empty() ? options.channel : options.truthChannel, options.where);
  const View<const float> chosen = planes.where.empty() ? View<const float>{} : planes.where.view();
  const PlaneDifference difference =
      comparePlanes(planes.value, planes.truth, chosen, options.truthSamples);
  if (!options.picture.empty()) {
    const Floats picture = differencePicture(planes.value, planes.truth, chosen, options.gain);
    writePng(options.picture, picture, picture, picture, {}, 8);
  }
  if (options.json)
    console.results(printedJson(toJson(difference, planes)));
  else
    print(console.out, difference, planes, options.truthSamples);
}

}  // namespace

void addCompareCommand(CLI::App& app, Console& console, int&) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command =
      app.add_subcommand("compare", "Measure how far one channel is from another, its truth");
  command->add_option("file", options->file, "frame to judge (EXR)")->required();
  command->add_option("truth", options->truthFile, "frame that holds the truth (EXR)")->required();
  command->add_option("--channel", options->channel, "channel or layer, such as visibility.Key")
      ->required();
  command->add_option("--against", options->truthChannel,
                      "channel or layer of the truth, such as truth.Key.V (the same name)");
  command->add_option("--where", options->where,
                      "channel beside the truth; only pixels where it is not 0 count (where either "
                      "file's Normal shows an object)");
  command
      ->add_option("--truth-samples", options->truthSamples,
                   "samples a pixel of the truth, to report its own noise")
      ->check(CLI::Range(0, 1 << 20));
  command->add_option("--picture", options->picture, "PNG of the difference; grey is equal");
  command->add_option("--gain", options->gain, "contrast of the picture (2)")
      ->check(CLI::Range(0.01f, 1000.0f));
  command->add_flag("--json", options->json, "as JSON");
  command->callback([options, &console] { compare(*options, console); });
}

}  // namespace kagefude
