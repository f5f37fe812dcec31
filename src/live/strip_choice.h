#pragma once

#include <string>
#include <vector>

#include "live/show_stage.h"

namespace kagefude {

/// The strips that the page offers: the built-in ones, then the pictures in the folder and its
/// folders, four deep, links and hidden ones left out, in alphabetical order, at most 200. EXRs are
/// strips in the folder `strips` alone; elsewhere they are frames. What cannot be looked into is
/// left out. "" is the current folder.
std::vector<std::string> stripsToChoose(const std::filesystem::path& folder,
                                        const std::filesystem::path& strips = {});

/// Whether a file is named as a picture that can be a strip.
bool isStripPicture(const std::filesystem::path& path);

/// What those names end in, for a sentence.
std::string stripSuffixes();

/// A strip as the display shows it, at most 64 pixels high. `onDisk` is the look as its file has it
/// (refuseForeignPaths). Throws LookError for a file that the page may not name, else as StripSet
/// does. Cost: the strip is loaded.
ShownPixels showStrip(const LivePicture& picture, const Look& onDisk, const std::string& name);

}  // namespace kagefude
