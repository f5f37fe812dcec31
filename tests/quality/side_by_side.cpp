#include "side_by_side.h"

#include <OpenImageIO/imagebuf.h>

#include <cmath>

#include "base/error.h"
#include "picture/draw_text.h"

namespace kagefude {
namespace {

constexpr int zoom = 2, bar = 26, gap = 4, textSize = 18;
constexpr float strength = 16;

struct Colour {
  float r, g, b;
};

Colour shadowColour(float share, bool background) {
  if (background) return {0.32f, 0.40f, 0.52f};
  return {1 - share, 1 - share, 1 - share};
}

Colour differenceColour(float error, bool judged) {
  if (!judged) return {0.8f, 0.8f, 0.8f};
  const float rest = 1 - std::min(1.0f, strength * error);
  return {1, rest, rest};
}

}  // namespace

void writeSideBySide(const std::string& path, const std::string& method, View<const float> ours,
                     View<const float> truth, View<const uint8_t> leftOut) {
  const int tile = zoom * ours.width + gap, height = zoom * ours.height + bar;
  Floats text(3 * tile - gap, height, 0.0f);
  const std::string titles[] = {method, "Cycles, 64 samples", "difference x 16"};
  for (int i = 0; i < 3; ++i) drawText(text, i * tile + 4, textSize, textSize, titles[i]);
  OIIO::ImageBuf image(OIIO::ImageSpec(text.width(), height, 3, OIIO::TypeFloat));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < text.width(); ++x) {
      const int column = x % tile / zoom, row = (y - bar) / zoom;
      Colour colour{text(x, y), text(x, y), text(x, y)};
      if (y >= bar && column < ours.width) {
        const bool background = truth(column, row) < 0;
        const float share = ours(column, row), expected = truth(column, row);
        const bool judged = !background && leftOut(column, row) == 0;
        colour = x < tile       ? shadowColour(share, background)
                 : x < 2 * tile ? shadowColour(expected, background)
                                : differenceColour(std::fabs(share - expected), judged);
      }
      image.setpixel(x, y, &colour.r);
    }
  if (!image.write(path, OIIO::TypeUInt8)) throw InputError(image.geterror());
}

}  // namespace kagefude
