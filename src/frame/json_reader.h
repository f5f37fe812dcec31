#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "image/vec.h"

namespace kagefude::detail {

/// A value in a JSON file together with its place, so that every complaint can name both. All
/// getters throw InputError: "shot.0001.json: lights[0].radius should be a number >= 0, but is
/// ...". Strings longer than 4096 bytes and lists longer than 65536 are refused.
class JsonPlace {
 public:
  /// Parses a file of at most 64 MiB.
  static nlohmann::json parseFile(const std::filesystem::path& path);

  JsonPlace(const std::filesystem::path& file, const nlohmann::json& value, std::string place)
      : file_(&file), value_(&value), place_(std::move(place)) {}

  /// The member of an object; has() tells whether it is there and not null.
  JsonPlace operator[](std::string_view key) const;
  bool has(std::string_view key) const;
  /// The elements of a list of at least `fewest` and at most `most`.
  std::vector<JsonPlace> list(size_t fewest = 0, size_t most = 65536) const;

  double number(double least, double most) const;
  double number() const;
  int integer(int least, int most) const;
  uint32_t index() const;
  bool boolean() const;
  std::string text() const;
  /// A text that is not empty.
  std::string name() const;
  /// One of `choices`, as its position.
  size_t choice(const std::vector<std::string>& choices) const;
  V3d vector() const;
  /// A vector of any length but zero, made unit.
  V3d unitVector() const;
  Transform matrix() const;
  /// Eight hexadecimal digits, as Cryptomatte manifests write ids.
  uint32_t hexadecimal() const;
  /// A path below the file's folder, joined with it.
  std::filesystem::path fileBeside() const;

  [[noreturn]] void refuse(std::string_view expected) const;
  const std::string& place() const { return place_; }

 private:
  const std::filesystem::path* file_;
  const nlohmann::json* value_;
  std::string place_;
};

}  // namespace kagefude::detail
