#include "oiio/write_picture.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "oiio/webp_file.h"

namespace kagefude::oiio {
namespace {

void setAttribute(OIIO::ImageSpec& spec, const PictureAttribute& attribute) {
  const OIIO::TypeDesc type(attribute.type.c_str());
  if (type == OIIO::TypeString) return spec.attribute(attribute.name, attribute.text);
  const size_t count = type.basevalues();
  if (attribute.numbers.size() < count || count == 0) return;
  if (type.basetype == OIIO::TypeDesc::FLOAT) {
    const std::vector<float> values(attribute.numbers.begin(), attribute.numbers.end());
    spec.attribute(attribute.name, type, values.data());
  } else if (type.basetype == OIIO::TypeDesc::INT) {
    const std::vector<int> values(attribute.numbers.begin(), attribute.numbers.end());
    spec.attribute(attribute.name, type, values.data());
  }
}

/// What a file says of how it is stored, of its own colours, and of ids that only it holds.
bool staysBehind(const std::string& name) {
  for (const char* prefix : {"oiio:", "openexr:", "tiff:", "png:", "jpeg:", "dpx:", "ICC",
                             "cryptomatte/", "kagefude/fingerprint"})
    if (name.starts_with(prefix)) return true;
  for (const char* whole :
       {"compression", "Compression", "CompressionQuality", "planarconfig", "name", "multiView",
        "textureformat", "chromaticities", "Orientation", "Software"})
    if (name == whole) return true;
  return false;
}

void carryMetadata(const std::string& file, int part, OIIO::ImageSpec& spec) {
  const auto input = OIIO::ImageInput::open(file);
  if (!input || !input->seek_subimage(part, 0))
    throw std::runtime_error("the metadata of " + file +
                             " cannot be read: " + (input ? input->geterror() : OIIO::geterror()));
  for (const OIIO::ParamValue& value : input->spec().extra_attribs)
    if (!staysBehind(value.name().string())) spec.extra_attribs.push_back(value);
}

/// Without a date OpenImageIO writes the present one. Blank is what Exif 2.3 has where it is not
/// known (4.6.4, DateTime).
void dateIfAsked(const std::string& format, OIIO::ImageSpec& spec) {
  if (format == "tiff" && !spec.find_attribute("DateTime"))
    spec.attribute("DateTime", "    :  :     :  :  ");
}

OIIO::ImageSpec specOf(const WrittenPicture& picture) {
  const PictureHeader& header = picture.header;
  OIIO::ImageSpec spec(header.dataWindow.width, header.dataWindow.height,
                       static_cast<int>(header.channels.size()),
                       OIIO::TypeDesc(std::string(sampleTypeName(header.channels[0].type))));
  spec.x = header.dataWindow.x;
  spec.y = header.dataWindow.y;
  spec.full_x = header.displayWindow.x;
  spec.full_y = header.displayWindow.y;
  spec.full_width = header.displayWindow.width;
  spec.full_height = header.displayWindow.height;
  for (size_t c = 0; c < header.channels.size(); ++c)
    spec.channelnames[c] = header.channels[c].name;
  spec.alpha_channel = header.alpha;
  if (!picture.metadataFile.empty())
    carryMetadata(picture.metadataFile, picture.metadataPart, spec);
  for (const PictureAttribute& attribute : header.attributes) setAttribute(spec, attribute);
  // Kept as they are given: else OpenImageIO would divide by alpha for formats that want that.
  if (header.unassociated) spec.attribute("oiio:UnassociatedAlpha", 1);
  if (!header.colourSpace.empty()) spec.attribute("oiio:ColorSpace", header.colourSpace);
  dateIfAsked(header.format, spec);
  return spec;
}

/// A DPX header holds its file's name (SMPTE 268M, field 5), where OpenImageIO writes what it was
/// called by: the temporary's path.
void nameInside(const std::string& path, const std::string& name) {
  constexpr std::streamoff place = 36;
  constexpr size_t length = 100;
  std::string field = name.substr(0, length - 1);
  field.resize(length, '\0');
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(place);
  if (!file.write(field.data(), length) || !file.flush())
    throw std::runtime_error("its header cannot be written");
}

}  // namespace

void writePicture(const WrittenPicture& picture, const float* pixels) {
  const OIIO::ImageSpec spec = specOf(picture);
  if (picture.header.format == "webp") return writeWebp(picture.path, spec, pixels);
  const std::unique_ptr<OIIO::ImageOutput> output =
      OIIO::ImageOutput::create(picture.header.format);
  if (!output) throw std::runtime_error(OIIO::geterror());
  if (!output->open(picture.path, spec) || !output->write_image(OIIO::TypeFloat, pixels) ||
      !output->close())
    throw std::runtime_error(output->geterror());
  if (picture.header.format == "dpx") nameInside(picture.path, picture.name);
}

}  // namespace kagefude::oiio
