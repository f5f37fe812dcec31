#pragma once

#include <filesystem>
#include <map>

#include "live/frame_stages.h"
#include "live/strip_shelf.h"

namespace kagefude {

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

  /// The frame under a look, sampled so that its longer side is at most `size` pixels, and of those
  /// samples every `coarser`-th (1: all) in both ways; size 0: whole. Each step keeps its own
  /// stages. Lights whose name matches one of `moving` have few places where the frame is sampled
  /// (shadow.places, method places). Files that changed on disk are read again. Throws as
  /// planFrame, readFramePlanes and composeFrame do, and Superseded when `stop` is asked for; what
  /// was made until then is kept.
  LivePicture compose(const Look& look, StripShelf& shelf, int size, std::stop_token stop = {},
                      int coarser = 1, const std::vector<std::string>& moving = {});

  /// What its planes and stages take, about; 0 before the first picture. Its casters not counted.
  size_t bytes() const { return bytes_; }

  const std::filesystem::path& path() const { return path_; }
  int frame() const { return frame_; }

 private:
  struct Proxy {
    Stage<FramePlanes> samples;
    FrameStages stages;
  };

  void compose(LivePicture& picture, const Made<StripSet>& strips, FramePlan plan,
               const Made<FramePlanes>& planes, StageRun& run);

  std::filesystem::path path_;
  int frame_;
  std::string view_;
  Stage<FramePlanes> planes_;
  FrameStages whole_;
  std::map<int, Proxy> proxies_;  ///< by step
  size_t bytes_ = 0;
};

}  // namespace kagefude
