#include "exr/fast_read.h"

#include <OpenEXR/openexr.h>
#include <fmt/format.h>

#include <cstdint>

#include "base/error.h"
#include "exr/fast_chunks.h"
#include "exr/header_claims.h"

namespace kagefude {
namespace {

/// Deflate's best case: two bits for 258 bytes.
constexpr int64_t mostBytesPerPackedByte = 1032;

/// OpenEXRCore prints to stderr unless it is given somewhere else to complain.
void ignoreMessage(exr_const_context_t, exr_result_t, const char*) {}

std::optional<ExrCompression> fastCompression(exr_compression_t compression) {
  switch (compression) {
    case EXR_COMPRESSION_NONE:
      return ExrCompression::none;
    case EXR_COMPRESSION_RLE:
      return ExrCompression::rle;
    case EXR_COMPRESSION_ZIPS:
      return ExrCompression::zips;
    case EXR_COMPRESSION_ZIP:
      return ExrCompression::zip;
    default:
      return std::nullopt;
  }
}

std::optional<ExrType> fastType(exr_pixel_type_t type) {
  switch (type) {
    case EXR_PIXEL_UINT:
      return ExrType::uint32;
    case EXR_PIXEL_HALF:
      return ExrType::half;
    case EXR_PIXEL_FLOAT:
      return ExrType::float32;
    default:
      return std::nullopt;
  }
}

/// The box as a window; nothing if it is empty or its size overflows an int.
std::optional<Window> usableWindow(const exr_attr_box2i_t& box) {
  const int64_t width = static_cast<int64_t>(box.max.x) - box.min.x + 1;
  const int64_t height = static_cast<int64_t>(box.max.y) - box.min.y + 1;
  if (width < 1 || height < 1 || width > INT32_MAX || height > INT32_MAX) return std::nullopt;
  return Window{box.min.x, box.min.y, static_cast<int>(width), static_cast<int>(height)};
}

bool readChannels(exr_const_context_t context, int index, ExrPart& part) {
  const exr_attr_chlist_t* list = nullptr;
  if (exr_get_channels(context, index, &list) != EXR_ERR_SUCCESS || list == nullptr) return false;
  for (int c = 0; c < list->num_channels; ++c) {
    const exr_attr_chlist_entry_t& entry = list->entries[c];
    const std::optional<ExrType> type = fastType(entry.pixel_type);
    if (!type || entry.x_sampling != 1 || entry.y_sampling != 1) return false;
    part.channels.push_back({entry.name.str, *type});
  }
  return !part.channels.empty();
}

/// Fills `part` as far as the fast path can read it; false if it cannot.
bool readHeader(exr_const_context_t context, int index, ExrPart& part) {
  exr_storage_t storage;
  exr_compression_t compression;
  exr_lineorder_t order;
  exr_attr_box2i_t data, display;
  if (exr_get_storage(context, index, &storage) != EXR_ERR_SUCCESS ||
      storage != EXR_STORAGE_SCANLINE ||
      exr_get_compression(context, index, &compression) != EXR_ERR_SUCCESS ||
      exr_get_lineorder(context, index, &order) != EXR_ERR_SUCCESS ||
      order != EXR_LINEORDER_INCREASING_Y ||
      exr_get_data_window(context, index, &data) != EXR_ERR_SUCCESS ||
      exr_get_display_window(context, index, &display) != EXR_ERR_SUCCESS) {
    return false;
  }
  const auto codec = fastCompression(compression);
  const auto dataWindow = usableWindow(data);
  const auto displayWindow = usableWindow(display);
  if (!codec || !dataWindow || !displayWindow) return false;
  part.compression = *codec;
  part.data = *dataWindow;
  part.display = *displayWindow;
  // Multi-part files state their number of chunks, and OpenEXRCore believes them.
  const int64_t rows = exrRowsPerChunk(part.compression);
  int32_t chunks = 0;
  if (exr_get_chunk_count(context, index, &chunks) != EXR_ERR_SUCCESS ||
      chunks != (part.data.height + rows - 1) / rows) {
    return false;
  }
  return readChannels(context, index, part);
}

ExrPart readPart(exr_const_context_t context, int index) {
  ExrPart part;
  const char* name = nullptr;
  if (exr_get_name(context, index, &name) == EXR_ERR_SUCCESS && name != nullptr) part.name = name;
  ExrPart readable;
  readable.name = part.name;
  if (!readHeader(context, index, readable)) return part;
  readable.readable = true;
  return readable;
}

/// A header can promise a terabyte in a hundred bytes; no codec can keep that promise.
void checkSize(const std::string& path, int64_t fileBytes, const ExrPart& part) {
  int64_t pixelBytes = 0;
  for (const ExrChannel& channel : part.channels) pixelBytes += exrTypeBytes(channel.type);
  const int64_t most =
      part.compression == ExrCompression::none ? fileBytes : fileBytes * mostBytesPerPackedByte;
  if (part.data.pixels() > most / pixelBytes) {
    throw InputError(fmt::format(
        "{}: the header claims {} x {} pixels of {} channels, more than {} bytes can hold", path,
        part.data.width, part.data.height, part.channels.size(), fileBytes));
  }
}

}  // namespace

int ExrPart::channelIndex(const std::string& wanted) const {
  for (size_t c = 0; c < channels.size(); ++c) {
    if (channels[c].name == wanted) return static_cast<int>(c);
  }
  return -1;
}

void FastExr::Close::operator()(_priv_exr_context_t* context) const { exr_finish(&context); }

std::optional<FastExr> FastExr::open(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  const auto fileBytes = static_cast<int64_t>(std::filesystem::file_size(path, error));
  if (error) return std::nullopt;
  checkHeaderClaims(path, static_cast<uint64_t>(fileBytes));

  exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
  settings.error_handler_fn = ignoreMessage;
  settings.flags = EXR_CONTEXT_FLAG_STRICT_HEADER | EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE |
                   EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
  exr_context_t context = nullptr;
  if (exr_start_read(&context, path.c_str(), &settings) != EXR_ERR_SUCCESS) {
    if (context != nullptr) exr_finish(&context);
    return std::nullopt;
  }
  FastExr file;
  file.path_ = path.string();
  file.context_.reset(context);
  int count = 0;
  if (exr_get_count(context, &count) != EXR_ERR_SUCCESS) return std::nullopt;
  bool anyReadable = false;
  for (int index = 0; index < count; ++index) {
    file.parts_.push_back(readPart(context, index));
    if (!file.parts_.back().readable) continue;
    anyReadable = true;
    checkSize(file.path_, fileBytes, file.parts_.back());
  }
  if (!anyReadable) return std::nullopt;
  return file;
}

void FastExr::read(int part, std::span<const ExrTarget> targets) const {
  readExrChunks({path_, context_.get(), part, parts_.at(static_cast<size_t>(part))}, targets);
}

std::vector<Floats> FastExr::readFloats(int part, std::span<const int> channels) const {
  const Window& window = parts_.at(static_cast<size_t>(part)).data;
  std::vector<Floats> planes;
  std::vector<ExrTarget> targets;
  for (const int channel : channels) {
    planes.emplace_back(window.width, window.height);
    targets.push_back({channel, planes.back().view()});
  }
  read(part, targets);
  return planes;
}

}  // namespace kagefude
