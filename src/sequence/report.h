#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace kagefude {

/// A small display-ready picture: 8-bit R, G, B interleaved, row by row from the top.
struct Thumbnail {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgb;
};

/// What the report shows of one frame.
struct ReportFrame {
  int frame = 0;
  std::string view;
  bool kept = false;
  double readSeconds = 0;
  double computeSeconds = 0;
  double writeSeconds = 0;
  std::vector<std::string> warnings;
  std::string failure;  ///< empty when it did not fail
};

struct ReportHeader {
  std::string title;    ///< such as the output pattern
  std::string command;  ///< as it was called
  std::string version;
  std::string look;  ///< the look with every value resolved
};

/// How far one picture is from the one before it, in 8-bit steps.
struct FrameChange {
  double mean = 0;     ///< mean absolute difference of all pixels and channels
  double largest = 0;  ///< the largest mean of a block of 8 × 8 pixels: sees a small thing pop
};
FrameChange frameChange(const Thumbnail& before, const Thumbnail& after);

/// Positions whose change stands out from their neighbourhood: above twice the median of the eight
/// values around it plus three steps. Negative values stand for "not known" and are passed over.
std::vector<size_t> findPops(const std::vector<double>& changes);

/// A frame with its pictures as the report keeps them.
struct ReportEntry {
  ReportFrame frame;
  std::string image;  ///< PNG, relative to the report's folder; empty without a picture
  Thumbnail proxy;    ///< the picture reduced, for the change between frames
};

/// A static page about a run: `index.html` and `thumbs/*.png` in a folder, everything in it, no
/// network needed. Frames may come in any order and from several threads at a time; memory per
/// frame is a copy of the thumbnail reduced to at most 96 pixels a side.
class Report {
 public:
  using WriteImage = std::function<void(const std::filesystem::path&, const Thumbnail&)>;

  /// Makes the folder. OutputError when that fails. `writeImage` writes a PNG.
  Report(std::filesystem::path folder, ReportHeader header, WriteImage writeImage);

  /// Writes the thumbnail and notes the frame. `picture` is empty for a failed frame.
  void add(const ReportFrame& frame, const Thumbnail& picture);

  /// Writes index.html. May be called at any time, again after more frames.
  void finish() const;

 private:
  std::filesystem::path folder_;
  ReportHeader header_;
  WriteImage writeImage_;
  mutable std::mutex mutex_;
  std::map<std::pair<std::string, int>, ReportEntry> entries_;  ///< by view and frame
};

}  // namespace kagefude
