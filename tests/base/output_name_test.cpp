#include "base/output_name.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "test_folder.h"

namespace kagefude {
namespace {

TEST(OutputName, SuffixesMeanWhatTheySay) {
  requireSuffix("out/shot.####.exr", ".exr", "--output");
  requireSuffix("A.EXR", ".exr", "--output");
  for (const char* wrong : {"x.png", "x", "look.toml", ".exr", "x.exr/y"})
    EXPECT_THROW(requireSuffix(wrong, ".exr", "--output"), UsageError) << wrong;
}

TEST(OutputName, WhatIsThereIsNotReplaced) {
  const TestFolder folder;
  EXPECT_NO_THROW(refuseToReplace(folder / "new.png", "-o"));
  const std::string there = folder.write("strip.png");
  const std::string said = messageOf<UsageError>([&] { refuseToReplace(there, "-o"); });
  EXPECT_NE(said.find("strip.png is there already"), std::string::npos) << said;
  EXPECT_NE(said.find("another name for -o"), std::string::npos) << said;
  EXPECT_NE(said.find("--force"), std::string::npos) << said;
  std::filesystem::create_symlink("nowhere", folder / "link.png");
  EXPECT_THROW(refuseToReplace(folder / "link.png", "-o"), UsageError);
  EXPECT_THROW(refuseToReplace(folder.path(), "-o"), UsageError);
}

}  // namespace
}  // namespace kagefude
