#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "image/window.h"

namespace kagefude {

/// How a picture's file stores a channel. Integers of other sizes count as the next larger one.
enum class SampleType { uint8, uint16, uint32, half, single };

/// "uint8", "uint16", "uint32", "half" or "float", as OpenImageIO calls them.
std::string_view sampleTypeName(SampleType type);

/// Bytes that a sample has in its file.
int bytesOf(SampleType type);

struct PictureChannel {
  std::string name;
  SampleType type = SampleType::uint8;
};

/// A file's attribute under OpenImageIO's name. Numbers of every type are in `numbers` and as words
/// in `text`; text is in `text` alone.
struct PictureAttribute {
  std::string name;
  std::string type;  ///< OpenImageIO's, such as "string", "int", "float", "matrix"
  std::string text;
  std::vector<double> numbers;
};

/// What a picture's file says of itself ahead of its pixels.
struct PictureHeader {
  std::string format;  ///< OpenImageIO's name of the format, such as "tiff"
  Window dataWindow;
  Window displayWindow;
  std::vector<PictureChannel> channels;
  int alpha = -1;                ///< the channel that is alpha; -1: none
  bool unassociated = false;     ///< colours are not multiplied by alpha
  std::string colourSpace;       ///< as OpenImageIO names it; "" when the file does not say
  int orientation = 1;           ///< Exif's, 1 to 8; 1 is upright
  bool severalPictures = false;  ///< frames of a film, pages, layers beside the first picture
  bool deep = false;
  int depth = 1;  ///< of a volume
  std::vector<PictureAttribute> attributes;

  /// The text of an attribute, "" without it.
  std::string text(std::string_view name) const;
};

/// To and from what the worker's messages hold.
nlohmann::json toJson(const PictureHeader& header);
PictureHeader headerFrom(const nlohmann::json& json);

}  // namespace kagefude
