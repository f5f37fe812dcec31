#include "picture/picture_header.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace kagefude {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 5> typeNames = {"uint8", "uint16", "uint32", "half",
                                                       "float"};

json toJson(const Window& window) { return {window.x, window.y, window.width, window.height}; }

Window windowFrom(const json& numbers) {
  return {numbers.at(0), numbers.at(1), numbers.at(2), numbers.at(3)};
}

}  // namespace

std::string_view sampleTypeName(SampleType type) { return typeNames[static_cast<size_t>(type)]; }

int bytesOf(SampleType type) {
  constexpr std::array<int, 5> bytes = {1, 2, 4, 2, 4};
  return bytes[static_cast<size_t>(type)];
}

std::string PictureHeader::text(std::string_view name) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const PictureAttribute& a) { return a.name == name; });
  return found == attributes.end() ? std::string() : found->text;
}

json toJson(const PictureHeader& header) {
  json channels = json::array(), attributes = json::array();
  for (const PictureChannel& c : header.channels)
    channels.push_back({c.name, static_cast<int>(c.type)});
  for (const PictureAttribute& a : header.attributes)
    attributes.push_back({a.name, a.type, a.text, a.numbers});
  return {{"format", header.format},
          {"data", toJson(header.dataWindow)},
          {"display", toJson(header.displayWindow)},
          {"channels", channels},
          {"alpha", header.alpha},
          {"unassociated", header.unassociated},
          {"space", header.colourSpace},
          {"orientation", header.orientation},
          {"several", header.severalPictures},
          {"deep", header.deep},
          {"depth", header.depth},
          {"attributes", attributes}};
}

PictureHeader headerFrom(const json& j) {
  PictureHeader header;
  header.format = j.at("format");
  header.dataWindow = windowFrom(j.at("data"));
  header.displayWindow = windowFrom(j.at("display"));
  for (const json& c : j.at("channels"))
    header.channels.push_back({c.at(0), static_cast<SampleType>(c.at(1).get<int>())});
  header.alpha = j.at("alpha");
  header.unassociated = j.at("unassociated");
  header.colourSpace = j.at("space");
  header.orientation = j.at("orientation");
  header.severalPictures = j.at("several");
  header.deep = j.at("deep");
  header.depth = j.at("depth");
  for (const json& a : j.at("attributes"))
    header.attributes.push_back({a.at(0), a.at(1), a.at(2), a.at(3).get<std::vector<double>>()});
  return header;
}

}  // namespace kagefude
