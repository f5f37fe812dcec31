#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "colour/colour.h"
#include "compositor/frame_plan.h"
#include "compositor/look_use.h"
#include "compositor/strip_set.h"
#include "compositor/write_frame_picture.h"
#include "look/look.h"
#include "sequence/batch.h"
#include "sequence/fingerprint.h"
#include "sequence/frame_jobs.h"
#include "sequence/report.h"

namespace kagefude {

/// What to do about outputs that are there already: make them anew, keep them, or keep those whose
/// fingerprint says that look, inputs and program are still the same.
enum class ExistingOutputs { overwrite, skip, update };

struct CompRequest {
  PlanRequest
      plan;  ///< outputs[0] is the frame, outputs[1], if any, the preview; by their suffixes
  ExistingOutputs existing = ExistingOutputs::overwrite;
  size_t maxMemory = 0;
  size_t maxFrames = 0;  ///< in flight; 0 is one a thread
  bool skipBadFrames = false;
  bool thumbnails = false;  ///< makes a thumbnail of every frame, of kept ones from their output
  std::stop_token stop;
};

/// One frame of a finished or running batch, as progress and report hear of it.
struct CompEvent {
  const FrameJob* job = nullptr;
  FrameEvent frame;
  std::vector<std::string> warnings;
  Thumbnail thumbnail;  ///< empty unless asked for, and of a failed frame
};

/// Comps a sequence with one look. Plans every job and opens the first frame before anything is
/// touched, so that an error of the look shows with nothing written.
class CompBatch {
 public:
  /// Throws UsageError, LookError and InputError as formatOf, depthFor, planJobs, Look, Colour and
  /// StripSet do.
  CompBatch(const Look& look, CompRequest request);
  ~CompBatch();

  const std::vector<FrameJob>& jobs() const { return jobs_; }
  /// What of the look fitted nothing in all frames, a sentence each; after run(). Empty where
  /// frames were kept, for what these show is not known.
  std::vector<std::string> unused() const;
  /// What the plan has to say beside its jobs, see planJobs.
  const std::vector<std::string>& notes() const { return notes_; }
  /// Runs all jobs in the current TBB arena; `onFrame` is never called twice at a time. Frames
  /// whose outputs were made and are not on the disk any more when all is over come back as `lost`.
  BatchResult run(const std::function<void(const CompEvent&)>& onFrame);

 private:
  struct Planned;
  struct Read;
  struct Composed;
  FramePlan planJob(const FrameJob& job) const;
  /// The frame's plan, made once: when its memory is estimated, and the first when the batch is.
  Planned& planned(size_t index);
  Read read(size_t index);
  Composed compose(size_t index, Read input);
  void write(size_t index, Composed output) const;
  bool isDone(size_t index);
  bool isUpToDate(size_t index);
  void addFilesBeside(const FramePlan& plan, Fingerprint& print);
  /// Of everything that decides a frame's pixels. Files are looked at before they are read, so that
  /// one which changes meanwhile makes the frame stale.
  Fingerprint fingerprint(const FrameJob& job) const;
  /// Of an output of the frame, which a change of the view makes stale where it is seen through it.
  std::string outputFingerprint(size_t output, const std::string& frame) const;
  bool isShown(size_t output) const { return isDisplayReferred(kinds_[output].depth); }
  void warnOfAlpha(const FrameResult& result, std::vector<std::string>& warnings) const;

  const Look& look_;
  CompRequest request_;
  std::vector<std::string> notes_;
  std::vector<FrameJob> jobs_;
  std::vector<PictureOutput> kinds_;  ///< by output of a job
  Colour colour_;
  StripSet strips_;
  FileDigests digests_;
  Fingerprint common_;                              ///< program, look and its files
  std::string view_;                                ///< what integer outputs are shown through
  std::vector<std::unique_ptr<Planned>> planned_;   ///< by job, from its plan to its reading
  std::vector<std::vector<std::string>> warnings_;  ///< by job; written by its own stage only
  std::vector<Thumbnail> thumbnails_;               ///< likewise
  std::vector<LookUse> uses_;                       ///< likewise
  bool keptSome_ = false;
};

}  // namespace kagefude
