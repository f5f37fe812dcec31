#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "exr/write_image.h"
#include "look/output_layers.h"
#include "look/shadow_methods.h"
#include "passes/tone/light.h"
#include "picture/picture_format.h"

// The look's sections that are not a pass's own parameters. Each is declared once, here.
namespace kagefude {

/// [shadow]: how each light's visibility is found.
struct ShadowParams {
  ShadowMethod method = ShadowMethod::automatic;
  std::vector<std::string> lights = {"*"};
  float strength = 1.0f;
  int places = 9;
  std::string receiver;
  std::string blob;
};
inline constexpr Parameter shadowParameters[] = {
    choice<&ShadowParams::method>("method", shadowMethodNames, shadowMethodHelp.view()),
    plain<&ShadowParams::lights>("lights", "names or globs of the lights that take part"),
    number<&ShadowParams::strength>("strength", 0, 1, "",
                                    "share of the light that a full shadow takes away"),
    number<&ShadowParams::places>("places", 5, 65, "",
                                  "places on the light's disc that method places cuts masks from"),
    plain<&ShadowParams::receiver>("receiver",
                                   "object that planar shadows and blobs fall on; flat"),
    plain<&ShadowParams::blob>(
        "blob", "picture of the blob, relative to the look; empty: a soft round one"),
};
inline constexpr ParameterTable shadowTable{"shadow", "chooses lights and the shadow method",
                                            "004, light sum: k", shadowParameters};

/// [scene]: the size of what the shot shows, for frames whose JSON does not say it.
struct SceneParams {
  std::vector<float> centre;
  float radius = 0.0f;
  float distance = 0.0f;
  std::vector<float> world;

  /// Whether it stands for what the JSON says of the scene's place and size.
  bool sizes() const { return !centre.empty() && radius > 0.0f; }
};
inline constexpr Parameter sceneParameters[] = {
    numbers<&SceneParams::centre>(
        "centre", 3, -1e12, 1e12, "world units",
        "middle x, y, z of what the shot shows, the same for all its frames; strokes of objects "
        "that no JSON describes run round it; empty: as the JSON says"),
    number<&SceneParams::radius>(
        "radius", 0, 1e12, "world units",
        "radius of what the shot shows; strokes of grounds, and of objects that no JSON describes, "
        "are sized by it; 0: as the JSON says"),
    number<&SceneParams::distance>(
        "distance", 0, 1e12, "world units",
        "distance of the camera from it, for brush.size = \"screen\"; 0: as the JSON says"),
    numbers<&SceneParams::world>(
        "world", 3, 0, 1e6, "scene-linear",
        "radiance r, g, b of the world's own light, for tone.world; empty: as the JSON says"),
};
inline constexpr ParameterTable sceneTable{"scene", "says how large the shot's scene is",
                                           "kagefude", sceneParameters};

/// [colour]: spaces of the strips, of the result and of the previews.
struct ColourParams {
  std::string config;
  std::string strip;
  std::string display;
  std::string view;
};
inline constexpr Parameter colourParameters[] = {
    plain<&ColourParams::config>(
        "config", "OCIO config, relative to the look; empty: $OCIO, then the built-in one"),
    plain<&ColourParams::strip>("strip", "space that strips are painted in; empty: sRGB"),
    plain<&ColourParams::display>(
        "display", "display of previews and of integer outputs; empty: the config's default"),
    plain<&ColourParams::view>(
        "view", "view of previews and of integer outputs; empty: the display's default"),
};
inline constexpr ParameterTable colourTable{"colour", "names the colour spaces", "OpenColorIO",
                                            colourParameters};

enum class Background { beauty, transparent, colour, paper, picture, strip };
inline constexpr std::string_view backgroundNames[] = {"beauty", "transparent", "colour",
                                                       "paper",  "picture",     "strip"};
enum class Edges { coverage, pixel };
inline constexpr std::string_view edgeNames[] = {"coverage", "pixel"};
inline constexpr std::string_view compressionNames[] = {"none", "rle", "zips", "zip", "piz"};

/// [output]: what is written.
struct OutputParams {
  std::vector<std::string> layers;
  bool passthrough = false;
  Background background = Background::beauty;
  Edges edges = Edges::coverage;
  SampleDepth colour = SampleDepth::automatic;
  Compression compression = Compression::zip;
  int quality = 95;
  int scale = 1;
};
inline constexpr Parameter outputParameters[] = {
    plain<&OutputParams::layers>("layers", outputLayerHelp.view()),
    plain<&OutputParams::passthrough>("passthrough",
                                      "also writes every other input channel unchanged"),
    choice<&OutputParams::background>(
        "background", backgroundNames,
        "what stands where no surface is painted: the render, nothing, "
        "or what [ground] and [paper] describe"),
    choice<&OutputParams::edges>("edges", edgeNames,
                                 "whether things meet by their Cryptomatte coverage, or pixel by "
                                 "pixel"),
    choice<&OutputParams::colour>(
        "colour", sampleDepthNames,
        "samples of R,G,B,A, floats scene-linear and integers as the display shows them; auto: "
        "half in EXR, uint16 in TIFF and PNG, uint10 in DPX, uint8 in JPEG and WebP; data layers "
        "are always float"),
    choice<&OutputParams::compression>("compression", compressionNames, "lossless EXR compression"),
    number<&OutputParams::quality>("quality", 1, 100, "",
                                   "of JPEG and WebP; 100 makes WebP lossless"),
    number<&OutputParams::scale>(
        "scale", 1, 8, "",
        "how many times smaller than the frame the picture is written, filtered in linear light: "
        "2 for frames exported with --scale 2. Lengths in pixels are those of what is written"),
};
inline constexpr ParameterTable outputTable{"output", "chooses what is written", "kagefude",
                                            outputParameters};

enum class StripColour { automatic, replace, multiply };
inline constexpr std::string_view stripColourNames[] = {"auto", "replace", "multiply"};

/// One [[style]]: which surfaces it paints, and with what.
struct StyleParams {
  std::vector<std::string> object;
  std::vector<std::string> material;
  int index = 0;
  int priority = 0;
  std::string strip = "builtin:neutral";
  StripColour colour = StripColour::automatic;
  std::vector<float> reference;
  std::string light;
  std::vector<float> outlineColour;
  std::vector<std::string> lightStrips;
};
inline constexpr Parameter styleParameters[] = {
    plain<&StyleParams::object>("object", "names or globs of objects that the style paints"),
    plain<&StyleParams::material>("material", "names or globs of materials that the style paints"),
    number<&StyleParams::index>("index", 0, 1 << 24, "",
                                "object index that the style paints; 0: by name only"),
    number<&StyleParams::priority>(
        "priority", -1000, 1000, "",
        "of several styles that match a surface the highest holds; of equal "
        "ones the first in the look"),
    plain<&StyleParams::strip>(
        "strip",
        "picture of the strip, relative to the look, or builtin:neutral, :soft, :fine, :cel"),
    choice<&StyleParams::colour>(
        "colour", stripColourNames,
        "whether the strip replaces the surface's colour or multiplies it; auto multiplies for "
        "builtin:neutral only"),
    numbers<&StyleParams::reference>(
        "reference", 0, -1e12, 1e12, "world units",
        "reference point x, y, z for all objects of the style; empty: each object's own"),
    plain<&StyleParams::light>("light",
                               "light that strokes run round; empty: the one that weighs most"),
    numbers<&StyleParams::outlineColour>("outline_colour", 3, 0, 100, "scene-linear",
                                         "colour r, g, b of the outlines; empty: no outlines"),
    plain<&StyleParams::lightStrips>(
        "light_strips",
        "strips of single lights, such as Rim=strips/rim.png (* and ? in names; the first that "
        "fits): what such a light adds is painted with its strip, and it counts in no other; "
        "Rim= counts it in the style's own, whatever light.strip says"),
};
inline constexpr ParameterTable styleTable{"style", "paints objects or materials with a strip",
                                           "002 fig. 5.5", styleParameters};

enum class LightKind { automatic, point, spot, sun, area };
inline constexpr std::string_view lightKindNames[] = {"auto", "point", "spot", "sun", "area"};

/// One [[light]]: settings for lights of the sidecar whose name matches, or a light of its own
/// where no sidecar describes it (then `masks` or `depth_map` name its layers or file).
struct LightParams {
  std::string name;
  LightKind type = LightKind::automatic;
  std::vector<float> position;
  std::vector<float> direction;
  float radius = 0.0f;
  float weight = -1.0f;
  bool on = true;
  std::vector<std::string> masks;
  std::vector<float> places;
  std::string depthMap;
  std::vector<float> lightFromWorld;
  std::vector<float> clipFromLight;
  std::string strip;
};
inline constexpr Parameter lightParameters[] = {
    plain<&LightParams::name>("name", "name or glob of the light"),
    choice<&LightParams::type>("type", lightKindNames,
                               "kind of a light that no JSON describes; auto: as the JSON says, "
                               "else a point"),
    numbers<&LightParams::position>(
        "position", 3, -1e12, 1e12, "world units",
        "where it stands; moves a light of the sidecar, which then takes its shadow from "
        "the casters"),
    plain<&LightParams::on>("on", "false switches the light off"),
    numbers<&LightParams::direction>("direction", 3, -1e12, 1e12, "",
                                     "which way its light travels (sun, spot, area)"),
    number<&LightParams::radius>("radius", 0, 1e12, "world units", "radius of its disc"),
    number<&LightParams::weight>(
        "weight", -1, 1e12, "watts per square metre",
        "irradiance at its subject, by which it shares in the tone and leads the strokes; -1: "
        "from the JSON's energy and distance, else the mean of the other lights"),
    plain<&LightParams::masks>("masks", "layers or channels of its hard masks, in order"),
    numbers<&LightParams::places>(
        "places", 0, -1, 1, "radii",
        "place u, v of each mask on the light; empty: pair for 2 masks, centre and ring for more"),
    plain<&LightParams::depthMap>("depth_map", "file of its depth map; # stands for the frame"),
    numbers<&LightParams::lightFromWorld>("light_from_world", 16, -1e12, 1e12, "",
                                          "matrix of the depth map's camera, row by row"),
    numbers<&LightParams::clipFromLight>("clip_from_light", 16, -1e12, 1e12, "",
                                         "projection of the depth map's camera, row by row"),
    plain<&LightParams::strip>(
        "strip",
        "strip, as style.strip names one, that what this light adds is painted with on everything; "
        "empty: it counts in each style's own"),
};
inline constexpr ParameterTable lightTable{"light", "settings of one light, or a light of its own",
                                           "kagefude", lightParameters};

}  // namespace kagefude
