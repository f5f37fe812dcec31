#pragma once

#include <span>
#include <string_view>

#include "passes/brush/brush_params.h"
#include "passes/casters/coverage.h"
#include "passes/casters/planar_projection.h"
#include "passes/casters/shadow_volume.h"
#include "passes/casters/texture_shadow.h"
#include "passes/depth_map/pcf.h"
#include "passes/depth_map/pcss.h"
#include "passes/edges/outline.h"
#include "passes/light_shape/light_shape.h"
#include "passes/search/pair_search.h"
#include "passes/tone/lambert.h"
#include "passes/tone/merge.h"
#include "passes/tone/smooth.h"
#include "passes/tone/surfaces.h"
#include "passes/tone/tone.h"

namespace kagefude {

/// Every pass's parameters: the look's as a whole, or those of one light or style after its own
/// settings were laid over the look's.
struct PassParams {
  SurfacesParams surfaces;
  PairParams pair;
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
  OutlineParams outline;
};

/// Where a look can set a pass's parameters: for the whole look always, and for one light or style.
enum class Scope { look, light, style };
inline constexpr std::string_view scopeNames[] = {"look", "light", "style"};

/// One pass as the look sees it: its table, where its parameters lie, and for what they can differ.
struct PassEntry {
  const ParameterTable* table;
  void* (*in)(PassParams&);
  Scope finest;  ///< look: the same for all lights and styles
};

/// Whether a section or a key of it does anything in a scope. Sections that no pass has do.
bool actsIn(Scope scope, std::string_view section);
bool actsIn(Scope scope, std::string_view section, std::string_view key);

/// All passes in the order in which a frame runs through them.
std::span<const PassEntry> passList();

/// All tables that a look can hold: the passes' and the look's own sections.
std::span<const ParameterTable* const> allTables();

}  // namespace kagefude
