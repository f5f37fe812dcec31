#pragma once

#include <vector>

#include "passes/edges/edge_border.h"
#include "passes/edges/edge_window.h"
#include "passes/strip/strip.h"

namespace kagefude {

/// A border as one of its pixels knows it.
struct BorderSite {
  PixelAt own, other;        ///< the pixels on both sides
  float x = 0, y = 0;        ///< a point of the border, pixels; centres at whole numbers
  float outX = 0, outY = 0;  ///< unit, from the own thing to the other
  bool inFront = false;      ///< whether the own thing is
  float grain = 0;           ///< of the strokes in front, as coarse as the border is moved
  float slope = 0;           ///< its change along the border, (outY, -outX), by a pixel
  float half = 0;    ///< half of the thickness of the thing in front, pixels, as far as it matters
  float behind = 0;  ///< of the one behind
  float melted = 0;  ///< how far the border is lost, 0..1
};

/// **[ours]** What every pixel at a border knows of it. Where the border runs and which way is told
/// to a fraction of a pixel: by what the thing covers of the pixels on both sides, else by its
/// share of a Gaussian window. Everything is evened along the border, so that what is made from it
/// bends as a line does.
class BorderSites {
 public:
  /// squared: distance of each pixel to the nearest of `at`, noSite where it was not asked for; at
  /// the sites, where it is 0, it becomes the number of the site. `in` and `borders` must outlive
  /// this.
  BorderSites(const EdgePaint& in, const EdgeBorders& borders, View<const uint8_t> at,
              View<uint32_t> squared);

  /// As far as sites measure the thickness of things: distances beyond it tell nothing more.
  static float enoughOf(const PaintedEdgeParams& front);

  /// The site of the own thing that is nearest to (x, y), from the index y * width + x of the
  /// nearest of any; null where that has none beside it.
  const BorderSite* find(int x, int y, uint32_t nearest) const;

 private:
  BorderSite siteAt(int x, int y) const;
  void placeBorder(BorderSite& site) const;
  float meanGrain(const PixelAt& at, float rough) const;
  float halfThickness(const BorderSite& site, bool ownSide, float enough) const;
  float lostShare(const BorderSite& site, const PaintedEdgeParams& front) const;
  float meanBrightness(const PixelAt& at) const;
  Rgba shownAt(int x, int y) const;
  BorderSite evened(const BorderSite& site, const std::vector<BorderSite>& raw) const;

  const EdgePaint& in_;
  const EdgeBorders& borders_;
  View<const uint8_t> at_;
  View<uint32_t> squared_;
  EdgeWindow window_;
  std::vector<BorderSite> sites_;
};

}  // namespace kagefude
