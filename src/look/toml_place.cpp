#include "look/toml_place.h"

#include <algorithm>

namespace kagefude {
namespace {

bool isBefore(const toml::source_position& a, const toml::source_position& b) {
  return a.line != b.line ? a.line < b.line : a.column < b.column;
}

bool isListOfHeaders(const toml::node& node) {
  const toml::array* list = node.as_array();
  return list && !list->empty() && list->front().is_table() &&
         !list->front().as_table()->is_inline();
}

}  // namespace

size_t offsetOf(std::string_view text, const toml::source_position& place) {
  constexpr std::string_view byteOrderMark = "\xef\xbb\xbf";
  size_t at = text.starts_with(byteOrderMark) ? byteOrderMark.size() : 0;
  for (toml::source_index line = 1; line < place.line; ++line)
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  const auto continues = [&](size_t i) {
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0u) == 0x80u;
  };
  for (toml::source_index column = 1; column < place.column && at < text.size(); ++column) {
    ++at;
    while (continues(at)) ++at;
  }
  return at;
}

TableKind kindOf(std::string_view text, const toml::table& root, const toml::table& table) {
  if (&table == &root) return TableKind::root;
  if (table.is_inline()) return TableKind::inlined;
  const toml::source_position begin = table.source().begin;
  const size_t at = offsetOf(text, begin);
  if (at >= text.size() || text[at] != '[') return TableKind::dotted;
  const bool isImplied = std::any_of(table.begin(), table.end(), [&](const auto& entry) {
    return entry.second.source().begin == begin;
  });
  return isImplied ? TableKind::implied : TableKind::header;
}

toml::source_position endOfValues(std::string_view text, const toml::table& root,
                                  const toml::table& table) {
  const TableKind kind = kindOf(text, root, table);
  toml::source_position end =
      kind == TableKind::header ? table.source().end : toml::source_position{1, 1};
  for (const auto& [key, node] : table) {
    if (isListOfHeaders(node)) continue;
    const toml::table* inner = node.as_table();
    toml::source_position own = node.source().end;
    if (inner && !inner->is_inline()) {
      if (kindOf(text, root, *inner) != TableKind::dotted) continue;
      own = endOfValues(text, root, *inner);
    }
    if (isBefore(end, own)) end = own;
  }
  return end;
}

}  // namespace kagefude
