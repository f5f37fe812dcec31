#pragma once

#include "look/look.h"

namespace kagefude {

/// What the page may make the program read. A look's author may name any file; what comes from the
/// page may not, for a page can be made to send something that its user never asked for. So beside
/// what the look on disk already names, the page can choose built-in strips, and strips that lie in
/// the look's folder or below it, links followed; and it cannot name a colour configuration, a
/// blob's picture, a depth map or further files of the frame. Throws LookError that names the key.
///
/// onDisk: the look as its file has it; asked: the same file with the page's changes.
void refuseForeignPaths(const Look& onDisk, const Look& asked);

/// Whether a path as a look writes it names something in `folder` or below it, links followed, but
/// for the folder itself. It need not be there.
bool liesInFolder(const std::filesystem::path& folder, const std::string& name);

/// A path as a look writes it that lies in `look`'s folder: relative to it.
std::string nameIn(const Look& look, const std::filesystem::path& path);

}  // namespace kagefude
