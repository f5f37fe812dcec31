#include "base/place_error.h"
#include "compositor/shadow/caster_light.h"
#include "passes/casters/planar_projection.h"
#include "passes/casters/texture_shadow.h"
#include "picture/strip_file.h"

namespace kagefude {
namespace {

Floats blobPicture(const std::filesystem::path& file) {
  if (file.empty()) return {};
  StripPicture picture = readStrip(file, "picture");
  Floats grey(picture.width(), picture.height());
  for (size_t i = 0; i < grey.view().pixels(); ++i)
    grey.row(0)[i] = (picture.red.row(0)[i] + picture.green.row(0)[i] + picture.blue.row(0)[i]) / 3;
  return grey;
}

}  // namespace

LightVisibility blobShadow(const ShadowWork& work) {
  const FrameLight& light = work.light;
  const FramePlanes& frame = work.frame;
  const ReceiverPlane ground =
      planeOfReceiver(seenSurface(frame), receiverId(work), light.receiver);
  std::vector<BlobPlace> places;
  std::vector<uint32_t> ids;
  if (work.plan.sidecar)
    for (const SidecarObject& object : work.plan.sidecar->objects) {
      if (object.flat || object.name == light.receiver) continue;
      places.push_back(blobUnder(object.worldFromObject, object.boundsMin, object.boundsMax,
                                 ground.normal, ground.normal.dot(ground.point),
                                 light.passes.blob));
      ids.push_back(work.plan.idSource == IdSource::index ? object.index : object.cryptoId);
    }
  const Floats picture = withPlace(light.blobNamed, [&] { return blobPicture(light.blob); });
  return {blobTone(frame.position, frame.objectId, places, ids, picture, light.passes.blob), {}};
}

}  // namespace kagefude
