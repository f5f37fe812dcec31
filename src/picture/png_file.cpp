#include "picture/png_file.h"

#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>

#include "base/error.h"
#include "base/plain_file.h"
#include "base/printable.h"
#include "exr/image_file.h"

namespace kagefude {
namespace {

void keepMessage(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

void ignoreWarning(png_structp, png_const_charp) {}

/// Runs calls to libpng; false when one of them failed. libpng leaves a failed call by a jump to
/// here, so `step` must make nothing that has a destructor.
template <class Step>
bool succeeds(png_structp png, const Step& step) {
  if (setjmp(png_jmpbuf(png))) return false;
  step();
  return true;
}

/// Walks over a PNG's chunks before libpng does, which allocates what a chunk claims (up to 2 GiB)
/// before it finds that the file ends. InputError for a claim beyond the end. Returns whether the
/// last chunk, IEND, is there: whether the file is whole.
bool checkChunks(const std::filesystem::path& path) {
  const uint64_t bytes = requirePlainFile(path);
  std::ifstream file(path, std::ios::binary);
  constexpr uint64_t signature = 8, frame = 12;  // length, type and checksum of a chunk
  for (uint64_t at = signature; at + 8 <= bytes;) {
    unsigned char head[8] = {};
    file.seekg(static_cast<std::streamoff>(at));
    if (!file.read(reinterpret_cast<char*>(head), 8)) return false;
    const uint64_t size = uint64_t{head[0]} << 24 | head[1] << 16 | head[2] << 8 | head[3];
    const std::string type(reinterpret_cast<const char*>(head) + 4, 4);
    if (at + frame + size > bytes)
      throw InputError(
          fmt::format("{} cannot be read: its chunk {} claims {} bytes, and the file has {}",
                      path.string(), printable(type), size, bytes));
    if (type == "IEND") return true;
    at += frame + size;
  }
  return false;
}

struct CloseFile {
  void operator()(FILE* file) const { std::fclose(file); }
};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path)
      : path_(path), whole_(checkChunks(path)), file_(std::fopen(path.c_str(), "rbe")) {
    if (!file_) refuse(fmt::format("cannot be read: {}", std::strerror(errno)));
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &message_, keepMessage, ignoreWarning);
    info_ = png_ ? png_create_info_struct(png_) : nullptr;
    if (!info_) throw std::bad_alloc();
    constexpr png_alloc_size_t mostUnpacked = 8 << 20;  // of one text or profile
    png_set_chunk_malloc_max(png_, mostUnpacked);
  }
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  void readHeader() {
    require([&] {
      png_init_io(png_, file_.get());
      png_read_info(png_, info_);
    });
  }

  std::optional<std::string> text(const std::string& key) const {
    png_textp texts = nullptr;
    const int count = png_get_text(png_, info_, &texts, nullptr);
    for (int i = 0; i < count; ++i)
      if (key == texts[i].key) return std::string(texts[i].text);
    return std::nullopt;
  }

  bool isWhole() const { return whole_; }

  PngPicture picture(int64_t mostPixels) {
    const int64_t pixels =
        int64_t{png_get_image_width(png_, info_)} * png_get_image_height(png_, info_);
    if (pixels > mostPixels)
      refuse(fmt::format("is {} x {} pixels; at most {} are allowed",
                         png_get_image_width(png_, info_), png_get_image_height(png_, info_),
                         mostPixels));
    PngPicture result;
    require([&] {
      png_set_expand(png_);
      png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
      result.width = static_cast<int>(png_get_image_width(png_, info_));
      result.height = static_cast<int>(png_get_image_height(png_, info_));
      result.channels = png_get_channels(png_, info_);
      result.bits = png_get_bit_depth(png_, info_);
    });
    checkClaim(path_, result.width, result.height, result.channels * result.bits / 8,
               std::filesystem::file_size(path_));
    const size_t rowBytes = png_get_rowbytes(png_, info_);
    std::vector<unsigned char> bytes(rowBytes * static_cast<size_t>(result.height));
    std::vector<png_bytep> rows;
    for (int y = 0; y < result.height; ++y)
      rows.push_back(bytes.data() + rowBytes * static_cast<size_t>(y));
    require([&] {
      png_read_image(png_, rows.data());
      png_read_end(png_, nullptr);
    });
    result.samples.resize(bytes.size() / (result.bits == 16 ? 2 : 1));
    for (size_t i = 0; i < result.samples.size(); ++i)
      result.samples[i] = result.bits == 16
                              ? static_cast<uint16_t>(bytes[2 * i] << 8 | bytes[2 * i + 1])
                              : bytes[i];
    return result;
  }

 private:
  template <class Step>
  void require(const Step& step) {
    if (!succeeds(png_, step)) refuse("cannot be read: " + message_);
  }
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("{} {}", path_.string(), why));
  }

  std::filesystem::path path_;
  bool whole_;
  std::unique_ptr<FILE, CloseFile> file_;
  std::string message_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

struct Encoded {
  std::vector<unsigned char> bytes;
  std::string message;
};

void append(png_structp png, png_bytep bytes, size_t count) {
  auto* const encoded = static_cast<Encoded*>(png_get_io_ptr(png));
  try {
    encoded->bytes.insert(encoded->bytes.end(), bytes, bytes + count);
    return;
  } catch (const std::bad_alloc&) {
  }
  png_error(png, "out of memory");
}

void nothingToFlush(png_structp) {}

void writeHeader(png_structp png, png_infop info, const PngPicture& picture,
                 const std::vector<png_text>& texts) {
  constexpr int types[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                           PNG_COLOR_TYPE_RGB_ALPHA};
  png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width),
               static_cast<png_uint_32>(picture.height), picture.bits, types[picture.channels - 1],
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
  png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
  png_write_info(png, info);
}

void packRow(const PngPicture& picture, int y, std::vector<unsigned char>& row) {
  const size_t count = static_cast<size_t>(picture.width) * static_cast<size_t>(picture.channels);
  const uint16_t* const in = picture.samples.data() + count * static_cast<size_t>(y);
  for (size_t i = 0; i < count; ++i) {
    if (picture.bits == 16) {
      row[2 * i] = static_cast<unsigned char>(in[i] >> 8);
      row[2 * i + 1] = static_cast<unsigned char>(in[i] & 255);
    } else {
      row[i] = static_cast<unsigned char>(in[i]);
    }
  }
}

}  // namespace

PngPicture readPng(const std::filesystem::path& path, int64_t mostPixels) {
  Reader reader(path);
  reader.readHeader();
  return reader.picture(mostPixels);
}

std::optional<std::string> readPngText(const std::filesystem::path& path, const std::string& key) {
  try {
    Reader reader(path);
    if (!reader.isWhole()) return std::nullopt;
    reader.readHeader();
    return reader.text(key);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::vector<unsigned char> encodePng(const PngPicture& picture,
                                     const std::map<std::string, std::string>& texts) {
  Encoded encoded;
  std::vector<png_text> list;
  for (const auto& [key, value] : texts) {
    png_text& text = list.emplace_back();
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = const_cast<char*>(key.c_str());  // libpng only reads it
    text.text = const_cast<char*>(value.c_str());
    text.text_length = value.size();
  }
  std::vector<unsigned char> row(static_cast<size_t>(picture.width) *
                                 static_cast<size_t>(picture.channels) *
                                 static_cast<size_t>(picture.bits / 8));
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &encoded.message, keepMessage, ignoreWarning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info) {
    png_destroy_write_struct(&png, nullptr);
    throw std::bad_alloc();
  }
  const bool good = succeeds(png, [&] {
    png_set_write_fn(png, &encoded, append, nothingToFlush);
    writeHeader(png, info, picture, list);
    for (int y = 0; y < picture.height; ++y) {
      packRow(picture, y, row);
      png_write_row(png, row.data());
    }
    png_write_end(png, info);
  });
  png_destroy_write_struct(&png, &info);
  if (!good) throw OutputError("the PNG encoder says: " + encoded.message);
  return std::move(encoded.bytes);
}

}  // namespace kagefude
