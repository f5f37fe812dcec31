#include "sequence/frame_jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "base/error.h"
#include "base/files_read.h"
#include "base/nearest_name.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

using FrameFiles = std::map<int, fs::path>;

/// With --skip-bad-frames each missing frame is a failed one, a job of its own up to this many; the
/// others are named together, so that a plan costs what is on disk and not what is asked for.
constexpr size_t mostMissingJobs = 1000;

std::vector<int> framesOf(const FrameFiles& files) {
  std::vector<int> frames;
  for (const auto& [frame, path] : files) frames.push_back(frame);
  return frames;
}

std::vector<int> difference(const std::vector<int>& all, const FrameFiles& files) {
  std::vector<int> missing;
  for (const int frame : all)
    if (!files.contains(frame)) missing.push_back(frame);
  return missing;
}

std::string counted(size_t frames) {
  return fmt::format("{} frame{}", frames, frames == 1 ? "" : "s");
}

std::string quoted(const FramePattern& pattern, const std::string& view) {
  if (view.empty() || !pattern.hasView()) return pattern.text();
  return fmt::format("{} ({})", pattern.text(), view);
}

/// What lies in the folder of a pattern that nothing fits.
std::string folderHint(const fs::path& sample) {
  const fs::path folder = sample.has_parent_path() ? sample.parent_path() : fs::path(".");
  std::error_code failed;
  if (!fs::is_directory(folder, failed))
    return fmt::format("the folder {} does not exist", folder.string());
  std::vector<std::string> names;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed))
    names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  return fmt::format("the folder has {}", listNames(names, 3));
}

/// Every frame between the first and the last at the spacing that the given ones share.
std::vector<int> withoutGaps(const std::vector<int>& frames, const FramePattern& pattern) {
  int64_t step = 0;
  for (size_t i = 1; i < frames.size(); ++i)
    step = std::gcd(step, int64_t{frames[i]} - frames[i - 1]);
  if (step == 0) return frames;
  if ((int64_t{frames.back()} - frames.front()) / step >= static_cast<int64_t>(kMostFrames))
    throw InputError(fmt::format("the frames of {} lie too far apart ({}); name them with --frames",
                                 pattern.text(), describeFrames(frames)));
  std::vector<int> all;
  for (int64_t frame = frames.front(); frame <= frames.back(); frame += step)
    all.push_back(static_cast<int>(frame));
  return all;
}

/// Plans one request; the steps follow each other in run().
class Planner {
 public:
  Planner(const PlanRequest& request, std::vector<std::string>* notes)
      : request_(request), notes_(notes) {
    const auto hasView = [](const FramePattern& pattern) { return pattern.hasView(); };
    if (std::any_of(request.inputs.begin(), request.inputs.end(), hasView) ||
        std::any_of(request.outputs.begin(), request.outputs.end(), hasView)) {
      views_ = request.views.empty() ? std::vector<std::string>{"left", "right"} : request.views;
    } else {
      views_ = {""};
    }
  }

  std::vector<FrameJob> run() {
    scan();
    chooseFrames();
    checkOutputPlaces();
    checkMissing();
    checkOutputNames(makeJobs(chunkSpan(frames_.size() * views_.size(), Chunk{}), nullptr));
    return makeJobs(chunkSpan(frames_.size() * views_.size(), request_.chunk), notes_);
  }

 private:
  bool hasFrames() const {
    return std::any_of(request_.inputs.begin(), request_.inputs.end(),
                       [](const FramePattern& pattern) { return pattern.hasFrame(); });
  }

  void scan() {
    for (const FramePattern& input : request_.inputs)
      for (const std::string& view : views_) files_.push_back(input.scan(view));
  }

  const FrameFiles& filesOf(size_t input, size_t view) const {
    return files_[input * views_.size() + view];
  }

  void chooseFrames() {
    if (request_.frames) {
      frames_ = *request_.frames;
      if (frames_.size() > 1 && !hasFrames())
        throw UsageError(
            fmt::format("{} has no place for the frame (such as ####), but {} are asked "
                        "for",
                        request_.inputs.front().text(), counted(frames_.size())));
    } else if (hasFrames()) {
      chooseScannedFrames();
    } else {
      const FramePattern& input = request_.inputs.front();
      frames_ = {frameNumberOf(input.path(0, views_.front())).value_or(1)};
    }
  }

  void chooseScannedFrames() {
    const FrameFiles* lead = nullptr;
    std::string leadName;
    const FramePattern* leadPattern = nullptr;
    for (size_t i = 0; i < request_.inputs.size(); ++i) {
      const FramePattern& input = request_.inputs[i];
      if (!input.hasFrame()) continue;
      for (size_t v = 0; v < views_.size(); ++v) {
        const FrameFiles& files = filesOf(i, v);
        if (files.empty())
          throw InputError(fmt::format("no file fits {}; {}", quoted(input, views_[v]),
                                       folderHint(input.path(1, views_[v]))));
        if (!lead) {
          lead = &files;
          leadName = quoted(input, views_[v]);
          leadPattern = &input;
        } else if (framesOf(files) != framesOf(*lead) && !request_.skipBadFrames) {
          throw InputError(fmt::format("{} has {} ({}), but {} has {} ({})", leadName,
                                       counted(lead->size()), describeFrames(framesOf(*lead)),
                                       quoted(input, views_[v]), counted(files.size()),
                                       describeFrames(framesOf(files))));
        }
      }
    }
    std::set<int> all;
    for (const FrameFiles& files : files_)
      for (const auto& [frame, path] : files) all.insert(frame);
    frames_ = withoutGaps({all.begin(), all.end()}, *leadPattern);
    noteSpacing(*leadPattern);
  }

  /// A shot on twos, or one that lacks every other frame: the names do not tell, so it is said.
  void noteSpacing(const FramePattern& pattern) {
    if (!notes_ || frames_.size() < 2 || frames_[1] == frames_[0] + 1) return;
    notes_->push_back(
        fmt::format("{} has the frames {} and none between them; if there should be "
                    "more, name them with --frames",
                    pattern.text(), describeFrames(frames_)));
  }

  void checkOutputPlaces() const {
    for (const FramePattern& output : request_.outputs) {
      if (frames_.size() > 1 && !output.hasFrame())
        throw UsageError(
            fmt::format("{} stands for {} ({}), but the output {} has no place for the "
                        "frame (such as ####)",
                        request_.inputs.front().text(), counted(frames_.size()),
                        describeFrames(frames_), output.text()));
      if (views_.size() > 1 && !output.hasView())
        throw UsageError(
            fmt::format("{} views are asked for ({}), but the output {} has no place "
                        "for the view (%V)",
                        views_.size(), listNames(views_), output.text()));
    }
  }

  /// The jobs of a span of all frames and views; of frames that are not there only the first.
  std::vector<FrameJob> makeJobs(const ChunkSpan& span, std::vector<std::string>* notes) const {
    std::vector<FrameJob> jobs;
    std::vector<int> left;
    size_t missing = 0;
    for (size_t place = span.first; place < span.last; ++place) {
      const int frame = frames_[place / views_.size()];
      const size_t view = place % views_.size();
      if (missing >= mostMissingJobs && lacks(frame, view)) {
        left.push_back(frame);
        continue;
      }
      jobs.push_back(makeJob(frame, view));
      if (jobs.back().missing) ++missing;
    }
    const size_t more = left.size();
    if (notes && more > 0)
      notes->push_back(
          fmt::format("beyond {} missing frames {} more are not there and are left out: {}",
                      missing, more, describeFrames(std::move(left))));
    return jobs;
  }

  FrameJob makeJob(int frame, size_t view) const {
    FrameJob job;
    job.frame = frame;
    job.view = views_[view];
    for (size_t i = 0; i < request_.inputs.size(); ++i) addInput(i, view, &job);
    for (const FramePattern& output : request_.outputs)
      job.outputs.push_back(output.path(frame, job.view));
    return job;
  }

  bool lacks(int frame, size_t view) const {
    for (size_t i = 0; i < request_.inputs.size(); ++i)
      if (request_.inputs[i].hasFrame() && !filesOf(i, view).contains(frame)) return true;
    return false;
  }

  void addInput(size_t input, size_t view, FrameJob* job) const {
    const FramePattern& pattern = request_.inputs[input];
    fs::path path = pattern.path(job->frame, job->view);
    bool found = false;
    if (pattern.hasFrame()) {
      const auto file = filesOf(input, view).find(job->frame);
      found = file != filesOf(input, view).end();
      if (found) path = file->second;
    } else {
      std::error_code ignored;
      found = fs::exists(path, ignored);
    }
    if (!found && !job->missing) job->missing = path;
    job->inputs.push_back(std::move(path));
  }

  /// Before any job is made: a slip in --frames may ask for millions.
  void checkMissing() const {
    for (size_t i = 0; i < request_.inputs.size(); ++i)
      for (size_t v = 0; v < views_.size(); ++v) checkMissingInput(i, v);
  }

  void checkMissingInput(size_t input, size_t view) const {
    const FramePattern& pattern = request_.inputs[input];
    if (!pattern.hasFrame()) {
      const fs::path path = pattern.path(frames_.front(), views_[view]);
      std::error_code ignored;
      if (!request_.skipBadFrames && !fs::exists(path, ignored))
        throw InputError(fmt::format("{} does not exist; {}", path.string(), folderHint(path)));
      return;
    }
    const FrameFiles& files = filesOf(input, view);
    const std::vector<int> missing = difference(frames_, files);
    if (missing.empty()) return;
    const bool slip = files.empty() && missing.size() > mostMissingJobs;
    if (request_.skipBadFrames && !slip) return;
    if (files.empty())
      throw InputError(fmt::format("no file fits {}; {}", quoted(pattern, views_[view]),
                                   folderHint(pattern.path(frames_.front(), views_[view]))));
    throw InputError(fmt::format("{} lacks {} of {} ({}): {}; it has {}",
                                 quoted(pattern, views_[view]), missing.size(),
                                 counted(frames_.size()), describeFrames(frames_),
                                 describeFrames(missing), describeFrames(framesOf(files))));
  }

  void checkOutputNames(const std::vector<FrameJob>& jobs) const {
    std::set<std::string> inputs;
    const auto normal = [](const fs::path& path) {
      return fs::absolute(path).lexically_normal().string();
    };
    FileSet files;
    for (const FrameJob& job : jobs)
      for (const fs::path& input : job.inputs) {
        inputs.insert(normal(input));
        files.add(input);
      }
    std::set<std::string> outputs;
    for (const FrameJob& job : jobs)
      for (const fs::path& output : job.outputs) {
        if (files.find(output) || inputs.contains(normal(output)))
          throw UsageError(fmt::format("the output {} would overwrite an input", output.string()));
        if (!outputs.insert(normal(output)).second)
          throw UsageError(fmt::format("two outputs have one name: {}", output.string()));
      }
  }

  const PlanRequest& request_;
  std::vector<std::string>* notes_;
  std::vector<std::string> views_;
  std::vector<FrameFiles> files_;  ///< by input, then view
  std::vector<int> frames_;
};

}  // namespace

std::string FrameJob::name() const {
  return view.empty() ? fmt::format("frame {}", frame) : fmt::format("frame {} {}", frame, view);
}

std::vector<FrameJob> planJobs(const PlanRequest& request, std::vector<std::string>* notes) {
  return Planner(request, notes).run();
}

}  // namespace kagefude
