#include "oiio/write_picture.h"

#include <OpenImageIO/imageio.h>

#include <memory>
#include <stdexcept>

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

OIIO::ImageSpec specOf(const PictureHeader& header) {
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
  for (const PictureAttribute& attribute : header.attributes) setAttribute(spec, attribute);
  // Kept as they are given: else OpenImageIO would divide by alpha for formats that want that.
  if (header.unassociated) spec.attribute("oiio:UnassociatedAlpha", 1);
  if (!header.colourSpace.empty()) spec.attribute("oiio:ColorSpace", header.colourSpace);
  return spec;
}

}  // namespace

void writePicture(const std::string& path, const PictureHeader& header, const float* pixels) {
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(header.format);
  if (!output) throw std::runtime_error(OIIO::geterror());
  if (!output->open(path, specOf(header)) || !output->write_image(OIIO::TypeFloat, pixels) ||
      !output->close())
    throw std::runtime_error(output->geterror());
}

}  // namespace kagefude::oiio
