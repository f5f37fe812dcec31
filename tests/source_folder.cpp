#include "source_folder.h"

#include <cstdlib>

namespace kagefude::testing {

std::filesystem::path sourceFolder() { return KAGEFUDE_SOURCE_DIR; }

std::filesystem::path sampleFolder() {
  const char* const given = std::getenv("KAGEFUDE_SAMPLES");
  return given ? std::filesystem::path(given) : sourceFolder() / ".." / "shared" / "data";
}

}  // namespace kagefude::testing
