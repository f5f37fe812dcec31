#pragma once

#include <filesystem>

#include "live/frame_stages.h"

namespace kagefude {

/// A look's colour configuration and strips. Each is kept while the look names it and its file lies
/// unchanged on disk.
class StripShelf {
 public:
  const Made<Colour>& colourOf(const Look& look, StageRun& run);
  /// The strips in the colours of `colour`, until the next call: strips that stay go over from one
  /// set to the next, so nobody else may hold the set.
  Made<StripSet> stripsOf(const Look& look, const Made<Colour>& colour, StageRun& run);

 private:
  Stage<Colour> colour_;
  std::shared_ptr<const Colour> colourOfSet_;  ///< which the set refers to
  std::shared_ptr<StripSet> set_;
  uint64_t version_ = 0;
  StageKey key_;
  std::map<std::string, StageKey> stamps_;  ///< of each strip in the set
};

/// A picture with what it was made of: what the viewer shows and the probe reads.
struct LivePicture {
  std::shared_ptr<const Look> look;  ///< as it was asked for
  std::shared_ptr<const FramePlan> plan;
  StagedFrame stages;
  Made<Colour> colour;
  int step = 1;                   ///< every how many pixels it was sampled; 1: equal to comp's
  std::vector<std::string> made;  ///< the stages that were made for it
};

/// One frame on disk, with its stages at full size and through a proxy.
class LiveFrame {
 public:
  LiveFrame(std::filesystem::path path, int frame, std::string view = "")
      : path_(std::move(path)), frame_(frame), view_(std::move(view)) {}

  /// The frame under a look, sampled so that its longer side is at most `size` pixels; 0: whole.
  /// Files that changed on disk are read again. Throws as planFrame, readFramePlanes and
  /// composeFrame do, and Superseded when `stop` is asked for; what was made until then is kept.
  LivePicture compose(const Look& look, StripShelf& shelf, int size, std::stop_token stop = {});

  const std::filesystem::path& path() const { return path_; }
  int frame() const { return frame_; }

 private:
  std::filesystem::path path_;
  int frame_;
  std::string view_;
  Stage<FramePlanes> planes_, samples_;
  FrameStages whole_, proxy_;
};

}  // namespace kagefude
