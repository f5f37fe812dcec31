#include "frame/fit_camera.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kagefude {
namespace {

constexpr int size = 12;
using Vector = std::array<double, size>;
using Matrix = std::array<Vector, size>;

// Cyclic Jacobi: `a` becomes diagonal, the columns of `v` its eigenvectors.
void diagonalise(Matrix& a, Matrix& v) {
  v = {};
  for (size_t i = 0; i < size; ++i) v[i][i] = 1;
  for (int sweep = 0; sweep < 60; ++sweep) {
    for (size_t p = 0; p < size; ++p)
      for (size_t q = p + 1; q < size; ++q) {
        if (std::abs(a[p][q]) <= 1e-300) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (size_t k = 0; k < size; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (size_t k = 0; k < size; ++k) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
          const double vp = v[k][p], vq = v[k][q];
          v[k][p] = c * vp - s * vq;
          v[k][q] = s * vp + c * vq;
        }
      }
  }
}

// Moves and scales values to a mean of 0 and a mean distance of about 1.
struct Scaling {
  V3d middle{0, 0, 0};
  double scale = 1;
  V3d operator()(const V3d& p) const { return (p - middle) * scale; }
};

template <class Place>
Scaling scalingOf(const std::vector<SeenPoint>& points, const Place& place) {
  Scaling result;
  for (const SeenPoint& point : points)
    result.middle += place(point) / static_cast<double>(points.size());
  double spread = 0;
  for (const SeenPoint& point : points)
    spread += (place(point) - result.middle).length() / static_cast<double>(points.size());
  result.scale = spread > 0 ? 1 / spread : 1;
  return result;
}

void addRow(Matrix& sum, const Vector& row) {
  for (size_t i = 0; i < size; ++i)
    for (size_t j = 0; j < size; ++j) sum[i][j] += row[i] * row[j];
}

V3d worldOf(const SeenPoint& point) { return point.world; }
V3d pictureOf(const SeenPoint& point) { return {point.x, point.y, 0}; }

// The projection's twelve numbers in scaled terms; nothing when more than one would fit.
std::optional<Vector> solve(const std::vector<SeenPoint>& points, const Scaling& world,
                            const Scaling& picture) {
  Matrix sum{}, vectors;
  for (const SeenPoint& point : points) {
    const V3d p = world(point.world), s = picture(pictureOf(point));
    addRow(sum, {p.x, p.y, p.z, 1, 0, 0, 0, 0, -s.x * p.x, -s.x * p.y, -s.x * p.z, -s.x});
    addRow(sum, {0, 0, 0, 0, p.x, p.y, p.z, 1, -s.y * p.x, -s.y * p.y, -s.y * p.z, -s.y});
  }
  diagonalise(sum, vectors);
  std::array<size_t, size> order;
  for (size_t i = 0; i < size; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return sum[a][a] < sum[b][b]; });
  const double least = std::abs(sum[order[0]][order[0]]), next = sum[order[1]][order[1]];
  if (!(next > 1e-7 * static_cast<double>(points.size())) || least > 0.01 * next)
    return std::nullopt;
  Vector result;
  for (size_t k = 0; k < size; ++k) result[k] = vectors[k][order[0]];
  return result;
}

V3d rowOf(const Vector& m, size_t row) { return {m[4 * row], m[4 * row + 1], m[4 * row + 2]}; }

bool fits(const std::vector<SeenPoint>& points, const Vector& m, const Scaling& world,
          const Scaling& picture) {
  double sum = 0;
  for (const SeenPoint& point : points) {
    const V3d p = world(point.world), s = picture(pictureOf(point));
    const double w = rowOf(m, 2).dot(p) + m[11];
    if (!(w > 0)) return false;
    const double x = (rowOf(m, 0).dot(p) + m[3]) / w - s.x;
    const double y = (rowOf(m, 1).dot(p) + m[7]) / w - s.y;
    sum += x * x + y * y;
  }
  const double pixels = std::sqrt(sum / static_cast<double>(points.size())) / picture.scale;
  return pixels < 0.5;
}

}  // namespace

std::optional<Transform> fitCamera(const std::vector<SeenPoint>& points) {
  if (points.size() < 32) return std::nullopt;
  const Scaling world = scalingOf(points, worldOf), picture = scalingOf(points, pictureOf);
  auto m = solve(points, world, picture);
  if (!m) return std::nullopt;
  // A projection is known up to its sign: things stand in front of the camera.
  const V3d first = world(points.front().world);
  if (rowOf(*m, 2).dot(first) + (*m)[11] < 0)
    for (double& value : *m) value = -value;
  if (!fits(points, *m, world, picture)) return std::nullopt;
  const V3d ahead = rowOf(*m, 2).normalized();
  V3d right = rowOf(*m, 0) - ahead * rowOf(*m, 0).dot(ahead);
  V3d down = rowOf(*m, 1) - ahead * rowOf(*m, 1).dot(ahead);
  right.normalize();
  down.normalize();
  constexpr double mostSkew = 0.02;
  if (std::abs(right.dot(down)) > mostSkew || right.cross(down).dot(ahead) <= 0)
    return std::nullopt;
  down = ahead.cross(right);
  const V3d rows[3] = {right, -down, -ahead};
  // The camera's place is what the projection maps to nothing.
  Transform linear;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) linear.m[i][j] = rowOf(*m, i)[static_cast<int>(j)];
  const V3d scaled = linear.inverse().direction({-(*m)[3], -(*m)[7], -(*m)[11]});
  const V3d place = scaled / world.scale + world.middle;
  Transform result;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) result.m[i][j] = rows[i][static_cast<int>(j)];
    result.m[i][3] = -rows[i].dot(place);
  }
  return result;
}

}  // namespace kagefude
