#include "frame/frame_group.h"

#include "exr/read_channels.h"
#include "frame/frame_fixtures.h"
#include "frame/frame_view.h"

namespace kagefude {
namespace {

using namespace testing;

std::string layerFor(const std::string& pattern, const std::string& frame,
                     const std::string& view = "") {
  const auto files = groupFiles(frame, {pattern}, 12, view);
  return files.size() == 1 ? files[0].layer : "no file";
}

TEST(FrameGroup, TheLayerIsWhatTheFilesNameAdds) {
  EXPECT_EQ(layerFor("shot.N.####.exr", "a/shot.0012.exr"), "N");
  EXPECT_EQ(layerFor("shot.N.####.exr", "a/shot.beauty.0012.exr"), "N");
  EXPECT_EQ(layerFor("shot_world_pos.%04d.tif", "a/shot_rgba.0012.exr"), "world.pos");
  EXPECT_EQ(layerFor("shot.%V.P.####.exr", "a/shot.left.0012.exr", "left"), "P");
  EXPECT_EQ(layerFor("../normals/shot.####.exr", "a/beauty/shot.0012.exr"), "normals");
  EXPECT_EQ(layerFor("data.Normal=n.####.tif", "a/shot.0012.exr"), "data.Normal");
}

TEST(FrameGroup, FilesLieBesideTheFrameAndItsOwnIsLeftOut) {
  const auto files = groupFiles("a/shot.0012.exr", {"shot.####.exr", "shot.P.####.exr"}, 12, "");
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].path, "a/shot.P.0012.exr");
}

TEST(FrameGroup, PatternsThatAreNoneNameTheKey) {
  expectContains(messageOf<LookError>([&] { groupFiles("a.exr", {"a.##.##.exr"}, 1, ""); }),
                 "frame.files: a.##.##.exr");
  expectContains(messageOf<LookError>([&] { groupFiles("a.exr", {"a.%V.exr"}, 1, ""); }),
                 "frame.files: a.%V.exr");
}

TEST(FrameGroup, ChannelsOfAllFilesAreReadEachFromItsOwn) {
  const TemporaryFolder folder;
  writeChannels(folder / "shot.exr", {"R", "G", "B"});
  writeChannels(folder / "shot.N.exr", {"R", "G", "B"}, PixelType::half);
  writeChannels(folder / "shot.P.exr", {"X", "P.Y"}, PixelType::single, {1, 1, 2, 2});
  std::vector<GroupFile> others = groupFiles(folder / "shot.exr", {"shot.N.exr"}, 1, "");
  const ImageFile joined = openFrame(folder / "shot.exr", "", others);
  EXPECT_EQ(joined.channelNames(), (std::vector<std::string>{"B", "G", "R", "N.B", "N.G", "N.R"}));
  const auto planes = readFloats(joined, std::vector<std::string>{"N.G", "G", "R"});
  EXPECT_EQ(planes[0](2, 1), 106.0f);
  EXPECT_EQ(planes[1](2, 1), 106.0f);
  EXPECT_EQ(planes[2](2, 1), 6.0f);
  others = groupFiles(folder / "shot.exr", {"shot.P.exr"}, 1, "");
  expectContains(messageOf<InputError>([&] { openFrame(folder / "shot.exr", "", others); }),
                 "the files of a frame have one size");
}

}  // namespace
}  // namespace kagefude
