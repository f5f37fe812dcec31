#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace kagefude {

/// A text that is put together when the program is compiled: `spell(put)` calls `put` with one
/// piece after the other. Keeps a parameter's help true to the table that it tells of.
template <class Spell>
class JoinedText {
 public:
  consteval explicit JoinedText(Spell spell) {
    spell([this](std::string_view piece) {
      for (const char c : piece) text_[length_++] = c;
    });
  }
  constexpr std::string_view view() const { return {text_.data(), length_}; }

 private:
  std::array<char, 2048> text_{};  // a longer text does not compile
  size_t length_ = 0;
};

}  // namespace kagefude
