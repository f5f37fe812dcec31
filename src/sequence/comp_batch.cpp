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
#include "compositor/read_frame.h"
#include "compositor/write_frame.h"
#include "exr/header_claims.h"
#include "frame/frame_group.h"
#include "picture/png_file.h"
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

/// What is the same for all frames of a run. Of the colour configuration that is what its
/// transforms in use do, so this also refuses those that cannot be made; the others do not matter.
Fingerprint commonFingerprint(const Look& look, const Colour& colour) {
  Fingerprint print;
  print.add("version", KAGEFUDE_VERSION).add("look", resolvedText(look));
  for (const StyleLook& style : look.styles)
    if (!isBuiltinStrip(style.style.strip)) print.addFile("strip", look.resolve(style.style.strip));
  if (!colour.file().empty()) print.addFile("colour", colour.file());
  const std::string stripSpace = stripColourSpace(look);
  if (colour.hasSpace(stripSpace)) print.add("strip space", colour.toWorkingId(stripSpace));
  return print;
}

/// Every file of which the run knows before it begins that it will be read.
FileSet filesToRead(const Look& look, const Colour& colour, const std::vector<FrameJob>& jobs) {
  FileSet files;
  files.add(colour.file());
  for (const StyleLook& style : look.styles)
    if (!isBuiltinStrip(style.style.strip)) files.add(look.resolve(style.style.strip));
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
      colour_(look.colourConfig()),
      strips_(look, colour_),
      common_(commonFingerprint(look, colour_)),
      view_(request_.plan.outputs.size() > 1 || request_.thumbnails
                ? colour_.toDisplayId(look.colour.display, look.colour.view)
                : std::string()),
      planned_(jobs_.size()),
      warnings_(jobs_.size()),
      thumbnails_(jobs_.size()),
      uses_(jobs_.size()) {
  refuseOutputsThatAreRead(look, colour_, jobs_);
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

std::string CompBatch::previewFingerprint(const std::string& frame) const {
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
    if (!isWholeExr(job.outputs.front())) return false;
    if (openImage(job.outputs.front()).text(kFingerprintAttribute) != print.hex()) return false;
    for (size_t i = 1; i < job.outputs.size(); ++i)
      if (readPngText(job.outputs[i], kFingerprintAttribute) != previewFingerprint(print.hex()))
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
    thumbnails_[index] = storedThumbnail(look_, colour_, job.outputs.front());
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
  uses_[index] = lookUse(look_, input.plan, result.fittingStyles);
  if (request_.thumbnails) thumbnails_[index] = frameThumbnail(look_, colour_, result.colour);
  return {std::move(input.plan), std::move(result), std::move(input.fingerprint)};
}

void CompBatch::write(size_t index, Composed output) const {
  const std::vector<std::filesystem::path>& paths = jobs_[index].outputs;
  const std::map<std::string, std::string> attributes = {
      {kFingerprintAttribute, output.fingerprint}};
  for (size_t i = 1; i < paths.size(); ++i) {
    makeFolders(paths[i].parent_path());
    writePreview(look_, colour_, output.result, paths[i],
                 {{kFingerprintAttribute, previewFingerprint(output.fingerprint)}});
  }
  makeFolders(paths.front().parent_path());
  writeFrame(look_, output.plan, output.result, paths.front(), attributes);
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
    return frameMemory(look_, planned(i).plan, jobs_[i].outputs.size() > 1);
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
