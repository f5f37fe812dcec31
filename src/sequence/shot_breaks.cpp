#include "sequence/shot_breaks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kagefude {
namespace {

constexpr double smallestChange = 1e-3;
constexpr const char* exportAgain =
    "export the shot again, so that its JSONs say it for the whole shot, or give [scene] in the "
    "look";

bool differs(double a, double b) {
  return std::abs(a - b) > smallestChange * std::max(std::abs(a), std::abs(b));
}

void note(std::vector<ShotBreak>& breaks, int frame, ShotBreak found) {
  const auto same = std::find_if(breaks.begin(), breaks.end(),
                                 [&](const ShotBreak& b) { return b.kind == found.kind; });
  if (same != breaks.end()) {
    same->frames.push_back(frame);
    return;
  }
  found.frames = {frame};
  breaks.push_back(std::move(found));
}

void noteLight(const SidecarLight& before, const SidecarLight& now, int frame,
               std::vector<ShotBreak>& breaks) {
  if (differs(before.subjectRadius, now.subjectRadius))
    note(breaks, frame,
         {fmt::format("the radius of what light {} lights", now.name),
          fmt::format("goes from {:.4g} to {:.4g}, so strokes of grounds change their size",
                      before.subjectRadius, now.subjectRadius),
          exportAgain,
          {}});
  if (before.masks && now.masks && !differs(before.radius, now.radius) &&
      differs(before.masks->offset, now.masks->offset))
    note(breaks, frame,
         {fmt::format("the offset of the masks of light {}", now.name),
          fmt::format("goes from {:.4g} to {:.4g} though the light keeps its size, so its shadows "
                      "change their width",
                      before.masks->offset, now.masks->offset),
          "export the shot again, or with --offset",
          {}});
}

bool sameShot(const WholeShot& a, const WholeShot& b) {
  const auto sameLight = [](const ShotLight& one, const ShotLight& other) {
    return one.name == other.name && !differs(one.irradiance, other.irradiance);
  };
  return a.first == b.first && a.last == b.last && !differs(a.subjectRadius, b.subjectRadius) &&
         !differs(a.distance, b.distance) &&
         std::equal(a.lights.begin(), a.lights.end(), b.lights.begin(), b.lights.end(), sameLight);
}

}  // namespace

std::string ShotBreak::sentence() const {
  const std::string more =
      frames.size() > 1 ? fmt::format(" (and {} more)", frames.size() - 1) : std::string();
  return fmt::format("frame {}{}: {} {}; {}", frames.front(), more, kind, change, remedy);
}

void noteShotBreaks(const Sidecar& before, const Sidecar& now, int frame,
                    std::vector<ShotBreak>& breaks) {
  for (const SidecarLight& light : now.lights)
    if (const SidecarLight* earlier = before.findLight(light.name))
      noteLight(*earlier, light, frame, breaks);
  if (before.shot.has_value() != now.shot.has_value() ||
      (before.shot && !sameShot(*before.shot, *now.shot)))
    note(breaks, frame,
         {"what the JSON says of the whole shot",
          "is other than in the frame before, so sizes and the leading light may change",
          "export all frames from one state of the file",
          {}});
}

}  // namespace kagefude
