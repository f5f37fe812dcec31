#include "exr/carry_attributes.h"

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "exr/reserved_attributes.h"

namespace kagefude::detail {
namespace {

constexpr size_t longestName = 255;

class TextStream : public Imf::OStream {
 public:
  TextStream() : Imf::OStream("attribute") {}
  void write(const char bytes[], int count) override {
    text.replace(std::min(place_, text.size()), static_cast<size_t>(count), bytes,
                 static_cast<size_t>(count));
    place_ += static_cast<size_t>(count);
  }
  uint64_t tellp() override { return place_; }
  void seekp(uint64_t place) override { place_ = place; }

  std::string text;

 private:
  size_t place_ = 0;
};

std::string bytesOf(const Imf::Attribute& attribute) {
  TextStream stream;
  attribute.writeValueTo(stream, Imf::EXR_VERSION);
  return attribute.typeName() + ("\n" + stream.text);
}

void addPart(const Imf::Header& from, const std::string& part, Imf::Header& header) {
  for (auto a = from.begin(); a != from.end(); ++a) {
    if (isOfStorage(a.name())) continue;
    const auto known = header.find(a.name());
    if (known == header.end()) {
      header.insert(a.name(), a.attribute());
      continue;
    }
    const std::string own = part + "/" + a.name();
    const bool isNew = header.find(own) == header.end() && own.size() <= longestName;
    if (isNew && bytesOf(known.attribute()) != bytesOf(a.attribute()))
      header.insert(own, a.attribute());
  }
}

}  // namespace

void carryAttributes(const ImageFile& source, bool allParts, Imf::Header& header) {
  const Imf::Header& first = source.leadingHeader();
  for (auto a = first.begin(); a != first.end(); ++a)
    if (!isOfStorage(a.name())) header.insert(a.name(), a.attribute());
  for (size_t i = 1; allParts && i < source.ownParts.size(); ++i) {
    const auto part = static_cast<size_t>(source.ownParts[i]);
    const std::string& name = source.parts[part].name;
    addPart((*source.headers)[part], name.empty() ? fmt::format("part{}", part) : name, header);
  }
  if (!source.view.empty()) header.insert("view", Imf::StringAttribute(source.view));
}

}  // namespace kagefude::detail
