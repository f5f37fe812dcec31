#include "compositor/stroke_normals.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "image/parallel.h"
#include "image/real_math.h"
#include "passes/tone/smooth.h"

namespace kagefude {
namespace {

/// Half width of an anchor's window in pixels; 0 for none.
int windowOf(const StyledSurfaces& styled, size_t anchor) {
  constexpr float most = 256;
  const float half = 0.5f * styled.brushes[anchor].smoothNormals * styled.stripPixels[anchor];
  if (half < 1.0f) return 0;
  const float steps = std::floor(2.0f * log2Of(half) + 0.5f);
  return static_cast<int>(std::min(exp2Of(0.5f * steps), most) + 0.5f);
}

std::vector<int> windowsOf(const StyledSurfaces& styled) {
  std::vector<int> windows;
  for (size_t i = 0; i < styled.brushes.size(); ++i) windows.push_back(windowOf(styled, i));
  return windows;
}

/// The surfaces of the anchors that `windows` gives this width; all else is background.
Labels onlyWindow(const StyledSurfaces& styled, View<const uint32_t> surfaces,
                  const std::vector<int>& windows, int window) {
  Labels labels(surfaces.width, surfaces.height);
  parallelRows(surfaces.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < surfaces.width; ++x) {
        const uint16_t anchor = styled.anchorIndex(x, y);
        const bool own = anchor != 0 && windows[anchor - 1u] == window;
        labels(x, y) = own ? surfaces(x, y) : 0u;
      }
  });
  return labels;
}

void takeUnit(const Labels& labels, const Vec3Plane& mean, Vec3Plane& normals) {
  parallelRows(labels.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < labels.width(); ++x) {
        if (labels(x, y) == 0) continue;
        const V3f n = mean.view()(x, y);
        const float length = std::sqrt(n.dot(n));
        if (length > 0.0f) normals.set(x, y, n / length);
      }
  });
}

}  // namespace

bool smoothsNormals(const StyledSurfaces& styled) {
  const std::vector<int> windows = windowsOf(styled);
  return std::any_of(windows.begin(), windows.end(), [](int width) { return width > 0; });
}

Vec3Plane strokeNormals(const FramePlanes& planes, const StyledSurfaces& styled,
                        View<const uint32_t> surfaces) {
  const std::vector<int> windows = windowsOf(styled);
  std::set<int> widths(windows.begin(), windows.end());
  widths.erase(0);
  Vec3Plane normals;
  if (widths.empty()) return normals;
  normals.x = planes.normal.x.clone();
  normals.y = planes.normal.y.clone();
  normals.z = planes.normal.z.clone();
  for (const int width : widths) {
    const Labels labels = onlyWindow(styled, surfaces, windows, width);
    SmoothParams params;
    params.h = width;
    Vec3Plane mean;
    mean.x = smoothWithinSurfaces(planes.normal.x, labels, params);
    mean.y = smoothWithinSurfaces(planes.normal.y, labels, params);
    mean.z = smoothWithinSurfaces(planes.normal.z, labels, params);
    takeUnit(labels, mean, normals);
  }
  return normals;
}

}  // namespace kagefude
