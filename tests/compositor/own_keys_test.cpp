// The keys of a look that belong to no pass: each changes what is written, or is shown to
// elsewhere.
#include <cstring>
#include <fstream>
#include <sstream>

#include "compositor/map_frame.h"
#include "compositor/write_frame_picture.h"
#include "look/look_sections.h"

namespace kagefude {
namespace {

using testing::identityRows;
using testing::lightJson;
using testing::MapFrame;

/// Two things and a hole under one lamp, with a second pass of every kind under another name.
class OwnKeys : public ::testing::Test {
 protected:
  static constexpr int side = MapFrame::side;

  OwnKeys() {
    frame.addOther();
    frame.sidecar["objects"][1]["flat"] = true;
    frame.sidecar["materials"] = {{{"name", "Clay"}, {"index", 1}},
                                  {{"name", "Wood"}, {"index", 2}}};
    frame.addLight(lightJson("Lamp", "point", {1, 0.5f, 4}, {0, 0, -1}, 100));
    frame.addMasks("pair", {{1, 0}, {-1, 0}},
                   [](int x, int y, size_t k) { return x > 2 + int(k) || y < 2; });
    frame.addLight(lightJson("Fill", "sun", {-9, 0, 9}, V3f(1, 0, -1).normalized(), 1));
    frame.addLid();
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) pixel(x, y);
    cryptomatte("CryptoObject00", 3);
    cryptomatte("MoreObject00", 6);
    cryptomatte("CryptoMaterial00", 5);
    cryptomatte("MoreMaterial00", 2);
    depthMap("depth.exr", 2);
    depthMap("other.exr", 4);
    frame.sidecar["objects"][0]["instanced"] = true;
    frame.sidecar["objects"][0]["world_from_object"][0][3] = 0.5;
    // The camera's x runs along the world's y.
    frame.sidecar["camera"]["camera_from_world"] = {
        {0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, -10}, {0, 0, 0, 1}};
    const Floats grey(4, 4, 0.3f);
    writePng(frame.folder / "own.png", grey, grey, grey);
    std::ofstream(frame.folder / "own.ocio") << ownConfig;
  }

  void pixel(int x, int y) {
    const V3f p(MapFrame::across(x), -MapFrame::across(y), 0);
    const float f = float(x + 2 * y) / 24;
    frame.setVector("MorePosition", x, y, p * 1.5f);
    frame.setVector("MoreNormal", x, y, V3f(0, 0.3f, 1).normalized());
    frame.setVector("Rest", x, y, p);
    frame.setVector("Crumpled", x, y, {p.x * 2, p.y * p.y, p.x});
    frame.setVector("UV", x, y, {0.5f + p.x / 2, 0.5f + p.y / 2, 0});
    frame.setVector("MoreUV", x, y, {0.5f + p.y / 2, 0.3f - p.x / 2, 0});
    frame.plane("Dice.X")(x, y) = x < 2 ? 0.2f : 0.7f;
    const bool hole = y == 0, right = x >= side / 2;
    if (hole) frame.plane("IndexOB.X")(x, y) = 0;
    frame.plane("MoreIndex.X")(x, y) = hole ? 0.0f : x >= 2 ? 2.0f : 1.0f;
    frame.plane("IndexMA.X")(x, y) = hole ? 0.0f : right ? 2.0f : 1.0f;
    frame.plane("MoreMaterial.X")(x, y) = hole ? 0.0f : x >= 6 ? 2.0f : 1.0f;
    frame.plane("Faces.X")(x, y) = y < 4 ? 1.0f : 2.0f;
    frame.plane("Depth.Z")(x, y) = right ? 5.0f : 9.0f;
    frame.plane("MoreDepth.Z")(x, y) = y < 5 ? 5.0f : 9.0f;
    frame.plane("Seen.R")(x, y) = y > 4 ? 0.2f : 0.9f;
    frame.plane("MoreSeen.R")(x, y) = x > 4 ? 0.2f : 0.9f;
    for (const char* channel : {"R", "G", "B", "A"}) {
      const bool alpha = *channel == 'A';
      frame.plane(std::string("Combined.") + channel)(x, y) = alpha ? 1.0f : f;
      frame.channel(std::string("Fog.Combined.") + channel)(x, y) = alpha ? 1.0f : 0.5f * f;
      if (alpha) continue;
      frame.plane(std::string("MoreBeauty.") + channel)(x, y) = 1 - f;
      frame.plane(std::string("DiffCol.") + channel)(x, y) = 0.2f + 0.5f * f;
      frame.plane(std::string("MoreColour.") + channel)(x, y) = 0.7f - 0.5f * f;
    }
    // A second layer whose ground is tilted.
    for (const char* axis : {"X", "Y", "Z"}) {
      frame.channel(std::string("Far.Position.") + axis)(x, y) = 2 * p[*axis - 'X'];
      frame.channel(std::string("Far.Normal.") + axis)(x, y) = *axis == 'Z' ? 1.0f : 0.0f;
    }
    frame.channel("Far.IndexOB.X")(x, y) = hole ? 0.0f : 1.0f;
  }

  /// Thing in the columns before `border`, which it covers by a quarter, and Other from there on.
  void cryptomatte(const std::string& name, int border) {
    const uint32_t bits[2] = {0x3f800001, 0x3f900002};
    float ids[2];
    std::memcpy(ids, bits, sizeof ids);
    const bool objects = name.find("Object") != std::string::npos;
    nlohmann::json& named = frame.sidecar[objects ? "objects" : "materials"];
    named[0]["crypto"] = "3f800001";
    named[1]["crypto"] = "3f900002";
    for (int y = 1; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        frame.plane(name + ".r")(x, y) = ids[x >= border];
        frame.plane(name + ".g")(x, y) = x == border ? 0.75f : 1.0f;
        frame.plane(name + ".b")(x, y) = x == border ? ids[0] : 0.0f;
        frame.plane(name + ".a")(x, y) = x == border ? 0.25f : 0.0f;
      }
  }

  void depthMap(const std::string& name, int first) const {
    Floats depth(8, 8, 1e10f);
    for (int y = 0; y < 8; ++y)
      for (int x = first; x < first + 3; ++x) depth(x, y) = 2.0f;
    frame.writeDepthMap(name, depth);
  }

  /// The frame, its preview and a JPEG of it as they are written.
  std::string written(const std::string& lookText) const {
    const std::filesystem::path path = frame.write(), folder = frame.folder.path();
    frame.folder.write("look.toml", lookText);
    std::vector<std::string> set;
    if (lookText.find("frame.layer") == std::string::npos) set = {"frame.layer=\"ViewLayer\""};
    const Look look = readLook(folder / "look.toml", set);
    const Colour colour(look.colourConfig());
    const StripSet strips(look, colour);
    const FramePlan plan = planFrame(look, path, 1);
    const FrameResult result = composeFrame(look, strips, plan, readFramePlanes(plan));
    writeFrame(look, plan, result, folder / "out.exr", {});
    const PictureOutput preview{&formatOf("out.png", "--preview")};
    const PictureOutput jpeg{&formatOf("out.jpg", "--output")};
    writeFramePicture(look, colour, plan, result, folder / "out.png", preview, "");
    writeFramePicture(look, colour, plan, result, folder / "out.jpg", jpeg, "");
    return bytesOf(folder / "out.exr") + bytesOf(folder / "out.png") + bytesOf(folder / "out.jpg");
  }
  static std::string bytesOf(const std::filesystem::path& path) {
    std::ostringstream bytes;
    bytes << std::ifstream(path, std::ios::binary).rdbuf();
    return bytes.str();
  }

  /// Two displays, of which the second and its second view are darker; scene-linear is `linear`.
  static constexpr const char* ownConfig = R"(ocio_profile_version: 2
roles:
  scene_linear: linear
  default: linear
file_rules:
  - !<Rule> {name: Default, colorspace: linear}
displays:
  Screen:
    - !<View> {name: Plain, colorspace: linear}
    - !<View> {name: Dark, colorspace: darker}
  Beamer:
    - !<View> {name: Plain, colorspace: darker}
colorspaces:
  - !<ColorSpace>
    name: linear
  - !<ColorSpace>
    name: darker
    to_scene_reference: !<ExponentTransform> {value: [2, 2, 2, 1]}
)";

  MapFrame frame;
};

/// The look before a key is given, and the line that gives it.
struct Trial {
  std::string before, line;
  bool json = true;  ///< whether the frame has one
};

const std::string own = "[[light]]\nname = \"Lamp\"\n";
const std::string added = "[[light]]\nname = \"New\"\ntype = \"point\"\nposition = [0.5, 1, 3]\n";
const std::string painted =
    "[[style]]\nobject = \"Thing\"\nstrip = \"builtin:soft\"\ncolour = \"replace\"\n";
const std::string mapped =
    "shadow.method = \"pcf\"\nshadow.lights = [\"New\"]\n" + added +
    "light_from_world = [1,0,0,0, 0,1,0,0, 0,0,1,-4, 0,0,0,1]\n"
    "clip_from_light = [2,0,0,0, 0,2,0,0, 0,0,-1,-0.2, 0,0,-1,0]\ndepth_map = \"depth.exr\"\n";
const std::string bare = "frame.object_index = \"IndexOB\"\n" + added +
                         "[[style]]\nindex = 2\nstrip = \"builtin:soft\"\n";
const std::string darker = "colour.config = \"own.ocio\"\ncolour.strip = \"linear\"\n";
const std::string wooden = "[[style]]\nmaterial = \"Wood\"\nstrip = \"builtin:soft\"\n";
const std::string other =
    "[[style]]\nobject = \"*\"\nstrip = \"builtin:fine\"\ncolour = \"replace\"\n";
const std::string grounded = "brush.ground = \"rest\"\n" + painted;
const std::string masked =
    "masks = [\"ViewLayer.Seen\", \"ViewLayer.MoreSeen\", \"ViewLayer.mask.Lamp.0\"]\n"
    "radius = 1.5\n";
const std::string sunny = "[[light]]\nname = \"New\"\ntype = \"sun\"\ndirection = [0, 0.5, -1]\n";
const std::string ownStrip = "[[style]]\nobject = \"*\"\nstrip = \"own.png\"\n";
const std::string every = "output.layers = [\"*\"]\n";

/// A trial for every key; those without a line are shown to act where the text says.
const std::map<std::string, Trial> trials = {
    {"frame.layer", {painted, "frame.layer = \"Far\""}},
    {"frame.beauty_layer", {"", "frame.beauty_layer = \"Fog\""}},
    {"frame.files", {"frame_files_test.sh", ""}},
    {"frame.view", {"ViewsAndParts", ""}},
    {"frame.position", {painted, "frame.position = \"MorePosition\""}},
    {"frame.normal", {painted, "frame.normal = \"MoreNormal\""}},
    {"frame.depth",
     {"outline.objects = false\noutline.width = 2\n" + bare + "outline_colour = [0, 0, 0]\n",
      "frame.depth = \"MoreDepth\"", false}},
    {"frame.object_index", {painted, "frame.object_index = \"MoreIndex\""}},
    {"frame.material_index", {wooden, "frame.material_index = \"MoreMaterial\""}},
    {"frame.vector", {"WarpError and check: a comp needs no other frame", ""}},
    {"frame.albedo", {"", "frame.albedo = \"MoreColour\""}},
    {"frame.beauty", {"", "frame.beauty = \"MoreBeauty\""}},
    {"frame.crypto_object",
     {"Cryptomatte.* of the resolver: found by the header, as a frame of a test has none", ""}},
    {"frame.crypto_material", {"as frame.crypto_object", ""}},
    {"frame.surface", {"smooth.all_methods = true\n" + every, "frame.surface = \"Faces\""}},
    {"frame.rest", {grounded, "frame.rest = \"Crumpled\""}},
    {"frame.rest_space", {"StrokeGroundsTest", ""}},
    {"frame.uv", {"brush.ground = \"uv\"\n" + painted, "frame.uv = \"MoreUV\""}},
    {"frame.instance_random", {grounded, "frame.instance_random = \"Dice\""}},
    {"frame.position_space", {"", "frame.position_space = \"camera\""}},
    {"frame.normal_space",
     {"frame.normal = \"MoreNormal\"\n" + painted, "frame.normal_space = \"camera\""}},
    {"frame.normal_range", {"", "frame.normal_range = \"0..1\""}},
    {"frame.normal_axes",
     {"frame.normal = \"MoreNormal\"\n" + painted, "frame.normal_axes = \"y -x z\""}},
    {"frame.depth_kind", {"RebuiltFrame", ""}},
    {"frame.up",
     {"scene.centre = [0, 0, 0]\nscene.radius = 2\n" + bare, "frame.up = \"y\"", false}},
    {"frame.camera_from_world", {"RebuiltFrame", ""}},
    {"frame.clip_from_camera", {"RebuiltFrame", ""}},
    {"frame.emission",
     {"tone.emission = 1\nframe.emission = \"DiffCol\"\n", "frame.emission = \"MoreColour\""}},
    {"scene.world", {"tone.world = 1\nscene.world = [0, 0, 0]\n", "scene.world = [1, 1, 1]"}},
    {"scene.centre",
     {"scene.centre = [0, 0, 0]\nscene.radius = 2\n" + bare, "scene.centre = [3, 0, 0]", false}},
    {"scene.radius",
     {"scene.centre = [0, 0, 0]\nscene.radius = 2\n" + bare, "scene.radius = 9", false}},
    {"scene.distance", {"not shown: a frame of a few pixels has no stroke that it changes", ""}},
    {"colour.config", {"", darker}},
    {"colour.strip",
     {darker + "colour.display = \"Screen\"\n" + ownStrip, "colour.strip = \"darker\""}},
    {"colour.display", {darker, "colour.display = \"Beamer\""}},
    {"colour.view", {darker, "colour.view = \"Dark\""}},
    {"output.layers", {"", "output.layers = [\"outline\"]"}},
    {"output.passthrough", {"", "output.passthrough = true"}},
    {"output.background", {"", "output.background = \"transparent\""}},
    {"output.edges", {painted, "output.edges = \"pixel\""}},
    {"output.quality", {"", "output.quality = 10"}},
    {"output.colour", {"", "output.colour = \"float\""}},
    {"output.compression", {"", "output.compression = \"none\""}},
    {"output.scale", {"", "output.scale = 2"}},
    {"light.name", {"[[light]]\nname = \"Fill\"\non = false\n", "name = \"Lamp\""}},
    {"light.type", {added, "type = \"sun\"\ndirection = [0, 0.5, -1]"}},
    {"light.position", {added, "position = [-3, 1, 3]"}},
    {"light.on", {own, "on = false"}},
    {"light.direction", {sunny, "direction = [1, 0, -1]"}},
    {"light.radius", {"shadow.method = \"places\"\n" + added, "radius = 1.5"}},
    {"light.weight", {added, "weight = 50"}},
    {"light.masks", {added, "masks = [\"ViewLayer.Seen\", \"ViewLayer.MoreSeen\"]"}},
    {"light.places", {"LightLayers.AnyNinePlacesAreNoRing", ""}},
    {"light.depth_map", {mapped, "depth_map = \"other.exr\""}},
    {"light.light_from_world",
     {mapped, "light_from_world = [1,0,0,1, 0,1,0,0, 0,0,1,-4, 0,0,0,1]"}},
    {"light.clip_from_light",
     {mapped, "clip_from_light = [1,0,0,0, 0,1,0,0, 0,0,-1,-0.2, 0,0,-1,0]"}},
    {"style.object", {"[[style]]\nstrip = \"builtin:soft\"\n", "object = \"Thing\""}},
    {"style.material", {"[[style]]\nstrip = \"builtin:soft\"\n", "material = \"Wood\""}},
    {"style.index", {"[[style]]\nstrip = \"builtin:soft\"\n", "index = 2"}},
    {"style.priority", {painted + other, "priority = 1"}},
    {"style.strip", {painted, "strip = \"own.png\""}},
    {"light.strip", {own, "strip = \"own.png\""}},
    {"style.light_strips", {painted, "light_strips = [\"Fill=own.png\"]"}},
    {"style.colour", {painted, "colour = \"multiply\""}},
    {"style.reference", {painted, "reference = [3, 2, 1]"}},
    {"style.light", {"tone_and_style_test.cpp", ""}},
    {"style.outline_colour", {"outline.width = 2\n" + painted, "outline_colour = [1, 0, 0]"}},
    {"shadow.method", {"", "shadow.method = \"none\""}},
    {"shadow.lights", {"", "shadow.lights = [\"Fill\"]"}},
    {"shadow.strength", {"", "shadow.strength = 0.3"}},
    {"shadow.places",
     {"shadow.method = \"places\"\n" + added + "radius = 1.5\n", "shadow.places = 17"}},
    {"shadow.receiver", {"RefusedWithout and KeysOfReceivers", ""}},
    {"shadow.blob",
     {"shadow.method = \"blob\"\nshadow.receiver = \"Other\"\n", "shadow.blob = \"own.png\""}},
};

/// `look` with the line at its top or, of a light or style, at its end, in place of an equal key.
std::string withLine(const std::string& look, const std::string& key, const std::string& line) {
  const bool inTable = key.starts_with("light.") || key.starts_with("style.");
  const std::string start = line.substr(0, line.find(' ') + 1);
  std::istringstream lines(look);
  std::string kept;
  for (std::string one; std::getline(lines, one);)
    if (!one.starts_with(start)) kept += one + "\n";
  return inTable ? kept + line + "\n" : line + "\n" + kept;
}

TEST_F(OwnKeys, EachChangesWhatIsWritten) {
  for (const LookSection& row : lookSections) {
    const std::string section(row.table->pass);
    if (!std::set<std::string>{"frame", "scene", "colour", "output", "light", "style", "shadow"}
             .contains(section))
      continue;
    for (const Parameter& parameter : row.table->parameters) {
      const std::string key = section + "." + std::string(parameter.name);
      const auto trial = trials.find(key);
      if (trial == trials.end()) {
        ADD_FAILURE() << key << " has no trial";
        continue;
      }
      const auto& [before, line, json] = trial->second;
      frame.withJson = json;
      if (line.empty()) continue;
      try {
        EXPECT_NE(written(before), written(withLine(before, key, line))) << key << " does nothing";
      } catch (const Error& error) {
        ADD_FAILURE() << key << ": " << error.what();
      }
    }
  }
}

}  // namespace
}  // namespace kagefude
