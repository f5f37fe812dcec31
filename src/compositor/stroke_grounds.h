#pragma once

#include <set>
#include <string>
#include <vector>

#include "compositor/frame_plan.h"
#include "passes/brush/brush_anchor.h"
#include "passes/brush/brush_params.h"

namespace kagefude {

/// What the strokes of each seen surface are held to, and where its pixels lie there: places at
/// rest as applyBrush takes them, from the frame's rest positions or UVs.
class StrokeGrounds {
 public:
  /// Counts what each of `surfaces` surfaces (numbers from 1 in `index`) shows of either.
  StrokeGrounds(const FramePlan& plan, const FramePlanes& planes, View<const uint16_t> index,
                size_t surfaces);

  /// Whether surface `number`, of that object, is held to its rest or its UVs; false: to the
  /// object's own axes. A surface without any rest positions, where the frame has them, is held so
  /// too; one that misses them in part has positions there (see noteMissing). `params` are its
  /// brush's: those whose reference points cannot share the places (UVs, a rest in world space,
  /// instances) get one.
  bool choose(size_t number, uint32_t object, BrushParams& params);

  /// Takes what turns a surface's passes into places: rest positions go through the object's matrix
  /// of this frame without its turn and move, so they have its size in the world; those in world
  /// space, and of an object that no JSON describes, are taken as they are (frame.up apart); UVs
  /// are sized by brush.uv_size. Instances of one object are shifted against each other by their
  /// random numbers, in whole steps. The anchor learns of the steps, and of places that do not lie
  /// along its axes.
  void lay(size_t number, uint32_t object, const BrushSubject& subject, BrushAnchor& anchor);

  /// The places of all surfaces; empty where none lies at rest.
  Vec3Plane places(const FramePlanes& planes, View<const uint16_t> index) const;

  /// Says of which objects `choose` found no rest positions or UVs, and of which only some: one
  /// line for each kind.
  void noteMissing(std::vector<std::string>& warnings) const;

 private:
  struct Surface {
    size_t pixels = 0, withRest = 0, withUv = 0;
    BrushParams::Ground ground = BrushParams::Ground::object;
    Transform placeFromRest, placeFromWorld;
    float uvSize = 0;
    float shift = 0;  ///< world units, of the steps by which instances are shifted; 0: none
  };

  V3f placeAt(const Surface& surface, const FramePlanes& planes, int x, int y) const;
  /// Places of pixels [first, end) of row y, all of one surface that lies at rest.
  void layRun(const Surface& surface, const FramePlanes& planes, int y, int first, int end,
              Vec3Plane& result) const;

  const FramePlan& plan_;
  std::vector<Surface> surfaces_;
  /// Names of objects without places [0: at all, 1: in part] of [0: rest, 1: UV].
  std::set<std::string> missing_[2][2];
};

}  // namespace kagefude
