#include "image/sparse_plane.h"

#include <algorithm>
#include <cstring>

namespace kagefude {
namespace {

bool holdsSomething(const uint8_t* words, size_t count) {
  uint32_t any = 0;
  for (size_t i = 0; i < count; ++i) {
    uint32_t word;
    std::memcpy(&word, words + i * sizeof word, sizeof word);
    any |= word;
  }
  return any != 0;
}

}  // namespace

void SparsePlane::setRow(int y, const void* words) {
  const auto* const from = static_cast<const uint8_t*>(words);
  const size_t width = static_cast<size_t>(width_), all = blocks();
  const auto lengthOf = [&](size_t i) { return std::min<size_t>(block, width - i * block); };
  const auto startOf = [&](size_t i) { return from + i * block * sizeof(uint32_t); };
  std::vector<uint32_t> starts(all, 0);
  auto next = static_cast<uint32_t>(all);
  for (size_t i = 0; i < all; ++i)
    if (holdsSomething(startOf(i), lengthOf(i))) {
      starts[i] = next;
      next += block;
    }
  std::vector<uint32_t>& row = rows_[static_cast<size_t>(y)];
  row.clear();
  if (next == all) return;
  row = std::vector<uint32_t>(next, 0);
  std::copy(starts.begin(), starts.end(), row.begin());
  for (size_t i = 0; i < all; ++i)
    if (starts[i]) std::memcpy(row.data() + starts[i], startOf(i), lengthOf(i) * sizeof(uint32_t));
}

std::span<uint32_t> SparsePlane::keptOf(int y) {
  std::vector<uint32_t>& row = rows_[static_cast<size_t>(y)];
  return std::span(row).subspan(row.empty() ? 0 : blocks());
}

std::span<const uint32_t> SparsePlane::keptOf(int y) const {
  const std::vector<uint32_t>& row = rows_[static_cast<size_t>(y)];
  return std::span(row).subspan(row.empty() ? 0 : blocks());
}

void SparsePlane::clear(int x, int y) {
  std::vector<uint32_t>& row = rows_[static_cast<size_t>(y)];
  if (row.empty()) return;
  if (const uint32_t start = row[static_cast<size_t>(x / block)])
    row[start + static_cast<size_t>(x % block)] = 0;
}

size_t SparsePlane::bytes() const {
  size_t words = 0;
  for (const std::vector<uint32_t>& row : rows_) words += row.size();
  return words * sizeof(uint32_t);
}

}  // namespace kagefude
