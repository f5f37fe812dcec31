#pragma once

#include <string>
#include <string_view>

namespace kagefude {

/// Text as one line that can do nothing but be read: control characters (C0, DEL, C1), the Unicode
/// line separators and direction marks, and bytes that are no UTF-8 become \n, \t, \r or \xHH.
/// Names in other people's files reach the log through here, so they can neither begin a line of
/// their own (which farms would take for ours) nor command a terminal.
std::string printable(std::string_view text);

/// The same for a text of several lines, each by itself; line breaks stay.
std::string printableLines(std::string_view text);

}  // namespace kagefude
