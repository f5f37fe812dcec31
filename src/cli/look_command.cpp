#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/error.h"
#include "base/folders.h"
#include "base/frame_pattern.h"
#include "base/nearest_name.h"
#include "base/output_name.h"
#include "base/placed_together.h"
#include "base/printed_json.h"
#include "base/temp_file.h"
#include "cli/commands.h"
#include "compositor/check_look.h"
#include "compositor/compose_frame.h"
#include "compositor/light_visibility.h"
#include "compositor/look_colour.h"
#include "compositor/read_frame.h"
#include "compositor/seen_things.h"
#include "compositor/write_frame_picture.h"
#include "exr/write_image.h"
#include "image/parallel.h"
#include "look/draft_look.h"
#include "look/write_look.h"
#include "sequence/interrupt.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

struct NewOptions {
  std::string frame, output, preset, preview;
  std::vector<std::string> overrides;
  bool force = false;
};

fs::path stripFolderOf(const fs::path& look) {
  return look.parent_path() / (look.stem().string() + "_strips");
}

/// What the look is made of must not be there yet, for it may be somebody's work.
void refuseOverwriting(const NewOptions& options) {
  if (options.force) return;
  refuseToReplace(options.output, "-o");
  refuseToReplace(stripFolderOf(options.output), "-o");
  if (!options.preview.empty()) refuseToReplace(options.preview, "--preview");
}

void paintStrips(const std::vector<DraftStrip>& strips, const fs::path& folder) {
  std::vector<std::exception_ptr> errors(strips.size());
  parallelRows(static_cast<int>(strips.size()), 1, [&](int first, int) {
    const auto i = static_cast<size_t>(first);
    try {
      const PaintedStrip strip = paintStrip(strips[i].params);
      // Pen lines keep a trace finer than a byte, see hatchStrip.
      const int bits = strips[i].params.hatch > 0 ? 16 : 8;
      writePng(folder / strips[i].file, strip.r, strip.g, strip.b, {}, bits);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

/// Gives the line to say of it.
std::string paintPreview(const NewOptions& options, const Colour& colour, Console& console) {
  const Look look = readLook(options.output, {});
  const StripSet strips(look, colour);
  const FramePlan plan = planFrame(look, options.frame, frameNumberOf(options.frame).value_or(1));
  const FrameResult result = composeFrame(look, strips, plan, readFramePlanes(plan));
  const PictureOutput kind{&formatOf(options.preview, "--preview"), SampleDepth::uint8,
                           FormatAlpha::none};
  writeFramePicture(look, colour, plan, result, options.preview, kind, "");
  for (const std::string& warning : result.warnings)
    console.message("warning: " + options.frame + ": " + warning);
  return fmt::format("{}: {} x {}", options.preview, result.alpha.width(), result.alpha.height());
}

/// How many times larger than the shot a frame is: as the caller says, else its JSON, where that
/// divides its sides.
int scaleOf(const Look& look, const FramePlan& plan) {
  if (look.output.scale > 1 || !plan.sidecar) return look.output.scale;
  const int scale = plan.sidecar->scale;
  const Window& window = plan.image.displayWindow;
  return scale >= 1 && window.width % scale == 0 && window.height % scale == 0 ? scale : 1;
}

bool smooths(const FramePlan& plan, const FramePlanes& planes) {
  for (size_t i = 0; i < plan.lights.size(); ++i)
    if (isSmoothed(plan.lights[i], planes.lights[i])) return true;
  return false;
}

DraftFrame draftFrame(const NewOptions& options, const Look& look, const Colour& colour,
                      Console& console) {
  const FramePlan plan =
      planWithMaterials(look, options.frame, frameNumberOf(options.frame).value_or(1));
  const FramePlanes planes = readFramePlanes(plan);
  const Floats tone = plainTone(look, plan, planes);
  DraftFrame frame{fs::path(options.frame).filename().string(),
                   planes.width,
                   planes.height,
                   scaleOf(look, plan),
                   brightTone(tone, planes.objectId),
                   smooths(plan, planes),
                   seenThings(plan, planes, tone)};
  std::vector<std::string> fromBeauty;
  for (DraftThing& thing : frame.things) {
    thing.colour = toStripLinear(colour, thing.colour);
    if (thing.fromBeauty)
      fromBeauty.push_back(thing.object.empty() ? thing.material : thing.object);
  }
  if (!fromBeauty.empty())
    console.message(fmt::format(
        "warning: {}: things have no diffuse colour there ({}), so the look takes theirs from the "
        "picture, light and all",
        options.frame, listNames(fromBeauty)));
  return frame;
}

/// What would fail after the look is written is refused before, and its folder made.
void checkPreview(const NewOptions& options) {
  if (options.preview.empty()) return;
  if (formatOf(options.preview, "--preview").isExr())
    throw UsageError("--preview: previews are display-ready, and EXRs are scene-linear");
  const fs::path folder = fs::absolute(options.preview).lexically_normal().parent_path();
  if (folder == fs::absolute(stripFolderOf(options.output)).lexically_normal())
    throw UsageError(
        fmt::format("--preview: {} lies in the folder of the look's strips, which is "
                    "made anew; choose another folder",
                    options.preview));
}

void makeLook(const NewOptions& options, Console& console) {
  const EndsAtOnce interrupts;
  requireSuffix(options.output, ".toml", "--output");
  checkPreview(options);
  const LookPreset& preset = lookPreset(options.preset);
  refuseOverwriting(options);
  const Look given = readLookText("", options.output, options.overrides);
  const Colour colour = colourOf(given);
  const DraftFrame frame = draftFrame(options, given, colour, console);
  const fs::path folder = stripFolderOf(options.output);
  const DraftLook draft = draftLook(preset, frame, folder.filename().string());
  const std::string text = writeOverrides(draft.text, options.output, options.overrides).text;
  if (!options.preview.empty()) makeFolders(fs::absolute(options.preview).parent_path());
  const size_t styles = readLookText(text, options.output, {}).styles.size();
  // A look without its strips, or strips without a look, would stand in the way of the next try.
  PlacedTogether files(folder.parent_path() / ("." + folder.filename().string() + ".new"));
  paintStrips(draft.strips, files.scratch());
  const fs::path look = files.scratch() / fs::path(options.output).filename();
  writeFileAtomically(look, text);
  for (const DraftStrip& strip : draft.strips)
    files.place(files.scratch() / strip.file, folder / strip.file);
  files.place(look, options.output);
  const std::string preview = options.preview.empty() ? "" : paintPreview(options, colour, console);
  files.keep();
  console.result(fmt::format("{}: {} style{}, {} in {}", options.output, styles,
                             styles == 1 ? "" : "s", styles == 1 ? "its strip" : "their strips",
                             folder.string()));
  if (!preview.empty()) console.result(preview);
}

void addNew(CLI::App& look, Console& console) {
  auto options = std::make_shared<NewOptions>();
  std::vector<std::string> names;
  std::string help = "how it is painted:";
  for (const LookPreset& preset : lookPresets()) {
    names.emplace_back(preset.name);
    help += fmt::format("{} {}, {}", names.size() > 1 ? ";" : "", preset.name, preset.sentence);
  }
  CLI::App* command = look.add_subcommand(
      "new", "Make a look for what a frame shows, with strips in its things' own colours");
  command->add_option("frame", options->frame, "frame (EXR)")->required();
  command->add_option("-o,--output", options->output, "look to write (TOML); strips go beside it")
      ->required();
  command->add_option("--preset", options->preset, help)->required()->check(CLI::IsMember(names));
  command->add_option("--preview", options->preview,
                      "also comps the frame with it into this picture, such as preview.png");
  command->add_option("--set", options->overrides,
                      "section.key=value, such as frame.albedo=plate; written into the look");
  command->add_flag("--force", options->force, "write over a look and strips that are there");
  command->callback([options, &console] { makeLook(*options, console); });
}

struct CheckOptions {
  std::string look;
  std::vector<std::string> frames;
  bool json = false;
};

int runCheck(const CheckOptions& options, Console& console) {
  const std::vector<fs::path> frames(options.frames.begin(), options.frames.end());
  const auto progress = [&](size_t done, size_t all) {
    if (console.terminal)
      console.err << fmt::format("\r{} of {} keys{}", done, all, done == all ? "\n" : "")
                  << std::flush;
  };
  const LookCheck check = checkLook(readLookFile(options.look), options.look, frames, progress);
  if (options.json) {
    console.results(printedJson(
        {{"problems", check.problems}, {"defaults", check.defaults}, {"waiting", check.waiting}}));
  } else {
    for (const std::string& problem : check.problems) console.result("problem: " + problem);
    if (!check.defaults.empty())
      console.result(fmt::format("set to what they are anyway: {}", listNames(check.defaults)));
    for (const std::string& style : check.waiting) console.result("waiting: " + style);
    if (check.problems.empty())
      console.result(check.waiting.empty() ? "everything in it has an effect"
                                           : "everything else in it has an effect");
  }
  if (check.problems.empty()) return allGood;
  console.message(fmt::format("ERROR: {}: {} of its entries and keys {} nothing there",
                              options.look, check.problems.size(),
                              check.problems.size() == 1 ? "does" : "do"));
  return someFailed;
}

void addCheck(CLI::App& look, Console& console, int& exit) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = look.add_subcommand(
      "check", "Tell which styles, lights and keys of a look change nothing in frames");
  command->add_option("look", options->look, "look file (TOML)")->required();
  command->add_option("frames", options->frames, "frames (EXR)")->required();
  command->add_flag("--json", options->json, "as JSON");
  command->callback([options, &console, &exit] { exit = runCheck(*options, console); });
}

}  // namespace

void addLookCommand(CLI::App& app, Console& console, int& exit) {
  CLI::App* look = app.add_subcommand("look", "Make looks for frames, or check them");
  look->require_subcommand(1);
  addNew(*look, console);
  addCheck(*look, console, exit);
}

}  // namespace kagefude
