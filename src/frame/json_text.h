#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace kagefude::detail {

/// What a JSON of someone else's may hold: a value takes 16 bytes and more where the text needs
/// two, and everything that walks over values goes one call deeper at each level.
struct JsonBounds {
  size_t depth = 32;
  size_t values = size_t{4} << 20;
};

/// Why a text is beyond the bounds ("lists and objects lie within each other more than 32 deep"),
/// or "". Looks at brackets and commas outside of strings, in one pass without memory; of a text
/// that is no JSON it tells the same.
std::string beyondBounds(std::string_view text, const JsonBounds& bounds = {});

}  // namespace kagefude::detail
