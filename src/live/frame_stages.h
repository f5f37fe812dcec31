#pragma once

#include <map>
#include <string>
#include <vector>

#include "compositor/frame_plan.h"
#include "compositor/frame_result.h"
#include "compositor/light_visibility.h"
#include "compositor/strip_set.h"
#include "compositor/styled_surfaces.h"
#include "live/stage.h"
#include "passes/brush/brush_map.h"

namespace kagefude {

/// Labels of a frame's surfaces, and which pixels are joined in them.
struct FrameSurfaces {
  Labels labels;
  Bytes joins;
};

/// Surfaces with their styles, and what is doubted about them.
struct DoubtedStyles {
  StyledSurfaces surfaces;
  std::vector<std::string> warnings;
};

/// A picture as it is written, and how much of each painted pixel outlines cover (empty: none).
struct FinishedPicture {
  FrameResult frame;  ///< colour, alpha and `standing`; layers are stages here
  Floats outline;
};

/// What one light gave.
struct LightStagesMade {
  std::string name;
  Made<LightVisibility> shadow;  ///< before smoothing
  Made<Floats> visibility, tone;
};

/// A frame with all its stages. Holds what it shows, whatever is made afterwards.
struct StagedFrame {
  Made<FramePlanes> planes;
  Made<FrameSurfaces> surfaces;
  std::vector<LightStagesMade> lights;
  Made<DoubtedStyles> styles;
  Made<Floats> tone;  ///< brush.tone
  Made<BrushResult> strokes, ownLights;
  Made<FinishedPicture> picture;
  std::vector<std::string> warnings;  ///< each once, in the order of composeFrame's
};

/// Runs the look on one frame as composeFrame does, with the same functions in the same order, and
/// keeps what each stage made. A stage is made again only when something changed that its key names
/// (see live.h). The picture equals composeFrame's bit for bit. One call at a time.
class FrameStages {
 public:
  /// `look` has its lengths in painted pixels (inRenderedPixels); `planes` are those of `plan`.
  /// Throws Superseded between two stages when `run.stop` is asked for, else as composeFrame does;
  /// what was made until then stays.
  StagedFrame compose(const Look& look, const Made<StripSet>& strips, const FramePlan& plan,
                      const Made<FramePlanes>& planes, StageRun& run);

 private:
  struct LightStages {
    Stage<LightVisibility> shadow;
    Stage<Floats> smoothed, tone;
  };

  LightStagesMade composeLight(const Look& look, const FramePlan& plan, size_t light,
                               const StagedFrame& frame, StageRun& run);
  Made<Floats> composeTone(const Look& look, const FramePlan& plan, const StagedFrame& frame,
                           StageRun& run);
  Made<Floats> composeShared(const Look& look, const FramePlan& plan, const StagedFrame& frame,
                             StageKey tone, StageRun& run);
  void paint(const Look& look, const Made<StripSet>& strips, const FramePlan& plan,
             StagedFrame& frame, StageRun& run);
  void forgetLights(const FramePlan& plan);

  Stage<FrameSurfaces> surfaces_;
  std::map<std::string, LightStages> lights_;
  Stage<Floats> sum_, tone_, shared_;
  Stage<DoubtedStyles> styles_;
  Stage<BrushResult> strokes_, ownLights_;
  Stage<FinishedPicture> picture_;
};

}  // namespace kagefude
