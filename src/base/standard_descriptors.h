#pragma once

namespace kagefude {

/// Makes sure that descriptors 0, 1 and 2 are open, with /dev/null in the place of those that are
/// not. Some daemons and farms start programs with them closed; the next file that is opened would
/// get such a number, and progress text would land in a frame. Call it first in main, before
/// anything is opened.
void ensureStandardDescriptors();

}  // namespace kagefude
