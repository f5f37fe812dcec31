#include "base/printable.h"

#include <fmt/format.h>

#include <cstdint>

namespace kagefude {
namespace {

/// One character: how many bytes, and which; a byte that begins none is `bad`.
struct Character {
  size_t bytes = 1;
  uint32_t code = 0;
  bool bad = false;
};

Character characterAt(std::string_view text, size_t at) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[at + i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return {1, first, false};
  const size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || at + bytes > text.size()) return {1, first, true};
  uint32_t code = first & (0x7fu >> bytes);
  for (size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0u) != 0x80u) return {1, first, true};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  constexpr uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  if (code < least[bytes] || code > 0x10ffff || surrogate) return {1, first, true};
  return {bytes, code, false};
}

bool commands(uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x200e && code <= 0x200f) ||
         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string line;
  line.reserve(text.size());
  for (size_t at = 0; at < text.size();) {
    const Character c = characterAt(text, at);
    if (!c.bad && !commands(c.code)) {
      line += text.substr(at, c.bytes);
    } else if (c.code == '\n' || c.code == '\t' || c.code == '\r') {
      line += c.code == '\n' ? "\\n" : c.code == '\t' ? "\\t" : "\\r";
    } else {
      for (size_t i = 0; i < c.bytes; ++i)
        line += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at + i]));
    }
    at += c.bytes;
  }
  return line;
}

std::string printableLines(std::string_view text) {
  std::string lines;
  for (size_t at = 0; at < text.size();) {
    const size_t end = text.find('\n', at);
    lines += printable(text.substr(at, end - at));
    if (end == std::string_view::npos) break;
    lines += '\n';
    at = end + 1;
  }
  return lines;
}

}  // namespace kagefude
