#include "exr/read_channels.h"

#include <tbb/global_control.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "exr/fast_fixture.h"
#include "frame/frame_fixtures.h"

namespace kagefude {
namespace {

using namespace testing;
using Names = std::vector<std::string>;

TEST(ReadChannels, OnlyWhatIsAskedForInTheOrderAsked) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", {"a", "b", "c"}, PixelType::half);
  const auto planes = readFloats(openImage(folder / "a.exr"), Names{"c", "a"});
  ASSERT_EQ(planes.size(), 2u);
  EXPECT_EQ(planes[0](1, 2), 209.0f);
  EXPECT_EQ(planes[1](1, 2), 9.0f);
  EXPECT_TRUE(readFloats(openImage(folder / "a.exr"), {}).empty());
}

TEST(ReadChannels, UnknownChannelsAreNamedWithTheNearest) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", {"Layer.Depth.Z"});
  expectContains(messageOf<InputError>(
                     [&] { readFloats(openImage(folder / "a.exr"), Names{"Layer.Dpeth.Z"}); }),
                 "has no channel Layer.Dpeth.Z (did you mean Layer.Depth.Z?)");
}

TEST(ReadChannels, HalfIdsAreRefused) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", {"id"}, PixelType::half);
  expectContains(messageOf<InputError>([&] { readBits(openImage(folder / "a.exr"), Names{"id"}); }),
                 "stores the id channel id as half float");
}

TEST(ReadChannels, IndicesAreRoundedAndStrangeOnesAreBackground) {
  Floats values(6, 1);
  const float given[] = {2.9999f, 3.0f, -4.0f, NAN, 1e20f, 0.4f};
  for (int x = 0; x < 6; ++x) values(x, 0) = given[x];
  const Labels labels = roundIndices(values);
  const uint32_t expected[] = {3, 3, 0, 0, 0, 0};
  for (int x = 0; x < 6; ++x) EXPECT_EQ(labels(x, 0), expected[x]) << x;
}

TEST(ReadChannels, OneChannelInSeveralFormsIsReadOnce) {
  const TemporaryFolder folder;
  writeChannels(folder / "h.exr", {"v"}, PixelType::half);
  writeChannels(folder / "f.exr", {"v"}, PixelType::single);
  for (const char* name : {"h.exr", "f.exr"}) {
    const ImageFile file = openImage(folder / name);
    ChannelReader reader(file);
    Floats first, second;
    RawPlane raw;
    reader.floats("v", first);
    reader.raw("v", raw);
    reader.floats("v", second);
    reader.read();
    EXPECT_EQ(first(3, 2), 11.0f);
    EXPECT_EQ(second(3, 2), 11.0f);
    EXPECT_EQ(raw.type, file.channels[0].type);
  }
}

/// Calls `check(reader, name, values, others)` for halves, floats and whole numbers full of noise,
/// by themselves and where others want the channel as well. Zip is decoded by the fast path, PIZ by
/// OpenEXR.
template <class Check>
void onNoise(const Check& check) {
  const TemporaryFolder folder;
  const std::string path = (folder / "a.exr").string();
  for (const Imf::Compression codec : {Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
    writeWithOpenExr(path, {makeTestPart("", {-5, 2, 37, 19}, codec, TestPixels::noise, 3)});
    const ImageFile file = openImage(path);
    for (const std::string name : {"R", "Layer.Depth.Z", "Layer.Index.X"}) {
      const Floats values = std::move(readFloats(file, Names{name}).front());
      for (const bool others : {false, true}) {
        ChannelReader reader(file);
        check(reader, name, values, others);
      }
    }
  }
}

TEST(ReadChannels, MasksAreTheSameWhateverReadsThemAndWhoeverElseWantsThem) {
  onNoise([](ChannelReader& reader, const std::string& name, const Floats& values, bool others) {
    Bytes first, second;
    Floats floats;
    RawPlane raw;
    size_t unknown = 7, again = 7, expected = 0;
    reader.mask(name, first, unknown);
    if (others) {
      reader.floats(name, floats);
      reader.raw(name, raw);
    }
    reader.mask(name, second, again);
    reader.read();
    for (int i = 0; i < 37 * 19; ++i) {
      const float value = values.row(0)[i];
      const bool known = std::isfinite(value);
      ASSERT_EQ(first.row(0)[i], !known || value >= 0.5f ? 1 : 0) << name << " " << i;
      ASSERT_EQ(second.row(0)[i], first.row(0)[i]);
      expected += !known;
    }
    EXPECT_EQ(unknown, expected) << name;
    EXPECT_EQ(again, expected) << name;
    if (others) {
      EXPECT_EQ(std::memcmp(floats.row(0), values.row(0), 4 * 37 * 19), 0) << name;
    }
  });
}

TEST(ReadChannels, SparsePlanesAreTheSameWhateverReadsThemAndWhoeverElseWantsThem) {
  onNoise([](ChannelReader& reader, const std::string& name, const Floats& values, bool others) {
    SparsePlane first, second;
    Bytes mask;
    size_t unknown = 0;
    RawPlane raw;
    reader.sparseFloats(name, first);
    if (others) {
      reader.mask(name, mask, unknown);
      reader.raw(name, raw);
    }
    reader.sparseFloats(name, second);
    reader.read();
    for (int y = 0; y < 19; ++y)
      for (int x = 0; x < 37; ++x) {
        ASSERT_EQ(first(x, y), std::bit_cast<uint32_t>(values(x, y))) << name << " " << x;
        ASSERT_EQ(second(x, y), first(x, y)) << name << " " << x;
      }
  });
}

TEST(ReadChannels, SparseIdsKeepTheirBitsAndHalvesAreRefused) {
  const TemporaryFolder folder;
  const std::string path = (folder / "a.exr").string();
  const auto part = makeTestPart("", {-5, 2, 37, 19}, Imf::ZIP_COMPRESSION, TestPixels::noise, 3);
  writeWithOpenExr(path, {part});
  const ImageFile file = openImage(path);
  for (const Channel& channel : file.channels) {
    ChannelReader reader(file);
    SparsePlane sparse;
    if (channel.type == PixelType::half) {
      EXPECT_THROW(reader.sparseBits(channel.name, sparse), InputError);
      continue;
    }
    reader.sparseBits(channel.name, sparse);
    reader.read();
    const Labels ids = std::move(readBits(file, Names{channel.name}).front());
    for (int y = 0; y < 19; ++y)
      for (int x = 0; x < 37; ++x) ASSERT_EQ(sparse(x, y), ids(x, y)) << channel.name;
  }
}

TEST(ReadChannels, SameBitsForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  writeChannels(folder / "a.exr", {"a", "b"}, PixelType::single, {-7, 3, 33, 1100});
  const ImageFile file = openImage(folder / "a.exr");
  for (const size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto planes = readFloats(file, Names{"a", "b"});
    for (int i = 0; i < 33 * 1100; ++i) {
      ASSERT_EQ(planes[0].row(0)[i], static_cast<float>(i));
      ASSERT_EQ(planes[1].row(0)[i], static_cast<float>(i) + 100.0f);
    }
  }
}

}  // namespace
}  // namespace kagefude
