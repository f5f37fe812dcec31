#include "look/toml_text.h"

#include <fmt/format.h>

#include <cstdint>

namespace kagefude {
namespace {

/// Length of the UTF-8 character that begins there; 0 where none does.
size_t characterAt(std::string_view text, size_t at) {
  const auto byte = [&](size_t i) { return static_cast<uint8_t>(i < text.size() ? text[i] : 0); };
  const uint8_t first = byte(at);
  if (first < 0x80) return 1;
  const size_t length = first >= 0xf0 && first < 0xf5   ? 4
                        : first >= 0xe0 && first < 0xf0 ? 3
                        : first >= 0xc2 && first < 0xe0 ? 2
                                                        : 0;
  for (size_t i = 1; i < length; ++i)
    if ((byte(at + i) & 0xc0) != 0x80) return 0;
  const uint8_t second = byte(at + 1);
  const bool tooLong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool noCharacter = (first == 0xed && second > 0x9f) || (first == 0xf4 && second > 0x8f);
  return tooLong || noCharacter ? 0 : length;
}

}  // namespace

std::string tomlString(std::string_view name) {
  std::string text = "\"";
  for (size_t i = 0; i < name.size();) {
    const size_t length = characterAt(name, i);
    const char c = name[i];
    if (length == 0)
      text += '?';
    else if (c == '"' || c == '\\')
      text += {'\\', c};
    else if (length == 1 && (static_cast<uint8_t>(c) < 0x20 || c == 0x7f))
      text += fmt::format("\\u{:04X}", static_cast<int>(c));
    else
      text += name.substr(i, length);
    i += length == 0 ? 1 : length;
  }
  return text + '"';
}

}  // namespace kagefude
