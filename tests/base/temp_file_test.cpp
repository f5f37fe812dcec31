#include "base/temp_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "base/error.h"
#include "test_folder.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

/// Runs `body` in a process of its own and returns its exit code.
template <class Body>
int exitCodeOf(const Body& body) {
  const pid_t child = fork();
  if (child == 0) _exit(body());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(TempFile, AppearsOnlyWithCommit) {
  const TestFolder folder;
  TempFile file(folder / "shot.0001.exr");
  EXPECT_EQ(file.path().filename().string().front(), '.');
  EXPECT_EQ(fs::canonical(file.path().parent_path()), fs::canonical(folder.path()));
  std::ofstream(file.path()) << "pixels";
  EXPECT_FALSE(fs::exists(file.target()));
  file.commit();
  EXPECT_EQ(TestFolder::read(folder / "shot.0001.exr"), "pixels");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(TempFile, LeavesTheOlderFileWithoutCommit) {
  const TestFolder folder;
  folder.write("a.exr", "old");
  {
    const TempFile file(folder / "a.exr");
    std::ofstream(file.path()) << "half of the n";
  }
  EXPECT_EQ(TestFolder::read(folder / "a.exr"), "old");
  EXPECT_EQ(folder.entries(), 1u);
  writeFileAtomically(folder / "a.exr", "new");
  EXPECT_EQ(TestFolder::read(folder / "a.exr"), "new");
}

TEST(TempFile, TwoOnOneTargetDoNotMeet) {
  const TestFolder folder;
  const TempFile one(folder / "a.exr");
  const TempFile two(folder / "a.exr");
  EXPECT_NE(one.path(), two.path());
}

TEST(TempFile, NamesAreRecognised) {
  const TestFolder folder;
  const TempFile file(folder / "a.kagefude-b.exr");
  const auto name = parseTempName(file.path().filename().string());
  ASSERT_TRUE(name);
  EXPECT_EQ(name->target, "a.kagefude-b.exr");
  EXPECT_EQ(name->pid, getpid());
  const auto other = parseTempName(".a.exr.kagefude-my-host-12-3.tmp");
  ASSERT_TRUE(other);
  EXPECT_EQ(other->host, "my-host");
  EXPECT_EQ(other->pid, 12);
  for (const char* foreign :
       {"a.exr", ".a.exr.tmp", "a.exr.kagefude-h-1-2.tmp", ".a.kagefude-h-1.tmp",
        ".a.kagefude-h-0-2.tmp", ".a.kagefude-h-x-2.tmp", ".a.kagefude-h-1-2",
        ".a.kagefude--1-2.tmp", ".kagefude-h-1-2.tmp", ".a.kagefude-h-99999999999999999999-2.tmp",
        ""})
    EXPECT_FALSE(parseTempName(foreign)) << foreign;
}

TEST(TempFile, VeryLongNamesStayWithinTheFileSystemsLimit) {
  const TestFolder folder;
  const std::string target = folder / (std::string(250, 'n') + ".exr");
  TempFile file(target);
  EXPECT_LE(file.path().filename().string().size(), 255u);
  EXPECT_TRUE(parseTempName(file.path().filename().string()));
  file.commit();
  EXPECT_TRUE(fs::exists(target));
}

TEST(TempFile, ImpossibleTargetsAreOneClearError) {
  const TestFolder folder;
  EXPECT_NE(messageOf<OutputError>([&] { TempFile(folder / "none/a.exr"); }).find("No such file"),
            std::string::npos);
  EXPECT_NE(messageOf<OutputError>([&] { TempFile(folder.path()); }).find("not a regular file"),
            std::string::npos);
  EXPECT_THROW(TempFile("/dev/null"), OutputError);
  EXPECT_THROW(TempFile(folder / ""), OutputError);
}

/// Root writes anywhere, so it lays its rights down first; only for a process of its own.
bool becomeNobody() {
  constexpr uid_t nobody = 65534;
  return geteuid() != 0 || (setgid(nobody) == 0 && setuid(nobody) == 0);
}

TEST(TempFile, ReadOnlyFolderIsOneClearError) {
  const TestFolder folder;
  constexpr auto readOnly = static_cast<fs::perms>(0555);
  fs::permissions(folder.path(), readOnly);
  const int code = exitCodeOf([&] {
    if (!becomeNobody()) return 9;
    const std::string error = messageOf<OutputError>([&] { TempFile(folder / "a.exr"); });
    return error.find("Permission denied") != std::string::npos ? 7 : 0;
  });
  EXPECT_EQ(code, 7);
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(TempFile, ASizeLimitLeavesTheOlderFile) {
  const TestFolder folder;
  folder.write("a.exr", "old");
  const int code = exitCodeOf([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      writeFileAtomically(folder / "a.exr", std::string(5000, 'n'));
    } catch (const OutputError&) {
      return 7;
    }
    return 0;
  });
  EXPECT_EQ(code, 7);
  EXPECT_EQ(TestFolder::read(folder / "a.exr"), "old");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(TempFile, LeftoversOfADeadProcessAreRemovedOthersStay) {
  const TestFolder folder;
  folder.write("done.exr");
  folder.write(".other.tmp");
  const int code = exitCodeOf([&] {
    new TempFile(folder / "a.exr");  // never destroyed: as if the process were killed
    return 3;
  });
  ASSERT_EQ(code, 3);
  const TempFile mine(folder / "b.exr");
  folder.write(".c.exr.kagefude-elsewhere-1-0.tmp");
  EXPECT_EQ(folder.entries(), 5u);
  EXPECT_EQ(removeLeftovers(folder.path()).size(), 1u);
  EXPECT_EQ(folder.entries(), 4u);
  EXPECT_TRUE(fs::exists(mine.path()));
}

TEST(TempFile, OldTemporariesOfAnyHostAreRemoved) {
  const TestFolder folder;
  const std::string file = folder.write(".c.exr.kagefude-elsewhere-1-0.tmp");
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::minutes(16));
  EXPECT_EQ(removeLeftovers(folder.path()).size(), 1u);
}

TEST(TempFile, LeftoversOfAnOlderProcessWithOurNumberAreRemoved) {
  const TestFolder folder;
  std::string own;
  {
    const TempFile file(folder / "a.exr");
    own = file.path().filename().string();
  }
  folder.write(own);
  EXPECT_EQ(removeLeftovers(folder.path()).size(), 1u);
  EXPECT_TRUE(removeLeftovers(folder / "none").empty());
}

// Age was taken for death: a task that was suspended for a quarter of an hour lost its batch.
TEST(TempFile, ASuspendedWriterKeepsItsFileHoweverOldItIs) {
  const TestFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    const TempFile file(folder / "a.exr");
    raise(SIGSTOP);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, WUNTRACED);
  ASSERT_TRUE(WIFSTOPPED(status));
  ASSERT_EQ(folder.entries(), 1u);
  const fs::path file = fs::directory_iterator(folder.path())->path();
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(24));
  EXPECT_TRUE(removeLeftovers(folder.path()).empty());
  EXPECT_TRUE(fs::exists(file));
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
  EXPECT_EQ(removeLeftovers(folder.path()).size(), 1u);
}

TEST(TempFile, AWriterOnAnotherHostKeepsItsFileWhileItsLockIsSeen) {
  const TestFolder folder;
  const std::string file = folder.write(".c.exr.kagefude-elsewhere-1-0.tmp");
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(24));
  const int writer = open(file.c_str(), O_RDWR);
  ASSERT_EQ(flock(writer, LOCK_EX), 0);
  EXPECT_TRUE(removeLeftovers(folder.path()).empty());
  close(writer);
  EXPECT_EQ(removeLeftovers(folder.path()).size(), 1u);
}

TEST(TempFile, TheFirstFileFinishedInAFolderClearsIt) {
  const TestFolder folder;
  const std::string file = folder.write(".c.exr.kagefude-elsewhere-1-0.tmp");
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(24));
  writeFileAtomically(folder / "index.html", "page");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(TempFile, LinksToOpenDescriptorsAreNotReplaced) {
  EXPECT_THROW(TempFile("/dev/stdout"), OutputError);
  EXPECT_THROW(TempFile("/proc/self/fd/1"), OutputError);
  EXPECT_THROW(TempFile("/dev/none.exr"), OutputError);
}

TEST(TempFile, AnInterruptRemovesThemAllAndTakesNoMore) {
  const TestFolder folder;
  const int code = exitCodeOf([&] {
    TempFile one(folder / "a.exr");
    const TempFile two(folder / "b.exr");
    removeLiveTempFiles();
    if (folder.entries() != 0) return 1;
    if (messageOf<OutputError>([&] { one.commit(); }).empty()) return 2;
    if (messageOf<OutputError>([&] { TempFile(folder / "c.exr"); }).empty()) return 3;
    return 0;
  });
  EXPECT_EQ(code, 0);
}

}  // namespace
}  // namespace kagefude
