#include "sequence/fingerprint.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/error.h"
#include "test_folder.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

std::string ofFile(const std::string& file) { return Fingerprint().addFile("in", file).hex(); }

TEST(Fingerprint, IsTheSameEverywhere) {
  // XXH3 of 32 zeros, "|1|3|", "a", "abc": worked out with xxhsum -H2.
  EXPECT_EQ(Fingerprint().add("a", "abc").hex(), "c39b3afb18fc984a479a9b2aa33c71b8");
  EXPECT_EQ(Fingerprint().hex().size(), 32u);
}

TEST(Fingerprint, PiecesDoNotRunTogether) {
  const std::string one = Fingerprint().add("a", "bc").hex();
  EXPECT_NE(one, Fingerprint().add("ab", "c").hex());
  EXPECT_NE(one, Fingerprint().add("a", "b").add("", "c").hex());
  EXPECT_NE(Fingerprint().add("a", "1").add("b", "2").hex(),
            Fingerprint().add("b", "2").add("a", "1").hex());
  EXPECT_EQ(Fingerprint().add("a", 12).hex(), Fingerprint().add("a", "12").hex());
}

TEST(Fingerprint, SmallFilesByContentAlone) {
  const TestFolder folder;
  const std::string file = folder.write("a.json", "one");
  const std::string first = ofFile(file);
  fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(5));
  EXPECT_EQ(ofFile(file), first);
  const auto time = fs::last_write_time(file);
  folder.write("a.json", "two");
  fs::last_write_time(file, time);
  EXPECT_NE(ofFile(file), first);
}

TEST(Fingerprint, FoldersDoNotCountNamesDo) {
  const TestFolder folder;
  EXPECT_EQ(ofFile(folder.write("x/a.exr", "same")), ofFile(folder.write("y/a.exr", "same")));
  EXPECT_NE(ofFile(folder.write("x/a.exr", "same")), ofFile(folder.write("x/b.exr", "same")));
}

TEST(Fingerprint, LargeFilesBySizeTimeAndSamples) {
  const TestFolder folder;
  std::string contents(3 << 20, 'x');
  const std::string file = folder.write("a.exr", contents);
  const auto time = fs::last_write_time(file);
  const std::string first = ofFile(file);
  EXPECT_EQ(ofFile(file), first);

  fs::last_write_time(file, time + std::chrono::nanoseconds(1000));
  EXPECT_NE(ofFile(file), first);

  for (const size_t changed : {size_t{0}, contents.size() - 1, size_t{4095}}) {
    std::string other = contents;
    other[changed] = 'y';
    folder.write("a.exr", other);
    fs::last_write_time(file, time);
    EXPECT_NE(ofFile(file), first) << changed;
  }
  folder.write("a.exr", contents + "x");
  fs::last_write_time(file, time);
  EXPECT_NE(ofFile(file), first);
}

TEST(Fingerprint, MissingAndUnreadableFiles) {
  const TestFolder folder;
  const std::string missing = ofFile(folder / "a.exr");
  EXPECT_NE(missing, ofFile(folder.write("a.exr", "")));
  EXPECT_THROW(ofFile(folder.path().string()), InputError);
}

TEST(Fingerprint, TimesAfter2262DoNotOverflow) {
  const TestFolder folder;
  const std::string file = folder.write("a.exr", std::string((1 << 20) + 1, 'x'));
  const auto setYear = [&](int64_t seconds) {
    const timespec times[2] = {{seconds, 0}, {seconds, 0}};
    ASSERT_EQ(utimensat(AT_FDCWD, file.c_str(), times, 0), 0);
  };
  setYear(10'413'792'000);  // 2300
  const std::string first = ofFile(file);
  setYear(10'413'792'001);
  EXPECT_NE(ofFile(file), first);
}

TEST(FileDigests, SeeAFileThatWasEditedInPlace) {
  const TestFolder folder;
  FileDigests digests;
  const std::string file = folder.write("a.obj", "v 0 0 0");
  const std::string first = digests.of(file);
  EXPECT_EQ(digests.of(file), first);
  folder.write("a.obj", "v 0 0 1");
  EXPECT_NE(digests.of(file), first);
  folder.write("a.obj", "v 0 0 0");
  EXPECT_EQ(digests.of(file), first);
  EXPECT_NE(digests.of(folder / "none.obj"), first);
}

}  // namespace
}  // namespace kagefude
