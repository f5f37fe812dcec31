#pragma once

#include "passes/search/nearest_site.h"

namespace kagefude::detail {

/// findNearestSites for one label, by two separable phases over its box. Writes wanted pixels of
/// the label only; without labels also noSite to all others.
void searchBox(const SiteSearch& search, const LabelBox& box, View<uint32_t> squared,
               View<uint32_t> index);

}  // namespace kagefude::detail
