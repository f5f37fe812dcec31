#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "frame/aov_resolver.h"
#include "look/pass_list.h"
#include "look/sections.h"

namespace kagefude {

/// A [[light]] of the look with the passes' parameters that hold for it.
struct LightLook {
  LightParams light;
  ShadowParams shadow;
  PassParams passes;
};

/// A [[style]] of the look with the passes' parameters that hold for it.
struct StyleLook {
  StyleParams style;
  PassParams passes;
};

/// A look file with every value resolved. Lights and styles keep the file's order; for a light the
/// last that matches holds, for a surface the style that chooseStyle finds.
struct Look {
  std::filesystem::path folder;  ///< paths in the look are relative to it
  AovNames frame;
  ShadowParams shadow;
  SceneParams scene;
  ColourParams colour;
  OutputParams output;
  PassParams passes;
  std::vector<LightLook> lights;
  std::vector<StyleLook> styles;

  /// The file that a path in the look means.
  std::filesystem::path resolve(const std::string& path) const;
  /// The OCIO config that the look names, resolved; "" when it names none.
  std::string colourConfig() const;
};

/// The style that holds for a surface: of those that match the one of the highest priority, of
/// equal ones the first in the file; null when none matches.
const StyleLook* chooseStyle(const std::vector<StyleLook>& styles,
                             const std::function<bool(const StyleParams&)>& matches);

/// Reads a look file and lays `overrides` ("section.key=value", also "style[0].brush.key=value")
/// over it. An empty path gives the defaults. Throws LookError with file:line.
Look readLook(const std::filesystem::path& path, const std::vector<std::string>& overrides);

/// The look as TOML with all values resolved, in a fixed order: what a report shows and what a
/// fingerprint is made of.
std::string resolvedText(const Look& look);

}  // namespace kagefude
