#include "frame/draw_text.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include <filesystem>

#include "base/error.h"

namespace kagefude {
namespace {

// OIIO's own search finds no font on a plain Debian.
constexpr const char* fontFiles[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
};

std::string findFont() {
  for (const char* file : fontFiles)
    if (std::filesystem::exists(file)) return file;
  throw InputError(fmt::format("no font to write labels with: expected {} (Debian package "
                               "fonts-dejavu-core)",
                               fontFiles[0]));
}

}  // namespace

void drawText(View<float> picture, int x, int y, int size, const std::string& text) {
  static const std::string font = findFont();
  const OIIO::ImageSpec spec(picture.width, picture.height, 1, OIIO::TypeFloat);
  OIIO::ImageBuf canvas(spec, picture.data);
  const float white[] = {1.0f};
  if (!OIIO::ImageBufAlgo::render_text(canvas, x, y, text, size, font, white))
    throw InputError(fmt::format("cannot write the label {}: {}", text, canvas.geterror()));
}

}  // namespace kagefude
