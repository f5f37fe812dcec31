#include "live/stage_key.h"

#include <algorithm>

namespace kagefude {
namespace {

void addTo(StageKey& key, const std::string& text) { key.add(std::string_view(text)); }
void addTo(StageKey& key, const std::vector<std::string>& texts) {
  key.add(texts.size());
  for (const std::string& text : texts) addTo(key, text);
}
void addTo(StageKey& key, const std::vector<double>& numbers) {
  key.add(numbers.size());
  for (const double number : numbers) key.add(number);
}
template <class Number>
void addTo(StageKey& key, Number number) {
  key.add(number);
}

}  // namespace

StageKey& StageKey::bytes(const void* data, size_t count) {
  key_.append(static_cast<const char*>(data), count);
  return *this;
}

/// With its length, so that "ab" + "c" is not "a" + "bc".
StageKey& StageKey::add(std::string_view text) {
  return add(text.size()).bytes(text.data(), text.size());
}

StageKey& StageKey::add(const V3f& v) { return add(v.x).add(v.y).add(v.z); }

StageKey& StageKey::add(const Transform& transform) {
  for (const auto& row : transform.m)
    for (const double number : row) add(number);
  return *this;
}

StageKey& StageKey::add(const ParameterTable& table, const void* params,
                        std::initializer_list<std::string_view> without) {
  for (const Parameter& parameter : table.parameters) {
    if (std::find(without.begin(), without.end(), parameter.name) != without.end()) continue;
    std::visit([this](const auto& value) { addTo(*this, value); }, parameter.get(params));
  }
  return *this;
}

}  // namespace kagefude
