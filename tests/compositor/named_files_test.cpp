#include <gtest/gtest.h>

#include "compositor/look_colour.h"
#include "compositor/map_frame.h"

namespace kagefude {
namespace {

using namespace testing;

/// Whatever a look names and cannot be used is called by the look's file, line and key.
struct FilesOfALook : ::testing::Test {
  FilesOfALook() { frame.addSun("Key", {0, 0, -1}); }

  void expectError(const std::string& look, const std::vector<std::string>& parts,
                   const std::vector<std::string>& set = {}) const {
    std::string said;
    try {
      frame.comp(look, set);
    } catch (const Error& error) {
      said = error.what();
    }
    for (const std::string& part : parts)
      EXPECT_NE(said.find(part), std::string::npos) << look << "no \"" << part << "\" in: " << said;
  }

  MapFrame frame;
};

TEST_F(FilesOfALook, StripsOfStyles) {
  frame.folder.write("teal.png");
  const std::string look =
      "[[style]]\nobject = \"Cup\"\n[[style]]\nobject = \"Thing\"\nstrip = \"teel.png\"\n";
  expectError(look, {"look.toml:5: style[1].strip: strip ", "teel.png does not exist",
                     "did you mean teal.png?"});
  expectError("[[style]]\nstrip = \"teal.png\"\n", {"look.toml:2: style[0].strip: ", "teal.png"});
  expectError("[style]\nstrip = \"none.png\"\n", {"look.toml:2: style[0].strip: "});
  expectError("[[style]]\nstrip = \"builtin:sof\"\n",
              {"look.toml:2: style[0].strip: there is no built-in strip sof"});
  expectError("[[style]]\nobject = \"*\"\n", {"--set style[0].strip: strip ", "none.png"},
              {"style[0].strip=none.png"});
}

TEST_F(FilesOfALook, StripsOfLights) {
  expectError("[[light]]\nname = \"Key\"\nstrip = \"none.png\"\n",
              {"look.toml:3: light[0].strip: strip "});
  expectError("[[style]]\nstrip = \"builtin:soft\"\n\nlight_strips = [\"Key=none.png\"]\n",
              {"look.toml:4: style[0].light_strips: strip "});
  expectError("[[style]]\nstrip = \"builtin:soft\"\nlight_strips = [\"Kei=\"]\n",
              {"look.toml:3: style.light_strips gives Kei", "did you mean Key?"});
  expectError("[[style]]\nstrip = \"builtin:soft\"\nlight = \"Kei\"\n",
              {"look.toml:3: style[0].light Kei is no light"});
}

TEST_F(FilesOfALook, GroundsAndBlobs) {
  expectError("[output]\nbackground = \"strip\"\n[ground]\nstrip = \"none.png\"\n",
              {"look.toml:4: ground.strip: strip "});
  expectError("[output]\nbackground = \"picture\"\n",
              {"look.toml:2: output.background = \"picture\" shows the file"});
  const std::string blob = "method = \"blob\"\nreceiver = \"Thing\"\nblob = \"none.png\"\n";
  expectError("[shadow]\n" + blob, {"look.toml:4: shadow.blob: picture "});
  expectError("[[light]]\nname = \"Key\"\n[light.shadow]\n" + blob,
              {"look.toml:6: light[0].shadow.blob: picture "});
  expectError("[shadow]\n" + blob + "[[light]]\nname = \"Key\"\n",
              {"look.toml:4: shadow.blob: picture "});
}

TEST_F(FilesOfALook, DepthMapsColoursAndOtherFiles) {
  expectError(
      "[shadow]\nmethod = \"pcf\"\nlights = [\"New\"]\n[[light]]\nname = \"New\"\n"
      "position = [0.5, 1, 3]\nlight_from_world = [1,0,0,0, 0,1,0,0, 0,0,1,-4, 0,0,0,1]\n"
      "clip_from_light = [2,0,0,0, 0,2,0,0, 0,0,-1,-0.2, 0,0,-1,0]\ndepth_map = \"none.exr\"\n",
      {"look.toml:9: light[0].depth_map: ", "none.exr"});
  expectError("[frame]\nfiles = [\"P=none.exr\"]\n", {"look.toml:2: frame.files: ", "none.exr"});
  expectError("[output]\nlayers = [\"brush.tnoe\"]\n",
              {"look.toml:2: output.layers: no layer", "did you mean brush.tone?"});
  frame.folder.write("look.toml", "[colour]\nconfig = \"none.ocio\"\n");
  const Look look = readLook(frame.folder / "look.toml", {});
  const std::string said = messageOf<InputError>([&] { colourOf(look); });
  EXPECT_NE(said.find("look.toml:2: colour.config: "), std::string::npos) << said;
}

}  // namespace
}  // namespace kagefude
