#include "compositor/unknown_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "frame/sanitise.h"

namespace kagefude {
namespace {

const Window& partWindowOf(const ImageFile& image, const std::string& channelName) {
  const Channel* channel = image.findChannel(channelName);
  return image.parts[static_cast<size_t>(channel->part)].dataWindow;
}

std::vector<std::string> channelsOf(const FrameLight& light) {
  std::vector<std::string> names = light.maskChannels;
  if (!light.tracedChannel.empty()) names.push_back(light.tracedChannel);
  return names;
}

Window intersect(const Window& a, const Window& b) {
  const int left = std::max(a.x, b.x), top = std::max(a.y, b.y);
  return {left, top, std::max(0, std::min(a.x + a.width, b.x + b.width) - left),
          std::max(0, std::min(a.y + a.height, b.y + b.height) - top)};
}

template <class Visit>
void visitOutside(const Window& known, int width, int height, const Visit& visit) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (x < known.x || y < known.y || x >= known.x + known.width || y >= known.y + known.height)
        visit(x, y);
}

std::string spellWindow(const Window& w) {
  return fmt::format("{} x {} from ({}, {})", w.width, w.height, w.x, w.y);
}

const char* nameOf(const FrameLight& light) {
  return light.tracedChannel.empty() ? "masks" : "traced visibility";
}

std::string doubtNumbers(const FrameLight& light, const LightPlanes& own) {
  const size_t count = std::accumulate(own.unknown.begin(), own.unknown.end(), size_t{0});
  if (count == 0) return "";
  const size_t planes = own.unknown.size();
  return fmt::format(
      "NaN or Inf in the {} of light {} is taken as lit ({} value{} of {}); render "
      "them again",
      nameOf(light), light.name, count, count == 1 ? "" : "s",
      planes == 1 ? "one plane" : fmt::format("{} planes", planes));
}

std::string doubtWindow(const FramePlan& plan, const FramePlanes& planes, const FrameLight& light,
                        const Window& known) {
  size_t outside = 0;
  visitOutside(known, planes.width, planes.height,
               [&](int x, int y) { outside += planes.objectId(x, y) != 0; });
  if (outside == 0) return "";
  const Window& whole = plan.image.dataWindow;
  return fmt::format(
      "the {} of light {} cover {} of the frame's {} pixels only, so {} pixels of "
      "surfaces beyond are taken as lit; render them for the whole frame",
      nameOf(light), light.name,
      spellWindow({known.x + whole.x, known.y + whole.y, known.width, known.height}),
      spellWindow(whole), outside);
}

}  // namespace

Window maskedWindow(const FramePlan& plan, const FrameLight& light) {
  Window known = plan.image.dataWindow;
  for (const std::string& name : channelsOf(light))
    known = intersect(known, partWindowOf(plan.image, name));
  known.x -= plan.image.dataWindow.x;
  known.y -= plan.image.dataWindow.y;
  return known;
}

std::vector<std::string> takeUnknownAsLit(const FramePlan& plan, FramePlanes& planes) {
  std::vector<std::string> doubts;
  for (size_t i = 0; i < plan.lights.size(); ++i) {
    const FrameLight& light = plan.lights[i];
    LightPlanes& own = planes.lights[i];
    if (!own.traced.empty()) own.unknown = {clearNonFinite(own.traced.view(), 1.0f)};
    if (std::string doubt = doubtNumbers(light, own); !doubt.empty())
      doubts.push_back(std::move(doubt));
    const Window known = maskedWindow(plan, light);
    if (known == Window{0, 0, planes.width, planes.height}) continue;
    if (!own.traced.empty())
      visitOutside(known, planes.width, planes.height,
                   [&](int x, int y) { own.traced(x, y) = 1.0f; });
    if (std::string doubt = doubtWindow(plan, planes, light, known); !doubt.empty())
      doubts.push_back(std::move(doubt));
  }
  return doubts;
}

}  // namespace kagefude
