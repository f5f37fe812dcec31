#pragma once

#include "compositor/frame_planes.h"
#include "compositor/frame_result.h"
#include "look/look.h"

namespace kagefude {

struct FrameLight;

/// What a frame's composition has made when layers are taken. A layer may move its plane away.
struct LayerSources {
  const FramePlanes& planes;
  const FrameLight* light = nullptr;  ///< stage light: the one at hand, as are the next two
  Floats visibility{};
  Floats confidence{};  ///< empty: 1 everywhere
  Floats tone{}, outline{}, angle{}, repeat{};
  Labels surfaces{};
};

/// Whether the look asks for a layer.
bool asksFor(const Look& look, std::string_view layer);

/// The layers that a frame with these lights can write, by name.
std::vector<std::string> layerNames(const std::vector<FrameLight>& lights);

/// Throws LookError naming the nearest layer when an entry of output.layers matches none.
void checkLayers(const Look& look, const std::vector<FrameLight>& lights);

/// Bytes a pixel of the layers that the look asks for.
size_t layerBytes(const Look& look, const std::vector<FrameLight>& lights);

/// Puts the layers of a stage that the look asks for into `result`.
void takeLayers(const Look& look, LayerStage stage, LayerSources& sources, FrameResult& result);

}  // namespace kagefude
