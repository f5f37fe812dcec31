#include <algorithm>
#include <set>
#include <utility>

#include "frame/aov_names.h"
#include "frame/aov_resolver.h"
#include "frame/frame_view.h"

namespace kagefude {
namespace {

using namespace detail;

struct Component {
  PassChannels pass;  ///< without channels
  int order = 0;
};

// Cuts the last part (behind the last dot) off `name` and returns it; all of it without a dot.
std::string_view cutLast(std::string_view& name) {
  const size_t dot = name.rfind('.');
  if (dot == std::string_view::npos) return std::exchange(name, {});
  const std::string_view last = name.substr(dot + 1);
  name = name.substr(0, dot);
  return last;
}

std::string_view lastOf(std::string_view name) {
  const size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

using Views = std::set<std::string, std::less<>>;

Views viewsOf(const ImageFile& file) {
  if (file.viewTaken) return {};
  const std::vector<std::string> views = listViews(file);
  return {views.begin(), views.end()};
}

Component split(std::string_view name, const Views& views) {
  if (name.find('.') == std::string_view::npos) {
    // Bare R, G, B, A are a beauty; bare Z and named single channels are passes of their own.
    const bool colour = componentOrder(name) >= 0 && !isKnownPass(name);
    return {{"", colour ? "" : std::string(name), "", {}}, colour ? componentOrder(name) : 0};
  }
  std::string_view rest = name;
  int order = 0;
  const std::string_view suffix = lastOf(rest);
  if (componentOrder(suffix) >= 0) {
    order = componentOrder(suffix);
    cutLast(rest);
  }
  std::string_view pass = cutLast(rest), view;
  if (views.contains(pass) && !rest.empty()) {
    view = pass;
    pass = cutLast(rest);
  }
  return {{std::string(rest), std::string(pass), std::string(view), {}}, order};
}

bool isPictureWithDepth(const std::vector<std::pair<int, std::string>>& members) {
  bool red = false, depth = false;
  for (const auto& [order, name] : members) {
    const std::string last = plainName(lastOf(name));
    red = red || last == "r" || last == "red";
    depth = depth || last == "z";
  }
  return red && depth;
}

// A part's bare R, G, B, A and Z share its name, but its Z is a depth of its own.
void takeDepthOut(std::vector<PassChannels>& passes,
                  std::vector<std::vector<std::pair<int, std::string>>>& members) {
  for (size_t i = passes.size(); i-- > 0;) {
    if (!isPictureWithDepth(members[i])) continue;
    const auto depth = std::find_if(members[i].begin(), members[i].end(), [](const auto& m) {
      return plainName(lastOf(m.second)) == "z";
    });
    PassChannels own = passes[i];
    own.layer = own.layer.empty() ? own.pass : own.layer + "." + own.pass;
    own.pass = std::string(lastOf(depth->second));
    passes.push_back(std::move(own));
    members.push_back({*depth});
    members[i].erase(depth);
  }
}

bool isOne(const PassChannels& a, const PassChannels& b) {
  return a.layer == b.layer && a.pass == b.pass && a.view == b.view;
}

}  // namespace

std::vector<PassChannels> listPasses(const ImageFile& file) {
  const auto views = viewsOf(file);
  std::vector<PassChannels> passes;
  std::vector<std::vector<std::pair<int, std::string>>> members;
  for (const Channel& channel : file.channels) {
    const Component component = split(channel.name, views);
    const auto found = std::find_if(passes.begin(), passes.end(), [&](const PassChannels& p) {
      return isOne(p, component.pass);
    });
    const auto index = static_cast<size_t>(found - passes.begin());
    if (found == passes.end()) {
      passes.push_back(component.pass);
      members.emplace_back();
    }
    members[index].emplace_back(component.order, channel.name);
  }
  takeDepthOut(passes, members);
  for (size_t i = 0; i < passes.size(); ++i) {
    std::stable_sort(members[i].begin(), members[i].end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& member : members[i]) passes[i].channels.push_back(std::move(member.second));
  }
  return passes;
}

std::vector<std::string> listLayers(const std::vector<PassChannels>& passes) {
  std::vector<std::string> layers;
  for (const PassChannels& pass : passes) {
    const bool known = std::find(layers.begin(), layers.end(), pass.layer) != layers.end();
    if (!pass.layer.empty() && !known) layers.push_back(pass.layer);
  }
  return layers;
}

}  // namespace kagefude
