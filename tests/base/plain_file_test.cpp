#include "base/plain_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/error.h"
#include "test_folder.h"

namespace kagefude {
namespace {

TEST(PlainFile, GivesItsContent) {
  const TestFolder folder;
  const std::string file = folder.write("a.json", "{}");
  EXPECT_EQ(requirePlainFile(file), 2u);
  EXPECT_EQ(readPlainFile(file, 2), "{}");
  EXPECT_NE(messageOf<InputError>([&] { readPlainFile(file, 1); }).find("at most 1"),
            std::string::npos);
}

TEST(PlainFile, WhatIsNoneIsRefusedAndNeverWaitedFor) {
  const TestFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const std::string& file :
       {folder / "pipe", folder.path().string(), std::string("/dev/zero"), folder / "none"}) {
    EXPECT_THROW(requirePlainFile(file), InputError) << file;
    EXPECT_THROW(readPlainFile(file, 100), InputError) << file;
  }
  EXPECT_NE(messageOf<InputError>([&] { requirePlainFile(folder / "pipe"); }).find("a pipe"),
            std::string::npos);
}

}  // namespace
}  // namespace kagefude
