#include "passes/search/classes.h"

#include <algorithm>

#include "image/clones.h"
#include "image/parallel.h"
#include "passes/require_size.h"

namespace kagefude {
namespace {

/// Bit 0: some mask hides the light; bit 1: some mask sees it.
KAGEFUDE_CLONES void addMask(const uint8_t* mask, int count, uint8_t* seen) {
  for (int x = 0; x < count; ++x) seen[x] |= mask[x] ? 2 : 1;
}

KAGEFUDE_CLONES void settleRow(const uint32_t* labels, int count, uint8_t* seen) {
  constexpr auto umbra = static_cast<uint8_t>(ShadowClass::umbra);
  constexpr auto penumbra = static_cast<uint8_t>(ShadowClass::penumbra);
  constexpr auto lit = static_cast<uint8_t>(ShadowClass::lit);
  for (int x = 0; x < count; ++x) {
    const uint8_t kind = seen[x] == 3 ? penumbra : (seen[x] == 2 ? lit : umbra);
    seen[x] = labels[x] == 0 ? static_cast<uint8_t>(ShadowClass::background) : kind;
  }
}

}  // namespace

Bytes classifyShadow(std::span<const View<const uint8_t>> masks, View<const uint32_t> labels) {
  if (masks.empty()) throw InputError("a light has no shadow masks to classify");
  for (size_t k = 0; k < masks.size(); ++k)
    requireSize(fmt::format("shadow mask {}", k), masks[k], labels.width, labels.height);
  Bytes classes(labels.width, labels.height);
  parallelRows(labels.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y) {
      uint8_t* const seen = classes.row(y);
      std::fill_n(seen, labels.width, uint8_t{0});
      for (const View<const uint8_t>& mask : masks) addMask(mask.row(y), labels.width, seen);
      settleRow(labels.row(y), labels.width, seen);
    }
  });
  return classes;
}

}  // namespace kagefude
