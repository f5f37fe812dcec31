#pragma once

#include <Imath/ImathBox.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfLineOrder.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "exr/fast_types.h"
#include "image/window.h"

namespace kagefude {

/// A folder of its own for each test, removed afterwards.
class ExrFastTest : public ::testing::Test {
 protected:
  ExrFastTest() {
    std::string name = (std::filesystem::temp_directory_path() / "kagefude_exr_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~ExrFastTest() override { std::filesystem::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

inline std::vector<char> contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// One channel of a test file: its samples as they are in the file, row by row.
struct TestChannel {
  std::string name;
  ExrType type;
  std::vector<uint8_t> bytes;
};

struct TestPart {
  std::string name;
  Window data;
  Window display;
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  Imf::LineOrder order = Imf::INCREASING_Y;
  std::vector<TestChannel> channels;
};

enum class TestPixels { smooth, flat, noise };

/// A part whose channels carry every type. Noise is any bits but NaNs, so that it does not shrink.
TestPart makeTestPart(const std::string& name, Window data, Imf::Compression compression,
                      TestPixels pixels, uint32_t seed);
/// Written by OpenEXR's C++ library; more than one part makes a multi-part file.
void writeWithOpenExr(const std::string& path, const std::vector<TestPart>& parts);
/// The samples of one channel as OIIO reads them, in the file's type (floats for half ones, exact).
std::vector<uint8_t> readWithOiio(const std::string& path, int part, const std::string& channel,
                                  ExrType type);

}  // namespace kagefude
