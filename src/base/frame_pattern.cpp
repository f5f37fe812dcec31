#include "base/frame_pattern.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <system_error>

#include "base/error.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

size_t digitsAt(std::string_view text, size_t from) {
  size_t end = from;
  while (end < text.size() && isDigit(text[end])) ++end;
  return end - from;
}

/// A frame place: where it stands, how long it is, and the padding that it asks for.
struct Place {
  size_t at = 0;
  size_t length = 0;
  int padding = 0;
};

constexpr int kMostPadding = 32;

int paddingOf(std::string_view digits, std::string_view text) {
  int padding = 1;
  if (!digits.empty()) std::from_chars(digits.data(), digits.data() + digits.size(), padding);
  if (padding < 1 || digits.size() > 2 || padding > kMostPadding)
    throw UsageError(fmt::format("pattern '{}' pads the frame to an impossible width", text));
  return padding;
}

std::optional<Place> printfPlace(std::string_view text, size_t at) {
  if (text[at] != '%') return std::nullopt;
  const size_t digits = digitsAt(text, at + 1);
  const size_t end = at + 1 + digits;
  if (end >= text.size() || text[end] != 'd') return std::nullopt;
  const std::string_view width = text.substr(at + 1, digits);
  if (!width.empty() && width[0] != '0')
    throw UsageError(
        fmt::format("pattern '{}' pads the frame with spaces; write %0{}d", text, width));
  return Place{at, digits + 2, paddingOf(width.substr(width.empty() ? 0 : 1), text)};
}

std::optional<Place> houdiniPlace(std::string_view text, size_t at) {
  if (!text.substr(at).starts_with("$F")) return std::nullopt;
  const size_t digits = digitsAt(text, at + 2);
  const size_t end = at + 2 + digits;
  const bool partOfWord = end < text.size() && std::isalpha(static_cast<unsigned char>(text[end]));
  if (digits == 0 && partOfWord) return std::nullopt;
  return Place{at, digits + 2, paddingOf(text.substr(at + 2, digits), text)};
}

std::optional<Place> runPlace(std::string_view text, size_t at) {
  const char mark = text[at];
  if (mark != '#' && mark != '@') return std::nullopt;
  const size_t end = std::min(text.find_first_not_of(mark, at), text.size());
  const size_t length = end - at;
  if (length == 1) return mark == '#' ? std::optional(Place{at, 1, 4}) : std::nullopt;
  if (length > kMostPadding)
    throw UsageError(fmt::format("pattern '{}' pads the frame to an impossible width", text));
  return Place{at, length, static_cast<int>(length)};
}

std::optional<Place> findPlace(std::string_view text, size_t from) {
  for (size_t at = from; at < text.size(); ++at) {
    if (auto place = runPlace(text, at)) return place;
    if (auto place = printfPlace(text, at)) return place;
    if (auto place = houdiniPlace(text, at)) return place;
  }
  return std::nullopt;
}

bool mentionsView(std::string_view text) {
  return text.find("%V") != std::string_view::npos || text.find("%v") != std::string_view::npos;
}

}  // namespace

FramePattern::FramePattern(std::string_view text) : text_(text), hasView_(mentionsView(text)) {
  if (text.empty()) throw UsageError("an input or output name is empty");
  if (text.ends_with('/'))
    throw UsageError(fmt::format("'{}' is a folder; expected a file name or pattern", text));
  const size_t slash = text.rfind('/');
  const size_t nameAt = slash == std::string_view::npos ? 0 : slash + 1;
  const auto place = findPlace(text, nameAt);
  if (!place) {
    before_ = text;
    return;
  }
  const size_t end = place->at + place->length;
  if (findPlace(text, end))
    throw UsageError(fmt::format("pattern '{}' has two places for the frame; keep one", text));
  before_ = text.substr(0, place->at);
  after_ = text.substr(end);
  padding_ = place->padding;
}

std::string FramePattern::expandViews(std::string_view text, std::string_view view) const {
  std::string result;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool isPlace = text[i] == '%' && i + 1 < text.size() && std::tolower(text[i + 1]) == 'v';
    if (!isPlace) {
      result += text[i];
      continue;
    }
    if (view.empty())
      throw UsageError(
          fmt::format("pattern '{}' has a place for the view, but no view is asked for", text_));
    ++i;
    result += text[i] == 'V' ? view : view.substr(0, 1);
  }
  return result;
}

std::string FramePattern::number(int frame) const { return fmt::format("{:0{}}", frame, padding_); }

fs::path FramePattern::path(int frame, std::string_view view) const {
  if (!hasFrame()) return expandViews(before_, view);
  return expandViews(before_, view) + number(frame) + expandViews(after_, view);
}

std::optional<int> FramePattern::frameOf(std::string_view text) const {
  const bool negative = text.starts_with('-');
  const std::string_view digits = text.substr(negative ? 1 : 0);
  if (digits.empty() || digitsAt(digits, 0) != digits.size()) return std::nullopt;
  int frame = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), frame);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  const bool blenderForm = frame < 0 && digits == fmt::format("{:0{}}", -int64_t{frame}, padding_);
  if (text != number(frame) && !blenderForm) return std::nullopt;
  return frame;
}

std::map<int, fs::path> FramePattern::scan(std::string_view view) const {
  std::map<int, fs::path> files;
  if (!hasFrame()) return files;
  const fs::path head = expandViews(before_, view);
  const fs::path folder = head.parent_path();
  const std::string start = head.filename().string();
  const std::string end = expandViews(after_, view);
  const fs::path place = folder.empty() ? fs::path(".") : folder;

  std::error_code failed;
  if (!fs::is_directory(place, failed)) return files;
  fs::directory_iterator entry(place, failed);
  for (; !failed && entry != fs::directory_iterator(); entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    if (name.size() <= start.size() + end.size() || !name.starts_with(start) ||
        !name.ends_with(end))
      continue;
    const std::string_view middle =
        std::string_view(name).substr(start.size(), name.size() - start.size() - end.size());
    const auto frame = frameOf(middle);
    std::error_code ignored;
    if (!frame || fs::is_directory(entry->path(), ignored)) continue;
    if (middle == number(*frame) || !files.contains(*frame)) files[*frame] = folder / name;
  }
  if (failed)
    throw InputError(fmt::format("cannot read folder {}: {}", place.string(), failed.message()));
  return files;
}

std::optional<int> frameNumberOf(const fs::path& file) {
  const std::string stem = file.stem().string();
  size_t at = stem.size();
  while (at > 0 && isDigit(stem[at - 1])) --at;
  if (at == stem.size()) return std::nullopt;
  const bool minus = at > 0 && stem[at - 1] == '-' && (at == 1 || std::ispunct(stem[at - 2]));
  if (minus) --at;
  int frame = 0;
  const auto [end, error] = std::from_chars(stem.data() + at, stem.data() + stem.size(), frame);
  if (error != std::errc()) return std::nullopt;
  return frame;
}

}  // namespace kagefude
