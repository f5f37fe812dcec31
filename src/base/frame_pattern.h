#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kagefude {

/// A file name with a place for the frame number and perhaps one for the view, as pipelines write
/// them. The frame place stands in the file's own name, at most once, in one of these forms:
///
///     shot.####.exr   a run of n ≥ 2 is n digits; a lone # is 4, as in Nuke, Blender and Natron
///     shot.@@@@.exr   a run of n ≥ 2 is n digits; a lone @ is just a letter
///     shot.%04d.exr   printf's; %d is unpadded
///     shot.$F4.exr    Houdini's; $F is unpadded
///
/// `%V` is the view's name (left, right), `%v` its first letter; they may stand anywhere, also in
/// folders and more than once. A pattern without a frame place names one file.
///
/// Numbers wider than the padding are written out. A negative number's minus counts as one of the
/// digits when written (-5 in #### is -005, as printf, OIIO and Nuke do); when reading, -0005
/// (Blender's form) is found too.
class FramePattern {
 public:
  FramePattern() = default;
  /// UsageError for an empty pattern, one that ends in a slash, two frame places, or a printf form
  /// that does not pad with zeros.
  explicit FramePattern(std::string_view text);

  const std::string& text() const { return text_; }
  bool hasFrame() const { return padding_ > 0; }
  bool hasView() const { return hasView_; }
  /// Digits that the frame is padded to, 1 for none; 0 without a frame place.
  int padding() const { return padding_; }

  /// The path for a frame and a view. UsageError when the pattern has a view place and `view` is
  /// empty. Without a frame place the frame does not matter.
  std::filesystem::path path(int frame, std::string_view view = {}) const;

  /// The files on disk that fit, by frame. Where two spellings of one number lie side by side, the
  /// one that path() gives is taken. Empty when the folder is missing; InputError when it cannot be
  /// read. Without a frame place always empty.
  std::map<int, std::filesystem::path> scan(std::string_view view = {}) const;

 private:
  std::string expandViews(std::string_view text, std::string_view view) const;
  std::string number(int frame) const;
  std::optional<int> frameOf(std::string_view digits) const;

  std::string text_;
  std::string
      before_;  ///< up to the frame place, view places not yet filled; all of it without one
  std::string after_;
  int padding_ = 0;
  bool hasView_ = false;
};

/// The number at the end of a single file's name, before its extension: 12 for shot.0012.exr, -3
/// for shot.-003.exr; nothing for shot.exr. This is the frame of an input without a frame place.
std::optional<int> frameNumberOf(const std::filesystem::path& file);

}  // namespace kagefude
