#include "look/light_strip.h"

#include <fmt/format.h>

#include <set>

#include "base/error.h"
#include "base/glob.h"

namespace kagefude {

LightStrip lightStripFrom(const std::string& entry) {
  const size_t equals = entry.find('=');
  if (equals == std::string::npos) return {entry, ""};
  return {entry.substr(0, equals), entry.substr(equals + 1)};
}

std::vector<LightStrip> lightStripsOf(const StyleParams& style) {
  std::vector<LightStrip> strips;
  for (const std::string& entry : style.lightStrips) strips.push_back(lightStripFrom(entry));
  return strips;
}

void checkLightStrips(const StyleParams& style) {
  std::set<std::string> lights;
  for (const std::string& entry : style.lightStrips) {
    if (entry.find('=') == std::string::npos || entry.front() == '=')
      throw LookError(fmt::format(
          "style.light_strips wants LIGHT=STRIP, such as Rim=strips/rim.png, not \"{}\"", entry));
    if (const std::string light = lightStripFrom(entry).light; !lights.insert(light).second)
      throw LookError(fmt::format("style.light_strips gives light {} two strips", light));
  }
}

std::string stripOfLight(const Look& look, const StyleParams& style, const std::string& light) {
  for (const LightStrip& own : lightStripsOf(style))
    if (matchesGlob(light, own.light)) return own.strip;
  std::string strip;
  for (const LightLook& settings : look.lights)
    if (matchesGlob(light, settings.light.name)) strip = settings.light.strip;
  return strip;
}

}  // namespace kagefude
