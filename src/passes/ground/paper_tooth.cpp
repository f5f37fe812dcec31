#include "passes/ground/paper_tooth.h"

#include <algorithm>
#include <cmath>

#include "image/parallel.h"
#include "passes/brush/brush_taps.h"
#include "passes/ground/view_angles.h"

namespace kagefude {
namespace {

/// Two sizes of the tooth and the share of the coarser one.
struct ToothOctave {
  float perUnit = 1;  ///< grains to one unit of length, of the finer
  float coarser = 0;
};

/// Widths of a grain are whole powers of two of a unit; `wanted` is the width asked for.
ToothOctave octaveOf(float wanted) {
  const float level = log2Of(wanted), whole = std::floor(level);
  return {exp2Of(-whole), level - whole};
}

/// Both octaves, mixed so that heights stay as spread as they are. Seen from far above, ranks of a
/// mix of two are those of one that is stretched about its middle.
ToothSample mixed(const ToothSample& a, const ToothSample& b, float share) {
  const float first = 1.0f - share;
  const float gain = 1.0f / std::sqrt(first * first + share * share);
  const float height = 0.5f + ((a.height - 0.5f) * first + (b.height - 0.5f) * share) * gain;
  return {height < 0.0f   ? 0.0f
          : height > 1.0f ? 1.0f
                          : height,
          (a.slope * first + b.slope * share) * gain};
}

ToothSample inPlane(const ToothTile& tile, float u, float v, const ToothOctave& octave) {
  const float fine = octave.perUnit, coarse = 0.5f * octave.perUnit;
  if (octave.coarser <= 0.0f) return tile.between(u * fine, v * fine);
  // The two octaves lie shifted against each other, or one would repeat the other's crossings.
  return mixed(tile.between(u * fine, v * fine), tile.between(u * coarse + 7.3f, v * coarse + 3.1f),
               octave.coarser);
}

/// On the planes of three axes, by how much the surface faces each.
ToothSample onAxes(const ToothTile& tile, const V3f& place, const V3f& facing,
                   const ToothOctave& octave) {
  float squares[3], largest = 0;
  for (int k = 0; k < 3; ++k) {
    squares[k] = facing[k] * facing[k] + leastFacing;
    largest = squares[k] > largest ? squares[k] : largest;
  }
  float sum = 0, sumSquares = 0, height = 0, slope = 0;
  for (int k = 0; k < 3; ++k) {
    const float weight = excessShare(squares[k], largest);
    if (weight <= 0.0f) continue;
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const ToothSample own = inPlane(tile, place[i] + axisOffset[k], place[j], octave);
    height += weight * (own.height - 0.5f);
    slope += weight * own.slope;
    sum += weight;
    sumSquares += weight * weight;
  }
  const float gain = sum > 0.0f ? 1.0f / std::sqrt(sumSquares) : 0.0f;
  const float ranked = 0.5f + height * gain;
  return {ranked < 0.0f ? 0.0f : ranked > 1.0f ? 1.0f : ranked, slope * gain};
}

V3f placeOf(const ToothPlaces& in, const BrushAnchor& anchor, int x, int y) {
  if (anchor.atRest && !in.rest.empty()) return in.rest(x, y);
  return alongAxes(anchor.object, in.position(x, y) - anchor.object.origin);
}

/// Width of the pixel on the surface that it shows.
float pixelWidth(const CameraRays& rays, const V3f& position, const V3f& normal) {
  constexpr float leastFacingView = 0.2f;
  const V3d away = V3d(position) - rays.eye;
  const double distance = away.length();
  const V3d view = rays.orthographic ? rays.direction0 : away;
  const double length = view.length() * std::sqrt(static_cast<double>(normal.dot(normal)));
  const double turned = length > 0 ? std::fabs(view.dot(V3d(normal))) / length : 1;
  const auto facing = static_cast<float>(turned);
  return static_cast<float>(rays.pixelSize(distance)) /
         (facing > leastFacingView ? facing : leastFacingView);
}

ToothSample onObject(const ToothTile& tile, const ToothPlaces& in, const BrushAnchor& anchor, int x,
                     int y) {
  const V3f normal = in.normal(x, y);
  const float wanted = pixelWidth(*in.rays, in.position(x, y), normal) * tile.texelsPerGrain();
  if (!(wanted > 0.0f)) return {};
  return onAxes(tile, placeOf(in, anchor, x, y), alongAxes(anchor.object, normal),
                octaveOf(wanted));
}

/// Directions lie on a turn that a power of two of grains goes into, so that it closes.
ToothSample onDirection(const ToothTile& tile, const ToothPlaces& in, int x, int y) {
  const V3d direction = in.rays->direction(x + 0.5, y + 0.5);
  const ViewAngles angles = viewAngles(direction, in.upIsY);
  const auto radians = static_cast<float>(in.rays->directionX.length() / direction.length());
  const float wanted = radians * (0.5f / pi) * tile.texelsPerGrain();
  if (!(wanted > 0.0f)) return {};
  return inPlane(tile, angles.round, angles.above, octaveOf(wanted));
}

}  // namespace

void PaperSurface::read(int x, int y, int count, ToothRun& run) const {
  if (tile_) {
    tile_->copyRow(x + offsetX_, y + offsetY_, count, run.height, run.slope);
  } else {
    std::copy_n(tooth_.height.row(y) + x, count, run.height);
    std::copy_n(tooth_.slope.row(y) + x, count, run.slope);
  }
}

PaperTooth worldTooth(const ToothTile& tile, const ToothPlaces& places) {
  const int width = places.anchorIndex.width, height = places.anchorIndex.height;
  PaperTooth tooth{Floats(width, height), Floats(width, height)};
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        const uint16_t index = places.anchorIndex(x, y);
        const ToothSample sample = index == 0
                                       ? onDirection(tile, places, x, y)
                                       : onObject(tile, places, places.anchors[index - 1u], x, y);
        tooth.height(x, y) = sample.height;
        tooth.slope(x, y) = sample.slope;
      }
  });
  return tooth;
}

}  // namespace kagefude
