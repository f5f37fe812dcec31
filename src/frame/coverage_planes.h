#pragma once

#include <string_view>
#include <vector>

#include "image/plane.h"
#include "image/sparse_plane.h"

namespace kagefude {

class ChannelReader;

/// The ranks of a Cryptomatte, of which all but the first hold something at edges only. Id 0 is
/// background.
struct CoveragePlanes {
  Labels firstId;
  Floats firstShare;  ///< how much of the pixel it covers
  std::vector<SparsePlane> otherIds, otherShares;

  bool empty() const { return firstId.empty(); }
  size_t ranks() const { return empty() ? 0 : 1 + otherIds.size(); }
  uint32_t id(size_t rank, int x, int y) const {
    return rank == 0 ? firstId(x, y) : otherIds[rank - 1](x, y);
  }
  float share(size_t rank, int x, int y) const {
    return rank == 0 ? firstShare(x, y) : otherShares[rank - 1].asFloat(x, y);
  }
};

/// Notes the planes of requestCryptomatte, without its names, with the reader, at most `ranks` of
/// at least 1. They must stay where they are until its read(). Throws what that throws.
void requestCoverage(ChannelReader& reader, std::string_view name, int ranks,
                     CoveragePlanes& coverage);

/// Cleans coverage: a pixel with a rank that is not finite, below -0.5 or above 1.5 becomes wholly
/// its first id. What lies between is kept as it is, for filters with negative lobes overshoot at
/// edges (Lanczos by a fifth). Returns how many pixels that were.
size_t clearImpossibleCoverage(CoveragePlanes& coverage);

/// The id with the most coverage at each pixel, as of CryptomattePlanes.
Labels dominantIds(const CoveragePlanes& coverage);

}  // namespace kagefude
