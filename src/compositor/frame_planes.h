#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compositor/casting_scene.h"
#include "frame/coverage_planes.h"
#include "image/vec.h"

namespace kagefude {

/// The pixels that one light brings: its hard masks (1 = sees the light), its traced visibility or
/// its depth map, whichever its method needs.
struct LightPlanes {
  std::vector<Bytes> masks;
  Floats traced;
  Floats depthMap;
  std::vector<size_t> unknown{};  ///< by mask, or of the traced visibility: how much is NaN or Inf
  size_t unknownTexels = 0;       ///< of the depth map: NaN and -Inf, taken as nothing
};

/// Everything that was read for one frame, one value a pixel of the data window. Empty where the
/// look does not need it or the frame has none.
struct FramePlanes {
  int width = 0;
  int height = 0;
  Vec3Plane position;  ///< world
  Vec3Plane normal;    ///< world, unit
  Labels objectId;     ///< 0 = background
  Labels materialId;
  Vec3Plane rest;  ///< as the pass has it; x is NaN where it holds nothing
  Floats u, v;     ///< UVs
  Floats instanceRandom;
  Vec3Plane albedo;
  Vec3Plane beauty;
  Floats alpha;
  Floats emission;  ///< luminance of what surfaces give off themselves
  Vec3Plane lines;  ///< drawn lines that lie over everything, associated, and their alpha
  Floats linesAlpha;
  Floats depth;                     ///< only for outlines where no camera is known
  CoveragePlanes coverage;          ///< Cryptomatte of objects, for clean edges
  Vec3Plane meanNormal;             ///< of all samples of the pixel, through the beauty's filter
  std::vector<LightPlanes> lights;  ///< in the order of the plan's lights
  std::optional<CameraRays> rays;   ///< where the camera is known
  std::shared_ptr<const CastingScene> casting;  ///< null when no light needs it
  std::vector<std::string> warnings;            ///< what is doubted about the pixels
  std::vector<std::string> meanWarnings;        ///< of the mean normals: where the look uses them
  size_t badPixels = 0;                         ///< pixels whose NaN or Inf made them background
  size_t badBeauty = 0;  ///< pixels of the beauty that hold NaN or Inf, taken as black
  size_t badAlbedo = 0;  ///< the same of the albedo
};

}  // namespace kagefude
