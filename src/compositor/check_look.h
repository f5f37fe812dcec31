#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "look/look.h"

namespace kagefude {

/// What of a look does nothing in the frames that it was held against.
struct LookCheck {
  std::vector<std::string> problems;  ///< a sentence each: entries that fit nothing, idle keys
  std::vector<std::string> defaults;  ///< keys that are set to what they are anyway
  std::vector<std::string> waiting;   ///< styles and keys that wait for other frames: no problems
};

/// Comps frames with a look, and again without each key that it sets, and tells which change no bit
/// of the picture in any of them: so it is true whatever decides that a key matters. Not tried are
/// keys that say what an entry is (names, index), and those of [output] and [colour] that say how
/// the picture is written. Entries that fit nothing are told once (unusedEntries), their keys not;
/// nor are those of styles that paint nothing, for their things are not seen or styles of higher
/// priority paint them: these wait for other frames. A style that stands behind others of its own
/// priority everywhere is a problem.
/// A key that does nothing in one style or light, but in another, waits too: what it needs is not
/// seen there.
/// `progress` is called with what is done of all. Throws as planFrame, readFramePlanes, StripSet.
/// Cost: a comp of the first frame for each key, and of another frame for each that did nothing.
LookCheck checkLook(std::string_view text, const std::filesystem::path& path,
                    std::span<const std::filesystem::path> frames,
                    const std::function<void(size_t done, size_t all)>& progress);

}  // namespace kagefude
