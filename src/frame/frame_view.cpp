#include "frame/frame_view.h"

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiView.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/place_error.h"
#include "frame/aov_names.h"
#include "picture/frame_picture.h"

namespace kagefude {
namespace {

using namespace detail;
using Names = std::vector<std::string>;

bool has(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void addNew(Names& names, const std::string& name) {
  if (!name.empty() && !has(names, name)) names.push_back(name);
}

Names partsOf(std::string_view name) {
  Names parts;
  for (size_t dot = 0; dot != std::string_view::npos;) {
    dot = name.find('.');
    parts.emplace_back(name.substr(0, dot));
    name.remove_prefix(dot == std::string_view::npos ? name.size() : dot + 1);
  }
  return parts;
}

// left and right stand in many names; without a header that lists them they are views only behind
// the name of a pass that we know.
bool isViewOfKnownPass(std::string_view channel, const std::string& view) {
  Names parts = partsOf(channel);
  if (!parts.empty() && componentOrder(parts.back()) >= 0) parts.pop_back();
  return parts.size() > 1 && parts.back() == view && isKnownPass(parts[parts.size() - 2]);
}

// The view of a channel: its part's, or the one in its name.
ViewedName viewedName(const ImageFile& file, const Channel& channel, const Names& views) {
  ViewedName result = cutView(channel.name, views);
  const std::string& view = file.parts[static_cast<size_t>(channel.part)].view;
  if (result.view.empty()) result.view = view;
  return result;
}

[[noreturn]] void reportView(const ImageFile& file, const std::string& view, const Names& views) {
  throw InputError(fmt::format("{} has no view {}{} (views: {})", file.path.string(), view,
                               didYouMean(view, views), listNames(views)));
}

// The default view's channels may leave it out; then those without a view are its own, and no other
// view's.
bool namesDefault(const ImageFile& file, const Names& views) {
  return std::any_of(file.channels.begin(), file.channels.end(), [&](const Channel& channel) {
    return viewedName(file, channel, views).view == views.front();
  });
}

// The view's own channels win over common ones of the same name, wherever they stand.
void keepChannels(ImageFile& file, bool withCommon) {
  std::vector<ViewedName> names;
  std::set<std::string> own, used;
  for (const Channel& channel : file.channels) {
    names.push_back(viewedName(file, channel, file.views));
    if (names.back().view == file.view) own.insert(names.back().name);
  }
  std::vector<Channel> kept;
  for (size_t i = 0; i < names.size(); ++i) {
    const bool isOwn = names[i].view == file.view;
    const bool isCommon = names[i].view.empty() && withCommon && !own.contains(names[i].name);
    if (!(isOwn || isCommon) || !used.insert(names[i].name).second) continue;
    kept.push_back(file.channels[i]);
    kept.back().name = std::move(names[i].name);
  }
  file.channels = std::move(kept);
}

void keepParts(ImageFile& file) {
  std::vector<int> kept;
  for (const int part : file.ownParts) {
    const bool used = std::any_of(file.channels.begin(), file.channels.end(),
                                  [&](const Channel& channel) { return channel.part == part; });
    if (used) kept.push_back(part);
  }
  // Headers of the view's own parts speak before those of common ones.
  std::stable_partition(kept.begin(), kept.end(), [&](int part) {
    return file.parts[static_cast<size_t>(part)].view == file.view;
  });
  file.ownParts = std::move(kept);
}

}  // namespace

detail::ViewedName detail::cutView(std::string_view name, const std::vector<std::string>& views) {
  Names parts = partsOf(name);
  const size_t count = parts.size();
  if (views.empty() || count < 2) return {std::string(name), ""};
  for (const size_t place : {count - 2, count - 1, size_t{0}}) {
    if (!has(views, parts[place])) continue;
    std::string view = std::move(parts[place]);
    parts.erase(parts.begin() + static_cast<ptrdiff_t>(place));
    return {fmt::format("{}", fmt::join(parts, ".")), std::move(view)};
  }
  return {std::string(name), ""};
}

std::vector<std::string> listViews(const ImageFile& file) {
  Names views;
  for (const Imf::Header& header : *file.headers)
    if (Imf::hasMultiView(header))
      for (const std::string& view : Imf::multiView(header)) addNew(views, view);
  for (const Part& part : file.parts) addNew(views, part.view);
  if (!views.empty()) return views;
  for (const char* view : {"left", "right"})
    for (const Channel& channel : file.channels)
      if (isViewOfKnownPass(channel.name, view)) addNew(views, view);
  return views;
}

ImageFile takeView(ImageFile file, const std::string& view) {
  file.views = listViews(file);
  file.viewTaken = true;
  // A view that is asked for by name need not be listed to be known by its prefix or place.
  if (file.views.empty() && !view.empty()) {
    const Names asked = {view};
    if (std::any_of(file.channels.begin(), file.channels.end(),
                    [&](const Channel& c) { return !cutView(c.name, asked).view.empty(); }))
      file.views = asked;
  }
  if (file.views.empty()) return file;
  if (!view.empty() && !has(file.views, view)) reportView(file, view, file.views);
  file.view = view.empty() ? file.views.front() : view;
  const bool isDefault = file.view == file.views.front();
  keepChannels(file, isDefault || namesDefault(file, file.views));
  if (file.channels.empty()) reportView(file, file.view, file.views);
  keepParts(file);
  describeOwnParts(file);
  return file;
}

ImageFile openFrame(const std::filesystem::path& path, const std::string& view,
                    const std::vector<GroupFile>& others, const std::string& named) {
  std::vector<ImageFile> images;
  images.push_back(openAnyImage(path));
  if (others.empty()) return takeView(std::move(images.front()), view);
  std::vector<std::string> layers = {""};
  for (const GroupFile& other : others) {
    images.push_back(withPlace(named, [&] { return openAnyImage(other.path); }));
    layers.push_back(other.layer);
  }
  return takeView(joinImages(std::move(images), layers), view);
}

}  // namespace kagefude
