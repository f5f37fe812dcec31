#include "base/files_read.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/plain_file.h"
#include "base/temp_file.h"
#include "test_folder.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

TEST(FileSet, KnowsFilesByWhatTheyAre) {
  const TestFolder folder;
  FileSet files;
  files.add(folder.write("in/a.exr"));
  files.add(folder / "in/none.exr");
  fs::create_hard_link(folder / "in/a.exr", folder / "hard.exr");
  fs::create_symlink(folder / "in/a.exr", folder / "soft.exr");
  folder.write("b.exr");
  EXPECT_TRUE(files.find(folder / "in/../in/a.exr"));
  EXPECT_TRUE(files.find(folder / "hard.exr"));
  EXPECT_TRUE(files.find(folder / "soft.exr"));
  EXPECT_FALSE(files.find(folder / "b.exr"));
  EXPECT_FALSE(files.find(folder / "in/none.exr"));
}

TEST(FileSet, AMemberThatIsGoneIsNone) {
  const TestFolder folder;
  FileSet files;
  files.add(folder.write("a.exr"));
  fs::rename(folder / "a.exr", folder / "b.exr");  // the same file, and no longer the member
  EXPECT_FALSE(files.find(folder / "b.exr"));
}

TEST(FilesRead, AreNeverWritten) {
  const TestFolder folder;
  folder.write("look.toml", "old");
  fs::create_hard_link(folder / "look.toml", folder / "out.exr");
  {
    const FilesReadGuard guard;
    readPlainFile(folder / "look.toml", 100);
    const std::string message =
        messageOf<UsageError>([&] { writeFileAtomically(folder / "out.exr", "new"); });
    EXPECT_NE(message.find("look.toml"), std::string::npos) << message;
    writeFileAtomically(folder / "other.exr", "new");
  }
  EXPECT_EQ(TestFolder::read(folder / "look.toml"), "old");
  EXPECT_EQ(folder.entries(), 3u);
  writeFileAtomically(folder / "out.exr", "new");  // without a guard nothing is noted
}

TEST(FilesRead, AnOutputThatIsLookedAtMayBeMadeAnew) {
  const TestFolder folder;
  const FilesReadGuard guard;
  folder.write("out.exr", "old");
  {
    const LooksAtOutputs looking;
    readPlainFile(folder / "out.exr", 100);
  }
  writeFileAtomically(folder / "out.exr", "new");
  EXPECT_EQ(TestFolder::read(folder / "out.exr"), "new");
}

}  // namespace
}  // namespace kagefude
