#pragma once

#include <OpenEXR/ImfForward.h>

#include <optional>
#include <vector>

#include "exr/fast_write.h"

namespace kagefude::detail {

/// A header's attributes in the fast writer's terms, without those that follow from the image
/// itself; nothing when one is of a type that the fast writer does not know.
std::optional<std::vector<ExrAttribute>> fastAttributes(const Imf::Header& header);

}  // namespace kagefude::detail
