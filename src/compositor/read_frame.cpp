#include "compositor/read_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/error.h"
#include "base/nearest_name.h"
#include "compositor/casting_scene.h"
#include "compositor/doubt_bounds.h"
#include "compositor/doubt_depth_map.h"
#include "compositor/doubt_mean_normals.h"
#include "compositor/mend_coverage.h"
#include "compositor/position_pass.h"
#include "compositor/read_depth_map.h"
#include "compositor/rest_pass.h"
#include "compositor/unknown_light.h"
#include "compositor/unseen_things.h"
#include "exr/read_channels.h"
#include "frame/cryptomatte.h"
#include "frame/frame_view.h"
#include "frame/rebuild_positions.h"
#include "frame/sanitise.h"
#include "image/parallel.h"
#include "passes/tone/tint.h"

namespace kagefude {
namespace {

/// Ids as they are read: a Cryptomatte's ranks, or an index pass as numbers.
struct RequestedIds {
  CoveragePlanes matte;
  Floats index;
  Labels whole;  ///< an index pass of whole numbers, which a float would round above 2^24
};

void requestVector(ChannelReader& reader, const Aov& aov, Vec3Plane& planes) {
  reader.floats(aov.channels.at(0), planes.x);
  reader.floats(aov.channels.at(1), planes.y);
  reader.floats(aov.channels.at(2), planes.z);
}

bool isWhole(const ImageFile& file, const std::string& channelName) {
  const Channel* channel = file.findChannel(channelName);
  return channel && channel->type == PixelType::uint;
}

void requestIds(ChannelReader& reader, const Aov& aov, IdSource source, RequestedIds& ids) {
  if (source == IdSource::cryptomatte)
    requestCoverage(reader, aov.name, dominantRanks, ids.matte);
  else if (isWhole(reader.file(), aov.channels.at(0)))
    reader.bits(aov.channels.at(0), ids.whole);
  else
    reader.floats(aov.channels.at(0), ids.index);
}

void requestMasks(ChannelReader& reader, const FrameLight& light, LightPlanes& planes) {
  planes.unknown.resize(light.maskChannels.size());
  for (size_t k = 0; k < light.maskChannels.size(); ++k)
    reader.mask(light.maskChannels[k], planes.masks.emplace_back(), planes.unknown[k]);
}

Labels idsFrom(RequestedIds& ids, IdSource source, const Aov& aov, FramePlanes& planes) {
  if (source == IdSource::cryptomatte) {
    noteMended(aov.name, mendNamed(planes.normal, ids.matte), planes.warnings);
    return dominantIds(ids.matte);
  }
  return ids.whole.empty() ? roundIndices(ids.index) : std::move(ids.whole);
}

/// Of colours that are not finite 0.
Floats luminancesOf(const Vec3Plane& colour) {
  Floats result(colour.x.width(), colour.x.height());
  parallelRows(result.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < result.width(); ++x) {
        const float luminance = luminanceOf(colour.view()(x, y));
        result(x, y) = std::isfinite(luminance) ? luminance : 0.0f;
      }
  });
  return result;
}

/// An alpha that is 1 everywhere says no more than none.
bool isOpaque(const Floats& alpha) {
  if (alpha.empty()) return false;
  const float* const pixels = alpha.row(0);
  return std::all_of(pixels, pixels + alpha.view().pixels(), [](float a) { return a == 1.0f; });
}

/// A pixel without a normal shows no surface, whatever its id says.
void clearWithoutNormal(FramePlanes& planes) {
  parallelRows(planes.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < planes.width; ++x)
        if (planes.normal.view()(x, y) == V3f(0.0f)) planes.objectId(x, y) = 0;
  });
}

/// Calls clear(x, y) where a channel's part does not reach: a cropped part is empty around it.
template <class Clear>
void clearOutside(const FramePlan& plan, const std::string& name, const Clear& clear) {
  const Channel* channel = plan.image.findChannel(name);
  const Window& whole = plan.image.dataWindow;
  const Window& own = plan.image.parts[static_cast<size_t>(channel->part)].dataWindow;
  if (own == whole) return;
  const int left = own.x - whole.x, top = own.y - whole.y;
  parallelRows(whole.height, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < whole.width; ++x)
        if (x < left || y < top || x >= left + own.width || y >= top + own.height) clear(x, y);
  });
}

/// Where there is no position nothing is seen; a mean that is not there is not known.
void clearOutside(const FramePlan& plan, FramePlanes& planes) {
  clearOutside(plan, plan.position.channels.front(),
               [&](int x, int y) { planes.objectId(x, y) = 0; });
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  for (const std::string& name : plan.meanNormal)
    clearOutside(plan, name, [&](int x, int y) { planes.meanNormal.x(x, y) = unknown; });
}

/// A reading that the look can set stops the frame; what nothing explains is said.
void checkSpaces(const FramePlan& plan, FramePlanes& planes) {
  SpaceDoubt doubt =
      doubtSpaces(plan.spaces, plan.image, planes.position, planes.normal, planes.objectId);
  if (!doubt.known) {
    SpaceDoubt nearer = doubtDepth(plan.spaces, planes.position, planes.normal, planes.objectId);
    if (!nearer.sentence.empty()) doubt = std::move(nearer);
  }
  if (doubt.known)
    throw InputError(fmt::format("{}: {}", plan.image.path.string(), doubt.sentence));
  if (!doubt.sentence.empty()) planes.warnings.push_back(doubt.sentence);
  if (std::string outside = doubtBounds(plan, planes); !outside.empty())
    planes.warnings.push_back(std::move(outside));
}

void clearIds(const std::set<uint32_t>& unpainted, std::span<uint32_t> ids) {
  for (uint32_t& id : ids)
    if (unpainted.count(id)) id = 0;
}

void clearIds(const std::set<uint32_t>& unpainted, View<uint32_t> ids) {
  parallelRows(ids.height, [&](int first, int end) {
    clearIds(unpainted, std::span(ids.row(first), ids.row(end)));
  });
}

/// A TIFF may hold colours by themselves; here they are multiplied by alpha, as EXR has them.
void multiplyStraightBeauty(const FramePlan& plan, FramePlanes& planes) {
  if (!plan.beauty || planes.alpha.empty()) return;
  const Channel* const red = plan.image.findChannel(plan.beauty->channels[0]);
  if (!plan.image.parts[static_cast<size_t>(red->part)].straight) return;
  for (Floats* colour : {&planes.beauty.x, &planes.beauty.y, &planes.beauty.z})
    parallelRows(colour->height(), [&](int first, int end) {
      for (int y = first; y < end; ++y)
        for (int x = 0; x < colour->width(); ++x) (*colour)(x, y) *= planes.alpha(x, y);
    });
}

/// Where an object is not painted, the beauty stands: cut, or with what lies behind it.
void clearUnpainted(const FramePlan& plan, FramePlanes& planes) {
  if (!plan.sidecar) return;
  std::set<uint32_t> unpainted, inCryptomatte;
  for (const SidecarObject& object : plan.sidecar->objects)
    if (!object.painted) {
      unpainted.insert(plan.idSource == IdSource::index ? object.index : object.cryptoId);
      inCryptomatte.insert(object.cryptoId);
    }
  if (unpainted.empty()) return;
  clearIds(unpainted, planes.objectId.view());
  if (planes.coverage.empty()) return;
  clearIds(inCryptomatte, planes.coverage.firstId.view());
  for (SparsePlane& ids : planes.coverage.otherIds)
    for (int y = 0; y < ids.height(); ++y) clearIds(inCryptomatte, ids.keptOf(y));
}

void noteUnseen(const FramePlan& plan, FramePlanes& planes) {
  const std::vector<std::string> unseen = unseenThings(plan, planes);
  if (unseen.empty()) return;
  planes.warnings.push_back(fmt::format(
      "things cover pixels but stand at no pixel's centre, so they are not painted and what is "
      "behind "
      "them is ({}): they are more than half see-through, or thinner than a pixel; make them more "
      "opaque, or export larger frames (--scale)",
      listNames(unseen)));
}

}  // namespace

FramePlanes readFramePlanes(const FramePlan& plan) {
  FramePlanes planes;
  ChannelReader reader(plan.image);
  PositionPass positions;
  requestPositions(reader, plan, positions);
  requestVector(reader, plan.normal, planes.normal);
  if (plan.albedo) requestVector(reader, *plan.albedo, planes.albedo);
  Floats restAlpha;
  if (plan.rest) {
    requestVector(reader, *plan.rest, planes.rest);
    if (plan.rest->channels.size() > 3) reader.floats(plan.rest->channels[3], restAlpha);
  }
  if (plan.uv) {
    reader.floats(plan.uv->channels.at(0), planes.u);
    reader.floats(plan.uv->channels.at(1), planes.v);
  }
  if (plan.instanceRandom)
    reader.floats(plan.instanceRandom->channels.at(0), planes.instanceRandom);
  Vec3Plane emission;
  if (plan.emission) requestVector(reader, *plan.emission, emission);
  if (plan.beauty) {
    requestVector(reader, *plan.beauty, planes.beauty);
    if (plan.beauty->channels.size() > 3) reader.floats(plan.beauty->channels[3], planes.alpha);
  }
  if (!plan.lines.empty()) {
    reader.floats(plan.lines[0], planes.lines.x);
    reader.floats(plan.lines[1], planes.lines.y);
    reader.floats(plan.lines[2], planes.lines.z);
    reader.floats(plan.lines[3], planes.linesAlpha);
  }
  if (plan.depth) reader.floats(plan.depth->channels.at(0), planes.depth);
  RequestedIds objects, materials;
  requestIds(reader, plan.objectId, plan.idSource, objects);
  if (plan.materialId) requestIds(reader, *plan.materialId, plan.materialSource, materials);
  if (plan.coverage) requestCoverage(reader, plan.coverage->name, edgeRanks, planes.coverage);
  if (!plan.meanNormal.empty()) {
    reader.floats(plan.meanNormal[0], planes.meanNormal.x);
    reader.floats(plan.meanNormal[1], planes.meanNormal.y);
    reader.floats(plan.meanNormal[2], planes.meanNormal.z);
  }
  planes.lights.resize(plan.lights.size());
  for (size_t i = 0; i < plan.lights.size(); ++i)
    requestMasks(reader, plan.lights[i], planes.lights[i]);
  std::vector<Floats> traced(plan.lights.size());
  for (size_t i = 0; i < traced.size(); ++i)
    if (!plan.lights[i].tracedChannel.empty())
      reader.floats(plan.lights[i].tracedChannel, traced[i]);
  reader.read();

  planes.position = takePositions(plan, positions);
  planes.width = planes.position.x.width();
  planes.height = planes.position.x.height();
  for (size_t i = 0; i < plan.lights.size(); ++i) {
    LightPlanes& own = planes.lights[i];
    own.traced = std::move(traced[i]);
    readDepthMapOf(plan.lights[i], own, planes.warnings);
  }
  planes.objectId = idsFrom(objects, plan.idSource, plan.objectId, planes);
  if (plan.materialId)
    planes.materialId = idsFrom(materials, plan.materialSource, *plan.materialId, planes);
  const auto wantsScene = [](const FrameLight& light) {
    return entryOf(light.method).needs.camera;
  };
  const bool casts = std::any_of(plan.lights.begin(), plan.lights.end(), wantsScene);
  planes.rays = raysOf(plan, casts);
  if (casts) planes.casting = std::make_shared<const CastingScene>(readCastingScene(plan));
  if (plan.rest) markWithoutRest(restAlpha, planes.rest);
  convertToWorld(plan.spaces, plan.image, planes.position, planes.normal);
  clearOutside(plan, planes);
  if (plan.emission) planes.emission = luminancesOf(emission);
  multiplyStraightBeauty(plan, planes);
  planes.badBeauty = clearNonFiniteColour(planes.beauty, planes.alpha.view());
  if (isOpaque(planes.alpha)) planes.alpha = {};
  planes.badAlbedo = clearNonFiniteColour(planes.albedo);
  planes.badPixels = clearNonFinite(planes.position, planes.normal, planes.objectId.view());
  clearWithoutNormal(planes);
  clearWithoutDepth(plan, planes);
  if (plan.coverage) noteMended(plan.coverage->name, mendCoverage(plan, planes), planes.warnings);
  noteUnseen(plan, planes);
  clearUnpainted(plan, planes);
  checkMeanNormals(plan, planes);
  checkSpaces(plan, planes);
  for (std::string& doubt : takeUnknownAsLit(plan, planes))
    planes.warnings.push_back(std::move(doubt));
  for (std::string& doubt : setDoubtedMapsAside(plan, planes))
    planes.warnings.push_back(std::move(doubt));
  return planes;
}

}  // namespace kagefude
