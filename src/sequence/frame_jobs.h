#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/frame_pattern.h"
#include "sequence/frame_range.h"

namespace kagefude {

/// What a run is asked to do, as it stands on the command line.
struct PlanRequest {
  std::vector<FramePattern> inputs;        ///< at least one; the first one leads
  std::vector<FramePattern> outputs;       ///< every kind of file that is made per frame
  std::optional<std::vector<int>> frames;  ///< --frames; without it the inputs are scanned
  std::vector<std::string> views;          ///< for %V; left and right when empty
  Chunk chunk;                             ///< the part of the whole that this run takes
  bool skipBadFrames = false;              ///< missing inputs become failed frames, not an error
};

/// One frame (of one view) to be made.
struct FrameJob {
  int frame = 0;
  std::string view;                            ///< empty without a view place
  std::vector<std::filesystem::path> inputs;   ///< one per pattern of the request
  std::vector<std::filesystem::path> outputs;  ///< one per pattern of the request
  /// The first input that is not on disk. Only with skipBadFrames; the frame is to fail.
  std::optional<std::filesystem::path> missing;

  /// "frame 12" or "frame 12 left", for messages.
  std::string name() const;
};

/// Works out the whole run before anything is touched. Frames come in the order of --frames, or
/// ascending; the views of a frame follow each other. The chunk is cut last, after all checks, so
/// every part of a farm job fails alike.
///
/// An input without a frame place serves every frame; when all are so, there is one job, whose
/// frame is --frames' only one, else the number in the first input's name, else 1.
///
/// UsageError: an output without a frame (or view) place for several frames (views); two outputs
/// with one name; an output that is one of the inputs. InputError: no file fits; inputs whose
/// scanned frames differ; frames that are not on disk (named as a range) without skipBadFrames.
/// Frames that are asked for and not there cost nothing but their numbers: with skipBadFrames the
/// first 1,000 of them become jobs, the others are left out and named together (of a pattern that
/// nothing fits, more than that are an InputError). `notes`, when given, takes what the user should
/// know: that, and that the frames found lie wider apart than one.
std::vector<FrameJob> planJobs(const PlanRequest& request,
                                 std::vector<std::string>* notes = nullptr);

}  // namespace kagefude
