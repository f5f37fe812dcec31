#pragma once

#include <filesystem>

namespace kagefude {

/// Draws a frame as a renderer would export it and writes it with its JSON: 20 spheres on a floor
/// under a round light, with Position, Normal, IndexOB, Combined and nine hard masks, 20 float
/// channels, zip. For timing a machine where no rendered frame is at hand.
///
/// width, height: pixels, each 16 to 32767. The picture depends on the size alone. Throws
/// OutputError when it cannot be written. Cost: ten rays a pixel.
void writeSampleFrame(const std::filesystem::path& exr, int width, int height);

}  // namespace kagefude
