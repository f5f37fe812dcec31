#include "frame/frame_group.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "base/error.h"
#include "base/frame_pattern.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

bool isPlace(const std::string& word) {
  const bool number =
      std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  return number || word.find_first_of("#@%$") != std::string::npos;
}

/// The words of a file's name that name what it holds: not frame, view or suffix.
std::vector<std::string> wordsOf(const fs::path& file, const std::string& view) {
  std::vector<std::string> words = {""};
  for (const char c : file.stem().string()) {
    if (c == '.' || c == '_' || c == '-')
      words.emplace_back();
    else
      words.back() += c;
  }
  std::erase_if(words, [&](const std::string& word) { return isPlace(word) || word == view; });
  return words;
}

std::string layerOf(const fs::path& file, const fs::path& frame, const std::string& view) {
  std::vector<std::string> words = wordsOf(file, view);
  const std::vector<std::string> common = wordsOf(frame, view);
  const auto [first, ignored] =
      std::mismatch(words.begin(), words.end(), common.begin(), common.end());
  words.erase(words.begin(), first);
  if (words.empty()) return file.parent_path().filename().string();
  return fmt::format("{}", fmt::join(words, "."));
}

/// The end of the layer's name that a pattern gives, "" when it gives none.
std::string givenLayer(const std::string& text) {
  const size_t end = text.find('=');
  const std::string name = text.substr(0, end == std::string::npos ? 0 : end);
  return name.find_first_of("/#@%$") == std::string::npos ? name : "";
}

}  // namespace

std::vector<GroupFile> groupFiles(const fs::path& frame, const std::vector<std::string>& patterns,
                                  int number, const std::string& view) {
  std::vector<GroupFile> files;
  for (const std::string& text : patterns) {
    std::string layer = givenLayer(text);
    const std::string name = layer.empty() ? text : text.substr(layer.size() + 1);
    try {
      const FramePattern pattern(name);
      const fs::path path = (frame.parent_path() / pattern.path(number, view)).lexically_normal();
      if (path == frame.lexically_normal()) continue;
      if (layer.empty()) layer = layerOf(path, frame, view);
      files.push_back({path, layer});
    } catch (const UsageError& problem) {
      throw LookError(fmt::format("frame.files: {}: {}", text, problem.what()));
    }
  }
  return files;
}

}  // namespace kagefude
