#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "frame/aov_resolver.h"
#include "look/sections.h"
#include "passes/brush/brush_params.h"
#include "passes/casters/coverage.h"
#include "passes/casters/planar_projection.h"
#include "passes/casters/shadow_volume.h"
#include "passes/casters/texture_shadow.h"
#include "passes/depth_map/pair_depth.h"
#include "passes/depth_map/pcf.h"
#include "passes/depth_map/pcss.h"
#include "passes/edges/outline.h"
#include "passes/edges/painted_edge_params.h"
#include "passes/ground/ground.h"
#include "passes/ground/paper.h"
#include "passes/light_shape/light_shape.h"
#include "passes/search/pair_search.h"
#include "passes/tone/lambert.h"
#include "passes/tone/merge.h"
#include "passes/tone/smooth.h"
#include "passes/tone/surfaces.h"
#include "passes/tone/tint.h"
#include "passes/tone/tone.h"

namespace kagefude {

/// Every pass's parameters: the look's as a whole, or those of one light or style after its own
/// settings were laid over the look's.
struct PassParams {
  SurfacesParams surfaces;
  PairParams pair;
  PairDepthParams pairDepth;
  LightShapeParams lightShape;
  PcfParams pcf;
  PcssParams pcss;
  CoverageParams coverage;
  VolumeParams volume;
  PlanarParams planar;
  BlobParams blob;
  SmoothParams smooth;
  LambertParams shade;
  MergeParams merge;
  ToneParams tone;
  BrushParams brush;
  TintParams tint;
  PaintedEdgeParams edges;
  GroundParams ground;
  PaperParams paper;
  OutlineParams outline;
};

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
  /// Where each key stands that is set, by its name as --set has it ("style[1].strip"):
  /// "look.toml:12", or "--set"; null where no text was read.
  std::shared_ptr<const std::map<std::string, std::string>> places;

  /// Where a key stands, "" where it is not set.
  std::string placeOf(const std::string& key) const;
  /// What messages about what a key names begin with: "look.toml:12: style[1].strip".
  std::string keyWithPlace(const std::string& key) const;
  /// The file that a path in the look means.
  std::filesystem::path resolve(const std::string& path) const;
  /// The OCIO config that the look names, resolved; "" when it names none.
  std::string colourConfig() const;
};

/// Where a section can be given: for the whole look, and for one light or style.
enum class Scope { look, light, style };
inline constexpr std::string_view scopeNames[] = {"look", "light", "style"};

/// One section: its table, and where its parameters lie in the look, a light or a style; null where
/// it does nothing. The lists [[light]] and [[style]] have parameters in their entries alone.
struct LookSection {
  const ParameterTable* table;
  void* (*inLook)(Look&) = nullptr;
  void* (*inLight)(LightLook&) = nullptr;
  void* (*inStyle)(StyleLook&) = nullptr;
  std::string_view wholeLookKey =
      {};  ///< a key that is the same for all lights and styles; "" for none

  bool isList() const { return inLook == nullptr; }
};

namespace detail {

template <auto Member>
constexpr LookSection ofLook(const ParameterTable& table) {
  return {.table = &table, .inLook = [](Look& look) -> void* { return &(look.*Member); }};
}

template <auto Member>
constexpr LookSection ofPass(const ParameterTable& table, Scope finest,
                             std::string_view wholeLookKey = {}) {
  LookSection section{.table = &table,
                      .inLook = [](Look& look) -> void* { return &(look.passes.*Member); },
                      .wholeLookKey = wholeLookKey};
  if (finest == Scope::light)
    section.inLight = [](LightLook& light) -> void* { return &(light.passes.*Member); };
  if (finest == Scope::style)
    section.inStyle = [](StyleLook& style) -> void* { return &(style.passes.*Member); };
  return section;
}

}  // namespace detail

/// All sections; whatever reads a look, prints it or lists its keys goes through these. First the
/// look's own, then the passes in the order in which a frame runs through them, then the lists.
inline constexpr LookSection lookSections[] = {
    detail::ofLook<&Look::frame>(aovNamesTable),
    {.table = &shadowTable,
     .inLook = [](Look& look) -> void* { return &look.shadow; },
     .inLight = [](LightLook& light) -> void* { return &light.shadow; },
     .wholeLookKey = "lights"},
    detail::ofLook<&Look::scene>(sceneTable),
    detail::ofLook<&Look::colour>(colourTable),
    detail::ofLook<&Look::output>(outputTable),
    detail::ofPass<&PassParams::surfaces>(surfacesTable, Scope::look),
    detail::ofPass<&PassParams::pair>(pairTable, Scope::light),
    detail::ofPass<&PassParams::pairDepth>(pairDepthTable, Scope::light),
    detail::ofPass<&PassParams::lightShape>(lightShapeTable, Scope::light),
    detail::ofPass<&PassParams::pcf>(pcfTable, Scope::light),
    detail::ofPass<&PassParams::pcss>(pcssTable, Scope::light),
    detail::ofPass<&PassParams::coverage>(coverageTable, Scope::light),
    detail::ofPass<&PassParams::volume>(volumeTable, Scope::light),
    detail::ofPass<&PassParams::planar>(planarTable, Scope::light),
    detail::ofPass<&PassParams::blob>(blobTable, Scope::light),
    detail::ofPass<&PassParams::smooth>(smoothTable, Scope::light),
    detail::ofPass<&PassParams::shade>(shadeTable, Scope::light),
    detail::ofPass<&PassParams::merge>(mergeTable, Scope::light, "lights"),
    detail::ofPass<&PassParams::tone>(toneTable, Scope::style, "light"),
    detail::ofPass<&PassParams::brush>(brushTable, Scope::style),
    detail::ofPass<&PassParams::tint>(tintTable, Scope::style),
    detail::ofPass<&PassParams::edges>(paintedEdgeTable, Scope::style),
    detail::ofPass<&PassParams::ground>(groundTable, Scope::look),
    detail::ofPass<&PassParams::paper>(paperTable, Scope::look),
    detail::ofPass<&PassParams::outline>(outlineTable, Scope::style),
    {.table = &lightTable},
    {.table = &styleTable},
};

/// Whether a section, or a key of it, does anything in a scope.
bool actsIn(Scope scope, const LookSection& section);
bool actsIn(Scope scope, const LookSection& section, std::string_view key);

}  // namespace kagefude
