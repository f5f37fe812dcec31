#include "passes/ground/fitted_picture.h"

#include <algorithm>

#include "image/parallel.h"
#include "passes/brush/brush_params.h"

namespace kagefude {

ColourPlanes fitPicture(const Strip& picture, const SkyView& view) {
  const auto width = static_cast<float>(picture.width()),
             height = static_cast<float>(picture.height());
  const auto shownWidth = static_cast<float>(std::max(view.displayWidth, 1)),
             shownHeight = static_cast<float>(std::max(view.displayHeight, 1));
  const float scale = std::max(shownWidth / width, shownHeight / height);
  const float stepU = 1.0f / (scale * width), stepV = 1.0f / (scale * height);
  ColourPlanes out{Floats(view.width, view.height), Floats(view.width, view.height),
                   Floats(view.width, view.height), Floats(view.width, view.height)};
  // A lookup beyond the last column's centre would mix in the first: pictures do not go round.
  const float edge = 0.5f / width;
  parallelRows(view.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < view.width; ++x) {
        const float fromMiddleX = static_cast<float>(x + view.offsetX) + 0.5f - 0.5f * shownWidth;
        const float fromMiddleY = static_cast<float>(y + view.offsetY) + 0.5f - 0.5f * shownHeight;
        const float u = std::clamp(0.5f + fromMiddleX * stepU, edge, 1.0f - edge);
        const float v = std::clamp(0.5f - fromMiddleY * stepV, 0.0f, 1.0f);
        const Rgba colour =
            stripFiltered(picture, u, v, {stepU, 0, 0, stepV}, BrushParams{}.maxProbes);
        out.r(x, y) = colour[0];
        out.g(x, y) = colour[1];
        out.b(x, y) = colour[2];
        out.a(x, y) = picture.opaque ? 1.0f : colour[3];
      }
  });
  return out;
}

}  // namespace kagefude
