#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// The second, horizontal phase of exact distances: per pixel of a row the least of
/// (x - u)² + offset(u)² over the row's columns u, with offset the rows to a column's nearest site.
namespace kagefude::detail {

inline constexpr int16_t noRow = 32767;     ///< no site in this column
inline constexpr uint16_t farAway = 65535;  ///< squared offset of a site that is out of reach
inline constexpr int rowReach = 252;        ///< a multiple of 4 whose next square fits 16 bits
inline constexpr int rowBlock = 32;         ///< pixels searched together
/// What must lie before and behind a row's squares.
inline constexpr int rowPad = rowReach + 4 + 2 * rowBlock;

/// Squares a row of offsets of either sign; those out of reach become farAway.
void squareRow(const int16_t* offsets, int count, uint16_t* squares);

/// Smallest squares[x ± o] + o² for a block of pixels; lanes start at `best`, 0 where no answer is
/// wanted. Returns false when a lane may have a nearer site out of reach.
bool searchBlock(const uint16_t* squares, uint16_t* best);

/// Where the nearest sites of a block lie that searchBlock has found, by columns and rows from each
/// pixel; of equally near ones the smaller row, then the smaller column. offsets: signed, padded as
/// the squares; squared: what searchBlock gave, at most rowReach².
void findBlockSites(const uint16_t* squares, const int16_t* offsets, const uint16_t* squared,
                    int16_t* across, int16_t* down);

/// Lower envelope of one row's parabolas, exact at any distance. Of equally near sites it holds the
/// one with the smaller signed offset, then the smaller column.
class Envelope {
 public:
  void build(const int16_t* offsets, int count);

  /// Squared distance at column x, or noSite; x must not fall between calls after one build.
  uint32_t at(const int16_t* offsets, int x);
  /// The column of the site that the last at() found.
  int column() const { return columns_[cursor_]; }

 private:
  std::vector<int> columns_, starts_;
  size_t cursor_ = 0;
};

}  // namespace kagefude::detail
