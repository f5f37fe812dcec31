#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "colour/colour.h"
#include "compositor/stage_sink.h"
#include "look/sections.h"

namespace kagefude {

/// Collects every intermediate picture of a frame as a small labelled tile, and writes them as one
/// PNG: pictures through the display's view, numbers as grey from 0 to 1, labels in distinct
/// colours, classes as black, amber and white. Tiles keep the frame's proportions.
class ContactSheet : public StageSink {
 public:
  /// `tileWidth` in pixels; frames narrower than that are not enlarged.
  explicit ContactSheet(int tileWidth = 480) : tileWidth_(tileWidth) {}

  /// The configuration, and the display and view, through which pictures are shown from now on;
  /// both must live as long as pictures come.
  void showThrough(const Colour& colour, const ColourParams& spaces) {
    colour_ = &colour;
    spaces_ = &spaces;
  }

  void number(const std::string& title, View<const float> plane) override;
  void mask(const std::string& title, View<const uint8_t> plane) override;
  void labels(const std::string& title, View<const uint32_t> plane) override;
  void classes(const std::string& title, View<const uint8_t> plane) override;
  void directions(const std::string& title, Vec3View plane) override;
  void picture(const std::string& title, Vec3View plane) override;

  /// Writes the tiles so far, in the order in which they came. Throws OutputError.
  void write(const std::filesystem::path& path) const;

 private:
  struct Tile {
    std::string title;
    Floats r, g, b;
  };
  using Pixel = std::function<V3f(int x, int y)>;
  void add(const std::string& title, int width, int height, const Pixel& pixel, bool average);

  const Colour* colour_ = nullptr;
  const ColourParams* spaces_ = nullptr;
  int tileWidth_;
  std::vector<Tile> tiles_;
};

}  // namespace kagefude
