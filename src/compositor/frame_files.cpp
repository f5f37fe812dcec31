#include "compositor/frame_files.h"

#include <algorithm>
#include <set>

#include "frame/cryptomatte.h"

namespace kagefude {
namespace {

bool wantsCasters(const FrameLight& light) {
  return entryOf(light.method).needs.casters || light.method == ShadowMethod::blob;
}

}  // namespace

std::vector<std::filesystem::path> filesBeside(const FramePlan& plan) {
  std::set<std::filesystem::path> files;
  for (const Part& part : plan.image.parts)
    if (part.file != plan.image.path) files.insert(part.file);
  for (const FrameLight& light : plan.lights) {
    if (light.depthMap) files.insert(light.depthMap->file);
    if (!light.blob.empty()) files.insert(light.blob);
  }
  if (plan.hasCasters && std::any_of(plan.lights.begin(), plan.lights.end(), wantsCasters))
    for (const SidecarCaster& entry : plan.sidecar->casters) files.insert(entry.file);
  for (const Cryptomatte& matte : listCryptomattes(plan.image))
    if (const auto manifest = manifestFile(plan.image, matte)) files.insert(*manifest);
  return {files.begin(), files.end()};
}

}  // namespace kagefude
