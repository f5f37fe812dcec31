#pragma once

#include <algorithm>
#include <cstdint>

namespace kagefude {

/// The pixels of a larger picture, along one side, that one pixel of a smaller one stands for.
struct BoxSpan {
  int first = 0, end = 0;  ///< at least one pixel
};

/// The span of pixel `i` of `small` over `large` pixels, small <= large: spans follow each other
/// without gap and cover all.
constexpr BoxSpan boxSpan(int i, int large, int small) {
  const int first = static_cast<int>(int64_t{i} * large / small);
  return {first, std::max(first + 1, static_cast<int>((int64_t{i} + 1) * large / small))};
}

constexpr int pixelsIn(const BoxSpan& across, const BoxSpan& down) {
  return (across.end - across.first) * (down.end - down.first);
}

/// The sum of value(x, y) over a box, row by row, in `Sum`.
template <class Sum, class Value>
Sum boxSum(const BoxSpan& across, const BoxSpan& down, const Value& value) {
  Sum sum(0);
  for (int y = down.first; y < down.end; ++y)
    for (int x = across.first; x < across.end; ++x) sum += value(x, y);
  return sum;
}

}  // namespace kagefude
