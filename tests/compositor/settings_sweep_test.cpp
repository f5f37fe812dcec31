#include <set>

#include "compositor/sweep_frame.h"

namespace kagefude {
namespace {

using testing::companions;
using testing::contextOf;
using testing::takesPair;

class Sweep : public ::testing::Test, protected testing::SweepFrame {
 protected:
  /// Everything that a look makes of the frame, as bytes.
  std::string result(const std::string& look, const std::vector<std::string>& set) const {
    const FrameResult r = frame.comp("output.layers = [\"*\"]\n" + look, set);
    std::string bytes;
    const auto add = [&](View<const float> plane) {
      bytes.append(reinterpret_cast<const char*>(plane.data), plane.pixels() * sizeof(float));
    };
    add(r.colour.x);
    add(r.colour.y);
    add(r.colour.z);
    add(r.alpha);
    for (const auto& [name, plane] : r.layers) {
      if (!plane.floats.empty()) add(plane.floats);
      if (!plane.labels.empty())
        bytes.append(reinterpret_cast<const char*>(plane.labels.row(0)),
                     plane.labels.view().pixels() * sizeof(uint32_t));
    }
    return bytes;
  }

  /// Whether any value of the key changes the output.
  bool acts(const std::string& look, const std::string& path, const Parameter& p) const {
    const std::string before = result(look, {});
    for (const std::string& value : candidates(p))
      if (result(look, {path + "=" + value}) != before) return true;
    return false;
  }
};

TEST_F(Sweep, EveryKeyOfAPassActsWhereItIsTakenOrIsRefusedByName) {
  addLight("Fill", {-3, -1, 9}, 4);
  const std::set<std::string> noPasses{"frame",  "shadow", "scene", "colour",
                                       "output", "light",  "style", "ground"};
  for (const LookSection& row : lookSections) {
    const std::string section(row.table->pass);
    if (noPasses.contains(section)) continue;
    const std::string arrangement = takesPair(section) ? "pair" : "disc";
    arrange(arrangement, takesPair(section) ? 2 : 9);
    mask("Fill", frame.sidecar["lights"][1], arrangement, takesPair(section) ? 2 : 9, 4);
    // A spot for the cone alone: round lights have none.
    frame.sidecar["lights"][0]["type"] = section == "shade" ? "spot" : "point";
    frame.sidecar["lights"][0]["cone"] = {{"angle", 0.5}, {"blend", 0.5}};
    // Lights of two colours, or they tint nothing.
    frame.sidecar["lights"][0]["color"] = {1, section == "tint" ? 0.5 : 1, 1};
    for (const Parameter& p : row.table->parameters) {
      const std::string key = section + "." + std::string(p.name);
      const auto companion = companions.find(key);
      const std::string with = companion == companions.end() ? "" : companion->second;
      const std::string end =
          "[[light]]\nname = \"*\"\n[[style]]\nstrip = \"builtin:soft\"\n"
          "colour = \"replace\"\noutline_colour = [0, 0, 0]\n";
      const std::string look = with + contextOf(section) + end;
      EXPECT_TRUE(acts(with + contextOf(section) +
                           "[[style]]\nstrip = \"builtin:soft\"\ncolour = \"replace\"\n"
                           "outline_colour = [0, 0, 0]\n",
                       key, p))
          << key << " does nothing for the whole look";
      for (const Scope scope : {Scope::light, Scope::style}) {
        const std::string path = std::string(scope == Scope::light ? "light" : "style") + "[0].";
        if (actsIn(scope, row, p.name)) {
          EXPECT_TRUE(acts(look, path + key, p)) << path << key << " does nothing";
        } else {
          const std::string said = messageOf<LookError>(
              [&] { result(look, {path + key + "=" + candidates(p).front()}); });
          EXPECT_NE(said.find(section), std::string::npos) << path << key << ": " << said;
          EXPECT_NE(said.find("does nothing"), std::string::npos) << path << key << ": " << said;
        }
      }
    }
  }
}

TEST_F(Sweep, KeysThatOnlyDescribeOwnLightsAreRefusedOnOthers) {
  const std::string start = "[[light]]\nname = \"Key\"\n";
  for (const char* line :
       {"masks = [\"a\", \"b\"]", "places = [1, 0, -1, 0]", "depth_map = \"depth.exr\"",
        "light_from_world = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]",
        "clip_from_light = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]", "type = \"sun\""}) {
    const std::string said = messageOf<LookError>([&] { result(start + line + "\n", {}); });
    const std::string key = std::string(line).substr(0, std::string(line).find(' '));
    EXPECT_NE(said.find("light." + key), std::string::npos) << line << ": " << said;
  }
}

TEST_F(Sweep, OneShadowLightsListHoldsForTheWholeLook) {
  const std::string said = messageOf<LookError>(
      [&] { result("[[light]]\nname = \"Key\"\nshadow.lights = [\"Key\"]\n", {}); });
  EXPECT_NE(said.find("shadow.lights"), std::string::npos) << said;
}

TEST_F(Sweep, EveryKeyOfShadowActs) {
  for (const std::string start : {"", "[[light]]\nname = \"Key\"\n"}) {
    const auto differs = [&](const std::string& before, const std::string& after) {
      EXPECT_NE(result(start + before, {}), result(start + before + after, {})) << start << after;
    };
    differs("", "shadow.method = \"none\"\n");
    differs("", "shadow.strength = 0.3\n");
    differs("shadow.method = \"places\"\n", "shadow.places = 17\n");
    differs("shadow.method = \"blob\"\nshadow.receiver = \"Ground\"\n",
            "shadow.blob = \"" + blobFile() + "\"\n");
  }
}

}  // namespace
}  // namespace kagefude
