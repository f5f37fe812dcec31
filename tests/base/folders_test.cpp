#include "base/folders.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/error.h"
#include "test_folder.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

TEST(Folders, AreMadeWithThoseAbove) {
  const TestFolder folder;
  makeFolders(folder / "a/b/c");
  EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
  makeFolders(folder / "a/b/c");
  makeFolders(folder / "d/");
  EXPECT_TRUE(fs::is_directory(folder / "d"));
  makeFolders("");
}

TEST(Folders, AreFlushedInTheirParents) {
  const TestFolder folder;
  std::vector<fs::path> flushed;
  const auto note = [&](const fs::path& parent) { flushed.push_back(parent); };
  makeFolders(folder / "a/b", note);
  EXPECT_EQ(flushed, (std::vector<fs::path>{folder.path(), folder / "a"}));
  flushed.clear();
  makeFolders(folder / "a/b", note);
  EXPECT_TRUE(flushed.empty());
}

TEST(Folders, AFileInTheWayIsOneClearError) {
  const TestFolder folder;
  folder.write("a");
  EXPECT_THROW(makeFolders(folder / "a"), OutputError);
  EXPECT_THROW(makeFolders(folder / "a/b"), OutputError);
}

}  // namespace
}  // namespace kagefude
