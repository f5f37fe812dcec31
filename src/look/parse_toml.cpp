#include "look/parse_toml.h"

#include <fmt/format.h>

#include <vector>

#include "base/error.h"

namespace kagefude {
namespace {

/// Walks over a text as the parser will, as far as nesting goes: what is in strings and remarks
/// does not count, brackets and the dots of a key do.
class NestingCheck {
 public:
  NestingCheck(std::string_view text, const std::string& source) : text_(text), source_(source) {}

  void run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        skipString(c);
        continue;
      }
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
        continue;
      }
      take(c);
      ++at_;
    }
  }

 private:
  void take(char c) {
    if (c == '\n') ++line_;
    if (c == '.') ++dots_;
    // A header's dots hold for the lines below it; a key's end with its value.
    if (c == '[' || c == '{') open();
    if ((c == ']' || c == '}') && !outside_.empty()) close();
    if (c == ',' || (c == '\n' && outside_.empty())) dots_ = 0;
    if (header_ + within_ + dots_ + outside_.size() > mostNesting)
      throw LookError(fmt::format("{}:{}: keys and lists lie within each other more than {} deep",
                                  source_, line_, mostNesting));
  }

  void open() {
    isHeader_ = outside_.empty() ? lineIsEmpty() : isHeader_;
    if (outside_.empty() && isHeader_) header_ = 0;
    outside_.push_back(dots_);
    within_ += dots_;
    dots_ = 0;
  }

  void close() {
    if (isHeader_) header_ = std::max(header_, dots_);
    within_ -= outside_.back();
    dots_ = outside_.back();
    outside_.pop_back();
  }

  /// Whether nothing but spaces stands before this place in its line.
  bool lineIsEmpty() const {
    const size_t last = at_ == 0 ? std::string_view::npos : text_.find_last_not_of(" \t", at_ - 1);
    return last == std::string_view::npos || text_[last] == '\n';
  }

  void skipString(char quote) {
    const std::string three(3, quote);
    const bool lines = text_.substr(at_, 3) == three;
    at_ += lines ? 3 : 1;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') {
        if (!lines) return;  // not closed: the parser says so
        ++line_;
      }
      if (c == '\\' && quote == '"') {
        at_ += 2;
      } else if (c == quote && (!lines || text_.substr(at_, 3) == three)) {
        at_ += lines ? 3 : 1;
        return;
      } else {
        ++at_;
      }
    }
  }

  std::string_view text_;
  const std::string& source_;
  size_t at_ = 0, line_ = 1;
  size_t dots_ = 0;    ///< of the key that is being read
  size_t header_ = 0;  ///< of the section that the line is in
  size_t within_ = 0;  ///< of the keys whose values are open
  std::vector<size_t> outside_;
  bool isHeader_ = false;
};

}  // namespace

toml::table parseToml(std::string_view text, const std::string& source) {
  NestingCheck(text, source).run();
  return toml::parse(text, source);
}

}  // namespace kagefude
