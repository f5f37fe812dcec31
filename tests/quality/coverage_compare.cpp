// Compares coverage with a trace of the same frame at eight times the resolution, one sample in the
// middle of each of its pixels: exactly the 8x8 sub-pixels. Prints one line of the table and writes
// a picture of both and their difference. Leaves 1 when a demand is missed.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "frame/casters.h"
#include "passes/casters/coverage.h"
#include "passes/casters/shadow_volume.h"
#include "side_by_side.h"

namespace kagefude {
namespace {

using Json = nlohmann::json;

/// Sub-pixels whose surface is this near to edge-on to the light are at the terminator, where a
/// renderer's shading normals and ray offsets decide.
constexpr double terminator = 0.1;

Floats channelOf(const std::string& path, const std::vector<std::string>& names) {
  OIIO::ImageBuf image(path);
  if (!image.read(0, 0, true, OIIO::TypeFloat)) throw InputError(image.geterror());
  for (const std::string& name : names) {
    const int channel = image.spec().channelindex(name);
    if (channel < 0) continue;
    const OIIO::ImageBuf single = OIIO::ImageBufAlgo::channels(image, 1, {channel});
    Floats plane(image.spec().width, image.spec().height);
    single.get_pixels(OIIO::ROI::All(), OIIO::TypeFloat, plane.row(0));
    return plane;
  }
  throw InputError(fmt::format("{} has no channel {}", path, names.front()));
}

Vec3Plane vectorOf(const std::string& path, const std::string& pass) {
  Vec3Plane result;
  result.x = channelOf(path, {pass + ".X"});
  result.y = channelOf(path, {pass + ".Y"});
  result.z = channelOf(path, {pass + ".Z"});
  return result;
}

Floats idsOf(const std::string& path) {
  return channelOf(path, {"data.IndexOB.V", "data.IndexOB.X"});
}

Transform transformOf(const Json& rows) {
  Transform t;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) t.m[i][j] = rows[i][j];
  return t;
}

V3d vectorOf(const Json& v) { return {v[0], v[1], v[2]}; }

struct Truth {
  Floats coverage;  ///< negative where no sub-pixel shows a surface
  Bytes atTerminator, silhouette;
};

Truth truthOf(const std::string& path, int width, int height, const V3d& light) {
  const Floats mask =
      channelOf(path, {"mask.Key.0.V", "mask.Key.0.Shadow.R", "mask.Key.0.X", "mask.Key.0.R"});
  const Floats ids = idsOf(path);
  const Vec3Plane position = vectorOf(path, "data.Position");
  const Vec3Plane normal = vectorOf(path, "data.Normal");
  if (mask.width() != 8 * width || mask.height() != 8 * height)
    throw InputError(fmt::format("{} is not eight times as large as the frame", path));
  Truth truth{Floats(width, height), Bytes(width, height, uint8_t{0}),
              Bytes(width, height, uint8_t{0})};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      int seen = 0, hidden = 0;
      for (int k = 0; k < 64; ++k) {
        const int column = 8 * x + k % 8, row = 8 * y + k / 8;
        if (ids(column, row) != ids(8 * x, 8 * y)) truth.silhouette(x, y) = 1;
        if (ids(column, row) == 0) continue;
        ++seen;
        hidden += mask(column, row) < 0.5f;
        const V3d toLight = (light - V3d(position.view()(column, row))).normalized();
        if (std::fabs(V3d(normal.view()(column, row)).dot(toLight)) < terminator)
          truth.atTerminator(x, y) = 1;
      }
      truth.coverage(x, y) = seen == 0 ? -1.0f : float(hidden) / float(seen);
    }
  return truth;
}

/// Edge pixels are those whose 64 samples do not agree on the object or on the light; elsewhere one
/// sub-pixel's difference counts as right, more as wrong.
bool report(const std::string& name, const Truth& truth, const Floats& coverage, const Labels& ids,
            size_t triangles, double seconds) {
  double errors = 0, worst = 0, silhouetteErrors = 0;
  int edges = 0, wrong = 0, off = 0, skipped = 0, silhouettes = 0;
  for (int y = 0; y < coverage.height(); ++y)
    for (int x = 0; x < coverage.width(); ++x) {
      const float expected = truth.coverage(x, y);
      if (expected < 0 || ids(x, y) == 0) continue;
      if (truth.atTerminator(x, y)) {
        ++skipped;
        continue;
      }
      const double error = std::fabs(coverage(x, y) - expected);
      if ((expected > 0 && expected < 1) || truth.silhouette(x, y)) {
        ++edges;
        errors += error;
        worst = std::max(worst, error);
        if (truth.silhouette(x, y)) {
          ++silhouettes;
          silhouetteErrors += error;
        }
      } else {
        ++off;
        wrong += error > 1.5 / 64;
      }
    }
  const double mean = edges ? errors / edges : 0;
  fmt::print("| {} | {} | {} | {:.5f} | {:.3f} | {} | {:.5f} | {} of {} | {} | {:.2f} |\n", name,
             triangles, edges, mean, worst, silhouettes,
             silhouettes ? silhouetteErrors / silhouettes : 0.0, wrong, off, skipped, seconds);
  return edges > 0 && mean <= 1.0 / 64 && wrong == 0;
}

bool compare(const std::string& name, const std::string& frame, const std::string& fine,
             const std::string& picture, bool volume) {
  const std::string sidecar = frame.substr(0, frame.size() - 4) + ".json";
  const Json json = Json::parse(std::ifstream(sidecar));
  const Vec3Plane position = vectorOf(frame, "data.Position");
  const Vec3Plane normal = vectorOf(frame, "data.Normal");
  const Floats index = idsOf(frame);
  Labels ids(index.width(), index.height());
  for (int y = 0; y < ids.height(); ++y)
    for (int x = 0; x < ids.width(); ++x) ids(x, y) = static_cast<uint32_t>(index(x, y));
  std::map<std::string, uint32_t> idOf;
  for (const Json& object : json["objects"]) idOf[object["name"]] = object["index"];
  const FrameCasters read = readCasters(readSidecar(sidecar), idOf);
  for (const std::string& warning : read.warnings) fmt::print("warning: {}\n", warning);
  size_t triangles = 0;
  for (const CasterMesh& mesh : read.meshes) triangles += mesh.triangles.size();
  const Json& camera = json["camera"];
  const SeenSurface seen{
      position, normal, ids,
      cameraRays(transformOf(camera["clip_from_camera"]), transformOf(camera["camera_from_world"]),
                 vectorOf(camera["position"]), camera["type"] == "orthographic",
                 V2f(float(ids.width()), float(ids.height())), {0, 0, ids.width(), ids.height()})};
  const LightPlace light{false, vectorOf(json["lights"][0]["position"]), V3d(0, 0, -1)};
  const auto start = std::chrono::steady_clock::now();
  const CasterSet casters(read.meshes);
  const Floats coverage = volume ? shadowVolume(seen, read.meshes, casters, light, {})
                                 : shadowCoverage(seen, casters, light, {});
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  Truth truth = truthOf(fine, ids.width(), ids.height(), light.position);
  const bool kept =
      report(name + (volume ? " (volume)" : ""), truth, coverage, ids, triangles, time.count());
  // A pixel whose centre shows background has no surface to cut.
  for (int y = 0; y < ids.height(); ++y)
    for (int x = 0; x < ids.width(); ++x)
      if (ids(x, y) == 0) truth.coverage(x, y) = -1;
  writeSideBySide(picture, name + (volume ? ", volume" : ", coverage"), coverage, truth.coverage,
                  truth.atTerminator);
  return kept;
}

}  // namespace
}  // namespace kagefude

int main(int count, char** words) {
  if (count != 6) {
    fmt::print(stderr,
               "usage: coverage_compare NAME FRAME.exr FINE.exr PICTURE.png coverage|volume\n");
    return 2;
  }
  try {
    return kagefude::compare(words[1], words[2], words[3], words[4],
                             std::string(words[5]) == "volume")
               ? 0
               : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 2;
  }
}
