#pragma once

#include <filesystem>
#include <string>

namespace kagefude {

/// Where findSidecar gave nothing: that a JSON stands beside the frame and is not kagefude's, as
/// the end of a sentence on what is not known; "" without a JSON.
std::string foreignJson(const std::filesystem::path& imagePath);

}  // namespace kagefude
