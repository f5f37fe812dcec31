#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>
#include <malloc.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>

#include "passes/casters/coverage.h"

// Coverage of a 2K frame against tracing 64 shadow rays a pixel with Embree, which is given the
// same surface points: the pixel's plane at 8x8 sub-pixels, from P and N.
namespace kagefude {
namespace {

constexpr int width = 2048, height = 1080;

/// `count` x 2*count triangles on a torus over the ground, and the ground's two.
CasterMesh torus(int around, int across) {
  CasterMesh mesh{"torus", 2, {}, {}};
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * M_PI * i / around, v = 2 * M_PI * j / across;
      const double bump = 0.4 + 0.06 * std::sin(9 * u) * std::sin(5 * v);
      const double r = 1.2 + bump * std::cos(v);
      mesh.vertices.push_back({float(r * std::cos(u)), float(r * std::sin(u) * 0.8),
                               float(0.9 + bump * std::sin(v) + 0.4 * std::sin(u))});
    }
  const auto at = [&](int i, int j) {
    return static_cast<uint32_t>((i % around) * across + j % across);
  };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

struct Frame {
  std::vector<CasterMesh> meshes;
  Vec3Plane position{width, height}, normal{width, height};
  Labels ids{width, height, 0u};
  CameraRays rays;
  RTCDevice device;
  RTCScene scene;

  explicit Frame(int triangles) {
    const int across = static_cast<int>(std::sqrt(triangles / 6.0));
    meshes = {
        torus(triangles / 2 / across, across),
        {"ground", 1, {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}, {{0, 1, 2}, {0, 2, 3}}}};
    makeScene();
    makeCamera();
    tbb::parallel_for(0, height, [&](int y) {
      for (int x = 0; x < width; ++x) makePixel(x, y);
    });
  }
  ~Frame() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  void makeScene() {
    device = rtcNewDevice("");
    scene = rtcNewScene(device);
    for (const CasterMesh& mesh : meshes) {
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
      auto* vertices = static_cast<V3f*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX,
                                                                 0, RTC_FORMAT_FLOAT3, sizeof(V3f),
                                                                 mesh.vertices.size()));
      std::copy(mesh.vertices.begin(), mesh.vertices.end(), vertices);
      auto* triangles = static_cast<std::array<uint32_t, 3>*>(
          rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                  3 * sizeof(uint32_t), mesh.triangles.size()));
      std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
      rtcCommitGeometry(geometry);
      rtcAttachGeometryByID(scene, geometry, mesh.id);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene);
  }

  void makeCamera() {
    const V3d eye(0, -6, 4);
    const V3d z = (eye - V3d(0, 0, 0.4)).normalized();
    const V3d x = V3d(0, 0, 1).cross(z).normalized(), y = z.cross(x);
    const double opening = 0.5;
    rays.eye = eye;
    rays.directionX = x * (2 * opening / width);
    rays.directionY = -y * (2 * opening / width);
    rays.direction0 = -z - rays.directionX * (width / 2) - rays.directionY * (height / 2);
  }

  void makePixel(int x, int y) {
    const V3d d = rays.direction(x + 0.5, y + 0.5);
    RTCRayHit hit{};
    hit.ray = {float(rays.eye.x),
               float(rays.eye.y),
               float(rays.eye.z),
               0,
               float(d.x),
               float(d.y),
               float(d.z),
               0,
               std::numeric_limits<float>::infinity(),
               ~0u,
               0,
               0};
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &hit);
    const bool found = hit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    ids(x, y) = found ? hit.hit.geomID : 0;
    position.set(x, y, found ? V3f(rays.eye + d * double(hit.ray.tfar)) : V3f(0.0f));
    normal.set(x, y,
               found ? V3f(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z).normalized() : V3f(0.0f));
  }

  SeenSurface seen() const { return {position, normal, ids, rays}; }
};

const LightPlace light{false, {2.5, 1.5, 6}, {0, 0, -1}};

/// 64 occlusion rays a pixel in packets of 16, from the pixel's plane a little towards the light.
Floats tracedCoverage(const Frame& frame) {
  Floats result(width, height, 0.0f);
  tbb::parallel_for(0, height, [&](int y) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) RTCRay16 packet;
    alignas(64) int valid[16];
    std::fill_n(valid, 16, -1);
    for (int x = 0; x < width; ++x) {
      if (frame.ids(x, y) == 0) continue;
      const V3f n = frame.normal.view()(x, y);
      const V3f p(V3d(frame.position.view()(x, y)) - frame.rays.eye);
      const float numerator = p.dot(n);
      int hidden = 0;
      for (int first = 0; first < 64; first += 16) {
        for (int k = 0; k < 16; ++k) {
          const int s = first + k;
          const V3f d(frame.rays.direction(x + (s % 8 + 0.5) / 8, y + (s / 8 + 0.5) / 8));
          const V3f q = V3f(frame.rays.eye) + d * (numerator / d.dot(n));
          const V3f toLight = V3f(light.position) - q;
          packet.org_x[k] = q.x;
          packet.org_y[k] = q.y;
          packet.org_z[k] = q.z;
          packet.dir_x[k] = toLight.x;
          packet.dir_y[k] = toLight.y;
          packet.dir_z[k] = toLight.z;
          packet.tnear[k] = 1e-4f;
          packet.tfar[k] = 1.0f;
          packet.time[k] = 0;
          packet.mask[k] = ~0u;
          packet.flags[k] = 0;
        }
        rtcOccluded16(valid, frame.scene, &context, &packet);
        for (int k = 0; k < 16; ++k) hidden += packet.tfar[k] < 0;
      }
      result(x, y) = static_cast<float>(hidden) / 64;
    }
  });
  return result;
}

const Frame& frameOf(int triangles) {
  static const Frame small(20000), large(200000);
  return triangles == 20000 ? small : large;
}

void coverage(benchmark::State& state) {
  const Frame& frame = frameOf(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const CasterSet casters(frame.meshes);
    benchmark::DoNotOptimize(shadowCoverage(frame.seen(), casters, light, {}));
  }
}

/// A line of /proc/self/status, in bytes.
double memoryOf(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key)) return 1024 * std::stod(line.substr(key.size()));
  return 0;
}

/// The process's peak over what it held before, with the tree, the volumes and the result, and
/// with the planes that the pass reads, by pixels.
void coverageMemory(benchmark::State& state) {
  const Frame& frame = frameOf(static_cast<int>(state.range(0)));
  constexpr double pixels = double(width) * height, inputs = 7 * sizeof(float);
  for (auto _ : state) {
    releaseKeptPlaneMemory();
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";  // starts the peak anew
    const double before = memoryOf("VmRSS:");
    const CasterSet casters(frame.meshes);
    benchmark::DoNotOptimize(shadowCoverage(frame.seen(), casters, light, {}));
    state.counters["bytes_per_pixel"] = (memoryOf("VmHWM:") - before) / pixels + inputs;
  }
}

void embree64(benchmark::State& state) {
  const Frame& frame = frameOf(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(tracedCoverage(frame));
}

void masksOfNinePlaces(benchmark::State& state) {
  const Frame& frame = frameOf(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const CasterSet casters(frame.meshes);
    for (int k = 0; k < 9; ++k) {
      LightPlace place = light;
      place.position.x += 0.03 * k;
      benchmark::DoNotOptimize(hardShadowMask(frame.seen(), casters, place, {}));
    }
  }
}

BENCHMARK(coverageMemory)->Arg(20000)->Iterations(1);
BENCHMARK(coverage)
    ->Arg(20000)
    ->Arg(200000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK(embree64)
    ->Arg(20000)
    ->Arg(200000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK(masksOfNinePlaces)
    ->Arg(20000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace kagefude
