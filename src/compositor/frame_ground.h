#pragma once

#include <memory>

#include "compositor/finish_picture.h"
#include "passes/edges/behind_paint.h"
#include "passes/ground/paper_tooth.h"

namespace kagefude {

// What a picture is painted on: output.background with [ground] and [paper].

/// Whether the look's paint lies on a ground of its own or ends by [edges]; else it is laid over
/// the beauty, or nothing, as it is.
bool usesGround(const Look& look, const StyledSurfaces& styled);

/// Whether what lays paint on its ground needs the grain of the strokes.
bool keepsGrain(const Look& look, const StyledSurfaces& styled);

/// The paper's surface; none where the look has no paper. Fixed to the world only where the camera
/// is known.
PaperSurface framePaper(const FinishInput& in);

/// What lies behind the paint, pixel by pixel. `alpha` is that of the paint, its things met by
/// coverage: where it is 0 the beauty is taken as it is, elsewhere what it shows nearby. Where the
/// paint has gaps of its own (paper, dry brush) paper lies under things that stand before the
/// beauty.
class FrameGround {
 public:
  /// `in` and `surface` must outlive it.
  FrameGround(const FinishInput& in, View<const float> alpha, const PaperSurface& surface);

  /// Null for a transparent background and for a beauty that the frame lacks.
  const PaintGround* get() const { return ground_.get(); }

 private:
  std::unique_ptr<PaintGround> paper_, ground_;
};

}  // namespace kagefude
