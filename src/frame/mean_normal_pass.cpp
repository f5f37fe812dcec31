#include "frame/mean_normal_pass.h"

#include <fmt/format.h>

#include "base/nearest_name.h"

namespace kagefude {

MeanNormalPass findMeanNormal(const ImageFile& file, const Aov& normal) {
  const std::string& channel = normal.channels.at(0);  // "layer.Normal.X"
  const std::string pass = channel.substr(0, channel.rfind('.'));
  const std::string name = pass.substr(0, pass.rfind('.') + 1) + "MeanNormal";
  MeanNormalPass found;
  std::vector<std::string> missing;
  for (const char* axis : {"X", "Y", "Z"}) {
    std::string own = fmt::format("{}.{}", name, axis);
    (file.findChannel(own) ? found.channels : missing).push_back(std::move(own));
  }
  if (found.channels.empty()) return found;
  found.name = name;
  if (!missing.empty())
    found.fault = fmt::format("{} has no channel {}, so edges are mixed without mean normals", name,
                              listNames(missing));
  return found;
}

}  // namespace kagefude
