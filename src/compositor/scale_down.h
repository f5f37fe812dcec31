#pragma once

#include "compositor/frame_plan.h"
#include "compositor/frame_result.h"
#include "exr/read_channels.h"
#include "image/downscale.h"

namespace kagefude {

// `output.scale`: frames that were rendered larger than the shot are painted as they are, and come
// out at the shot's size.

/// The look with its lengths of unit "pixels", which are those of the picture that is written, in
/// pixels of the picture that is painted: `output.scale` times as many.
Look inRenderedPixels(Look look);
/// The look with its lengths of unit "pixels" times `factor`; whole numbers are rounded, and never
/// go below the least that their key takes.
Look multiplyPixels(Look look, double factor);

/// Throws InputError where `output.scale` does not divide the picture's sides; notes where the
/// frame's JSON says another scale.
void checkScale(const Look& look, FramePlan& plan);

/// Brings a result to the size that is written, at the end of a frame: colour and alpha by their
/// shares in linear light, layers of numbers by their means, layers that must not be mixed by the
/// pixel that stands for its square by `surfaces`. Nothing at a scale of 1.
void scaleDown(const Look& look, const FramePlan& plan, View<const uint32_t> surfaces,
               FrameResult& result);

/// Brings channels of the input to the size that is written. Cryptomattes are ranked anew by what
/// each id covers of the square, R, G, B, A are filtered by their shares and other half and float
/// channels by their means (NaN and Inf count as 0). Positions, normals, depths, indices, motion,
/// whole numbers and whatever else has x, y, z or u, v take the pixel of `standing`; motion is
/// divided by the scale, for it counts pixels.
void scaleDown(const Downscale& squares, int scale, View<const uint32_t> standing,
               const FramePlan& plan, std::vector<RawPlane>& planes);

}  // namespace kagefude
