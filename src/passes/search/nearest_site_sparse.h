#pragma once

#include <span>

#include "passes/search/nearest_site.h"

namespace kagefude::detail {

/// findNearestSites for labels whose pixels are few for their boxes, by sorted lists of their
/// sites: per wanted pixel the rows that hold sites, outward from its own, each by bisection.
void searchLists(const SiteSearch& search, std::span<const LabelBox> boxes, View<uint32_t> squared,
                 View<uint32_t> index);

}  // namespace kagefude::detail
