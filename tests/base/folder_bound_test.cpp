#include "base/folder_bound.h"

#include <gtest/gtest.h>

#include <string>

namespace kagefude {
namespace {

TEST(FolderBound, PathsBelowTheFolderStay) {
  for (const char* path : {"a.obj", "shot.casters/a.obj", "./a.obj", "..a/b..", "Key:1.depth.exr"})
    EXPECT_TRUE(staysInFolder(path)) << path;
}

TEST(FolderBound, AllElseLeavesIt) {
  for (const char* path :
       {"", "/etc/passwd", "..", "../a", "a/../../b", "a/..", "C:a", "C:\\a", "..\\a", "a\\b"})
    EXPECT_FALSE(staysInFolder(path)) << path;
  EXPECT_FALSE(staysInFolder(std::string("a\0/../b", 7)));
}

}  // namespace
}  // namespace kagefude
