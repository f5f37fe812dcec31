#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "exr/write_image.h"
#include "source_folder.h"
#include "test_folder.h"

namespace kagefude::testing {

/// An empty folder that goes when the test ends.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "kagefude-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }

 private:
  std::filesystem::path path_;
};

inline void writeText(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// A small EXR whose float channels hold 0, 1, 2 ... plus 100 times the channel's number.
inline void writeChannels(const std::filesystem::path& path, const std::vector<std::string>& names,
                          PixelType type = PixelType::single, Window window = {0, 0, 4, 3},
                          const std::map<std::string, std::string>& attributes = {}) {
  std::vector<Floats> planes;
  OutputImage image;
  image.dataWindow = image.displayWindow = window;
  image.attributes = attributes;
  for (size_t c = 0; c < names.size(); ++c) {
    Floats plane(window.width, window.height);
    for (int i = 0; i < window.width * window.height; ++i) {
      plane.row(0)[i] = static_cast<float>(i) + 100.0f * static_cast<float>(c);
    }
    planes.push_back(std::move(plane));
    image.channels.push_back(floatChannel(names[c], type, planes.back()));
  }
  writeExr(path, image);
}

inline void expectContains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is not in: " << text;
}

/// For tests that only add to others of the same thing on files that they make themselves.
#define KAGEFUDE_NEEDS_SAMPLES()                                           \
  if (!std::filesystem::is_directory(kagefude::testing::sampleFolder())) { \
    GTEST_SKIP() << "the sample files are not beside the repository";      \
  }

}  // namespace kagefude::testing
