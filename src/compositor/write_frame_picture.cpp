#include "compositor/write_frame_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "compositor/scale_down.h"
#include "exr/write_image.h"
#include "image/parallel.h"
#include "look/look.h"
#include "picture/picture_file.h"
#include "picture/png_file.h"
#include "picture/write_picture.h"

namespace kagefude {
namespace {

/// The part of a plane of `data`'s pixels that `display` shows, 0 where it has none.
Floats shown(const Floats& plane, const Window& data, const Window& display) {
  if (data == display) return plane.clone();
  Floats result(display.width, display.height, 0.0f);
  const int left = std::max(data.x, display.x);
  const int right = std::min(data.x + data.width, display.x + display.width);
  parallelRows(display.height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      const int row = y + display.y - data.y;
      if (row < 0 || row >= data.height || right <= left) continue;
      const float* const from = plane.row(row) + (left - data.x);
      std::copy(from, from + (right - left), result.row(y) + (left - display.x));
    }
  });
  return result;
}

/// Multiplies or divides colours by alpha; where that is 0 they stay.
template <class Step>
void byAlpha(Floats& colour, const Floats& alpha, const Step& step) {
  parallelRows(colour.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < colour.width(); ++x)
        if (alpha(x, y) > 0.0f) colour(x, y) = step(colour(x, y), alpha(x, y));
  });
}

struct ShownPlanes {
  Floats red, green, blue, alpha;  ///< alpha is empty for an output without

  std::array<Floats*, 3> colours() { return {&red, &green, &blue}; }
};

ShownPlanes shownPlanes(const Look& look, const Colour& colour, const FrameResult& result,
                        const Window& data, const Window& display, const PictureOutput& output) {
  ShownPlanes planes{shown(result.colour.x, data, display), shown(result.colour.y, data, display),
                     shown(result.colour.z, data, display), Floats()};
  if (output.alpha != FormatAlpha::none) planes.alpha = shown(result.alpha, data, display);
  if (!isDisplayReferred(output.depth)) return planes;
  if (output.alpha != FormatAlpha::none)
    for (Floats* plane : planes.colours())
      byAlpha(*plane, planes.alpha, [](float c, float a) { return c / a; });
  colour.toDisplay(planes.red, planes.green, planes.blue, look.colour.display, look.colour.view);
  if (output.alpha == FormatAlpha::associated)
    for (Floats* plane : planes.colours())
      byAlpha(*plane, planes.alpha, [](float c, float a) { return c * a; });
  return planes;
}

std::string softwareText(const std::string& fingerprint) {
  return fmt::format("kagefude {} (fingerprint {})", KAGEFUDE_VERSION, fingerprint);
}

SampleType sampleTypeOf(SampleDepth depth) {
  if (depth == SampleDepth::single) return SampleType::single;
  if (depth == SampleDepth::half) return SampleType::half;
  return depth == SampleDepth::uint8 ? SampleType::uint8 : SampleType::uint16;
}

int bitsOf(SampleDepth depth) {
  int bits = 0;
  for (int most = mostOf(depth); most > 0; most >>= 1) ++bits;
  return bits;
}

/// What a display's space is to programs that know of sRGB alone.
std::string spaceTag(const Look& look, const Colour& colour, SampleDepth depth) {
  if (!isDisplayReferred(depth)) return "Linear";
  const std::string space = colour.displaySpace(look.colour.display, look.colour.view);
  return space.find("sRGB") == std::string::npos ? "" : "sRGB";
}

PictureHeader headerFor(const Look& look, const Colour& colour, const Window& window,
                        const PictureOutput& output, const std::string& fingerprint) {
  PictureHeader header;
  header.format = output.format->name;
  header.dataWindow = header.displayWindow = {0, 0, window.width, window.height};
  const SampleType type = sampleTypeOf(output.depth);
  for (const char* name : {"R", "G", "B"}) header.channels.push_back({name, type});
  if (output.alpha != FormatAlpha::none) {
    header.alpha = 3;
    header.channels.push_back({"A", type});
  }
  header.unassociated = output.alpha == FormatAlpha::straight;
  header.colourSpace = spaceTag(look, colour, output.depth);
  const auto number = [&](const char* name, int value) {
    header.attributes.push_back({name, "int", "", {double(value)}});
  };
  if (isDisplayReferred(output.depth)) number("oiio:BitsPerSample", bitsOf(output.depth));
  number("CompressionQuality", look.output.quality);
  header.attributes.push_back({"Software", "string", softwareText(fingerprint), {}});
  if (output.format->name == "png")
    header.attributes.push_back({kFingerprintAttribute, "string", fingerprint, {}});
  return header;
}

bool isHandWritten(const PictureOutput& output) {
  return output.format->name == "png" && output.alpha == FormatAlpha::none;
}

void refuseSize(const std::filesystem::path& path, const Window& display, int longestSide) {
  if (display.width <= longestSide && display.height <= longestSide &&
      display.pixels() <= int64_t{1} << 30)
    return;
  throw OutputError(fmt::format(
      "{} cannot be written: the display window is {} x {} pixels, and such a file holds at most "
      "{} a side",
      path.string(), display.width, display.height, longestSide));
}

}  // namespace

void writeFramePicture(const Look& look, const Colour& colour, const FramePlan& plan,
                       const FrameResult& result, const std::filesystem::path& path,
                       const PictureOutput& output, const std::string& fingerprint) {
  const Window data = Downscale(plan.image.dataWindow, look.output.scale).window();
  const Window display = Downscale(plan.image.displayWindow, look.output.scale).window();
  refuseSize(path, display, output.format->longestSide);
  const ShownPlanes planes = shownPlanes(look, colour, result, data, display, output);
  if (isHandWritten(output))
    return writePng(path, planes.red, planes.green, planes.blue, {},
                    output.depth == SampleDepth::uint16 ? 16 : 8,
                    {{kFingerprintAttribute, fingerprint}});
  std::vector<View<const float>> views = {planes.red, planes.green, planes.blue};
  if (!planes.alpha.empty()) views.push_back(planes.alpha);
  const Part& leading = plan.image.parts[static_cast<size_t>(plan.image.ownParts.front())];
  const MetadataSource metadata{leading.file, leading.place};
  writePicture(path, headerFor(look, colour, display, output, fingerprint), views, &metadata);
}

std::string pictureFingerprint(const std::filesystem::path& path, const PictureFormat& format) {
  if (format.name == "png") return readPngText(path, kFingerprintAttribute).value_or("");
  PictureFile file(path);
  const PictureHeader& header = file.header();
  // Others that were cut are refused when they are opened.
  if (format.name == "webp") {
    Floats red(header.dataWindow.width, header.dataWindow.height);
    const PicturePlane plane{0, red, {}, {}};
    file.read({&plane, 1});
  }
  const std::string software = header.text("Software");
  constexpr size_t digits = 32;
  if (software.size() < digits + 1) return "";
  const std::string fingerprint = software.substr(software.size() - digits - 1, digits);
  return software == softwareText(fingerprint) ? fingerprint : "";
}

size_t pictureMemory(const PictureOutput& output) {
  constexpr size_t byHand = 24;  // three float planes, samples and their packed bytes
  if (isHandWritten(output)) return byHand;
  // Planes, what the worker is given, its samples and what its codec makes of them.
  constexpr size_t perChannel = 4 + 4 + 4 + 4;
  return perChannel * (output.alpha == FormatAlpha::none ? 3 : 4);
}

}  // namespace kagefude
