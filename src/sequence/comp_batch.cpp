#include "sequence/comp_batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/files_read.h"
#include "base/folders.h"
#include "base/temp_file.h"
#include "compositor/compose_frame.h"
#include "compositor/frame_files.h"
#include "compositor/frame_memory.h"
#include "compositor/look_colour.h"
#include "compositor/read_frame.h"
#include "compositor/write_frame.h"
#include "exr/header_claims.h"
#include "frame/frame_group.h"
#include "sequence/frame_thumbnail.h"

namespace kagefude {
namespace {

std::filesystem::path sidecarPath(std::filesystem::path image) {
  return image.replace_extension(".json");
}

/// Whether what was made (or kept) is still there: somebody may have removed the folder meanwhile.
bool isThere(const FrameJob& job) {
  return std::all_of(job.outputs.begin(), job.outputs.end(), [](const auto& output) {
    std::error_code failed;
    return std::filesystem::is_regular_file(output, failed) &&
           std::filesystem::file_size(output, failed) > 0;
  });
}

void removeLeftoversOf(const std::vector<FrameJob>& jobs) {
  std::vector<std::filesystem::path> folders;
  for (const FrameJob& job : jobs)
    for (const auto& output : job.outputs)
      if (std::find(folders.begin(), folders.end(), output.parent_path()) == folders.end())
        folders.push_back(output.parent_path());
  for (const auto& folder : folders) removeLeftovers(folder.empty() ? "." : folder);
}

/// The fingerprint that a whole output holds, "" when it holds none or is not whole.
std::string storedFingerprint(const std::filesystem::path& path, const PictureFormat& format) {
  if (!format.isExr()) return pictureFingerprint(path, format);
  return isWholeExr(path) ? openImage(path).text(kFingerprintAttribute).value_or("") : "";
}

/// What is the same for all frames of a run. Of the colour configuration that is what its
/// transforms in use do, so this also refuses those that cannot be made; the others do not matter.
Fingerprint commonFingerprint(const Look& look, const Colour& colour) {
  Fingerprint print;
  print.add("version", KAGEFUDE_VERSION).add("look", resolvedText(look));
  for (const std::string& name : paintedFiles(look))
    if (!isBuiltinStrip(name)) print.addFile("strip", look.resolve(name));
  if (!colour.file().empty()) print.addFile("colour", colour.file());
  const std::string stripSpace = stripColourSpace(look);
  if (colour.hasSpace(stripSpace)) print.add("strip space", colour.toWorkingId(stripSpace));
  return print;
}

/// Every file of which the run knows before it begins that it will be read.
FileSet filesToRead(const Look& look, const Colour& colour, const std::vector<FrameJob>& jobs) {
  FileSet files;
  files.add(colour.file());
  for (const std::string& name : paintedFiles(look))
    if (!isBuiltinStrip(name)) files.add(look.resolve(name));
  for (const FrameJob& job : jobs)
    for (const auto& input : job.inputs) {
      files.add(input);
      files.add(sidecarPath(input));
      const std::string& view = job.view.empty() ? look.frame.view : job.view;
      for (const GroupFile& other : groupFiles(input, look.frame.files, job.frame, view))
        files.add(other.path);
    }
  return files;
}

bool liesBelow(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::error_code failed;
  const auto inside = std::filesystem::weakly_canonical(file, failed)
                          .lexically_relative(std::filesystem::weakly_canonical(
                              folder.empty() ? "." : folder, failed));
  return !failed && !inside.empty() && *inside.begin() != "..";
}

/// Outputs that are there already are not among what the run reads. What a frame's header and JSON
/// name lies below its own folder, so it is looked up only for outputs that do as well.
void refuseOutputsThatAreRead(const Look& look, const Colour& colour,
                              const std::vector<FrameJob>& jobs) {
  std::vector<std::filesystem::path> there;
  std::error_code ignored;
  for (const FrameJob& job : jobs)
    for (const auto& output : job.outputs)
      if (std::filesystem::exists(output, ignored)) there.push_back(output);
  if (there.empty()) return;
  FileSet files = filesToRead(look, colour, jobs);
  for (const FrameJob& job : jobs) {
    const auto folder = job.inputs.front().parent_path();
    const bool beside = std::any_of(there.begin(), there.end(),
                                    [&](const auto& output) { return liesBelow(output, folder); });
    if (!beside || job.missing) continue;
    try {
      const FramePlan plan = planFrame(look, job.inputs.front(), job.frame);
      for (const auto& file : filesBeside(plan)) files.add(file);
    } catch (const InputError&) {
      // The frame fails with that when its turn comes, and writes nothing.
    }
  }
  for (const auto& output : there)
    if (const auto file = files.find(output))
      throw UsageError(fmt::format("the output {} would overwrite {}, which is read",
                                   output.string(), file->string()));
}

/// The frame as the look wants its samples; the preview in 8 bits and without alpha.
std::vector<PictureOutput> kindsOf(const Look& look, const std::vector<FramePattern>& outputs) {
  const PictureFormat& frame = formatOf(outputs.front().text(), "--output");
  const SampleDepth depth = depthFor(frame, look.output.colour);
  std::vector<PictureOutput> kinds = {{&frame, depth, alphaFor(frame, depth)}};
  for (size_t i = 1; i < outputs.size(); ++i)
    kinds.push_back(
        {&formatOf(outputs[i].text(), "--preview"), SampleDepth::uint8, FormatAlpha::none});
  return kinds;
}

}  // namespace

struct CompBatch::Planned {
  Fingerprint print;  ///< of the files as they were before they were looked into
  FramePlan plan;
};

struct CompBatch::Read {
  FramePlan plan;
  FramePlanes planes;
  std::string fingerprint;
};

struct CompBatch::Composed {
  FramePlan plan;
  FrameResult result;
  std::string fingerprint;
};

CompBatch::CompBatch(const Look& look, CompRequest request)
    : look_(look),
      request_(std::move(request)),
      jobs_(planJobs(request_.plan, &notes_)),
      kinds_(kindsOf(look, request_.plan.outputs)),
      colour_(colourOf(look)),
      strips_(look, colour_),
      common_(commonFingerprint(look, colour_)),
      view_(kinds_.size() > 1 || isShown(0) || request_.thumbnails
                ? colour_.toDisplayId(look.colour.display, look.colour.view)
                : std::string()),
      planned_(jobs_.size()),
      warnings_(jobs_.size()),
      thumbnails_(jobs_.size()),
      uses_(jobs_.size()) {
  refuseOutputsThatAreRead(look, colour_, jobs_);
  const bool more = !look.output.layers.empty() || look.output.passthrough;
  if (more && !kinds_.front().format->isExr())
    notes_.push_back(
        fmt::format("output.layers and output.passthrough go into EXRs; {} gets the picture alone",
                    request_.plan.outputs.front().text()));
  if (jobs_.empty()) return;
  try {
    planned(0);
  } catch (const InputError&) {
    if (!request_.skipBadFrames) throw;
  }
}

CompBatch::~CompBatch() = default;

FramePlan CompBatch::planJob(const FrameJob& job) const {
  FramePlan plan = planFrame(look_, job.inputs.front(), job.frame, job.view);
  const bool oneFile = !job.view.empty() && !request_.plan.inputs.front().hasView();
  if (oneFile && plan.image.views.empty())
    throw InputError(fmt::format(
        "{} holds one view and does not say which, so it cannot be made for {}; put %V into the "
        "input's name, or leave it out of the output's",
        plan.image.path.string(), job.view));
  return plan;
}

Fingerprint CompBatch::fingerprint(const FrameJob& job) const {
  Fingerprint print = common_;
  print.add("frame", int64_t{job.frame});
  if (!job.view.empty()) print.add("view", job.view);
  for (const auto& input : job.inputs)
    print.addFile("input", input).addFile("sidecar", sidecarPath(input));
  return print;
}

std::string CompBatch::outputFingerprint(size_t output, const std::string& frame) const {
  if (!isShown(output)) return frame;
  return Fingerprint().add("frame", frame).add("view", view_).hex();
}

CompBatch::Planned& CompBatch::planned(size_t index) {
  std::unique_ptr<Planned>& slot = planned_[index];
  if (slot) return *slot;
  const FrameJob& job = jobs_[index];
  Fingerprint print = fingerprint(job);
  FramePlan plan = planJob(job);
  addFilesBeside(plan, print);
  slot = std::make_unique<Planned>(Planned{std::move(print), std::move(plan)});
  return *slot;
}

void CompBatch::addFilesBeside(const FramePlan& plan, Fingerprint& print) {
  for (const auto& file : filesBeside(plan)) print.add(file.filename().string(), digests_.of(file));
}

bool CompBatch::isUpToDate(size_t index) {
  const FrameJob& job = jobs_[index];
  try {
    const Fingerprint& print = planned(index).print;
    const LooksAtOutputs looking;
    for (size_t i = 0; i < job.outputs.size(); ++i)
      if (storedFingerprint(job.outputs[i], *kinds_[i].format) != outputFingerprint(i, print.hex()))
        return false;
    return true;
  } catch (const InputError&) {
    return false;  // what cannot be read is not done
  }
}

bool CompBatch::isDone(size_t index) {
  if (request_.existing == ExistingOutputs::overwrite) return false;
  const FrameJob& job = jobs_[index];
  for (const auto& output : job.outputs)
    if (!std::filesystem::exists(output)) return false;
  if (request_.existing == ExistingOutputs::update && !isUpToDate(index)) return false;
  planned_[index].reset();
  const LooksAtOutputs looking;
  if (request_.thumbnails)
    thumbnails_[index] = storedThumbnail(look_, colour_, job.outputs.front(), isShown(0));
  return true;
}

CompBatch::Read CompBatch::read(size_t index) {
  const FrameJob& job = jobs_[index];
  if (job.missing) throw InputError(fmt::format("{} is not there", job.missing->string()));
  Planned& input = planned(index);
  FramePlanes planes = readFramePlanes(input.plan);
  Read result{std::move(input.plan), std::move(planes), input.print.hex()};
  planned_[index].reset();
  return result;
}

CompBatch::Composed CompBatch::compose(size_t index, Read input) {
  FrameResult result = composeFrame(look_, strips_, input.plan, std::move(input.planes));
  warnings_[index] = result.warnings;
  warnOfAlpha(result, warnings_[index]);
  uses_[index] = lookUse(look_, input.plan, result.fittingStyles);
  if (request_.thumbnails) thumbnails_[index] = frameThumbnail(look_, colour_, result.colour);
  return {std::move(input.plan), std::move(result), std::move(input.fingerprint)};
}

void CompBatch::warnOfAlpha(const FrameResult& result, std::vector<std::string>& warnings) const {
  const PictureOutput& frame = kinds_.front();
  if (frame.alpha != FormatAlpha::none) return;
  const View<const float> alpha = result.alpha;
  if (std::all_of(alpha.row(0), alpha.row(0) + alpha.pixels(), [](float a) { return a >= 1.0f; }))
    return;
  warnings.push_back(fmt::format(
      "{} files of {} samples hold no alpha, and parts of the frame are transparent; it stands on "
      "black",
      frame.format->suffixes.front(), sampleDepthName(frame.depth)));
}

void CompBatch::write(size_t index, Composed output) const {
  const std::vector<std::filesystem::path>& paths = jobs_[index].outputs;
  // The frame last: where it is there, all of its outputs are.
  for (size_t i = paths.size(); i-- > 0;) {
    makeFolders(paths[i].parent_path());
    const std::string fingerprint = outputFingerprint(i, output.fingerprint);
    if (kinds_[i].format->isExr())
      writeFrame(look_, output.plan, output.result, paths[i],
                 {{kFingerprintAttribute, fingerprint}});
    else
      writeFramePicture(look_, colour_, output.plan, output.result, paths[i], kinds_[i],
                        fingerprint);
  }
}

std::vector<std::string> CompBatch::unused() const {
  if (keptSome_) return {};
  LookUse all;
  for (const LookUse& use : uses_) all.add(use);
  return unusedEntries(look_, all);
}

BatchResult CompBatch::run(const std::function<void(const CompEvent&)>& onFrame) {
  removeLeftoversOf(jobs_);
  Stages<Read, Composed> stages;
  stages.read = [this](size_t i) { return read(i); };
  stages.compute = [this](size_t i, Read input) { return compose(i, std::move(input)); };
  stages.write = [this](size_t i, Composed output) { write(i, std::move(output)); };
  stages.memory = [this](size_t i) {
    std::vector<PictureOutput> pictures = kinds_;
    if (pictures.front().format->isExr()) pictures.erase(pictures.begin());
    return frameMemory(look_, planned(i).plan, pictures);
  };
  stages.isDone = [this](size_t i) { return isDone(i); };
  BatchOptions options;
  options.maxMemory = request_.maxMemory;
  options.maxFrames = request_.maxFrames;
  options.skipBadFrames = request_.skipBadFrames;
  options.stop = request_.stop;
  std::map<size_t, bool> made;  // and whether it was kept
  options.onFrame = [&](const FrameEvent& event) {
    keptSome_ = keptSome_ || event.outcome == FrameOutcome::kept;
    if (event.outcome != FrameOutcome::failed)
      made[event.index] = event.outcome == FrameOutcome::kept;
    onFrame({&jobs_[event.index], event, std::move(warnings_[event.index]),
             std::move(thumbnails_[event.index])});
  };
  BatchResult result = runBatch(jobs_.size(), stages, options);
  for (const auto& [index, kept] : made) {
    if (isThere(jobs_[index])) continue;
    --(kept ? result.kept : result.done);
    result.lost.push_back(index);
  }
  return result;
}

}  // namespace kagefude
