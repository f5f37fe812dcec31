#include "compositor/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "compositor/stage_colours.h"
#include "exr/write_image.h"
#include "image/box_reduce.h"
#include "image/parallel.h"
#include "picture/draw_text.h"

namespace kagefude {
namespace {

constexpr int captionHeight = 22;
constexpr int captionSize = 14;
constexpr int gap = 8;
constexpr float paper = 0.13f;

void blit(const Floats& tile, View<float> sheet, int left, int top) {
  for (int y = 0; y < tile.height(); ++y)
    std::copy_n(tile.row(y), tile.width(), sheet.row(top + y) + left);
}

}  // namespace

void ContactSheet::add(const std::string& title, int width, int height, const Pixel& pixel,
                       bool average) {
  const int across = std::min(tileWidth_, width);
  const int down = std::max(1, static_cast<int>(static_cast<int64_t>(height) * across / width));
  Tile tile{title, Floats(across, down), Floats(across, down), Floats(across, down)};
  parallelRows(down, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < across; ++x) {
        BoxSpan overX = boxSpan(x, width, across), overY = boxSpan(y, height, down);
        if (!average) overX.end = overX.first + 1, overY.end = overY.first + 1;
        V3f sum = boxSum<V3f>(overX, overY, pixel);
        sum /= static_cast<float>(pixelsIn(overX, overY));
        tile.r(x, y) = sum.x;
        tile.g(x, y) = sum.y;
        tile.b(x, y) = sum.z;
      }
  });
  tiles_.push_back(std::move(tile));
}

void ContactSheet::number(const std::string& title, View<const float> plane) {
  add(
      title, plane.width, plane.height,
      [&](int x, int y) { return V3f(std::clamp(plane(x, y), 0.0f, 1.0f)); }, true);
}

void ContactSheet::mask(const std::string& title, View<const uint8_t> plane) {
  add(
      title, plane.width, plane.height,
      [&](int x, int y) { return V3f(plane(x, y) ? 1.0f : 0.0f); }, true);
}

void ContactSheet::labels(const std::string& title, View<const uint32_t> plane) {
  add(
      title, plane.width, plane.height, [&](int x, int y) { return labelColour(plane(x, y)); },
      false);
}

void ContactSheet::classes(const std::string& title, View<const uint8_t> plane) {
  add(
      title, plane.width, plane.height,
      [&](int x, int y) { return classColour(static_cast<ShadowClass>(plane(x, y))); }, false);
}

void ContactSheet::directions(const std::string& title, Vec3View plane) {
  add(
      title, plane.width(), plane.height(),
      [&](int x, int y) { return directionColour(plane(x, y)); }, true);
}

void ContactSheet::picture(const std::string& title, Vec3View plane) {
  add(
      title, plane.width(), plane.height(), [&](int x, int y) { return plane(x, y); }, true);
  Tile& tile = tiles_.back();
  if (colour_) colour_->toDisplay(tile.r, tile.g, tile.b, spaces_->display, spaces_->view);
}

void ContactSheet::write(const std::filesystem::path& path) const {
  const int count = static_cast<int>(tiles_.size());
  const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(count))));
  const int rows = (count + columns - 1) / columns;
  int width = 1, height = 1;
  for (const Tile& tile : tiles_) {
    width = std::max(width, tile.r.width());
    height = std::max(height, tile.r.height());
  }
  const int cellWidth = width + gap, cellHeight = height + captionHeight + gap;
  const int sheetWidth = columns * cellWidth + gap, sheetHeight = rows * cellHeight + gap;
  Floats r(sheetWidth, sheetHeight, paper), g(sheetWidth, sheetHeight, paper),
      b(sheetWidth, sheetHeight, paper), text(sheetWidth, sheetHeight, 0.0f);
  for (int i = 0; i < count; ++i) {
    const int left = gap + i % columns * cellWidth, top = gap + i / columns * cellHeight;
    drawText(text, left, top + captionSize, captionSize, tiles_[static_cast<size_t>(i)].title);
    blit(tiles_[static_cast<size_t>(i)].r, r, left, top + captionHeight);
    blit(tiles_[static_cast<size_t>(i)].g, g, left, top + captionHeight);
    blit(tiles_[static_cast<size_t>(i)].b, b, left, top + captionHeight);
  }
  for (View<float> plane : {r.view(), g.view(), b.view()})
    for (size_t i = 0; i < plane.pixels(); ++i)
      plane.data[i] += (0.92f - plane.data[i]) * std::min(text.row(0)[i], 1.0f);
  writePng(path, r, g, b);
}

}  // namespace kagefude
