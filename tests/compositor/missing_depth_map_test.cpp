#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "compositor/sweep_frame.h"

namespace kagefude {
namespace {

struct MissingDepthMap : ::testing::Test, testing::SweepFrame {
  MissingDepthMap() { std::filesystem::remove(frame.folder / "depth.exr"); }
};

TEST_F(MissingDepthMap, MasksDoWithoutAndSayIt) {
  const FrameResult result = frame.comp("");
  EXPECT_EQ(std::count_if(result.warnings.begin(), result.warnings.end(),
                          [](const std::string& warning) {
                            return warning.find("depth.exr of light Key does not exist") !=
                                   std::string::npos;
                          }),
            1);
  const FrameResult alone = frame.comp("light_shape.depth_map = false\n");
  for (const std::string& warning : alone.warnings)
    EXPECT_EQ(warning.find("depth map"), std::string::npos) << warning;
}

TEST_F(MissingDepthMap, APairDoesWithoutByItself) {
  arrange("pair", 2);
  const FrameResult result = frame.comp("");
  EXPECT_NE(std::find_if(result.warnings.begin(), result.warnings.end(),
                         [](const std::string& warning) {
                           return warning.find("of light Key does not exist") != std::string::npos;
                         }),
            result.warnings.end());
  const FrameResult pair = frame.comp("shadow.method = \"pair\"\n");
  for (int y = 0; y < height; ++y)
    EXPECT_TRUE(
        std::equal(result.colour.x.row(y), result.colour.x.row(y) + width, pair.colour.x.row(y)));
}

TEST_F(MissingDepthMap, AMethodThatIsMadeOfItIsRefused) {
  try {
    frame.comp("shadow.method = \"pcss\"\n");
    ADD_FAILURE() << "nothing was refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("depth.exr"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace kagefude
