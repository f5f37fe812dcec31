#include "picture/draw_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exr/write_image.h"
#include "picture/draw_text.h"

namespace kagefude {
namespace {

constexpr int plotWidth = 960, panelHeight = 260;
constexpr int leftMargin = 70, rightMargin = 24, topMargin = 56, bottomMargin = 34;
constexpr int textSize = 13;
constexpr float paper = 0.13f;
constexpr V3f gridColour(0.27f), textColour(0.82f);

class Canvas {
 public:
  Canvas(int width, int height)
      : r_(width, height, paper), g_(width, height, paper), b_(width, height, paper) {}

  void blend(int x, int y, const V3f& colour, float share) {
    if (!r_.view().contains(x, y)) return;
    r_(x, y) += (colour.x - r_(x, y)) * share;
    g_(x, y) += (colour.y - g_(x, y)) * share;
    b_(x, y) += (colour.z - b_(x, y)) * share;
  }

  void text(int x, int y, const std::string& words, const V3f& colour) {
    Floats ink(r_.width(), 2 * textSize, 0.0f);
    drawText(ink, x, textSize + 4, textSize, words);
    for (int row = 0; row < ink.height(); ++row)
      for (int column = 0; column < ink.width(); ++column)
        if (ink(column, row) > 0) blend(column, y - textSize - 4 + row, colour, ink(column, row));
  }

  // A line of about 1.6 pixels with soft edges.
  void line(double x0, double y0, double x1, double y1, const V3f& colour) {
    const double dx = x1 - x0, dy = y1 - y0, squared = dx * dx + dy * dy;
    const int left = static_cast<int>(std::min(x0, x1)) - 2,
              right = static_cast<int>(std::max(x0, x1)) + 2;
    const int top = static_cast<int>(std::min(y0, y1)) - 2,
              bottom = static_cast<int>(std::max(y0, y1)) + 2;
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x) {
        const double along =
            squared > 0 ? std::clamp(((x - x0) * dx + (y - y0) * dy) / squared, 0.0, 1.0) : 0.0;
        const double off = std::hypot(x - x0 - along * dx, y - y0 - along * dy);
        blend(x, y, colour, static_cast<float>(std::clamp(1.3 - off, 0.0, 1.0)));
      }
  }

  void write(const std::filesystem::path& path) const { writePng(path, r_, g_, b_); }

 private:
  Floats r_, g_, b_;
};

/// The next of 1, 2, 5 times a power of ten.
double roundUp(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * unit >= value) return step * unit;
  return 10 * unit;
}

class PanelPainter {
 public:
  PanelPainter(Canvas& canvas, const PlotPanel& panel, const std::vector<int>& places, int top)
      : canvas_(canvas), panel_(panel), places_(places), top_(top) {
    double most = 0;
    for (const PlotCurve& curve : panel.curves)
      for (const double value : curve.values)
        if (std::isfinite(value)) most = std::max(most, value);
    most_ = most > 0 ? roundUp(most) : 1;
  }

  void paint() {
    canvas_.text(leftMargin, top_ + 20, panel_.title, textColour);
    paintGrid();
    int x = leftMargin;
    for (const PlotCurve& curve : panel_.curves) {
      canvas_.text(x, top_ + 40, curve.name, curve.colour);
      x += 16 + 8 * static_cast<int>(curve.name.size());
      paintCurve(curve);
    }
  }

 private:
  double x(size_t place) const {
    const double last = std::max<double>(1, static_cast<double>(places_.size()) - 1);
    return leftMargin + static_cast<double>(place) / last * (plotWidth - leftMargin - rightMargin);
  }
  double y(double value) const {
    const double inside = panelHeight - topMargin - bottomMargin;
    return top_ + topMargin + (1 - std::clamp(value / most_, 0.0, 1.0)) * inside;
  }

  void paintGrid() {
    for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const double at = std::round(y(part * most_));
      canvas_.line(leftMargin, at, plotWidth - rightMargin, at, gridColour);
      canvas_.text(8, static_cast<int>(at) + 5, fmt::format("{:g}", part * most_), textColour);
    }
    const size_t every = std::max<size_t>(1, (places_.size() + 23) / 24);
    for (size_t i = 0; i < places_.size(); i += every)
      canvas_.text(static_cast<int>(x(i)) - 6, top_ + panelHeight - 14,
                   fmt::format("{}", places_[i]), textColour);
  }

  void paintCurve(const PlotCurve& curve) {
    for (size_t i = 0; i < curve.values.size(); ++i) {
      if (!std::isfinite(curve.values[i])) continue;
      const bool joined = i > 0 && std::isfinite(curve.values[i - 1]);
      const size_t from = joined ? i - 1 : i;
      canvas_.line(x(from), y(curve.values[from]), x(i), y(curve.values[i]), curve.colour);
    }
  }

  Canvas& canvas_;
  const PlotPanel& panel_;
  const std::vector<int>& places_;
  int top_;
  double most_ = 1;
};

}  // namespace

void writePlot(const std::filesystem::path& path, const std::vector<int>& places,
               const std::vector<PlotPanel>& panels) {
  Canvas canvas(plotWidth, panelHeight * static_cast<int>(panels.size()));
  int top = 0;
  for (const PlotPanel& panel : panels) {
    PanelPainter(canvas, panel, places, top).paint();
    top += panelHeight;
  }
  canvas.write(path);
}

}  // namespace kagefude
