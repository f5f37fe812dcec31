#include "live/show_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "base/error.h"
#include "base/nearest_name.h"
#include "colour/display_bytes.h"
#include "compositor/stage_colours.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

char byteOf(float value) {
  // NaN is black.
  return static_cast<char>(
      static_cast<unsigned char>(value > 0.0f ? std::min(value, 1.0f) * 255.0f + 0.5f : 0.0f));
}

ShownPixels sized(int width, int height) {
  ShownPixels shown{width, height, {}};
  shown.bytes.resize(size_t{4} * static_cast<size_t>(width) * static_cast<size_t>(height));
  return shown;
}

/// `colour(x, y)` is what the display shows.
template <class PixelColour>
ShownPixels drawn(int width, int height, const PixelColour& colour) {
  ShownPixels shown = sized(width, height);
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      char* out =
          shown.bytes.data() + size_t{4} * static_cast<size_t>(y) * static_cast<size_t>(width);
      for (int x = 0; x < width; ++x, out += 4) {
        const V3f c = colour(x, y);
        for (int k = 0; k < 3; ++k) out[k] = byteOf(c[k]);
        out[3] = static_cast<char>(255);
      }
    }
  });
  return shown;
}

ShownPixels grey(View<const float> plane) {
  return drawn(plane.width, plane.height, [&](int x, int y) { return V3f(plane(x, y)); });
}

ShownPixels labels(View<const uint32_t> plane) {
  return drawn(plane.width, plane.height, [&](int x, int y) { return labelColour(plane(x, y)); });
}

struct NamedStage {
  std::string name;
  std::function<ShownPixels()> show;
};

/// All stages, each drawn when it is asked for.
std::vector<NamedStage> stagesOf(const LivePicture& picture, const Viewing& viewing) {
  const StagedFrame& frame = picture.stages;
  const FramePlanes& planes = *frame.planes;
  std::vector<NamedStage> stages;
  const auto colour = [&](const char* name, Vec3View view) {
    if (!view.empty())
      stages.push_back({name, [&, view] { return showColours(picture, view, viewing); }});
  };
  const auto number = [&](std::string name, View<const float> view) {
    if (!view.empty()) stages.push_back({std::move(name), [view] { return grey(view); }});
  };
  colour("beauty", planes.beauty);
  colour("albedo", planes.albedo);
  stages.push_back({"normals", [&] {
                      return drawn(planes.width, planes.height, [&](int x, int y) {
                        return directionColour(planes.normal.view()(x, y));
                      });
                    }});
  stages.push_back({"objects", [&] { return labels(planes.objectId); }});
  stages.push_back({"surfaces", [&] { return labels(frame.surfaces->labels); }});
  for (const LightStagesMade& light : frame.lights) {
    number("shadow." + light.name, light.shadow->visibility);
    number("visibility." + light.name, *light.visibility);
    number("tone." + light.name, *light.tone);
  }
  number("brush.tone", *frame.tone);
  number("outline", frame.picture->outline);
  colour("result", frame.picture->frame.colour);
  return stages;
}

}  // namespace

ShownPixels showColours(const LivePicture& picture, const Vec3View& colour,
                        const Viewing& viewing) {
  const ColourParams& spaces = picture.look->colour;
  const bool own = !viewing.display.empty();
  ShownPixels shown = sized(colour.width(), colour.height());
  displayBytes(*picture.colour, colour.x, colour.y, colour.z, viewing.exposure,
               own ? viewing.display : spaces.display, own ? viewing.view : spaces.view,
               shown.bytes.data());
  return shown;
}

ShownPixels showPainted(View<const float> red, View<const float> green, View<const float> blue) {
  return drawn(red.width, red.height,
               [&](int x, int y) { return V3f(red(x, y), green(x, y), blue(x, y)); });
}

std::vector<std::string> stageNames(const LivePicture& picture) {
  std::vector<std::string> names;
  for (const NamedStage& stage : stagesOf(picture, {})) names.push_back(stage.name);
  return names;
}

ShownPixels showStage(const LivePicture& picture, const std::string& stage,
                      const Viewing& viewing) {
  std::vector<std::string> names;
  for (const NamedStage& own : stagesOf(picture, viewing)) {
    if (own.name == stage) return own.show();
    names.push_back(own.name);
  }
  throw InputError(fmt::format("the picture has no stage {}{}; there are {}", stage,
                               didYouMean(stage, names), listNames(names)));
}

}  // namespace kagefude
