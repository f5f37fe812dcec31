#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sequence/report.h"

namespace kagefude {

/// The frames of one view in order, each with its change from the one before (negative: unknown).
struct ReportStrip {
  std::string view;
  std::vector<const ReportEntry*> entries;
  std::vector<FrameChange> changes;
};

/// The text with &, <, >, " and ' written as HTML entities and control characters
/// as printableLines has them.
std::string escapeHtml(std::string_view text);

/// The whole page: style, pictures' places and plots in one text, no links to other hosts.
std::string reportPage(const ReportHeader& header, const std::vector<ReportStrip>& strips);

}  // namespace kagefude
