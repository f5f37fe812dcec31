#pragma once

#include "base/parameter.h"

namespace kagefude {

/// Whether two parameter structs hold the same values of their table.
template <class Params>
bool sameParams(std::span<const Parameter> table, const Params& a, const Params& b) {
  for (const Parameter& p : table)
    if (p.get(&a) != p.get(&b)) return false;
  return true;
}

}  // namespace kagefude
