#pragma once

#include <filesystem>
#include <string>

#include "colour/colour.h"
#include "compositor/frame_plan.h"
#include "compositor/frame_result.h"
#include "picture/picture_format.h"

namespace kagefude {

/// The header's attribute that holds the fingerprint of what made an output
/// (sequence/fingerprint.h), in EXRs and PNGs; other formats have it in Software.
inline constexpr const char* kFingerprintAttribute = "kagefude/fingerprint";

/// How a frame is written where that is no EXR.
struct PictureOutput {
  const PictureFormat* format = nullptr;
  SampleDepth depth = SampleDepth::uint8;
  FormatAlpha alpha = FormatAlpha::none;  ///< the format's, or none for a preview
};

/// Writes a composited frame as a picture for people and other programs: what the display window
/// shows (overscan is cut, what the frame lacks is empty), through the look's display and view when
/// the samples are integers, scene-linear when they are floats. The view works on colours by
/// themselves, which are multiplied by alpha afterwards where the format wants that; without alpha
/// the frame stands on black. PNGs without alpha are written here, all others by OpenImageIO's
/// worker with what it keeps of the input's metadata. Whole or not at all; throws OutputError.
void writeFramePicture(const Look& look, const Colour& colour, const FramePlan& plan,
                       const FrameResult& result, const std::filesystem::path& path,
                       const PictureOutput& output, const std::string& fingerprint);

/// The fingerprint that a whole picture of writeFramePicture holds, "" when it holds none. Throws
/// InputError when it cannot be read.
std::string pictureFingerprint(const std::filesystem::path& path, const PictureFormat& format);

/// Bytes a pixel of the display window that writeFramePicture takes, the worker's included.
size_t pictureMemory(const PictureOutput& output);

}  // namespace kagefude
