#include "frame/sidecar.h"

#include <nlohmann/json.hpp>

#include "frame/cryptomatte.h"
#include "frame/foreign_json.h"
#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

using namespace testing;
using nlohmann::json;

json identity() { return {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}; }

json example() {
  json sample = {{"layer", "mask.Key.0"}, {"position", {0, 0, 4}}, {"uv", {1, 0}}};
  json other = {{"layer", "mask.Key.1"}, {"position", {0, 0, 5}}, {"uv", {-1, 0}}};
  json light = {{"name", "Key"},
                {"type", "spot"},
                {"position", {1, 2, 3}},
                {"direction", {0, 0, -2}},
                {"radius", 0.5},
                {"color", {1, 0.5, 0.25}},
                {"energy", 100},
                {"cone", {{"angle", 1.0}, {"blend", 0.2}}},
                {"subject", {{"center", {0, 0, 0}}, {"radius", 2}}},
                {"masks", {{"arrangement", "pair"}, {"offset", 0.3}, {"samples", {sample, other}}}},
                {"axes", {{"u", {1, 0, 0}}, {"v", {0, 1, 0}}}},
                {"depth_map",
                 {{"file", "shot.Key.depth.0012.exr"},
                  {"channel", "Depth.Z"},
                  {"resolution", {512, 512}},
                  {"projection", "perspective"},
                  {"light_from_world", identity()},
                  {"clip_from_light", identity()}}}};
  json object = {{"name", "Cup"},
                 {"index", 3},
                 {"crypto", "1a2b3c4d"},
                 {"world_from_object", identity()},
                 {"bounds", {{"min", {-1, -1, 0}}, {"max", {1, 1, 2}}}},
                 {"reference_point", {0, 0, 1}},
                 {"materials", {"Clay"}},
                 {"flat", false}};
  return {{"kagefude", 1},
          {"frame", 12},
          {"fps", 24.0},
          {"image", "shot.0012.exr"},
          {"resolution", {960, 540}},
          {"layers", {{"data", "data"}, {"beauty", "beauty"}}},
          {"camera",
           {{"type", "perspective"},
            {"position", {0, -5, 1}},
            {"direction", {0, 1, 0}},
            {"camera_from_world", identity()},
            {"clip_from_camera", identity()}}},
          {"lights", {light}},
          {"objects", {object}},
          {"materials", {{{"name", "Clay"}, {"index", 1}}}},
          {"something new", true}};
}

class SidecarTest : public ::testing::Test {
 protected:
  Sidecar read(const json& text) {
    writeText(folder_ / "shot.0012.json", text.dump());
    return readSidecar(folder_ / "shot.0012.json");
  }
  // The message for the example with the value at a JSON pointer replaced.
  std::string messageWith(const std::string& pointer, const json& value) {
    json changed = example();
    changed[json::json_pointer(pointer)] = value;
    return messageOf<InputError>([&] { read(changed); });
  }
  TemporaryFolder folder_;
};

TEST_F(SidecarTest, ReadsEverything) {
  const Sidecar sidecar = read(example());
  EXPECT_EQ(sidecar.frame, 12);
  EXPECT_EQ(sidecar.width, 960);
  EXPECT_EQ(sidecar.dataLayer, "data");
  ASSERT_NE(sidecar.findLight("Key"), nullptr);
  const SidecarLight& light = *sidecar.findLight("Key");
  EXPECT_EQ(light.type, LightType::spot);
  EXPECT_EQ(light.direction, V3d(0, 0, -1)) << "made unit";
  EXPECT_EQ(light.coneBlend, 0.2);
  EXPECT_EQ(light.subjectRadius, 2);
  ASSERT_EQ(light.masks->samples.size(), 2u);
  EXPECT_EQ(light.masks->samples[1].u, -1);
  EXPECT_EQ(light.depthMap->file, folder_ / "shot.Key.depth.0012.exr");
  EXPECT_EQ(sidecar.findObject(3u)->name, "Cup");
  EXPECT_EQ(sidecar.findObject("Cup")->cryptoId, 0x1a2b3c4du);
  EXPECT_EQ(sidecar.materials[0].cryptoId, cryptomatteId("Clay")) << "from the name";
  EXPECT_EQ(sidecar.findObject("cup"), nullptr);
}

json wholeShot() {
  return {{"first", 1},
          {"last", 24},
          {"subject", {{"center", {1, 2, 3}}, {"radius", 1.5}}},
          {"distance", 7.5},
          {"lights", {{{"name", "Key"}, {"irradiance", 2.0}, {"largest_irradiance", 3.0}}}}};
}

TEST_F(SidecarTest, ReadsWhatHoldsForTheWholeShot) {
  json changed = example();
  EXPECT_FALSE(read(changed).shot) << "older exports do not say it";
  EXPECT_EQ(read(changed).scale, 1);
  changed["shot"] = wholeShot();
  changed["scale"] = 2;
  const Sidecar sidecar = read(changed);
  EXPECT_EQ(sidecar.scale, 2);
  ASSERT_TRUE(sidecar.shot);
  EXPECT_EQ(sidecar.shot->first, 1);
  EXPECT_EQ(sidecar.shot->last, 24);
  EXPECT_EQ(sidecar.shot->subjectCenter, V3d(1, 2, 3));
  EXPECT_EQ(sidecar.shot->subjectRadius, 1.5);
  EXPECT_EQ(sidecar.shot->distance, 7.5);
  ASSERT_EQ(sidecar.shot->lights.size(), 1u);
  EXPECT_EQ(sidecar.shot->lights[0].irradiance, 2);
  EXPECT_EQ(sidecar.shot->lights[0].largestIrradiance, 3);
  changed["shot"]["distance"] = -1;
  expectContains(messageOf<InputError>([&] { read(changed); }),
                 "shot.distance should be a number from 0");
}

TEST_F(SidecarTest, ReadsLampsWithoutShadowAndAreas) {
  json changed = example();
  EXPECT_TRUE(read(changed).lights[0].castsShadow) << "as older exports, which leave it out";
  changed["lights"][0]["shadow"] = false;
  changed["lights"][0]["area"] = {{"shape", "ellipse"}, {"half_u", 1.25}, {"half_v", 0.2}};
  changed["lights"][0].erase("masks");
  const SidecarLight light = read(changed).lights[0];
  EXPECT_FALSE(light.castsShadow);
  ASSERT_TRUE(light.area);
  EXPECT_TRUE(light.area->ellipse);
  EXPECT_EQ(light.area->halfU, 1.25);
  EXPECT_EQ(light.area->halfV, 0.2);
}

TEST_F(SidecarTest, ReadsStretchedDiscsHardMasksAndWhatIsNotPainted) {
  json changed = example();
  EXPECT_EQ(read(changed).lights[0].masks->offsetV, 0.3) << "round";
  EXPECT_TRUE(read(changed).objects[0].painted);
  changed["lights"][0]["masks"]["offset_v"] = 0.1;
  changed["objects"][0]["painted"] = false;
  changed["layers"]["lines"] = "beauty.Freestyle";
  const Sidecar sidecar = read(changed);
  EXPECT_EQ(sidecar.lights[0].masks->offsetV, 0.1);
  EXPECT_FALSE(sidecar.objects[0].painted);
  EXPECT_EQ(sidecar.linesLayer, "beauty.Freestyle");
  changed["lights"][0]["masks"]["arrangement"] = "hard";
  expectContains(messageOf<InputError>([&] { read(changed); }), "should be a list of 1");
  changed["lights"][0]["masks"]["samples"].erase(1);
  EXPECT_EQ(read(changed).lights[0].masks->arrangement, MaskArrangement::hard);
  changed["lights"][0]["masks"]["arrangement"] = "grid";
  expectContains(messageOf<InputError>([&] { read(changed); }), "should be a list of 5");
  json& samples = changed["lights"][0]["masks"]["samples"];
  while (samples.size() < 5) samples.push_back(samples[0]);
  EXPECT_EQ(read(changed).lights[0].masks->arrangement, MaskArrangement::grid);
}

TEST_F(SidecarTest, ReadsWhatRestsAndWhatIsInstanced) {
  json changed = example();
  EXPECT_FALSE(read(changed).objects[0].restBounds);
  EXPECT_FALSE(read(changed).objects[0].instanced);
  changed["objects"][0]["rest_bounds"] = {{"min", {-3, -2, -1}}, {"max", {1, 2, 3}}};
  changed["objects"][0]["instanced"] = true;
  const SidecarObject object = read(changed).objects[0];
  EXPECT_EQ((*object.restBounds)[0], V3d(-3, -2, -1));
  EXPECT_EQ((*object.restBounds)[1], V3d(1, 2, 3));
  EXPECT_TRUE(object.instanced);
}

TEST_F(SidecarTest, SomeoneElsesJsonIsNotOurs) {
  for (const char* text : {R"({"asset": "x"})", "[1, 2]", "7"}) {
    writeText(folder_ / "shot.0012.json", text);
    EXPECT_FALSE(findSidecar(folder_ / "shot.0012.exr")) << text;
  }
  writeText(folder_ / "shot.0012.json", R"({"kagefude": 1, "fra)");
  EXPECT_THROW(findSidecar(folder_ / "shot.0012.exr"), InputError) << "ours may be cut";
}

// It was said not to be there.
TEST_F(SidecarTest, SomeoneElsesJsonIsCalledSo) {
  EXPECT_EQ(foreignJson(folder_ / "shot.0012.exr"), "");
  for (const char* text : {"[]", "{}", "null", "5", R"({"asset": "x"})"}) {
    writeText(folder_ / "shot.0012.json", text);
    EXPECT_EQ(foreignJson(folder_ / "shot.0012.exr"),
              "shot.0012.json beside the frame is none of kagefude's: it has no key \"kagefude\"");
  }
}

TEST_F(SidecarTest, AJsonThatEndsTooEarlyIsCalledSo) {
  const auto said = [&](const std::string& text) {
    writeText(folder_ / "shot.0012.json", text);
    return messageOf<InputError>([&] { findSidecar(folder_ / "shot.0012.exr"); });
  };
  expectContains(said(""), "shot.0012.json is not valid JSON: it is empty");
  expectContains(said("{\"a\": "), "is not valid JSON: it ends after 6 bytes, too early");
  expectContains(said("{\"a\": x}"), "is not valid JSON: trouble at byte 7 of 8");
}

TEST_F(SidecarTest, DepthIsBound) {
  writeText(folder_ / "shot.0012.json", std::string(1 << 20, '['));
  EXPECT_THROW(findSidecar(folder_ / "shot.0012.exr"), InputError);
}

TEST_F(SidecarTest, StandsBesideItsImage) {
  EXPECT_FALSE(findSidecar(folder_ / "shot.0012.exr"));
  read(example());
  EXPECT_EQ(findSidecar(folder_ / "shot.0012.exr")->frame, 12);
  EXPECT_FALSE(findSidecar(folder_ / "shot.0013.exr"));
}

TEST_F(SidecarTest, ComplaintsNameFileAndPlace) {
  expectContains(
      messageWith("/lights/0/masks/samples/1/position", {1, 2}),
      "shot.0012.json: lights[0].masks.samples[1].position should be a list of 3, but is "
      "a list of 2");
  expectContains(messageWith("/lights/0/type", "spto"),
                 "lights[0].type should be one of point, spot, sun and area, but is \"spto\"");
  expectContains(messageWith("/camera/camera_from_world/2", json::array()),
                 "camera.camera_from_world[2] should be a list of 4");
  expectContains(messageWith("/lights/0/radius", -1), "lights[0].radius should be a number from 0");
  expectContains(messageWith("/frame", 1.5), "frame should be a whole number");
  expectContains(messageWith("/objects/0/crypto", "xyz"), "should be eight hexadecimal digits");
  expectContains(messageWith("/lights/0/direction", {0, 0, 0}), "should be a direction");
  expectContains(messageWith("/lights", 7), "lights should be a list");
}

TEST_F(SidecarTest, MissingKeysNameTheNearest) {
  json changed = example();
  changed["lights"][0].erase("radius");
  changed["lights"][0]["raduis"] = 1;
  expectContains(messageOf<InputError>([&] { read(changed); }),
                 "lights[0].radius is missing (did you mean raduis?)");
}

// They were called missing, with themselves as what was meant.
TEST_F(SidecarTest, KeysThatAreNullAreCalledSo) {
  expectContains(messageWith("/lights/0/radius", nullptr),
                 "lights[0].radius is null, but a value is needed");
  expectContains(messageWith("/camera", nullptr), "camera is null, but a value is needed");
}

TEST_F(SidecarTest, OtherVersionsAreRefusedBeforeAllElse) {
  expectContains(messageOf<InputError>([&] {
                   read({{"kagefude", 2}});
                 }),
                 "format version 2, but this program reads version 1; use a newer kagefude");
  expectContains(messageOf<InputError>([&] { read({{"frame", 2}}); }), "kagefude is missing");
  expectContains(messageOf<InputError>([&] { read(json::array()); }),
                 "the file should be an object");
}

TEST_F(SidecarTest, PathsStayInTheFolder) {
  for (const char* path : {"../a.exr", "/etc/passwd", "a/../../b.exr", ""}) {
    EXPECT_FALSE(messageWith("/lights/0/depth_map/file", path).empty()) << path;
  }
  json inside = example();
  inside["lights"][0]["depth_map"]["file"] = "maps/a.exr";
  EXPECT_NO_THROW(read(inside));
}

TEST_F(SidecarTest, ArrangementsHaveTheirNumberOfSamples) {
  expectContains(messageWith("/lights/0/masks/arrangement", "disc"),
                 "lights[0].masks.samples should be a list of 4 to 256, but is a list of 2");
  json three = example();
  three["lights"][0]["masks"]["samples"].push_back(three["lights"][0]["masks"]["samples"][0]);
  expectContains(messageOf<InputError>([&] { read(three); }), "should be a list of 2");
}

TEST_F(SidecarTest, NamesComeOnce) {
  json twice = example();
  twice["objects"].push_back(twice["objects"][0]);
  expectContains(messageOf<InputError>([&] { read(twice); }), "\"Cup\" comes twice");
}

TEST_F(SidecarTest, SunsMayGiveDirectionsAlone) {
  json sun = example();
  for (json& sample : sun["lights"][0]["masks"]["samples"]) {
    sample.erase("position");
    sample["direction"] = {0, 1, -1};
  }
  sun["lights"][0]["type"] = "sun";
  const Sidecar sidecar = read(sun);
  EXPECT_NEAR(sidecar.lights[0].masks->samples[0].direction->z, -0.70710678, 1e-8);
}

TEST_F(SidecarTest, BrokenJsonIsAnInputError) {
  for (const std::string text : {"", "{", "{\"kagefude\": 1e999}", "\xff", "[[[[[["}) {
    writeText(folder_ / "bad.json", text);
    expectContains(messageOf<InputError>([&] { readSidecar(folder_ / "bad.json"); }), "bad.json");
  }
  writeText(folder_ / "deep.json", std::string(200'000, '['));
  EXPECT_THROW(readSidecar(folder_ / "deep.json"), InputError);
}

// Every value of the example replaced by every kind of wrong one: refused or read, never a crash.
TEST_F(SidecarTest, AnyWrongValueIsAnInputErrorAtMost) {
  const json flat = example().flatten();
  const std::vector<json> wrong = {nullptr, -1, 1e308, "text", json::array(), json::object(), true};
  int refused = 0;
  for (const auto& [pointer, value] : flat.items()) {
    // One number of a list stands for all of them.
    if (value.is_number() && pointer.back() >= '1' && pointer.back() <= '3') continue;
    for (const json& replacement : wrong) {
      json changed = example();
      changed[json::json_pointer(pointer)] = replacement;
      try {
        read(changed);
      } catch (const InputError& error) {
        expectContains(error.what(), "shot.0012.json");
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace kagefude
