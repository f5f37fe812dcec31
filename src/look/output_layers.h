#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "exr/image_file.h"
#include "look/help_text.h"

namespace kagefude {

struct LayerPlane;
struct LayerSources;

/// Takes a layer out of what a frame's composition made; the compositor's
/// (compositor/output_layers.h). The look only holds the pointer.
using LayerFunction = LayerPlane (*)(LayerSources&);

LayerPlane coverageLayer(LayerSources&);
LayerPlane visibilityLayer(LayerSources&);
LayerPlane confidenceLayer(LayerSources&);
LayerPlane toneLayer(LayerSources&);
LayerPlane outlineLayer(LayerSources&);
LayerPlane angleLayer(LayerSources&);
LayerPlane repeatLayer(LayerSources&);
LayerPlane surfaceLayer(LayerSources&);

/// When a layer's values are there.
enum class LayerStage {
  light,  ///< once for each light; the layer's name ends in the light's
  frame
};

/// One output layer, whole: `output.layers` and its help, the check of its names, the memory bound,
/// the type in the file and the call all come from this row.
struct OutputLayerEntry {
  std::string_view name;  ///< of a light's layer all before the light's name
  PixelType type;
  LayerStage stage;
  std::string_view sentence;
  LayerFunction function;
  std::string_view onlyMethod = "";  ///< of a light's layer: the shadow.method that brings it
  bool mixes = true;                 ///< whether the mean of two pixels means something
};

/// All layers. Of one light they are taken in this order.
inline constexpr std::array outputLayers{
    OutputLayerEntry{"coverage.", PixelType::single, LayerStage::light,
                     "share of the pixel that method coverage hides", coverageLayer, "coverage"},
    OutputLayerEntry{"visibility.", PixelType::single, LayerStage::light,
                     "how much of the light is seen", visibilityLayer},
    OutputLayerEntry{"confidence.", PixelType::single, LayerStage::light,
                     "1 where the visibility is measured, 0 where extrapolated", confidenceLayer},
    OutputLayerEntry{"brush.tone", PixelType::single, LayerStage::frame,
                     "the tone that chooses the strip's colour", toneLayer},
    OutputLayerEntry{"outline", PixelType::single, LayerStage::frame, "coverage by the outlines",
                     outlineLayer},
    OutputLayerEntry{"brush.angle", PixelType::single, LayerStage::frame, "the stroke angle",
                     angleLayer, "", false},
    OutputLayerEntry{"brush.repeat", PixelType::single, LayerStage::frame,
                     "repeats of the strip along the stroke", repeatLayer, "", false},
    OutputLayerEntry{"surface.id", PixelType::uint, LayerStage::frame,
                     "number of the smooth surface, 0 the background", surfaceLayer, "", false},
};

/// Bytes a pixel.
constexpr size_t bytesOf(const OutputLayerEntry& layer) {
  return layer.type == PixelType::half ? 2 : 4;
}

/// What `output.layers` takes: from the rows above.
inline constexpr JoinedText outputLayerHelp([](auto put) {
  put("layers beside R,G,B,A, names or globs; each must be one of the frame's");
  for (size_t i = 0; i < outputLayers.size(); ++i) {
    put(i == 0 ? ". " : "; ");
    put(outputLayers[i].name);
    put(outputLayers[i].stage == LayerStage::light ? "<light>: " : ": ");
    put(outputLayers[i].sentence);
  }
});

}  // namespace kagefude
