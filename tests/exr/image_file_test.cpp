#include "exr/image_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include "exr/read_channels.h"
#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

using namespace testing;

// Two parts; the second has a bare R and its own data window.
void writeTwoParts(const std::filesystem::path& path, const Imath::Box2i& second) {
  std::vector<Imf::Header> headers;
  for (int i = 0; i < 2; ++i) {
    const Imath::Box2i window = i == 0 ? Imath::Box2i({0, 0}, {3, 2}) : second;
    Imf::Header header(Imath::Box2i({0, 0}, {3, 2}), window);
    header.setName(i == 0 ? "rgba" : "diffuse");
    header.setType(Imf::SCANLINEIMAGE);
    header.channels().insert("R", Imf::Channel(Imf::FLOAT));
    headers.push_back(header);
  }
  Imf::MultiPartOutputFile output(path.c_str(), headers.data(), 2);
  for (int i = 0; i < 2; ++i) {
    const Imath::Box2i window = headers[static_cast<size_t>(i)].dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    std::vector<float> pixels(static_cast<size_t>(width * height), static_cast<float>(i + 5));
    Imf::FrameBuffer buffer;
    buffer.insert("R", Imf::Slice::Make(Imf::FLOAT, pixels.data(), window.min, width, height));
    Imf::OutputPart part(output, i);
    part.setFrameBuffer(buffer);
    part.writePixels(height);
  }
}

TEST(ImageFile, ReadsWindowsChannelsAndText) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", {"R", "Layer 1.Depth.Z"}, PixelType::half, {-5, 7, 4, 3},
                {{"owner", "someone"}});
  const ImageFile file = openImage(folder / "a.exr");
  EXPECT_EQ(file.dataWindow, (Window{-5, 7, 4, 3}));
  EXPECT_EQ(file.width, 4);
  EXPECT_EQ(file.height, 3);
  EXPECT_EQ(file.compression, "zip");
  EXPECT_EQ(file.channelNames(), (std::vector<std::string>{"Layer 1.Depth.Z", "R"}));
  EXPECT_EQ(file.findChannel("R")->type, PixelType::half);
  EXPECT_EQ(file.findChannel("r"), nullptr);
  EXPECT_EQ(file.text("owner"), "someone");
  EXPECT_FALSE(file.text("nobody"));
}

TEST(ImageFile, BareChannelsOfPartsTakeThePartsNameTheFirstToo) {
  const TemporaryFolder folder;
  writeTwoParts(folder / "two.exr", Imath::Box2i({0, 0}, {3, 2}));
  const ImageFile file = openImage(folder / "two.exr");
  EXPECT_EQ(file.channelNames(), (std::vector<std::string>{"rgba.R", "diffuse.R"}));
  const auto planes = readFloats(file, std::vector<std::string>{"diffuse.R", "rgba.R"});
  EXPECT_EQ(planes[0](3, 2), 6.0f);
  EXPECT_EQ(planes[1](0, 0), 5.0f);
}

TEST(ImageFile, PartsOfDifferentWindowsAreJoinedWithZerosAround) {
  const TemporaryFolder folder;
  writeTwoParts(folder / "two.exr", Imath::Box2i({-1, 1}, {2, 2}));
  const ImageFile file = openImage(folder / "two.exr");
  EXPECT_EQ(file.dataWindow, (Window{-1, 0, 5, 3}));
  const auto planes = readFloats(file, std::vector<std::string>{"rgba.R", "diffuse.R"});
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) {
      EXPECT_EQ(planes[0](x, y), x > 0 ? 5.0f : 0.0f) << x << " " << y;
      EXPECT_EQ(planes[1](x, y), x < 4 && y > 0 ? 6.0f : 0.0f) << x << " " << y;
    }
}

TEST(ImageFile, PartsFarApartClaimWhatNoneOfThemDoes) {
  const TemporaryFolder folder;
  writeTwoParts(folder / "far.exr", Imath::Box2i({90000, 90000}, {90001, 90001}));
  expectContains(messageOf<InputError>([&] { openImage(folder / "far.exr"); }),
                 "far.exr claims 90002 x 90002 pixels");
}

TEST(ImageFile, MissingAndForeignFilesAreNamed) {
  const TemporaryFolder folder;
  expectContains(messageOf<InputError>([&] { openImage(folder / "none.exr"); }), "none.exr");
  writeText(folder / "text.exr", "this is not a picture");
  expectContains(messageOf<InputError>([&] { openImage(folder / "text.exr"); }), "text.exr");
  expectContains(messageOf<InputError>([&] { openImage(folder.path()); }), folder.path().string());
}

TEST(ImageFile, TruncatedFilesAreInputErrors) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", {"R", "G"}, PixelType::single, {0, 0, 64, 64});
  const auto whole = std::filesystem::file_size(folder / "a.exr");
  for (const double share : {0.1, 0.3, 0.6, 0.9, 0.99}) {
    const auto path = folder / "cut.exr";
    std::filesystem::copy_file(folder / "a.exr", path,
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(path, static_cast<uintmax_t>(share * static_cast<double>(whole)));
    const auto message = messageOf<InputError>([&] {
      readFloats(openImage(path), std::vector<std::string>{"R", "G"});
    });
    expectContains(message, "cut.exr");
  }
}

TEST(ImageFile, TilesLargerThanThePictureAreReadUnlessTheyAreHuge) {
  const TemporaryFolder folder;
  const auto withTiles = [&](unsigned width, unsigned height) {
    Imf::Header header(8, 8);
    header.channels().insert("R", Imf::Channel(Imf::FLOAT));
    header.compression() = Imf::ZIP_COMPRESSION;
    header.setTileDescription(Imf::TileDescription(width, height));
    const std::vector<float> ones(64, 1.0f);
    Imf::TiledOutputFile output((folder / "tiles.exr").c_str(), header);
    Imf::FrameBuffer buffer;
    buffer.insert("R", Imf::Slice::Make(Imf::FLOAT, ones.data(), header.dataWindow()));
    output.setFrameBuffer(buffer);
    output.writeTile(0, 0);
  };
  withTiles(512, 256);
  const ImageFile file = openImage(folder / "tiles.exr");
  EXPECT_EQ(readFloats(file, std::vector<std::string>{"R"})[0](7, 7), 1.0f);
  withTiles(8192, 4096);
  expectContains(messageOf<InputError>([&] { openImage(folder / "tiles.exr"); }),
                 "tiles.exr claims tiles of 8192 x 4096 pixels in a picture of 8 x 8");
}

TEST(CheckClaim, AcceptsWhatDeflateCanPack) {
  // 8K, 20 float channels of a constant, packed 1,000 to one.
  EXPECT_NO_THROW(checkClaim("a", 7680, 4320, 80, 2'654'208));
  EXPECT_NO_THROW(checkClaim("a", 1000, 1000, 4, 300));
  EXPECT_NO_THROW(checkClaim("a", 8192, 8192, 8, 20'000, true));
}

TEST(CheckClaim, RefusesTheAbsurd) {
  EXPECT_THROW(checkClaim("a", 8192, 8192, 8, 20'000), InputError);
  EXPECT_THROW(checkClaim("a", 0, 10, 4, 1000), InputError);
  EXPECT_THROW(checkClaim("a", 131073, 1, 4, 1'000'000), InputError);
  EXPECT_THROW(checkClaim("a", 100'000, 100'000, 2, uint64_t{1} << 40), InputError);
  expectContains(
      messageOf<InputError>([] { checkClaim("bomb.exr", 30000, 30000, 4, 464); }),
      "bomb.exr claims 30000 x 30000 pixels (3433 MiB), which its 464 bytes cannot hold");
}

}  // namespace
}  // namespace kagefude
