// What comes from elsewhere: manifests, sidecars, casters, EXR and PNG files, palettes.
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "base/error.h"
#include "exr/fast_read.h"
#include "exr/read_channels.h"
#include "frame/casters.h"
#include "frame/cryptomatte.h"
#include "frame/sidecar.h"
#include "fuzz/fuzz_file.h"
#include "fuzz/harness.h"
#include "picture/palette_file.h"
#include "picture/png_file.h"
#include "picture/strip_file.h"

namespace kagefude::fuzz {
namespace {

/// Bigger claims are left unread, to keep the runs quick.
constexpr int64_t mostPixels = 1 << 16;

/// An image whose header carries these attributes, without a file.
ImageFile imageWith(const std::map<std::string, std::string>& attributes) {
  std::vector<Imf::Header> headers(1);
  for (const auto& [name, text] : attributes) headers[0].insert(name, Imf::StringAttribute(text));
  ImageFile image;
  image.path = "/nowhere/frame.exr";
  image.ownParts = {0};
  image.headers = std::make_shared<const std::vector<Imf::Header>>(std::move(headers));
  return image;
}

template <class Call>
void swallowErrors(const Call& call) {
  try {
    call();
  } catch (const Error&) {
  }
}

void readFast(const FastExr& file) {
  for (size_t p = 0; p < file.parts().size(); ++p) {
    const ExrPart& part = file.parts()[p];
    if (!part.readable || part.data.pixels() > mostPixels) continue;
    std::vector<int> wanted;
    for (size_t c = 0; c < std::min<size_t>(part.channels.size(), 8); ++c)
      wanted.push_back(static_cast<int>(c));
    swallowErrors([&] { file.readFloats(static_cast<int>(p), wanted); });
  }
}

}  // namespace

void fuzzManifest(std::string_view input) {
  const Cryptomatte matte{"cryptomatte/1234567", "Crypto", {}, {}, 0};
  for (const char* const kind : {"/manifest", "/manif_file"})
    swallowErrors([&] {
      const ImageFile image = imageWith({{matte.key + kind, std::string(input)}});
      readManifest(image, matte);
      manifestFile(image, matte);
    });
}

void fuzzSidecar(std::string_view input) {
  const FuzzFile file(input, ".json");
  swallowErrors([&] { readSidecar(file.path()); });
}

void fuzzCasters(std::string_view input) {
  const FuzzFile file(input, ".obj");
  swallowErrors([&] {
    CasterMesh mesh = readObj(file.path());
    faultWarning(mesh, cleanCasterMesh(mesh));
  });
}

void fuzzExrHeader(std::string_view input) {
  const FuzzFile file(input, ".exr");
  swallowErrors([&] {
    const ImageFile image = openImage(file.path());
    for (const Cryptomatte& matte : listCryptomattes(image)) readManifest(image, matte);
    for (int part = 0; part < static_cast<int>(image.parts.size()); ++part)
      for (const std::string& name : image.textNames(part)) image.textOfPart(part, name);
  });
  swallowErrors([&] { FastExr::open(file.path()); });
}

void fuzzExrChunks(std::string_view input) {
  const FuzzFile file(input, ".exr");
  swallowErrors([&] {
    const ImageFile image = openImage(file.path());
    for (const Part& part : image.parts)
      if (part.dataWindow.pixels() > mostPixels) return;
    size_t read = 0;
    for (const Channel& channel : image.channels)
      if (++read <= 8)
        swallowErrors([&] { readRaw(image, std::vector<std::string>{channel.name}); });
  });
  swallowErrors([&] {
    if (const auto fast = FastExr::open(file.path())) readFast(*fast);
  });
}

void fuzzPng(std::string_view input) {
  const FuzzFile file(input, ".png");
  swallowErrors([&] { readPng(file.path()); });
  swallowErrors([&] { readStrip(file.path()); });
  readPngText(file.path(), "kagefude");
}

void fuzzPalette(std::string_view input) {
  const FuzzFile file(input, ".gpl");
  swallowErrors([&] { readPalette(file.path()); });
  swallowErrors([&] { paletteFromText(std::string(input.substr(0, 4096))); });
}

}  // namespace kagefude::fuzz
