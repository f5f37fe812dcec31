#pragma once

#include <span>
#include <string>

#include "exr/fast_read.h"

namespace kagefude {

/// One readable part of an open file.
struct ExrSource {
  const std::string& path;
  const _priv_exr_context_t* context;
  int index;
  const ExrPart& part;
};

/// Reads every chunk of the part, in parallel, and spreads the wanted channels into their views;
/// see FastExr::read.
void readExrChunks(const ExrSource& source, std::span<const ExrTarget> targets);

}  // namespace kagefude
