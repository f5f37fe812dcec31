#include "frame/json_text.h"

#include <fmt/format.h>

namespace kagefude::detail {

std::string beyondBounds(std::string_view text, const JsonBounds& bounds) {
  size_t depth = 0, values = 1;
  bool inString = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\')
        ++i;
      else if (c == '"')
        inString = false;
      continue;
    }
    if (c == '"') inString = true;
    if (c == ',' || c == '[' || c == '{') ++values;
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (depth > bounds.depth)
      return fmt::format("lists and objects lie within each other more than {} deep", bounds.depth);
    if (values > bounds.values) return fmt::format("it has more than {} values", bounds.values);
  }
  return "";
}

}  // namespace kagefude::detail
