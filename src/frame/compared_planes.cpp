#include "frame/compared_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "base/nearest_name.h"
#include "exr/read_channels.h"
#include "frame/aov_resolver.h"

namespace kagefude {
namespace {

/// The channel of that name, or the only channel of the layer of that name.
const Channel& requireChannel(const ImageFile& image, const std::string& name) {
  if (const Channel* channel = image.findChannel(name)) return *channel;
  std::vector<std::string> inLayer;
  const std::vector<std::string> all = image.channelNames();
  for (const std::string& channel : all)
    if (channel.rfind(name + ".", 0) == 0) inLayer.push_back(channel);
  if (inLayer.size() == 1) return *image.findChannel(inLayer.front());
  throw InputError(fmt::format("{} has no channel {} (channels: {}){}", image.path.string(), name,
                               listNames(inLayer.empty() ? all : inLayer), didYouMean(name, all)));
}

const Window& windowOf(const ImageFile& image, const Channel& channel) {
  return image.parts[static_cast<size_t>(channel.part)].dataWindow;
}

/// What both cover; 0 pixels where they do not meet.
Window common(const Window& a, const Window& b) {
  const auto side = [](int firstA, int sizeA, int firstB, int sizeB) {
    const int64_t end = std::min(int64_t{firstA} + sizeA, int64_t{firstB} + sizeB);
    return static_cast<int>(std::max<int64_t>(0, end - std::max(firstA, firstB)));
  };
  return {std::max(a.x, b.x), std::max(a.y, b.y), side(a.x, a.width, b.x, b.width),
          side(a.y, a.height, b.y, b.height)};
}

/// A window's pixels of channels of one file; 0 where a channel's part does not reach.
std::vector<Floats> readWindow(const ImageFile& image, const std::vector<std::string>& channels,
                               const Window& window) {
  const std::vector<Floats> whole = readFloats(image, channels);
  std::vector<Floats> cut;
  const int left = window.x - image.dataWindow.x, top = window.y - image.dataWindow.y;
  for (const Floats& plane : whole) {
    Floats& own = cut.emplace_back(window.width, window.height, 0.0f);
    for (int y = std::max(0, -top); y < std::min(window.height, plane.height() - top); ++y)
      for (int x = std::max(0, -left); x < std::min(window.width, plane.width() - left); ++x)
        own(x, y) = plane(x + left, y + top);
  }
  return cut;
}

/// The Normal pass, or nothing: names that several layers have do not tell.
std::optional<Aov> normals(const ImageFile& image) {
  try {
    return findAov(image, {}, AovKind::normal);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// 1 where an object is; empty where the file has no normals.
Floats objectsIn(const ImageFile& image, const Window& window) {
  const std::optional<Aov> aov = normals(image);
  if (!aov || aov->channels.size() < 3) return {};
  const std::vector<Floats> normal =
      readWindow(image, {aov->channels[0], aov->channels[1], aov->channels[2]}, window);
  Floats objects(window.width, window.height, 0.0f);
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x)
      for (const Floats& component : normal)
        if (component(x, y) != 0.0f) objects(x, y) = 1.0f;
  return objects;
}

void requireSameDisplay(const ImageFile& file, const ImageFile& truth) {
  const Window &a = file.displayWindow, &b = truth.displayWindow;
  if (a.width == b.width && a.height == b.height) return;
  throw InputError(
      fmt::format("{} is a picture of {}x{} pixels, but the truth {} is one of {}x{} pixels",
                  file.path.string(), a.width, a.height, truth.path.string(), b.width, b.height));
}

}  // namespace

ComparedPlanes readCompared(const ImageFile& file, const std::string& channelName,
                            const ImageFile& truthFile, const std::string& truthChannelName,
                            const std::string& whereChannelName) {
  const Channel& channel = requireChannel(file, channelName);
  const Channel& truthChannel = requireChannel(truthFile, truthChannelName);
  requireSameDisplay(file, truthFile);
  const Window &own = windowOf(file, channel), &truths = windowOf(truthFile, truthChannel);
  const Window both = common(own, truths);
  if (both.pixels() == 0)
    throw InputError(fmt::format("{} and {} have no pixel in common: their data windows lie apart",
                                 file.path.string(), truthFile.path.string()));
  ComparedPlanes planes;
  planes.value = std::move(readWindow(file, {channel.name}, both).at(0));
  planes.truth = std::move(readWindow(truthFile, {truthChannel.name}, both).at(0));
  planes.outside = static_cast<size_t>(own.pixels() + truths.pixels() - 2 * both.pixels());
  if (!whereChannelName.empty()) {
    const Channel& where = requireChannel(truthFile, whereChannelName);
    planes.where = std::move(readWindow(truthFile, {where.name}, both).at(0));
    return planes;
  }
  planes.where = objectsIn(truthFile, both);
  if (planes.where.empty()) planes.where = objectsIn(file, both);
  const View<const float> where = planes.where.view();
  if (!where.empty())
    planes.background =
        static_cast<size_t>(std::count(where.data, where.data + where.pixels(), 0.0f));
  return planes;
}

}  // namespace kagefude
