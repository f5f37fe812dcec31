#include "sequence/report_plot.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/printable.h"

namespace kagefude {
namespace {

constexpr double kWidth = 1132;
constexpr double kLeft = 44;
constexpr double kRight = 12;
constexpr double kTop = 14;
constexpr double kBottom = 24;

double roundUp(double value) {
  double unit = 1;
  while (unit * 10 <= value) unit *= 10;
  while (unit > value) unit /= 10;
  for (const double step : {1.0, 2.0, 5.0})
    if (step * unit >= value) return step * unit;
  return 10 * unit;
}

/// A plot's frame: maps positions and values to the picture and draws the scale.
class Axes {
 public:
  Axes(const ReportStrip& strip, double height, double most)
      : strip_(strip), height_(height), most_(roundUp(std::max(most, 0.01))) {}

  double x(double position) const {
    const double count = static_cast<double>(std::max<size_t>(strip_.entries.size(), 1));
    return kLeft + (position + 0.5) / count * (kWidth - kLeft - kRight);
  }
  double y(double value) const {
    return height_ - kBottom - value / most_ * (height_ - kTop - kBottom);
  }
  double step() const { return x(1) - x(0); }

  std::string open(const std::string& label) const {
    std::string svg = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n",
                                  kWidth, height_, escapeHtml(label));
    for (const double part : {0.0, 0.5, 1.0}) {
      const double at = y(part * most_);
      svg += fmt::format(
          "<line class=\"grid\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>"
          "<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:g}</text>\n",
          kLeft, kWidth - kRight, at, at, kLeft - 8, at + 4, part * most_);
    }
    const size_t every = std::max<size_t>(1, (strip_.entries.size() + 23) / 24);
    for (size_t i = 0; i < strip_.entries.size(); i += every)
      svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                         x(static_cast<double>(i)), height_ - 6, strip_.entries[i]->frame.frame);
    return svg;
  }

 private:
  const ReportStrip& strip_;
  double height_;
  double most_;
};

/// A line through the known values, broken where one is not.
std::string curve(const Axes& axes, const std::vector<double>& values, const char* color) {
  std::string path;
  bool down = false;
  for (size_t i = 0; i < values.size(); ++i) {
    if (values[i] >= 0)
      path += fmt::format("{}{:.1f} {:.1f} ", down ? 'L' : 'M', axes.x(static_cast<double>(i)),
                          axes.y(values[i]));
    down = values[i] >= 0;
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"var({})\" stroke-width=\"1.8\"/>\n",
                     path, color);
}

}  // namespace

StripView::StripView(const ReportStrip& of, size_t index) : strip(of), number(index) {
  for (const FrameChange& change : of.changes) {
    mean.push_back(change.mean);
    largest.push_back(change.largest);
  }
  for (const auto& values : {mean, largest})
    for (const size_t at : findPops(values)) pops.insert(at);
}

std::string frameName(const ReportFrame& frame) {
  return frame.view.empty() ? fmt::format("{}", frame.frame)
                            : fmt::format("{} {}", frame.frame, frame.view);
}

std::string anchor(size_t strip, const ReportFrame& frame) {
  return fmt::format("f{}_{}", strip, frame.frame);
}

std::string changePlot(const StripView& view) {
  double most = 1;
  for (const double value : view.largest) most = std::max(most, value);
  const Axes axes(view.strip, 220, most);
  std::string svg = axes.open("change from the frame before");
  svg += curve(axes, view.largest, "--block") + curve(axes, view.mean, "--accent");
  for (size_t i = 0; i < view.mean.size(); ++i) {
    if (!view.frame(i).failure.empty())
      svg += fmt::format(
          "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"var(--bad)\" stroke-dasharray=\"3 4\">"
          "<title>frame {3} failed</title></path>\n",
          axes.x(static_cast<double>(i)), axes.y(0), kTop, escapeHtml(frameName(view.frame(i))));
    if (view.largest[i] < 0) continue;
    const bool pop = view.pops.contains(i);
    svg += fmt::format(
        "<a href=\"#{}\"><circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" "
        "fill=\"var({})\"><title>frame "
        "{}: {:.2f} mean, {:.1f} largest block</title></circle></a>\n",
        anchor(view.number, view.frame(i)), axes.x(static_cast<double>(i)), axes.y(view.largest[i]),
        pop ? 5.5 : 2.5, pop ? "--bad" : "--block", escapeHtml(frameName(view.frame(i))),
        view.mean[i], view.largest[i]);
  }
  return svg + "</svg>\n";
}

std::string timePlot(const StripView& view) {
  double most = 0;
  for (const ReportEntry* entry : view.strip.entries)
    most = std::max(
        most, entry->frame.readSeconds + entry->frame.computeSeconds + entry->frame.writeSeconds);
  const Axes axes(view.strip, 150, most);
  std::string svg = axes.open("seconds per frame");
  const double width = std::max(0.5, std::min(axes.step() * 0.7, 26.0));
  for (size_t i = 0; i < view.strip.entries.size(); ++i) {
    const ReportFrame& frame = view.frame(i);
    double base = 0;
    for (const auto& [seconds, color] : {std::pair{frame.readSeconds, "#5f7d95"},
                                         {frame.computeSeconds, "#7fb2d9"},
                                         {frame.writeSeconds, "#b9d3e6"}}) {
      svg += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>",
          axes.x(static_cast<double>(i)) - width / 2, axes.y(base + seconds), width,
          axes.y(base) - axes.y(base + seconds), color);
      base += seconds;
    }
    svg += '\n';
  }
  return svg + "</svg>\n";
}

std::string escapeHtml(std::string_view text) {
  std::string result;
  for (const char c : printableLines(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 32 || c == '\n' || c == '\t') result += c;
    }
  }
  return result;
}

}  // namespace kagefude
