#include "live/strip_store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/temp_file.h"
#include "compositor/strip_set.h"
#include "live/page_paths.h"
#include "live/strip_choice.h"
#include "passes/strip/strip_check.h"
#include "picture/strip_file.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

constexpr size_t longestName = 100;

/// A name that means a file of the folder, on any system, and nothing else.
void requireName(const std::string& name) {
  const bool spelledOut = std::none_of(name.begin(), name.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f || std::strchr("/\\:*?\"<>|", c) != nullptr;
  });
  if (name.empty() || name.size() > longestName || name.front() == '.' || !spelledOut)
    throw LookError("a strip's name has no folder, begins with no dot, and is at most 100 bytes");
  if (!isStripPicture(name))
    throw LookError(fmt::format("{} is not named as a picture: a strip's name ends in {}", name,
                                stripSuffixes()));
}

/// The folder of the look's strips; one that was made for this and stays empty is taken away again.
class StripsFolder {
 public:
  explicit StripsFolder(const Look& onDisk) : path_(stripsFolder(onDisk)) {
    // A link in the look's folder may lead elsewhere.
    const std::string name = nameIn(onDisk, path_);
    if (name != "." && !liesInFolder(onDisk.folder, name))
      throw LookError(fmt::format("{} leads out of the look's folder", path_.string()));
    std::error_code error;
    made_ = fs::create_directories(path_, error);
    if (error)
      throw OutputError(fmt::format("cannot make {}: {}", path_.string(), error.message()));
  }
  ~StripsFolder() {
    std::error_code holdsStrips;
    if (made_) fs::remove(path_, holdsStrips);
  }
  StripsFolder(const StripsFolder&) = delete;
  StripsFolder& operator=(const StripsFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  bool made_ = false;
};

bool isThere(const fs::path& file) { return fs::exists(fs::symlink_status(file)); }

/// A name that no file of the folder has: "teal-2.png".
std::string freeNameIn(const fs::path& folder, const std::string& name) {
  const fs::path given(name);
  for (int number = 2;; ++number) {
    std::string other =
        fmt::format("{}-{}{}", given.stem().string(), number, given.extension().string());
    if (!isThere(folder / other)) return other;
  }
}

bool holds(const fs::path& file, std::string_view bytes) {
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) != bytes.size()) return false;
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  return content.view() == bytes;
}

/// Takes the name for us, so that nothing that comes to be meanwhile is replaced. False when it is
/// taken.
class Reserved {
 public:
  explicit Reserved(fs::path file)
      : file_(std::move(file)),
        descriptor_(::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0 && errno != EEXIST)
      throw OutputError(fmt::format("cannot write {}: {}", file_.string(), std::strerror(errno)));
  }
  ~Reserved() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    if (!kept_) ::unlink(file_.c_str());
  }
  Reserved(const Reserved&) = delete;
  Reserved& operator=(const Reserved&) = delete;

  explicit operator bool() const { return descriptor_ >= 0; }
  void keep() { kept_ = true; }

 private:
  fs::path file_;
  int descriptor_;
  bool kept_ = false;
};

/// What an artist should know before the picture is kept. Throws InputError when it is no strip.
std::vector<std::string> problemsOf(const fs::path& file, const std::string& name) {
  try {
    const StripPicture picture = readStrip(file);
    return checkStrip(picture.red, picture.green, picture.blue).problems;
  } catch (const InputError& error) {
    std::string why = error.what();
    const size_t at = why.find(file.string());
    if (at != std::string::npos) why.replace(at, file.string().size(), name);
    throw InputError(why);
  }
}

StripKept ask(const fs::path& folder, const std::string& name,
              const std::vector<std::string>& problems) {
  StripKept asks{{}, {}, name};
  if (isThere(folder / name)) {
    asks.freeName = freeNameIn(folder, name);
    asks.question = fmt::format("{} is there already, as another picture. Keep this one as {}?",
                                name, asks.freeName);
  } else {
    asks.question = fmt::format("Keep {}?", name);
  }
  for (const std::string& problem : problems) asks.question += fmt::format("\n{}.", problem);
  return asks;
}

}  // namespace

fs::path stripsFolder(const Look& onDisk) {
  for (const StyleLook& style : onDisk.styles)
    if (!isBuiltinStrip(style.style.strip) && liesInFolder(onDisk.folder, style.style.strip))
      return onDisk.resolve(style.style.strip).parent_path();
  return onDisk.folder / "strips";
}

StripKept keepStrip(const Look& onDisk, const std::string& name, std::string_view bytes,
                    bool anyway) {
  requireName(name);
  const StripsFolder strips(onDisk);
  const fs::path& folder = strips.path();
  const fs::path file = folder / name;
  if (holds(file, bytes)) return {nameIn(onDisk, file)};
  const bool taken = isThere(file);
  TempFile made(taken ? folder / freeNameIn(folder, name) : file);
  std::ofstream(made.path(), std::ios::binary) << bytes << std::flush;
  std::error_code error;
  if (fs::file_size(made.path(), error) != bytes.size())
    throw OutputError(fmt::format("cannot write {}", file.string()));
  const std::vector<std::string> problems = problemsOf(made.path(), name);
  if (taken || (!problems.empty() && !anyway)) return ask(folder, name, problems);
  Reserved reserved(file);
  if (!reserved) return ask(folder, name, problems);
  made.commit();
  reserved.keep();
  return {nameIn(onDisk, file)};
}

StripKept keepStrip(const Look& onDisk, const std::string& name,
                    const std::function<void(const fs::path&)>& write) {
  requireName(name);
  const StripsFolder strips(onDisk);
  const fs::path& folder = strips.path();
  Reserved reserved(folder / name);
  if (!reserved) return ask(folder, name, {});
  write(folder / name);
  reserved.keep();
  return {nameIn(onDisk, folder / name)};
}

}  // namespace kagefude
