#pragma once

#include <array>
#include <optional>
#include <span>

#include "image/vec.h"
#include "passes/casters/camera_rays.h"
#include "passes/edges/behind_paint.h"
#include "passes/edges/pixel_cut.h"
#include "passes/edges/stair_share.h"
#include "passes/tone/surfaces.h"

namespace kagefude {

/// What is known of the surfaces that a picture shows.
struct EdgeSurfaces {
  std::span<const uint32_t> objects;  ///< of each style: whose it is; 0 is the background's
  View<const uint16_t> styles;        ///< what paints each pixel; another one is an edge too
  View<const uint8_t> joins;          ///< JoinedWay, as labelSurfaces keeps them
  Vec3View normal, position;          ///< world
  const CameraRays* rays = nullptr;   ///< null: not known
  bool betweenObjects = false;        ///< whether edges from one object to another are blended here
};

/// **[ours]** Clean edges inside objects, of one sample a pixel: every pixel's colour was made for
/// the surface at its centre; here a pixel of an edge gives the share of its square in which the
/// surfaces of its neighbours are seen to their colours. Where two surfaces meet in a crease, their
/// tangent planes say where it runs, to a fraction of a pixel (creaseLine), and the square is cut
/// by it exactly; corners, where several meet, by all of them. Where one surface hides the other,
/// and at borders of paint, the staircase of the edge tells its slope (stairShare). Pixels away
/// from edges are not touched. paint: in place, scene-linear, associated. Cost: a look at every
/// pixel's joins, some hundred operations at an edge.
void blendInnerEdges(const EdgeSurfaces& surfaces, const PaintViews& paint);

/// A way to one of a pixel's neighbours: the four sides first, then the corners.
struct EdgeStep {
  int x, y;
};
inline constexpr std::array<EdgeStep, 8> edgeSteps{
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

/// How much of each pixel's square shows the surfaces of its neighbours, as blendInnerEdges mixes
/// them. The surfaces' planes must outlive it.
class InnerEdges {
 public:
  explicit InnerEdges(const EdgeSurfaces& surfaces) : s_(surfaces) {}

  /// Whether nothing about a pixel needs a second look.
  bool plain(int x, int y) const;
  /// The share of each neighbour, in the order of edgeSteps; at most 1 together.
  std::array<double, 8> shares(int x, int y) const;

 private:
  uint32_t object(int x, int y) const { return s_.objects[s_.styles(x, y)]; }
  bool edge(int x, int y, EdgeStep step) const;
  bool blends(int x, int y, EdgeStep step) const;
  std::optional<HalfPlane> crease(int x, int y, EdgeStep step) const;
  void creases(int x, int y, std::array<double, 8>& shares) const;
  RunEnd follow(int x, int y, EdgeStep side, EdgeStep along) const;
  void stairs(int x, int y, std::array<double, 8>& shares) const;

  EdgeSurfaces s_;
};

}  // namespace kagefude
