#pragma once

#include <span>

#include "passes/brush_params.h"
#include "passes/coverage.h"
#include "passes/lambert.h"
#include "passes/light_shape.h"
#include "passes/merge.h"
#include "passes/outline.h"
#include "passes/pair_search.h"
#include "passes/pcf.h"
#include "passes/pcss.h"
#include "passes/planar_projection.h"
#include "passes/shadow_volume.h"
#include "passes/smooth.h"
#include "passes/surfaces.h"
#include "passes/texture_shadow.h"
#include "passes/tone.h"

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

/// One pass as the look sees it: its table, and where its parameters lie.
struct PassEntry {
  const ParameterTable* table;
  void* (*in)(PassParams&);
};

/// All passes in the order in which a frame runs through them.
std::span<const PassEntry> passList();

/// All tables that a look can hold: the passes' and the look's own sections.
std::span<const ParameterTable* const> allTables();

}  // namespace kagefude
