#pragma once

#include <set>
#include <string>
#include <vector>

#include "sequence/report_page.h"

namespace kagefude {

/// Everything about one view, worked out once for all parts of the page.
struct StripView {
  const ReportStrip& strip;
  size_t number;
  std::vector<double> mean;
  std::vector<double> largest;
  std::set<size_t> pops;

  StripView(const ReportStrip& of, size_t index);
  const ReportFrame& frame(size_t i) const { return strip.entries[i]->frame; }
};

/// "12", or "12 left".
std::string frameName(const ReportFrame& frame);

/// The id of a frame's row; a view's place among the views stands for its name.
std::string anchor(size_t strip, const ReportFrame& frame);

/// Change from frame to frame as inline SVG: mean and largest block, jumps and failures marked.
std::string changePlot(const StripView& view);

/// Seconds per frame as stacked bars.
std::string timePlot(const StripView& view);

}  // namespace kagefude
