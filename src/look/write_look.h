#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace kagefude {

/// A look's text after overrides were written into it.
struct WrittenLook {
  std::string text;
  std::vector<std::string> before;  ///< overrides of the new text that give the look before again,
                                    ///< but for entries that are new
};

/// Writes overrides ("style[0].brush.key=value", as of readLook) into the text of a look and leaves
/// every other byte as it is: comments, order, spaces, line ends. A value that is given is replaced
/// in place (a list with the comments in it), one that means the same is not touched; a new key
/// goes below the last one of its section, a new section to the end of the file or, as a dotted
/// key, into the entry that it belongs to. `path` is the file's name in messages, and what its
/// paths are relative to. Throws LookError when an override is wrong, or names no key; and when the
/// text cannot be changed so that it means the look with the overrides, value by value.
WrittenLook writeOverrides(std::string_view text, const std::filesystem::path& path,
                           const std::vector<std::string>& overrides);

/// The same on disk: the file is read anew and replaced as a whole, so that what others wrote since
/// stays; through a link, the file that it leads to. Gives WrittenLook::before. OutputError when it
/// cannot be written; then, and on any other error, the file is as it was.
std::vector<std::string> saveLook(const std::filesystem::path& path,
                                  const std::vector<std::string>& overrides);

}  // namespace kagefude
