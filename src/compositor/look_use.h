#pragma once

#include <set>
#include <string>
#include <vector>

#include "compositor/frame_plan.h"
#include "look/look.h"

namespace kagefude {

/// Which entries of a look found something in a frame, by their place in the look, and what there
/// was to be found. Of several frames together it tells a typing error from a thing that enters
/// later.
struct LookUse {
  std::vector<bool> styles;        ///< each [[style]]
  std::vector<bool> lights;        ///< each [[light]]
  std::vector<bool> shadowLights;  ///< each name of shadow.lights
  std::set<std::string> objects, materials, lightNames;

  void add(const LookUse& other);
};

/// The use of one frame. `styles` says which of them fit a surface that is seen; a style whose
/// names are listed in manifest or sidecar fits as well.
LookUse lookUse(const Look& look, const FramePlan& plan, std::vector<bool> styles);

/// One sentence for each entry that found nothing in all frames, with the nearest name.
std::vector<std::string> unusedEntries(const Look& look, const LookUse& use);

}  // namespace kagefude
