#include "sequence/frame_range.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <unordered_set>

#include "base/error.h"

namespace kagefude {
namespace {

constexpr const char* kForms = "write frames as 7, 1-10, 10-1, 1-10x2 or a list with commas";

struct Item {
  int64_t first = 0;
  int64_t last = 0;
  int64_t step = 1;

  int64_t count() const { return (last - first) / step + 1; }
};

/// Reads one item of a range from the left; every function takes what it understands off `rest_`.
class ItemParser {
 public:
  ItemParser(std::string_view item, std::string_view text)
      : item_(item), rest_(item), text_(text) {}

  Item parse() {
    Item item;
    item.first = item.last = number();
    if (take("..") || take("-")) {
      item.last = number();
      item.step = item.last < item.first ? -1 : 1;
      if (take("x") || take(":")) item.step = step(item.step);
    }
    if (!rest_.empty()) fail(fmt::format("'{}' is not understood", rest_));
    return item;
  }

 private:
  bool take(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  int number() {
    int value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error == std::errc::result_out_of_range) fail("the number is too large");
    if (error != std::errc()) {
      fail(rest_.empty() ? "a number is missing at the end"
                         : fmt::format("expected a number at '{}'", rest_));
    }
    rest_.remove_prefix(static_cast<size_t>(end - rest_.data()));
    return value;
  }

  int64_t step(int64_t direction) {
    const int64_t written = number();
    if (written == 0) fail("the step is zero");
    if (written < 0 && direction > 0) fail("the step leads away from the last frame");
    return direction * std::abs(written);
  }

  [[noreturn]] void fail(const std::string& why) const {
    const std::string where =
        item_ == text_ ? fmt::format("'{}'", item_) : fmt::format("'{}' in '{}'", item_, text_);
    throw UsageError(fmt::format("frames {}: {}; {}", where, why, kForms));
  }

  std::string_view item_;
  std::string_view rest_;
  std::string_view text_;
};

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Items between commas, then between spaces. An empty item between commas stays empty and fails
/// in the parser: it is more likely a slip than nothing.
std::vector<std::string_view> splitItems(std::string_view text) {
  std::vector<std::string_view> items;
  for (size_t from = 0; from <= text.size();) {
    const size_t comma = std::min(text.find(',', from), text.size());
    std::string_view part = trimmed(text.substr(from, comma - from));
    for (size_t gap = part.find_first_of(" \t"); gap != std::string_view::npos;
         gap = part.find_first_of(" \t")) {
      items.push_back(part.substr(0, gap));
      part = trimmed(part.substr(gap));
    }
    items.push_back(part);
    from = comma + 1;
  }
  return items;
}

/// The first mention of each. Frames of a range lie close together, so a bit for each of the
/// numbers between the smallest and the largest is less than a sorted list would be.
std::vector<int> eachOnce(const std::vector<int>& frames) {
  const auto [least, most] = std::minmax_element(frames.begin(), frames.end());
  const int64_t first = *least, span = int64_t{*most} - first + 1;
  std::vector<int> result;
  if (span <= static_cast<int64_t>(8 * kMostFrames)) {
    std::vector<bool> seen(static_cast<size_t>(span));
    for (const int frame : frames) {
      const auto at = static_cast<size_t>(frame - first);
      if (!seen[at]) result.push_back(frame);
      seen[at] = true;
    }
    return result;
  }
  std::unordered_set<int> seen;
  for (const int frame : frames)
    if (seen.insert(frame).second) result.push_back(frame);
  return result;
}

/// Length of the evenly spaced run that starts at `first` in sorted frames.
size_t runLength(const std::vector<int>& frames, size_t first) {
  size_t last = first + 1;
  if (last >= frames.size()) return 1;
  const int64_t step = int64_t{frames[last]} - frames[first];
  while (last + 1 < frames.size() && int64_t{frames[last + 1]} - frames[last] == step) ++last;
  const size_t length = last - first + 1;
  return length >= 3 || step == 1 ? length : 1;
}

std::vector<std::string> rangeItems(std::vector<int> frames, std::vector<size_t>* lengths) {
  if (!std::is_sorted(frames.begin(), frames.end())) std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  std::vector<std::string> items;
  for (size_t i = 0; i < frames.size();) {
    const size_t length = runLength(frames, i);
    std::string item = fmt::format("{}", frames[i]);
    if (length > 1) {
      item += fmt::format("-{}", frames[i + length - 1]);
      const int64_t step = int64_t{frames[i + 1]} - frames[i];
      if (step > 1) item += fmt::format("x{}", step);
    }
    items.push_back(std::move(item));
    lengths->push_back(length);
    i += length;
  }
  return items;
}

std::optional<size_t> wholeNumber(std::string_view text) {
  size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::vector<int> parseFrames(std::string_view text) {
  if (trimmed(text).empty()) throw UsageError(fmt::format("frames are empty; {}", kForms));
  std::vector<Item> items;
  int64_t count = 0;
  for (const std::string_view item : splitItems(trimmed(text))) {
    items.push_back(ItemParser(item, text).parse());
    count += items.back().count();
    if (count > static_cast<int64_t>(kMostFrames))
      throw UsageError(fmt::format("frames '{}' are more than {}", text, kMostFrames));
  }
  std::vector<int> frames;
  frames.reserve(static_cast<size_t>(count));
  for (const Item& item : items)
    for (int64_t i = 0; i < item.count(); ++i)
      frames.push_back(static_cast<int>(item.first + i * item.step));
  return items.size() == 1 ? frames : eachOnce(frames);
}

std::string formatFrames(std::vector<int> frames) {
  std::vector<size_t> lengths;
  return fmt::format("{}", fmt::join(rangeItems(std::move(frames), &lengths), ","));
}

std::string describeFrames(std::vector<int> frames, size_t most) {
  std::vector<size_t> lengths;
  std::vector<std::string> items = rangeItems(std::move(frames), &lengths);
  size_t left = 0;
  for (size_t i = most; i < items.size(); ++i) left += lengths[i];
  if (items.size() > most) items.resize(most);
  const std::string shown = fmt::format("{}", fmt::join(items, ","));
  return left > 0 ? fmt::format("{} and {} more", shown, left) : shown;
}

Chunk parseChunk(std::string_view text) {
  const size_t slash = std::min(text.find('/'), text.size());
  const auto index = wholeNumber(text.substr(0, slash));
  const auto count = slash < text.size() ? wholeNumber(text.substr(slash + 1)) : std::nullopt;
  if (!index || !count || *index < 1 || *index > *count || *count > 1'000'000)
    throw UsageError(fmt::format(
        "chunk '{}' is not a part i/n such as 2/4, with i from 1 to n and n up to 1000000", text));
  return {*index, *count};
}

ChunkSpan chunkSpan(size_t total, const Chunk& chunk) {
  const size_t shortest = total / chunk.count;
  const size_t longer = total % chunk.count;
  const auto start = [&](size_t part) { return part * shortest + std::min(part, longer); };
  return {start(chunk.index - 1), start(chunk.index)};
}

}  // namespace kagefude
