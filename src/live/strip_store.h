#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "look/look.h"

namespace kagefude {

/// What became of a strip that the page offers: it lies on disk and `strip` is its name as a look
/// writes it, or `question` must be answered first, and `freeName` is what it would be kept as.
struct StripKept {
  std::string strip{};
  std::string question{}, freeName{};
};

/// Where the page's strips are kept: the folder in which the first of the look's strips lies that
/// are in the look's folder or below it (refuseForeignPaths), else "strips" there.
std::filesystem::path stripsFolder(const Look& onDisk);

/// Keeps a picture that was dropped on the page, beside the look's other strips. `name` is the
/// file's, without a folder. What is on disk is never replaced: where another picture has the name,
/// a free one is proposed; one of the same bytes is that picture. So is asked when checkStrip finds
/// something to mend, unless `anyway`. Throws LookError for a name that is none of a picture's (a
/// folder, a hidden file, another suffix), InputError when it cannot be read as a strip
/// (readStrip), OutputError when it cannot be written; then nothing is left on disk.
StripKept keepStrip(const Look& onDisk, const std::string& name, std::string_view bytes,
                    bool anyway);

/// The same for a picture of the program's own: `write` writes it to the path that it is given, and
/// nothing needs to be checked.
StripKept keepStrip(const Look& onDisk, const std::string& name,
                    const std::function<void(const std::filesystem::path&)>& write);

}  // namespace kagefude
