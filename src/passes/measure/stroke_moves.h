#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "passes/measure/warp_error.h"

namespace kagefude {

/// How still the strokes of one object hold on its surface. A ratio is the root mean square of
/// their change from frame to frame over that of the strokes themselves (the picture less the
/// unstyled tone): 0 is still, and unrelated strokes have the root of 2.
struct ObjectMoves {
  uint32_t id = 0;
  std::string name;            ///< "" when nothing names it
  int64_t pixels = 0;          ///< compared, over all frames
  double change = 0;           ///< root mean square, scene-linear colour
  double ratio = 0;            ///< 0 without strokes
  double worst = 0;            ///< largest ratio of a frame
  int worstFrame = 0;          ///< where that is
  int worstX = 0, worstY = 0;  ///< pixel of that frame whose strokes change most, from the top left
};

/// **[ours]** Sums up strokes' changes frame by frame, for each object and each pixel.
class StrokeMoves {
 public:
  /// Counts a frame in: its strokes, and their error against the frame before. Pixels that are not
  /// compared are left out. Planes of one size, the same for all frames.
  void add(int frame, View<const uint32_t> ids, Vec3View strokes, const WarpError& error);
  /// Of objects with at least `fewest` compared pixels in a frame, the restless ones first.
  std::vector<ObjectMoves> objects(const std::map<uint32_t, std::string>& names) const;
  /// Where strokes move: each pixel's ratio over the frames, NaN where nothing was compared.
  Floats picture() const;

  static constexpr int64_t fewest = 64;

 private:
  struct Sum {
    double change = 0, strokes = 0;
    int64_t pixels = 0;
    float most = -1;
    int x = 0, y = 0;
    double ratio() const;
  };
  struct Object {
    Sum all;
    double worst = -1;
    int worstFrame = 0, x = 0, y = 0;
  };
  void addPicture(View<const uint32_t> ids, const WarpError& error,
                  const std::map<uint32_t, Sum>& sums);

  std::map<uint32_t, Object> objects_;
  Floats squares_, counts_;
};

}  // namespace kagefude
