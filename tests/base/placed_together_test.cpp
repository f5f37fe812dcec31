#include "base/placed_together.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "base/temp_file.h"
#include "test_folder.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

void placeNew(PlacedTogether& files, const fs::path& target) {
  writeFileAtomically(files.scratch() / "made", "new");
  files.place(files.scratch() / "made", target);
}

TEST(PlacedTogether, StaysWithKeep) {
  const TestFolder folder;
  folder.write("l.toml", "old");
  {
    PlacedTogether files(folder / ".l.new");
    placeNew(files, folder / "l_strips/a.png");
    placeNew(files, folder / "l.toml");
    files.keep();
  }
  EXPECT_EQ(TestFolder::read(folder / "l_strips/a.png"), "new");
  EXPECT_EQ(TestFolder::read(folder / "l.toml"), "new");
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(PlacedTogether, WithoutKeepAllIsAsBefore) {
  const TestFolder folder;
  folder.write("l.toml", "old");
  folder.write("own/mine.png", "mine");
  fs::create_symlink("nowhere", folder / "link.png");
  {
    PlacedTogether files(folder / ".l.new");
    placeNew(files, folder / "l_strips/a.png");
    placeNew(files, folder / "own/a.png");
    placeNew(files, folder / "link.png");
    placeNew(files, folder / "l.toml");
    EXPECT_EQ(TestFolder::read(folder / "l.toml"), "new");
  }
  EXPECT_FALSE(fs::exists(folder / "l_strips"));
  EXPECT_FALSE(fs::exists(folder / "own/a.png"));
  EXPECT_EQ(TestFolder::read(folder / "own/mine.png"), "mine");
  EXPECT_EQ(TestFolder::read(folder / "l.toml"), "old");
  EXPECT_EQ(fs::read_symlink(folder / "link.png"), "nowhere");
  EXPECT_EQ(folder.entries(), 3u);
}

TEST(PlacedTogether, OnePlaceThatCannotBeTakenTakesAllBack) {
  const TestFolder folder;
  folder.write("l.toml/inside", "mine");
  folder.write("file", "mine");
  const auto placing = [&](const char* target) {
    return messageOf<OutputError>([&] {
      PlacedTogether files(folder / ".l.new");
      placeNew(files, folder / "l_strips/a.png");
      placeNew(files, folder / target);
      files.keep();
    });
  };
  EXPECT_NE(placing("l.toml").find("l.toml: it is not a regular file"), std::string::npos);
  EXPECT_NE(placing("file/a.png").find("cannot write"), std::string::npos);
  EXPECT_EQ(TestFolder::read(folder / "l.toml/inside"), "mine");
  EXPECT_EQ(TestFolder::read(folder / "file"), "mine");
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(PlacedTogether, AnInterruptTakesAllBack) {
  const TestFolder folder;
  folder.write("l.toml", "old");
  const pid_t child = fork();
  if (child == 0) {
    PlacedTogether files(folder / ".l.new");
    placeNew(files, folder / "l_strips/a.png");
    placeNew(files, folder / "l.toml");
    removeLiveTempFiles();
    const bool refused =
        !messageOf<OutputError>([&] { files.keep(); }).empty() &&
        !messageOf<OutputError>([&] { files.place(folder / "x", folder / "y"); }).empty();
    _exit(refused ? 7 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(TestFolder::read(folder / "l.toml"), "old");
  EXPECT_EQ(folder.entries(), 1u);
}

}  // namespace
}  // namespace kagefude
