#pragma once

#include <vector>

#include "passes/brush/brush_frame.h"
#include "passes/brush/brush_params.h"

namespace kagefude {

/// What is known of a thing that strokes are laid on; one for each object and style.
struct BrushSubject {
  Transform worldFromObject;
  V3f boundsMin{0, 0, 0}, boundsMax{0, 0, 0};  ///< object space
  bool hasBounds = false;
  bool flat = false;                 ///< a ground or wall: the foot of the perpendicular is used
  std::vector<V3f> referencePoints;  ///< world; empty: automatic
  float mappingDistance = 0;         ///< world units; 0: the pass's parameter, or automatic
  float sceneRadius = 0;             ///< of all that the light shines on; 0: unknown
  float worldPerPixel = 0;           ///< width of a pixel at the subject; 0: unknown
  int strip = 0;                     ///< index into the strips given to applyBrush
};

/// How strokes are laid on one subject, in this frame alone.
struct BrushAnchor {
  struct Point {
    V3f position{0, 0, 0};
    BrushFrame frame;
    float along = 0;  ///< place on the long side, world units from the object's origin
  };
  std::vector<Point> points;  ///< at least one, by rising `along`
  ObjectAxes object;
  V3f longSide{1, 0, 0};  ///< world, unit
  bool atRest = false;    ///< strokes lie on the places at rest that applyBrush is given
  /// The places at rest do not lie along the object's axes (UVs, a rest in world space): strokes
  /// run as they would on the surface that is seen, carried to the places pixel by pixel.
  bool placesTurned = false;
  /// Instances' places lie whole numbers of this apart along each axis, so that they do not repeat
  /// each other; more than twice as far as any reaches from its reference point. 0: no instances.
  float instanceStep = 0;
  float mappingDistance = 1;  ///< Md, of the finer strokes
  float coarser = 0;          ///< share of the same strokes at 2 Md, 0..1
  float shift = 0;            ///< added to u at Md, so that octaves do not repeat each other
  float coarserShift = 0;     ///< added to u at 2 Md
  float octaves = 0;          ///< by which the wanted Md exceeds the one that octaves count from
  float octaveFade = 0.5f;    ///< share of an octave over which two change places
  int strip = 0;
};

/// Sizes of strokes that a pixel shows, as Md, `coarser` and the shifts of an anchor.
struct StrokeOctave {
  float mappingDistance, coarser, shift, coarserShift;
};

/// **[ours]** The octave in which strokes on skin that is 2^stretched times as large as it rests
/// have the size that the anchor wants; 0 gives the anchor's own. Within a quarter of an octave of
/// a whole one nothing is mixed (unless the anchor's strokes keep their size on the screen).
StrokeOctave strokeOctave(const BrushAnchor& anchor, float stretched);

/// **[ours]** Reference points (method §8) of a subject: the given ones; or for a flat subject the
/// foot of the perpendicular from the light on its plane (under a sun: the middle of its bounds);
/// or points evenly spaced along the longest side of its bounds, as many as `params.points` says.
/// From bounds and matrix only, never from visible pixels, so occlusion cannot move them. Without
/// bounds: the object's origin.
std::vector<V3f> referencePoints(const BrushSubject& subject, const Light& light,
                                 const BrushParams& params);

/// **[ours]** Md where none is set: a quarter of the mean half size of the bounds in the world (a
/// flat subject's thin side left out), so strokes grow with a growing object and do not swim; 1
/// without bounds.
float automaticMappingDistance(const BrushSubject& subject);

/// Everything applyBrush needs of one subject. Frames as the mapping asks: the seed's or the
/// turning one; over a flat subject V is the plane's normal away from the light, under any light.
/// With `size = screen` and a known worldPerPixel, Md follows the pixel's width in octaves of the
/// object's own Md, `coarser` fading between two: continuous under zoom, nothing slides. In the
/// same way an automatic Md of a flat subject larger than the scene follows a quarter of the
/// scene's radius.
BrushAnchor makeBrushAnchor(const BrushSubject& subject, const Light& light,
                            const BrushParams& params);

}  // namespace kagefude
