#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "image/vec.h"

namespace kagefude {

struct PlotCurve {
  std::string name;
  V3f colour;                  ///< display-encoded, 0..1
  std::vector<double> values;  ///< one for each place; NaN breaks the line
};

/// One coordinate system with its curves; values from 0 up.
struct PlotPanel {
  std::string title;
  std::vector<PlotCurve> curves;
};

/// Draws panels below each other over the same places (frame numbers along the lower edge), on dark
/// paper, and writes them as PNG. Values below 0 lie on the lower edge. Throws InputError when no
/// font is installed, OutputError when the picture cannot be written.
void writePlot(const std::filesystem::path& path, const std::vector<int>& places,
               const std::vector<PlotPanel>& panels);

}  // namespace kagefude
