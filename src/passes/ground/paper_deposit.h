#pragma once

#include "passes/edges/behind_paint.h"
#include "passes/ground/paper_tooth.h"

namespace kagefude {

/// **[ours]** Share of the paint that stays on paper of the height 0..1 under the brush: the brush
/// covers the highest `load` of the paper, load = pressure + by_tone (1/2 - tone) + grain / 10, and
/// what lies lower stays bare, up to `strength`. The step from covered to bare takes a quarter of
/// the heights to either side. grain: of the strokes, mean 0, variance 1: where a stroke is thick
/// it fills deeper hollows. A NaN tone counts as 0.
float depositShare(float height, float tone, float grain, const PaperParams& params);

/// Takes paint off where the paper does not hold it: all four planes are multiplied, so that it
/// stays associated; and lays the tooth's light and shade over its colours. tone: what the paint
/// was mixed for, 0..1. grain may be empty: level strokes.
void depositPaint(const PaintViews& paint, View<const float> tone, View<const float> grain,
                  const PaperSurface& surface, const PaperParams& params);

/// Light and shade of the tooth, 1 on a level place; multiplies colours.
float reliefFactor(float slope, const PaperParams& params);

/// One colour with the tooth's light and shade, opaque.
void shadeFlat(const V3f& colour, const float* slope, int count, const PaperParams& params,
               ColourRun& run);

/// Lays light and shade of the tooth over colours, alpha kept.
void shadeRelief(const PaintViews& picture, View<const float> slope, const PaperParams& params);

}  // namespace kagefude
