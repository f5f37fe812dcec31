#include "passes/classes.h"

#include "image/parallel.h"
#include "passes/require_size.h"

namespace kagefude {

Bytes classifyShadow(std::span<const View<const uint8_t>> masks, View<const uint32_t> labels) {
  if (masks.empty()) throw InputError("a light has no shadow masks to classify");
  for (size_t k = 0; k < masks.size(); ++k)
    requireSize(fmt::format("shadow mask {}", k), masks[k], labels.width, labels.height);
  Bytes classes(labels.width, labels.height);
  parallelRows(labels.height, [&](int y0, int y1) {
    for (int y = y0; y < y1; ++y) {
      // Bit 0: some mask hides the light; bit 1: some mask sees it.
      uint8_t* const seen = classes.row(y);
      for (int x = 0; x < labels.width; ++x) seen[x] = 0;
      for (const View<const uint8_t>& mask : masks) {
        const uint8_t* const m = mask.row(y);
        for (int x = 0; x < labels.width; ++x) seen[x] |= m[x] ? 2 : 1;
      }
      constexpr auto umbra = static_cast<uint8_t>(ShadowClass::umbra);
      constexpr auto penumbra = static_cast<uint8_t>(ShadowClass::penumbra);
      constexpr auto lit = static_cast<uint8_t>(ShadowClass::lit);
      const uint32_t* const label = labels.row(y);
      for (int x = 0; x < labels.width; ++x) {
        const uint8_t kind = seen[x] == 3 ? penumbra : (seen[x] == 2 ? lit : umbra);
        seen[x] = label[x] == 0 ? static_cast<uint8_t>(ShadowClass::background) : kind;
      }
    }
  });
  return classes;
}

}  // namespace kagefude
