#include "oiio/webp_file.h"

#include <OpenImageIO/tiffutils.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <vector>

namespace kagefude::oiio {
namespace {

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error(why); }

std::vector<uint8_t> bytesOf(const OIIO::ImageSpec& spec, const float* pixels) {
  const auto count = static_cast<size_t>(spec.image_pixels()) * static_cast<size_t>(spec.nchannels);
  std::vector<uint8_t> bytes(count);
  for (size_t i = 0; i < count; ++i) bytes[i] = static_cast<uint8_t>(pixels[i] * 255.0f + 0.5f);
  return bytes;
}

/// An encoder's picture and what it has encoded.
class Encoder {
 public:
  Encoder() {
    if (!WebPConfigInit(&config_) || !WebPPictureInit(&picture_)) fail("libwebp does not start");
    WebPMemoryWriterInit(&written_);
    picture_.writer = WebPMemoryWrite;
    picture_.custom_ptr = &written_;
  }
  ~Encoder() {
    WebPPictureFree(&picture_);
    WebPMemoryWriterClear(&written_);
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  WebPData encode(const OIIO::ImageSpec& spec, const std::vector<uint8_t>& bytes) {
    const int quality = spec.get_int_attribute("CompressionQuality", 95);
    config_.lossless = quality >= 100;
    config_.quality = config_.lossless ? 75.0f : static_cast<float>(quality);  // lossless: effort
    config_.exact = 1;
    picture_.use_argb = 1;
    picture_.width = spec.width;
    picture_.height = spec.height;
    const int stride = spec.width * spec.nchannels;
    const auto import = spec.nchannels == 4 ? WebPPictureImportRGBA : WebPPictureImportRGB;
    if (!import(&picture_, bytes.data(), stride) || !WebPEncode(&config_, &picture_))
      fail("libwebp refuses it with error " + std::to_string(picture_.error_code));
    return {written_.mem, written_.size};
  }

 private:
  WebPConfig config_;
  WebPPicture picture_;
  WebPMemoryWriter written_;
};

struct DeleteMux {
  void operator()(WebPMux* mux) const { WebPMuxDelete(mux); }
};
using Mux = std::unique_ptr<WebPMux, DeleteMux>;

}  // namespace

void writeWebp(const std::string& path, const OIIO::ImageSpec& spec, const float* pixels) {
  Encoder encoder;
  const WebPData packed = encoder.encode(spec, bytesOf(spec, pixels));
  std::vector<char> exif;
  OIIO::encode_exif(spec, exif, OIIO::endian::little);
  const WebPData block{reinterpret_cast<const uint8_t*>(exif.data()), exif.size()};
  const Mux mux(WebPMuxCreate(&packed, 0));
  WebPData whole{};
  if (!mux || WebPMuxSetChunk(mux.get(), "EXIF", &block, 0) != WEBP_MUX_OK ||
      WebPMuxAssemble(mux.get(), &whole) != WEBP_MUX_OK)
    fail("libwebp does not take its metadata");
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(whole.bytes), static_cast<std::streamsize>(whole.size));
  WebPDataClear(&whole);
  if (!file.flush()) fail("not all of it was taken by the disk");
}

void addWebpMetadata(const std::string& path, OIIO::ImageSpec& spec) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});
  const WebPData packed{reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
  const Mux mux(WebPMuxCreate(&packed, 0));
  WebPData block{};
  if (!mux || WebPMuxGetChunk(mux.get(), "EXIF", &block) != WEBP_MUX_OK) return;
  OIIO::decode_exif({reinterpret_cast<const char*>(block.bytes), block.size}, spec);
}

}  // namespace kagefude::oiio
