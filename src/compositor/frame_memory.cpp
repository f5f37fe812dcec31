#include "compositor/frame_memory.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <map>

#include "compositor/output_layers.h"
#include "compositor/own_lights.h"

namespace kagefude {
namespace {

// Bytes a pixel. Surfaces while they are found, and with their joins as they are kept; of a light,
// visibility as it is and smoothed, its confidence, shade and reach; of strokes, places and joins,
// and lines while they are drawn; what the allocator keeps of one stage while the next begins, and
// of composing while a frame is written.
constexpr size_t ofSurfaces = 9;
constexpr size_t ofLight = 24;
constexpr size_t ofStrokes = 3 + 24;
constexpr size_t ofChange = 8;
constexpr size_t ofWriting = 32;
constexpr size_t ofResult = 16;
constexpr size_t asHalf = 8;
constexpr size_t ofIds = 4;
constexpr size_t ofReadingIds = 16;  // two ranks of a Cryptomatte
constexpr size_t ofEdgeRanks = 33;   // four ranks of a Cryptomatte, if all are full
constexpr size_t ofWholeRanks = 24;  // three ranks, as readers other than the fast one hold them
constexpr size_t ofRanks = 40;       // a Cryptomatte that is ranked anew

// A ground of its own (widest: a painted sky, tooth on the world): the paint before things met, the
// ground and what it is made of, the tooth; and of painted edges the nearest borders and distances,
// and what pixels at borders know, a third of all at most.
constexpr size_t ofGround = 56, ofPaintedEdges = 46 + 38;
constexpr size_t ofTint = 12;
constexpr size_t ofTone = 4;
constexpr size_t ofOwnLights = 60;      // three pictures, a tone and an index
constexpr size_t ofSmoothNormals = 28;  // and the means of one width

/// Whether the look or a style has passes of which `which` holds.
template <class Which>
bool anyPasses(const Look& look, const Which& which) {
  return which(look.passes) ||
         std::any_of(look.styles.begin(), look.styles.end(),
                     [&](const StyleLook& style) { return which(style.passes); });
}

size_t groundBytes(const Look& look) {
  const Background background = look.output.background;
  const bool edges = anyPasses(look, [](const PassParams& p) { return p.edges.acts(); });
  const bool ground = edges || look.passes.paper.strength > 0 ||
                      (background != Background::beauty && background != Background::transparent);
  const bool tint = anyPasses(look, [](const PassParams& p) { return p.tint.light > 0; });
  const bool smooth =
      anyPasses(look, [](const PassParams& p) { return p.brush.smoothNormals > 0; });
  return (ground ? ofGround : 0) + (edges ? ofPaintedEdges : 0) + (tint ? ofTint : 0) +
         (smooth ? 2 * ofSmoothNormals : 0);
}

/// Planes that are read and kept as floats, or were made of such.
size_t floatBytes(const FramePlan& plan) {
  size_t floats = 4 * (3 + 3);
  if (plan.spaces.rebuilt) floats += 4 * (1 + 3);  // the depth, and what it would be otherwise
  if (plan.albedo) floats += 4 * 3;
  if (plan.rest) floats += 4 * (4 + 3);  // and the places that it gives
  if (plan.uv) floats += 4 * 2;
  if (plan.uv && !plan.rest) floats += 4 * 3;
  if (plan.instanceRandom) floats += 4;
  if (plan.emission) floats += 4 * 3;
  if (plan.beauty) floats += 4 * 4;
  if (!plan.lines.empty()) floats += 4 * 4;
  if (!plan.meanNormal.empty()) floats += 4 * 3;
  if (plan.depth) floats += 4;
  for (const FrameLight& light : plan.lights)
    if (!light.tracedChannel.empty()) floats += 4;
  return floats;
}

size_t inputBytes(const FramePlan& plan) {
  size_t bytes = 0;
  for (const Channel& channel : plan.image.channels)
    bytes += channel.type == PixelType::half ? 2 : 4;
  return bytes;
}

/// What a light's method needs at work; lights follow each other.
size_t methodBytes(const FrameLight& light) {
  const ShadowMethodEntry& method = entryOf(light.method);
  const size_t masks =
      method.cutsMasks ? static_cast<size_t>(light.castPlaces) : light.maskChannels.size();
  return method.bytes.perPixel + method.bytes.perMask * masks;
}

/// Chunks of EXR rows that threads unpack or pack at the same time: raw, split, predicted and
/// packed, and those that wait for their turn to be written.
size_t chunkBytes(const FramePlan& plan, size_t bytesPerPixel) {
  constexpr size_t rows = 16, copies = 6;
  const auto threads = static_cast<size_t>(tbb::this_task_arena::max_concurrency());
  return rows * copies * threads * bytesPerPixel * static_cast<size_t>(plan.image.width);
}

size_t depthMapBytes(const FramePlan& plan) {
  size_t bytes = 0;
  for (const FrameLight& light : plan.lights) {
    std::error_code unknown;
    if (!light.readsDepthMap || !std::filesystem::exists(light.depthMap->file, unknown)) continue;
    const ImageFile map = openImage(light.depthMap->file);
    bytes += 4 * static_cast<size_t>(map.width) * static_cast<size_t>(map.height);
  }
  return bytes;
}

/// Every entry is placed in the world and joins the tree, so instances of one mesh count each. A
/// triangle takes at least 20 bytes of an OBJ, and 320 while the tree is built: its mesh, the tree
/// and the sorted edges.
size_t casterBytes(const FramePlan& plan) {
  constexpr size_t ofMeshFile = 16;
  const auto wantsCasters = [](const FrameLight& light) {
    return entryOf(light.method).needs.casters || light.method == ShadowMethod::blob;
  };
  if (!plan.hasCasters || std::none_of(plan.lights.begin(), plan.lights.end(), wantsCasters))
    return 0;
  std::map<std::filesystem::path, size_t> sizes;
  size_t bytes = 0;
  for (const SidecarCaster& entry : plan.sidecar->casters) {
    const auto [place, isNew] = sizes.try_emplace(entry.file);
    std::error_code missing;
    const auto size = isNew ? std::filesystem::file_size(entry.file, missing) : 0;
    if (isNew && !missing) place->second = ofMeshFile * size;
    bytes += place->second;
  }
  return bytes;
}

/// Of the pictures that are written, at most; they show the display window, whose claim is not
/// that of a file.
size_t pictureBytes(const FramePlan& plan, std::span<const PictureOutput> pictures) {
  size_t perPixel = 0;
  for (const PictureOutput& picture : pictures)
    perPixel = std::max(perPixel, pictureMemory(picture));
  constexpr int64_t mostPixels = int64_t{1} << 30;
  return perPixel * static_cast<size_t>(std::min(plan.image.displayWindow.pixels(), mostPixels));
}

}  // namespace

size_t frameMemory(const Look& look, const FramePlan& plan,
                   std::span<const PictureOutput> pictures) {
  size_t masks = 0, methods = 0;
  for (const FrameLight& light : plan.lights) {
    masks += light.maskChannels.size();
    methods = std::max(methods, methodBytes(light));
  }
  const size_t floats = floatBytes(plan);
  const size_t ids = plan.materialId ? 2 * ofIds : ofIds;
  const size_t layers = layerBytes(look, plan.lights);
  const size_t edges = plan.coverage ? ofEdgeRanks : 0;
  const size_t tones = 4 * plan.lights.size();
  const size_t own = paintsOwnLights(look, plan) ? ofOwnLights : 0;
  const size_t input = inputBytes(plan);
  const size_t passed = look.output.passthrough ? input : 0;

  // Readers other than the fast one hold masks as floats first, and sparse ranks whole.
  const size_t reading =
      floats + 5 * masks + ids + ofReadingIds + edges + (plan.coverage ? ofWholeRanks : 0);
  const auto area = static_cast<size_t>(look.output.scale) * static_cast<size_t>(look.output.scale);
  const size_t scaling = area > 1 ? ofIds + (ofResult + layers + ofIds) / area : 0;
  const size_t composed = floats + edges + layers + tones + ofTone;
  const size_t lighting = composed + masks + ids + ofSurfaces + ofLight + methods;
  const size_t painting =
      composed + ofStrokes + ofIds + ofResult + own + scaling + groundBytes(look);
  const size_t written = (ofResult + asHalf + layers) / area;
  const size_t writing = written + passed + (area > 1 ? passed / area + ofRanks : 0);
  const size_t pixels =
      static_cast<size_t>(plan.image.width) * static_cast<size_t>(plan.image.height);
  const size_t before = (std::max({reading, lighting, painting}) + ofChange) * pixels;
  const size_t after = (writing + ofWriting) * pixels + pictureBytes(plan, pictures) / area;
  return std::max(before, after) + depthMapBytes(plan) + casterBytes(plan) +
         chunkBytes(plan, std::max(input, asHalf + layers + passed));
}

}  // namespace kagefude
