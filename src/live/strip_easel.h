#pragma once

#include <nlohmann/json_fwd.hpp>

#include "live/show_stage.h"
#include "live/strip_store.h"

namespace kagefude {

/// What the page paints strips of: the parameters of `strip make`, from the same table.
struct StripRecipe {
  std::string preset = "soft";
  std::vector<std::string> settings{};  ///< "key=value", over the preset's own
};

/// {"table": as /tables has them, "presets": {"soft": {"stroke_width": 64 ...} ...}}.
nlohmann::ordered_json stripKnobs();

/// The strip as its file would show it. Throws LookError for an unknown preset, for settings as
/// readSection does, and for more than four megapixels: so much is painted while nobody waits for
/// it, by `strip make`.
ShownPixels paintedStrip(const StripRecipe& recipe);

/// Paints it into the look's folder of strips, as `strip make` writes it; see keepStrip. `name`
/// ends in ".png". Throws as both.
StripKept keepPaintedStrip(const Look& onDisk, const std::string& name, const StripRecipe& recipe);

}  // namespace kagefude
