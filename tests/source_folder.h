#pragma once

#include <filesystem>

namespace kagefude::testing {

/// The checkout that the tests were built from.
std::filesystem::path sourceFolder();

}  // namespace kagefude::testing
