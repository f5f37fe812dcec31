#include "source_folder.h"

namespace kagefude::testing {

std::filesystem::path sourceFolder() { return KAGEFUDE_SOURCE_DIR; }

}  // namespace kagefude::testing
