#include "frame/sample_frame.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/temp_file.h"
#include "exr/write_image.h"
#include "image/parallel.h"
#include "image/real_math.h"
#include "image/vec.h"

namespace kagefude {
namespace {

constexpr int spheres = 20, masks = 9;
constexpr float lightRadius = 1.2f, tangent = 0.36f;  // of half the camera's vertical angle

const V3f cameraPlace(0, -15, 8), lightPlace(-5, -4, 9);

struct Sphere {
  V3f centre;
  float radius;
};

std::array<Sphere, spheres> makeSpheres() {
  std::array<Sphere, spheres> all;
  for (int i = 0; i < spheres; ++i) {
    const float radius = 0.4f + 0.05f * static_cast<float>(i * 7 % 11);
    const float x = static_cast<float>(i % 5) * 2.6f - 5.2f + 0.3f * static_cast<float>(i / 5 % 2);
    all[static_cast<size_t>(i)] = {{x, static_cast<float>(i / 5) * 2.8f - 4, radius}, radius};
  }
  return all;
}

/// Nearest distance along a unit direction at which a ray enters the sphere; negative: never.
float enters(const Sphere& s, const V3f& from, const V3f& direction) {
  const V3f away = from - s.centre;
  const float along = away.dot(direction);
  const float under = along * along - away.dot(away) + s.radius * s.radius;
  return under < 0 ? -1.0f : -along - std::sqrt(under);
}

struct Axes {
  V3f x, y, z;
};

Axes axesAlong(const V3f& forward) {
  const V3f x = forward.cross(V3f(0, 0, 1)).normalized();
  return {x, x.cross(forward), -forward};
}

struct Hit {
  uint32_t object = 0;  ///< 0: none; 1: the floor; then the spheres
  V3f place{0, 0, 0}, normal{0, 0, 0};
};

class Scene {
 public:
  Hit trace(const V3f& direction) const {
    Hit hit;
    float nearest = direction.z < -1e-4f ? -cameraPlace.z / direction.z : 1e30f;
    if (nearest < 60) hit = {1, cameraPlace + direction * nearest, V3f(0, 0, 1)};
    for (size_t i = 0; i < spheres_.size(); ++i) {
      const float distance = enters(spheres_[i], cameraPlace, direction);
      if (distance <= 0 || distance >= nearest) continue;
      nearest = distance;
      const V3f place = cameraPlace + direction * distance;
      hit = {static_cast<uint32_t>(i) + 2, place,
             (place - spheres_[i].centre) / spheres_[i].radius};
    }
    return hit;
  }

  bool sees(const Hit& hit, const V3f& light) const {
    const V3f all = light - hit.place;
    const float far = all.length();
    const V3f direction = all / far;
    if (hit.normal.dot(direction) <= 0) return false;
    const V3f from = hit.place + hit.normal * 1e-3f;
    for (const Sphere& s : spheres_) {
      const float distance = enters(s, from, direction);
      if (distance > 0 && distance < far) return false;
    }
    return true;
  }

  const std::array<Sphere, spheres>& all() const { return spheres_; }

 private:
  std::array<Sphere, spheres> spheres_ = makeSpheres();
};

/// The light's centre and eight places on its rim.
V2f placeOnLight(int i) {
  if (i == 0) return {0, 0};
  const SinCos turn = sinCosTurns(static_cast<float>(i - 1) / 8);
  return {turn.cos, turn.sin};
}

V3f maskLight(int i) {
  const Axes axes = axesAlong(-lightPlace.normalized());
  const V2f at = placeOnLight(i) * lightRadius;
  return lightPlace + axes.x * at.x + axes.y * at.y;
}

/// The planes of the frame, in the order of its channels.
struct Planes {
  std::vector<std::string> names;
  std::vector<Floats> planes;

  Planes(int width, int height) {
    for (const char* name :
         {"beauty.Combined.R", "beauty.Combined.G", "beauty.Combined.B", "beauty.Combined.A",
          "data.Position.X", "data.Position.Y", "data.Position.Z", "data.Normal.X", "data.Normal.Y",
          "data.Normal.Z", "data.IndexOB.V"})
      names.emplace_back(name);
    for (int i = 0; i < masks; ++i) names.push_back(fmt::format("mask.Key.{}.V", i));
    for (size_t i = 0; i < names.size(); ++i) planes.emplace_back(width, height, 0.0f);
  }

  void set(int x, int y, size_t first, const V3f& value) {
    for (size_t i = 0; i < 3; ++i) planes[first + i](x, y) = value[static_cast<int>(i)];
  }
};

void shade(const Scene& scene, const Hit& hit, int x, int y, Planes& out) {
  int seen = 0;
  for (int i = 0; i < masks; ++i) {
    const bool lit = scene.sees(hit, maskLight(i));
    seen += lit;
    out.planes[11 + static_cast<size_t>(i)](x, y) = lit ? 1.0f : 0.0f;
  }
  const float facing = std::max(0.0f, hit.normal.dot((lightPlace - hit.place).normalized()));
  const float light = 0.1f + 0.9f * facing * static_cast<float>(seen) / masks;
  const auto hue = static_cast<float>(hit.object * 5 % 21) / 21;
  out.set(x, y, 0, V3f(0.3f + 0.5f * hue, 0.5f, 0.8f - 0.5f * hue) * light);
  out.planes[3](x, y) = 1.0f;
  out.set(x, y, 4, hit.place);
  out.set(x, y, 7, hit.normal);
  out.planes[10](x, y) = static_cast<float>(hit.object);
}

using Json = nlohmann::ordered_json;

Json vector(const V3f& v) { return {v.x, v.y, v.z}; }

Json matrix(const Axes& axes, const V3f& place) {
  Json rows = Json::array();
  for (const V3f& axis : {axes.x, axes.y, axes.z})
    rows.push_back({axis.x, axis.y, axis.z, -axis.dot(place)});
  rows.push_back({0, 0, 0, 1});
  return rows;
}

Json moved(const V3f& by) {
  return {{1, 0, 0, by.x}, {0, 1, 0, by.y}, {0, 0, 1, by.z}, {0, 0, 0, 1}};
}

Json lightJson() {
  const Axes axes = axesAlong(-lightPlace.normalized());
  Json samples = Json::array();
  for (int i = 0; i < masks; ++i)
    samples.push_back({{"layer", fmt::format("mask.Key.{}", i)},
                       {"uv", {placeOnLight(i).x, placeOnLight(i).y}},
                       {"position", vector(maskLight(i))}});
  return {{"name", "Key"},
          {"type", "point"},
          {"position", vector(lightPlace)},
          {"direction", vector(-lightPlace.normalized())},
          {"radius", lightRadius},
          {"color", {1, 1, 1}},
          {"energy", 1000},
          {"subject", {{"center", {0, 0, 0}}, {"radius", 8}}},
          {"axes", {{"u", vector(axes.x)}, {"v", vector(axes.y)}}},
          {"masks", {{"arrangement", "disc"}, {"offset", lightRadius}, {"samples", samples}}}};
}

Json objectJson(const std::string& name, int index, const V3f& centre, const V3f& half) {
  return {{"name", name},
          {"index", index},
          {"crypto", fmt::format("{:08x}", 0x3f000000 + index)},
          {"world_from_object", moved(centre)},
          {"bounds", {{"min", vector(-half)}, {"max", vector(half)}}},
          {"reference_point", vector(centre)},
          {"reference_points", Json::array()},
          {"materials", Json::array()},
          {"flat", half.z == 0}};
}

std::string sidecarText(const std::filesystem::path& exr, int width, int height,
                        const Scene& scene) {
  const V3f forward = -cameraPlace.normalized();
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  Json objects = Json::array({objectJson("Floor", 1, {0, 0, 0}, {60, 60, 0})});
  for (int i = 0; i < spheres; ++i) {
    const Sphere& s = scene.all()[static_cast<size_t>(i)];
    objects.push_back(objectJson(fmt::format("Sphere {}", i + 1), i + 2, s.centre,
                                 V3f(s.radius, s.radius, s.radius)));
  }
  const Json camera = {{"type", "perspective"},
                       {"position", vector(cameraPlace)},
                       {"direction", vector(forward)},
                       {"camera_from_world", matrix(axesAlong(forward), cameraPlace)},
                       {"clip_from_camera",
                        {{1 / (tangent * aspect), 0, 0, 0},
                         {0, 1 / tangent, 0, 0},
                         {0, 0, -1, -0.2},
                         {0, 0, -1, 0}}}};
  const Json all = {{"kagefude", 1},
                    {"frame", 1},
                    {"fps", 24},
                    {"image", exr.filename().string()},
                    {"resolution", {width, height}},
                    {"pixel_aspect", 1},
                    {"layers", {{"data", "data"}, {"beauty", "beauty"}}},
                    {"camera", camera},
                    {"lights", Json::array({lightJson()})},
                    {"objects", objects},
                    {"materials", Json::array()}};
  return all.dump(1);
}

}  // namespace

void writeSampleFrame(const std::filesystem::path& exr, int width, int height) {
  const Scene scene;
  const Axes camera = axesAlong(-cameraPlace.normalized());
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  Planes planes(width, height);
  parallelRows(height, 4, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        const float u = (2 * (static_cast<float>(x) + 0.5f) / static_cast<float>(width) - 1);
        const float v = (1 - 2 * (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
        const V3f direction =
            camera.x * (u * tangent * aspect) + camera.y * (v * tangent) - camera.z;
        const Hit hit = scene.trace(direction.normalized());
        if (hit.object) shade(scene, hit, x, y, planes);
      }
  });
  OutputImage image;
  image.dataWindow = image.displayWindow = {0, 0, width, height};
  for (size_t i = 0; i < planes.names.size(); ++i)
    image.channels.push_back(floatChannel(planes.names[i], PixelType::single, planes.planes[i]));
  writeExr(exr, image);
  writeFileAtomically(std::filesystem::path(exr).replace_extension(".json"),
                      sidecarText(exr, width, height, scene));
}

}  // namespace kagefude
