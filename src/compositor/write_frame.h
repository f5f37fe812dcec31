#pragma once

#include <filesystem>
#include <map>

#include "compositor/frame_plan.h"
#include "compositor/frame_result.h"

namespace kagefude {

/// Writes a composited frame as EXR, with windows and metadata of its input, `attributes` in the
/// header, and every other input channel when the look passes them through. Whole or not at all.
void writeFrame(const Look& look, const FramePlan& plan, const FrameResult& result,
                const std::filesystem::path& path,
                const std::map<std::string, std::string>& attributes);

}  // namespace kagefude
