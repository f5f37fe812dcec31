#include "sequence/frame_thumbnail.h"

#include <algorithm>

#include "base/atomic_file.h"
#include "base/error.h"
#include "exr/read_channels.h"
#include "image/box_reduce.h"
#include "picture/frame_picture.h"
#include "picture/png_file.h"

namespace kagefude {
namespace {

constexpr int64_t longestSide = 320;

Floats reduced(View<const float> plane, int width, int height) {
  Floats small(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const BoxSpan across = boxSpan(x, plane.width, width),
                    down = boxSpan(y, plane.height, height);
      small(x, y) =
          static_cast<float>(boxSum<double>(across, down, plane) / pixelsIn(across, down));
    }
  return small;
}

uint8_t byteOf(float value) {
  if (!(value > 0.0f)) return 0;  // NaN as well
  return value < 1.0f ? static_cast<uint8_t>(value * 255.0f + 0.5f) : 255;
}

/// `show` makes the reduced planes display-ready.
template <class Show>
Thumbnail thumbnailOf(Vec3View picture, const Show& show) {
  Thumbnail thumbnail;
  const int64_t width = picture.width(), height = picture.height();
  const int64_t longest = std::max({width, height, longestSide});
  thumbnail.width = static_cast<int>(std::max<int64_t>(1, width * longestSide / longest));
  thumbnail.height = static_cast<int>(std::max<int64_t>(1, height * longestSide / longest));
  Floats r = reduced(picture.x, thumbnail.width, thumbnail.height);
  Floats g = reduced(picture.y, thumbnail.width, thumbnail.height);
  Floats b = reduced(picture.z, thumbnail.width, thumbnail.height);
  show(r, g, b);
  for (int y = 0; y < thumbnail.height; ++y)
    for (int x = 0; x < thumbnail.width; ++x)
      for (const Floats* plane : {&r, &g, &b}) thumbnail.rgb.push_back(byteOf((*plane)(x, y)));
  return thumbnail;
}

}  // namespace

Thumbnail frameThumbnail(const Look& look, const Colour& colour, Vec3View picture) {
  return thumbnailOf(picture, [&](Floats& r, Floats& g, Floats& b) {
    colour.toDisplay(r, g, b, look.colour.display, look.colour.view);
  });
}

Thumbnail storedThumbnail(const Look& look, const Colour& colour, const std::filesystem::path& path,
                          bool shown) {
  try {
    const std::vector<Floats> planes =
        readFloats(openAnyImage(path), std::vector<std::string>{"R", "G", "B"});
    const Vec3View picture{planes[0], planes[1], planes[2]};
    if (!shown) return frameThumbnail(look, colour, picture);
    return thumbnailOf(picture, [](Floats&, Floats&, Floats&) {});
  } catch (const InputError&) {
    return {};
  }
}

void writeThumbnail(const std::filesystem::path& path, const Thumbnail& thumbnail) {
  PngPicture picture{thumbnail.width, thumbnail.height, 3, 8, {}};
  picture.samples.assign(thumbnail.rgb.begin(), thumbnail.rgb.end());
  const std::vector<unsigned char> bytes = encodePng(picture, {});
  AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

}  // namespace kagefude
