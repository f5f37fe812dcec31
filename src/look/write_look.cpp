#include "look/write_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/files_read.h"
#include "look/look.h"
#include "look/override.h"
#include "look/parse_toml.h"
#include "look/read_section.h"
#include "look/toml_place.h"

namespace kagefude {
namespace {

using Path = std::vector<OverrideStep>;

std::string spellPath(const Path& path, size_t first) {
  std::string text;
  for (size_t i = first; i < path.size(); ++i) text += (i > first ? "." : "") + path[i].key;
  return text;
}

// The value of a look that a path names.

const ParameterTable* tableNamed(const std::string& name) {
  for (const LookSection& section : lookSections)
    if (section.table->pass == name) return section.table;
  return nullptr;
}

template <class Place>
void* sectionOf(const std::string& name, const Place& place) {
  for (const LookSection& section : lookSections)
    if (section.table->pass == name) return place(section);
  return nullptr;
}

template <class Entry>
void* paramsIn(std::vector<Entry>& entries, const Path& path, const auto& own, const auto& place) {
  const size_t index = path.front().index.value_or(0);
  if (index >= entries.size()) return nullptr;
  Entry& entry = entries[index];
  return path.size() == 2 ? own(entry) : sectionOf(path[1].key, place(entry));
}

void* paramsOf(Look& look, const Path& path) {
  const auto own = [](auto& entry) -> void* {
    if constexpr (requires { entry.light; })
      return &entry.light;
    else
      return &entry.style;
  };
  if (path.front().key == "light")
    return paramsIn(look.lights, path, own, [](LightLook& light) {
      return [&light](const LookSection& s) { return s.inLight ? s.inLight(light) : nullptr; };
    });
  if (path.front().key == "style")
    return paramsIn(look.styles, path, own, [](StyleLook& style) {
      return [&style](const LookSection& s) { return s.inStyle ? s.inStyle(style) : nullptr; };
    });
  return sectionOf(path.front().key,
                   [&](const LookSection& s) { return s.inLook ? s.inLook(look) : nullptr; });
}

/// As TOML; nothing where the look has no such value.
std::optional<std::string> spelledValue(Look& look, const Path& path) {
  const ParameterTable* table = tableNamed(path[path.size() - 2].key);
  const void* params = table ? paramsOf(look, path) : nullptr;
  if (!params) return std::nullopt;
  for (const Parameter& parameter : table->parameters)
    if (parameter.name == path.back().key) return spellValue(parameter, parameter.get(params));
  return std::nullopt;
}

// The place in the text that a path names.

/// The tables along a path as far as they are there, the root first.
std::vector<const toml::table*> tablesAlong(const toml::table& root, const Path& path) {
  std::vector<const toml::table*> tables{&root};
  for (size_t i = 0; i + 1 < path.size(); ++i) {
    const toml::node* node = tables.back()->get(path[i].key);
    if (node && node->is_array()) node = node->as_array()->get(path[i].index.value_or(0));
    if (!node || !node->is_table()) break;
    tables.push_back(node->as_table());
  }
  return tables;
}

std::string lineEndOf(std::string_view text) {
  const size_t end = text.find('\n');
  return end != std::string_view::npos && end > 0 && text[end - 1] == '\r' ? "\r\n" : "\n";
}

void append(std::string& text, const std::string& header, const std::string& assignment) {
  const std::string end = lineEndOf(text);
  if (!text.empty()) text += (text.back() == '\n' ? "" : end) + end;
  text += header + end + assignment + end;
}

/// In a line of its own below `place`, indented as the line above.
void insertLine(std::string& text, const toml::source_position& place, std::string line) {
  const std::string end = lineEndOf(text);
  const size_t at = offsetOf(text, place);
  const size_t begin = offsetOf(text, {place.line, 1});
  line.insert(0, text.substr(begin, text.find_first_not_of(" \t", begin) - begin));
  const size_t newline = text.find('\n', at);
  if (newline == std::string::npos)
    text += end + line + end;
  else
    text.insert(newline + 1, line + end);
}

void insertInBraces(std::string& text, const toml::table& table, const std::string& assignment) {
  const size_t brace = offsetOf(text, table.source().end) - 1;
  const size_t last = text.find_last_not_of(" \t", brace - 1) + 1;
  const std::string_view separator = table.empty() ? " " : ", ";
  text.replace(last, brace - last, fmt::format("{}{} ", separator, assignment));
}

void insertKey(std::string& text, const toml::table& root, const Path& path,
               const std::string& value) {
  const std::vector<const toml::table*> tables = tablesAlong(root, path);
  size_t at = tables.size() - 1;
  TableKind kind = kindOf(text, root, *tables[at]);
  const bool isNewSection = kind == TableKind::root || kind == TableKind::implied;
  while (kind == TableKind::dotted) kind = kindOf(text, root, *tables[--at]);
  const std::string assignment = fmt::format("{} = {}", spellPath(path, at), value);
  if (kind == TableKind::inlined)
    insertInBraces(text, *tables[at], assignment);
  else if (isNewSection)
    append(text, fmt::format("[{}]", spellPath({path.begin(), path.end() - 1}, 0)),
           fmt::format("{} = {}", path.back().key, value));
  else
    insertLine(text, endOfValues(text, root, *tables[at]), assignment);
}

void writeOne(std::string& text, const std::filesystem::path& path, const Override& given,
              const std::string& value) {
  const toml::table root = parseToml(text, path.string());
  if (beginsEntry(root, given)) {
    append(text, fmt::format("[[{}]]", given.path.front().key),
           fmt::format("{} = {}", given.path.back().key, value));
    return;
  }
  const std::vector<const toml::table*> tables = tablesAlong(root, given.path);
  const toml::node* node =
      tables.size() == given.path.size() ? tables.back()->get(given.path.back().key) : nullptr;
  if (!node) {
    insertKey(text, root, given.path, value);
    return;
  }
  Look look = readLookText(text, path, {});
  if (spelledValue(look, given.path) == value) return;
  const size_t begin = offsetOf(text, node->source().begin);
  text.replace(begin, offsetOf(text, node->source().end) - begin, value);
}

[[noreturn]] void refuseSaving(const std::filesystem::path& path, const std::string& why) {
  throw LookError(fmt::format("{} cannot be saved: {}", path.string(), why));
}

constexpr const char* byHand = "its text cannot be changed so; write the values by hand";

/// What was written must mean what was wanted.
void checkWritten(const std::string& text, const std::filesystem::path& path, const Look& wanted) {
  try {
    if (resolvedText(readLookText(text, path, {})) == resolvedText(wanted)) return;
  } catch (const LookError&) {
    refuseSaving(path, byHand);
  }
  refuseSaving(path, byHand);
}

}  // namespace

WrittenLook writeOverrides(std::string_view text, const std::filesystem::path& path,
                           const std::vector<std::string>& overrides) {
  Look before = readLookText(text, path, {});
  Look wanted = readLookText(text, path, overrides);
  WrittenLook written{std::string(text), {}};
  for (const std::string& override : overrides) {
    const Override given = parseOverride(override);
    const std::optional<std::string> value = spelledValue(wanted, given.path);
    const std::string name = override.substr(0, override.find('='));
    if (!value) refuseSaving(path, fmt::format("{} is no key of a look", name));
    if (const auto old = spelledValue(before, given.path))
      written.before.push_back(fmt::format("{}={}", name, *old));
    try {
      writeOne(written.text, path, given, *value);
    } catch (const toml::parse_error&) {  // a value before it was one that no TOML can have
      refuseSaving(path, byHand);
    }
  }
  checkWritten(written.text, path, wanted);
  return written;
}

std::vector<std::string> saveLook(const std::filesystem::path& path,
                                  const std::vector<std::string>& overrides) {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(path, error);
  if (error || !std::filesystem::is_regular_file(file))
    throw OutputError(fmt::format("{} cannot be saved: it is no file", path.string()));
  const LooksAtOutputs looking;
  const std::string text = readLookFile(path);
  WrittenLook written = writeOverrides(text, path, overrides);
  if (written.text != text) {
    AtomicFile out(file);
    std::filesystem::permissions(out.temporaryPath(), std::filesystem::status(file).permissions());
    out.write(written.text.data(), written.text.size());
    out.commit();
  }
  return std::move(written.before);
}

}  // namespace kagefude
