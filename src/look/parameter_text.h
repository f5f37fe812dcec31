#pragma once

#include <string>

#include "base/parameter.h"

namespace kagefude {

/// A parameter's type as users read it: "true/false", "integer", "choice" ...
const char* typeName(ValueType type);

/// Whether its numbers are bounded.
bool hasRange(const Parameter& parameter);

/// What it may be: "0 to 4 pixels", "auto | pair | line"; "" where it may be anything.
std::string rangeText(const Parameter& parameter);

}  // namespace kagefude
