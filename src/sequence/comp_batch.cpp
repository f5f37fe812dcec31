#include "sequence/comp_batch.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/temp_file.h"
#include "compositor/compose_frame.h"
#include "compositor/frame_memory.h"
#include "compositor/read_frame.h"
#include "compositor/write_frame.h"
#include "picture/png_file.h"
#include "sequence/frame_thumbnail.h"

namespace kagefude {
namespace {

std::filesystem::path sidecarPath(std::filesystem::path image) {
  return image.replace_extension(".json");
}

void makeFolderOf(const std::filesystem::path& file) {
  if (file.parent_path().empty()) return;
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error)
    throw OutputError(
        fmt::format("cannot make the folder {}: {}", file.parent_path().string(), error.message()));
}

void removeLeftoversOf(const std::vector<FrameJob>& jobs) {
  std::vector<std::filesystem::path> folders;
  for (const FrameJob& job : jobs)
    for (const auto& output : job.outputs)
      if (std::find(folders.begin(), folders.end(), output.parent_path()) == folders.end())
        folders.push_back(output.parent_path());
  for (const auto& folder : folders) removeLeftovers(folder.empty() ? "." : folder);
}

/// What is the same for all frames of a run.
Fingerprint commonFingerprint(const Look& look, const Colour& colour) {
  Fingerprint print;
  print.add("version", KAGEFUDE_VERSION).add("look", resolvedText(look));
  for (const StyleLook& style : look.styles)
    if (!isBuiltinStrip(style.style.strip)) print.addFile("strip", look.resolve(style.style.strip));
  for (const auto& file : colour.files()) print.addFile("colour", file);
  return print;
}

void addDepthMaps(const FramePlan& plan, Fingerprint& print) {
  for (const FrameLight& light : plan.lights)
    if (light.depthMap) print.addFile("depth map", light.depthMap->file);
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
      jobs_(planFrames(request_.plan)),
      colour_(look.colourConfig()),
      strips_(look, colour_),
      common_(commonFingerprint(look, colour_)),
      planned_(jobs_.size()),
      warnings_(jobs_.size()),
      thumbnails_(jobs_.size()) {
  if (jobs_.empty()) return;
  try {
    planned(0);
  } catch (const InputError&) {
    if (!request_.skipBadFrames) throw;
  }
}

CompBatch::~CompBatch() = default;

Fingerprint CompBatch::fingerprint(const FrameJob& job) const {
  Fingerprint print = common_;
  print.add("frame", int64_t{job.frame});
  for (const auto& input : job.inputs)
    print.addFile("input", input).addFile("sidecar", sidecarPath(input));
  return print;
}

CompBatch::Planned& CompBatch::planned(size_t index) {
  std::unique_ptr<Planned>& slot = planned_[index];
  if (slot) return *slot;
  const FrameJob& job = jobs_[index];
  Fingerprint print = fingerprint(job);
  FramePlan plan = planFrame(look_, job.inputs.front(), job.frame);
  addDepthMaps(plan, print);
  slot = std::make_unique<Planned>(Planned{std::move(print), std::move(plan)});
  return *slot;
}

bool CompBatch::isUpToDate(size_t index) {
  const FrameJob& job = jobs_[index];
  try {
    const Fingerprint& print = planned(index).print;
    if (openImage(job.outputs.front()).text(kFingerprintAttribute) != print.hex()) return false;
    for (size_t i = 1; i < job.outputs.size(); ++i)
      if (readPngText(job.outputs[i], kFingerprintAttribute) != print.hex()) return false;
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
  if (request_.thumbnails) thumbnails_[index] = frameThumbnail(look_, colour_, result.colour);
  return {std::move(input.plan), std::move(result), std::move(input.fingerprint)};
}

void CompBatch::write(size_t index, Composed output) const {
  const std::vector<std::filesystem::path>& paths = jobs_[index].outputs;
  const std::map<std::string, std::string> attributes = {
      {kFingerprintAttribute, output.fingerprint}};
  for (size_t i = 1; i < paths.size(); ++i) {
    makeFolderOf(paths[i]);
    writePreview(look_, colour_, output.result, paths[i], attributes);
  }
  makeFolderOf(paths.front());
  writeFrame(look_, output.plan, output.result, paths.front(), attributes);
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
  options.onFrame = [&](const FrameEvent& event) {
    onFrame({&jobs_[event.index], event, std::move(warnings_[event.index]),
             std::move(thumbnails_[event.index])});
  };
  return runBatch(jobs_.size(), stages, options);
}

}  // namespace kagefude
