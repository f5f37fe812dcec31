#include "compositor/position_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "base/error.h"
#include "frame/rebuild_positions.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

[[noreturn]] void refuse(const AovNames& names, const FramePlan& plan, const std::string& depth,
                         const std::string& fault) {
  try {
    requireAov(plan.image, names, AovKind::position);
  } catch (const InputError& missing) {
    throw InputError(
        fmt::format("{}; nor can positions be rebuilt from {}: {}", missing.what(), depth, fault));
  }
  throw InputError(fmt::format("{}: {}", plan.image.path.string(), fault));
}

bool isHalf(const ImageFile& file, const Aov& depth) {
  const Channel* channel = file.findChannel(depth.channels.at(0));
  return channel && channel->type == PixelType::half;
}

}  // namespace

void planPositions(const AovNames& names, FramePlan& plan) {
  if (auto position = findAov(plan.image, names, AovKind::position)) {
    plan.position = *std::move(position);
    return;
  }
  const auto depth = findAov(plan.image, names, AovKind::depth);
  if (!depth) requireAov(plan.image, names, AovKind::position);
  const std::string fault = rebuildFault(plan.spaces);
  if (!fault.empty()) refuse(names, plan, depth->name, fault);
  plan.position = *depth;
  plan.spaces.rebuilt = true;
  plan.warnings.push_back(
      fmt::format("there is no Position pass; positions are rebuilt from {}, taken as {}, and {}{}",
                  depth->name, depthKindNames[static_cast<size_t>(plan.spaces.measuredAlong())],
                  plan.spaces.camera->source,
                  isHalf(plan.image, *depth)
                      ? "; it is of half precision, whose steps of a two-thousandth roughen "
                        "penumbras: render it as float"
                      : ""));
}

void requestPositions(ChannelReader& reader, const FramePlan& plan, PositionPass& pass) {
  const auto& channels = plan.position.channels;
  if (plan.spaces.rebuilt) {
    reader.floats(channels.at(0), pass.depth);
    return;
  }
  reader.floats(channels.at(0), pass.given.x);
  reader.floats(channels.at(1), pass.given.y);
  reader.floats(channels.at(2), pass.given.z);
}

Vec3Plane takePositions(const FramePlan& plan, PositionPass& pass) {
  if (!plan.spaces.rebuilt) return std::move(pass.given);
  const Floats depth = std::move(pass.depth);
  return rebuildPositions(depth, plan.spaces, plan.image);
}

void clearWithoutDepth(const FramePlan& plan, FramePlanes& planes) {
  if (!plan.spaces.rebuilt) return;
  std::atomic<size_t> seen = 0, cleared = 0;
  parallelRows(planes.height, [&](int first, int end) {
    size_t ownSeen = 0, ownCleared = 0;
    for (int y = first; y < end; ++y)
      for (int x = 0; x < planes.width; ++x) {
        if (planes.objectId(x, y) == 0) continue;
        ++ownSeen;
        if (planes.position.view()(x, y) != V3f(0.0f)) continue;
        ++ownCleared;
        planes.objectId(x, y) = 0;
      }
    seen += ownSeen;
    cleared += ownCleared;
  });
  constexpr double ofEdges = 0.05;
  const auto share = static_cast<double>(cleared) / static_cast<double>(std::max<size_t>(seen, 1));
  if (share <= ofEdges) return;
  const std::string what = fmt::format(
      "{} is no place (0, negative, or above 9e9) in {} of the pixels that show objects",
      plan.position.name, cleared == seen ? "all" : fmt::format("{:.0f} %", 100 * share));
  if (cleared == seen) throw InputError(fmt::format("{}: {}", plan.image.path.string(), what));
  planes.warnings.push_back(what + ", so these stay unpainted");
}

}  // namespace kagefude
