#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/parameter.h"
#include "image/vec.h"

namespace kagefude {

/// Everything that a stage's result depends on, written one after the other: two results with equal
/// keys are the same bits. The whole key is kept and compared, not a hash of it, so that no two
/// settings are ever taken for each other; it is a few hundred bytes.
class StageKey {
 public:
  StageKey& add(std::string_view text);
  StageKey& add(const StageKey& other) { return add(std::string_view(other.key_)); }
  StageKey& add(const V3f& v);
  StageKey& add(const Transform& transform);
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) StageKey& add(T value) {
    return bytes(&value, sizeof value);
  }
  /// The values of a parameter struct, but for the named ones.
  StageKey& add(const ParameterTable& table, const void* params,
                std::initializer_list<std::string_view> without = {});

  bool operator==(const StageKey&) const = default;

 private:
  StageKey& bytes(const void* data, size_t count);

  std::string key_;
};

}  // namespace kagefude
