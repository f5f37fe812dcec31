#pragma once

#include <filesystem>

namespace kagefude::testing {

/// The checkout that the tests were built from.
std::filesystem::path sourceFolder();

/// Files that others made, which no test may need: $KAGEFUDE_SAMPLES, else ../shared/data beside
/// the checkout. May not exist.
std::filesystem::path sampleFolder();

}  // namespace kagefude::testing
