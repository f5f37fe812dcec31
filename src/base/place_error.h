#pragma once

#include <string>

#include "base/error.h"

namespace kagefude {

/// What `work` gives; an InputError or LookError that it throws says first what named the thing it
/// is about, such as "look.toml:12: style[1].strip". An empty `place` adds nothing.
template <class Work>
auto withPlace(const std::string& place, const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const InputError& error) {
    if (place.empty()) throw;
    throw InputError(place + ": " + error.what());
  } catch (const LookError& error) {
    if (place.empty()) throw;
    throw LookError(place + ": " + error.what());
  }
}

}  // namespace kagefude
