#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/frame_pattern.h"
#include "look/look.h"
#include "passes/measure/stroke_moves.h"
#include "sequence/shot_breaks.h"

namespace kagefude {

struct CheckRequest {
  FramePattern comped;                     ///< the finished frames: R, G, B and the tone layer
  std::optional<FramePattern> unstyled;    ///< the same, comped with brush.contrast = 0
  FramePattern aovs;                       ///< the rendered frames that they were made from
  std::optional<std::vector<int>> frames;  ///< without it all finished frames on disk
  std::string tone = "brush.tone";         ///< layer of the finished frames
  Look look;                               ///< names of passes in the rendered frames
};

/// One finished frame against the one before. Errors are root mean squares in scene-linear colour
/// over what both frames show; NaN for the first frame, and where nothing is seen in both.
struct CheckedFrame {
  int frame = 0;
  double compared = 0;  ///< share of the surfaces' pixels that are compared
  double picture = 0;   ///< warp error of the finished picture
  double plain = 0;     ///< of the unstyled tone: the unstyled sequence, or without one each
                        ///< object's mean colour over the sequence at each pixel's tone
  double tone = 0;      ///< of the tone itself, 0..1
  double strokes = 0;   ///< of the strokes alone: the picture less the unstyled tone
  double contrast = 0;  ///< of the strokes, see StrokeMeasure
  double grain = 0;     ///< of the strokes, pixels

  double excess() const { return picture - plain; }
};

struct CheckResult {
  std::vector<CheckedFrame> frames;
  double picture = 0, plain = 0, tone = 0, strokes = 0, excess = 0;  ///< means over the sequence
  double median = 0;  ///< of the picture's warp errors
  /// The largest of them over the median; Inf where more than half of the frames do not change.
  double jump = 0;
  int jumpFrame = 0;                         ///< where it is
  double contrast = 0;                       ///< median over the frames
  double contrastLow = 0, contrastHigh = 0;  ///< least and most, against the median
  double grain = 0, grainLow = 0, grainHigh = 0;
  std::vector<ObjectMoves> objects;  ///< the strokes of each, the restless ones first
  Floats moves;                      ///< where strokes move, see StrokeMoves::picture
  std::vector<ShotBreak> breaks;     ///< frames that the exporter described by what they show
};

/// Measures how a finished sequence holds still: see CheckedFrame. Frames must follow each
/// other: motion vectors reach
/// back by one. Throws UsageError when fewer than two frames are asked for or one does not follow
/// the other, InputError when a frame, a layer or a pass is missing.
CheckResult checkSequence(const CheckRequest& request);

/// The numbers as JSON, as curves over the frames, and as a PNG of where strokes move: black where
/// they hold still, over red to white where they are unrelated to those before; grey where
/// nothing was compared.
std::string checkJson(const CheckResult& result);
void drawMoves(const CheckResult& result, const std::filesystem::path& path);
void plotCheck(const CheckResult& result, const std::filesystem::path& path);

}  // namespace kagefude
