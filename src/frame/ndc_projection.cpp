#include "frame/ndc_projection.h"

#include <fmt/format.h>

#include <cmath>

#include "frame/camera_faults.h"

namespace kagefude::detail {
namespace {

// x = scaleX x / depth + middleX for a perspective, x = scaleX x + middleX for a parallel one.
struct Found {
  double scaleX, scaleY, middleX, middleY;
  bool perspective;
};

bool isSmall(double value, double beside, double distance) {
  return std::abs(value) <= 1e-4 * std::abs(beside) * (1 + distance);
}

constexpr auto noProjection = "is no projection of its worldToCamera's space";

// A point straight ahead at depth d has z = ahead d, so x is (x[0] x + x[2] ahead d) / (w[2] ahead
// d).
std::string readPerspective(const Transform& k, double ahead, double distance, Found& found) {
  const auto &x = k.m[0], &y = k.m[1], &w = k.m[3];
  const double w2 = std::abs(w[2]);
  if (!isSmall(w[0], w2, 0) || !isSmall(w[1], w2, 0) || !isSmall(x[3], x[0], distance) ||
      !isSmall(y[3], y[1], distance))
    return noProjection;
  // Of a matrix and its negative, which are the same, the one whose x goes right counts.
  const double sign = x[0] < 0 ? -1 : 1;
  found = {sign * x[0] / w2, sign * y[1] / w2, ahead * sign * x[2] / w2, ahead * sign * y[2] / w2,
           true};
  // Mantra's w is negative ahead; with the axis in the middle and y up that leaves no doubt.
  const bool behind = sign * w[2] * ahead < 0;
  const bool centred = isSmall(x[2], x[0], 0) && isSmall(y[2], y[1], 0);
  return behind && !(centred && found.scaleY > 0) ? "mirrors the picture" : "";
}

std::string readParallel(const Transform& k, Found& found) {
  const auto &x = k.m[0], &y = k.m[1], &w = k.m[3];
  const double w3 = std::abs(w[3]);
  if (!(w3 > 0) || !isSmall(w[0], w3, 0) || !isSmall(w[1], w3, 0) || !isSmall(w[2], w3, 0) ||
      !isSmall(x[2], x[0], 0) || !isSmall(y[2], y[1], 0))
    return noProjection;
  found = {x[0] / w[3], y[1] / w[3], x[3] / w[3], y[3] / w[3], false};
  return found.scaleX < 0 ? "mirrors the picture" : "";
}

// "" or what is wrong with it.
std::string readProjection(const Transform& k, double ahead, double distance, Found& found) {
  const auto &x = k.m[0], &y = k.m[1], &w = k.m[3];
  if (!isSmall(x[1], x[0], 0) || !isSmall(y[0], y[1], 0) || x[0] == 0 || y[1] == 0)
    return noProjection;
  return w[2] != 0 && isSmall(w[3], w[2], distance) ? readPerspective(k, ahead, distance, found)
                                                    : readParallel(k, found);
}

bool isNear(const Found& found, double middle) {
  constexpr double reach = 0.2;  // less than half of what lies between the two ranges' middles
  return std::abs(found.middleX - middle) < reach && std::abs(found.middleY - middle) < reach;
}

void stretchToClip(Found& found) {
  found.scaleX *= 2;
  found.scaleY *= 2;
  found.middleX = 2 * found.middleX - 1;
  found.middleY = 2 * found.middleY - 1;
}

Transform parallelClip(const Found& found) {
  Transform clip;
  clip.m[0][0] = found.scaleX;
  clip.m[0][3] = found.middleX;
  clip.m[1][1] = found.scaleY;
  clip.m[1][3] = found.middleY;
  clip.m[2][2] = -1;
  return clip;
}

}  // namespace

Transform perspectiveClip(double scaleX, double scaleY, double middleX, double middleY) {
  Transform clip;
  clip.m[0][0] = scaleX;
  clip.m[0][2] = -middleX;
  clip.m[1][1] = scaleY;
  clip.m[1][2] = -middleY;
  clip.m[2][2] = -1;
  clip.m[2][3] = -0.2;  // a near plane at 0.1 and none behind: nothing reads this depth
  clip.m[3][2] = -1;
  clip.m[3][3] = 0;
  return clip;
}

NdcProjection ndcProjection(const Transform& ndcFromCamera, bool looksAlongZ, double aspect,
                            double distance) {
  Found found{};
  const std::string fault = readProjection(ndcFromCamera, looksAlongZ ? 1 : -1, distance, found);
  if (!fault.empty()) return {std::nullopt, fault};
  if (isNear(found, 0.5))
    stretchToClip(found);
  else if (!isNear(found, 0))
    return {std::nullopt,
            fmt::format("has its axis at {:.3g}, {:.3g}, which is the middle of neither 0..1 nor "
                        "-1..1",
                        found.middleX, found.middleY)};
  if (found.scaleY < 0) {
    found.scaleY = -found.scaleY;
    found.middleY = -found.middleY;
  }
  const double pixels = found.scaleY / (found.scaleX * aspect);
  if (!(std::abs(pixels - 1) < 0.01))
    return {std::nullopt, fmt::format("spans another shape than the display window (pixels {:.3g} "
                                      "times as wide as high)",
                                      pixels)};
  const Transform clip =
      found.perspective ? perspectiveClip(found.scaleX, found.scaleY, found.middleX, found.middleY)
                        : parallelClip(found);
  const std::string unseen = projectionFault(clip);
  if (!unseen.empty()) return {std::nullopt, unseen};
  return {clip, ""};
}

}  // namespace kagefude::detail
