#pragma once

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfMultiView.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "image/plane.h"
#include "image/window.h"

namespace kagefude::testing {

/// Float channels by name; the planes are those of the whole display window.
using Channels = std::map<std::string, View<const float>>;

/// A part as other programs write it: its window cuts the channels' planes.
struct PartSpec {
  std::string name;
  std::string view;
  Channels channels;
  Window window = {};  ///< 0 x 0: all of the display
  std::map<std::string, std::string> attributes = {};
  std::map<std::string, Imath::M44f> matrices = {};
};

/// Writes parts whose display window is `width` x `height`, with `views` as the multiView list.
inline void writeParts(const std::filesystem::path& path, int width, int height,
                       std::vector<PartSpec> parts, const std::vector<std::string>& views = {}) {
  std::vector<Imf::Header> headers;
  for (PartSpec& part : parts) {
    if (part.window.width == 0) part.window = {0, 0, width, height};
    const Window& w = part.window;
    Imf::Header header(Imath::Box2i({0, 0}, {width - 1, height - 1}),
                       Imath::Box2i({w.x, w.y}, {w.x + w.width - 1, w.y + w.height - 1}));
    header.setType(Imf::SCANLINEIMAGE);
    if (!part.name.empty()) header.setName(part.name);
    if (!part.view.empty()) header.setView(part.view);
    if (!views.empty()) Imf::addMultiView(header, views);
    for (const auto& [name, value] : part.attributes)
      header.insert(name, Imf::StringAttribute(value));
    for (const auto& [name, value] : part.matrices) header.insert(name, Imf::M44fAttribute(value));
    for (const auto& [name, plane] : part.channels)
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    headers.push_back(header);
  }
  Imf::MultiPartOutputFile output(path.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (size_t i = 0; i < parts.size(); ++i) {
    Imf::FrameBuffer buffer;
    const size_t row = sizeof(float) * static_cast<size_t>(width);
    for (const auto& [name, plane] : parts[i].channels)
      buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, plane.data, Imath::V2i(0, 0), width, height,
                                           sizeof(float), row));
    Imf::OutputPart part(output, static_cast<int>(i));
    part.setFrameBuffer(buffer);
    part.writePixels(parts[i].window.height);
  }
}

}  // namespace kagefude::testing
