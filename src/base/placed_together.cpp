#include "base/placed_together.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/files_read.h"
#include "base/folders.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

fs::path folderAbove(const fs::path& path) {
  return path.parent_path().empty() ? fs::path(".") : path.parent_path();
}

[[noreturn]] void refuse(const fs::path& target, const std::string& why) {
  throw OutputError(fmt::format("cannot write {}: {}", target.string(), why));
}

}  // namespace

PlacedTogether::PlacedTogether(fs::path scratch)
    : scratch_(std::move(scratch)), atInterrupt_([this] { end(); }) {
  makeFolders(folderAbove(scratch_));
  std::error_code ignored;
  fs::remove_all(scratch_, ignored);
  makeFolders(scratch_);
}

PlacedTogether::~PlacedTogether() { end(); }

void PlacedTogether::place(const fs::path& made, const fs::path& target) {
  const std::lock_guard lock(mutex_);
  if (ended_) throw OutputError(fmt::format("did not write {}: interrupted", target.string()));
  refuseToOverwriteRead(target);
  std::error_code failed;
  if (fs::create_directory(folderAbove(target), failed)) folders_.push_back(folderAbove(target));
  const Placed placed{target, setAside(target)};
  fs::rename(made, target, failed);
  placed_.push_back(placed);
  if (failed) refuse(target, failed.message());
}

/// A link beside keeps what is there until the new file takes its name in one step; not all file
/// systems have links.
fs::path PlacedTogether::setAside(const fs::path& target) {
  std::error_code failed;
  const fs::file_status there = fs::symlink_status(target, failed);
  if (!fs::exists(there)) return {};
  if (!fs::is_regular_file(there) && !fs::is_symlink(there))
    refuse(target, "it is not a regular file");
  const fs::path before = scratch_ / fmt::format("{}.before", placed_.size());
  fs::create_hard_link(target, before, failed);
  if (failed) fs::rename(target, before, failed);
  if (failed) refuse(target, failed.message());
  return before;
}

void PlacedTogether::keep() {
  const std::lock_guard lock(mutex_);
  if (ended_) throw OutputError("nothing was written: interrupted");
  for (const fs::path& folder : folders_) flushFolder(folderAbove(folder));
  if (!placed_.empty()) flushFolder(folderAbove(placed_.back().target));
  placed_.clear();
  folders_.clear();
}

void PlacedTogether::takeBack() {
  std::error_code ignored;
  for (auto placed = placed_.rbegin(); placed != placed_.rend(); ++placed) {
    // A file that is linked to its target's own is not renamed onto it, so that goes first.
    fs::remove(placed->target, ignored);
    if (!placed->before.empty()) fs::rename(placed->before, placed->target, ignored);
  }
  for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder)
    fs::remove(*folder, ignored);
  placed_.clear();
  folders_.clear();
}

void PlacedTogether::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  takeBack();
  std::error_code ignored;
  fs::remove_all(scratch_, ignored);
}

}  // namespace kagefude
