#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/parameter.h"

namespace kagefude {

/// A parameter's value as JSON: true, numbers, texts, a choice by its name.
nlohmann::ordered_json jsonOf(const Parameter& parameter, const Value& value);

/// A table with name, sentence and source, and of each parameter its name, type, default, range,
/// choices, unit and sentence: what `passes --json` prints and the page makes its knobs of.
nlohmann::ordered_json jsonOf(const ParameterTable& table);

}  // namespace kagefude
