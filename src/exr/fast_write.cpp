#include "exr/fast_write.h"

#include <OpenEXR/openexr.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "exr/fast_header.h"
#include "exr/fast_kernels.h"

namespace kagefude {
namespace {

/// The file under construction. OpenEXRCore writes through it, so that the reason of a failure
/// (full disk) is known and closing is checked.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path)
      : path_(path), descriptor_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666)) {
    if (descriptor_ < 0) fail(errno);
  }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path_, ignored)) std::filesystem::remove(path_, ignored);
  }

  bool write(const void* bytes, uint64_t size, uint64_t offset) {
    const char* at = static_cast<const char*>(bytes);
    while (size > 0) {
      const ssize_t written = ::pwrite(descriptor_, at, size, static_cast<off_t>(offset));
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) {
        error_ = written < 0 ? errno : ENOSPC;
        return false;
      }
      at += written;
      size -= static_cast<uint64_t>(written);
      offset += static_cast<uint64_t>(written);
    }
    return true;
  }

  /// Throws with the reason of the failed write, if one failed.
  void check() const {
    if (error_ != 0) fail(error_);
  }

  /// Closes and keeps the file. Some file systems report a full disk only here.
  void keep() {
    const bool closed = ::close(descriptor_) == 0;
    const int reason = errno;
    descriptor_ = -1;
    if (closed) return;
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
    fail(reason);
  }

 private:
  [[noreturn]] void fail(int reason) const {
    throw OutputError(
        fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(reason)));
  }

  std::filesystem::path path_;
  int descriptor_;
  int error_ = 0;
};

void ignoreMessage(exr_const_context_t, exr_result_t, const char*) {}

int64_t writeBytes(exr_const_context_t, void* file, const void* bytes, uint64_t size,
                   uint64_t offset, exr_stream_error_func_ptr_t) {
  return static_cast<OutputFile*>(file)->write(bytes, size, offset) ? static_cast<int64_t>(size)
                                                                    : -1;
}

/// One chunk on its way to the file: as packed by a thread, or as it was.
struct PackedChunk {
  int firstRow = 0;
  std::vector<uint8_t> bytes;
};

/// What a thread keeps from chunk to chunk.
struct Scratch {
  explicit Scratch(ExrEffort effort) : deflater(effort) {}
  Deflater deflater;
  std::vector<uint8_t> raw, split, predicted, packed;
};

class ChunkPacker {
 public:
  explicit ChunkPacker(const ExrImage& image) : image_(image), kernels_(fastestExrKernels()) {
    for (const ExrSourceChannel& channel : image.channels) {
      channels_.push_back(&channel);
      rowBytes_ +=
          static_cast<size_t>(image.data.width) * static_cast<size_t>(exrTypeBytes(channel.type));
    }
    // The file's order, which the header's list has too: by name, byte by byte.
    std::sort(channels_.begin(), channels_.end(),
              [](const auto* a, const auto* b) { return a->name < b->name; });
  }

  PackedChunk pack(int firstRow, Scratch& scratch) const {
    const int end = std::min(firstRow + exrRowsPerChunk(image_.compression), image_.data.height);
    const size_t size = rowBytes_ * static_cast<size_t>(end - firstRow);
    scratch.raw.resize(size);
    gather(firstRow, end, scratch.raw.data());
    PackedChunk chunk{firstRow, {}};
    const size_t packedSize =
        image_.compression == ExrCompression::none ? 0 : compress(scratch, size);
    const std::vector<uint8_t>& bytes = packedSize > 0 ? scratch.packed : scratch.raw;
    chunk.bytes.assign(bytes.data(), bytes.data() + (packedSize > 0 ? packedSize : size));
    return chunk;
  }

 private:
  /// Puts the rows as EXR wants them: row by row, in each all channels one after the other.
  void gather(int firstRow, int endRow, uint8_t* out) const {
    for (int y = firstRow; y < endRow; ++y) {
      for (const ExrSourceChannel* channel : channels_) {
        const size_t bytes = static_cast<size_t>(image_.data.width) *
                             static_cast<size_t>(exrTypeBytes(channel->type));
        std::visit([&](const auto& view) { storeRow(view.row(y), *channel, bytes, out); },
                   channel->pixels);
        out += bytes;
      }
    }
  }

  template <class T>
  void storeRow(const T* row, const ExrSourceChannel& channel, size_t bytes, uint8_t* out) const {
    if constexpr (std::is_same_v<T, float>) {
      if (channel.type == ExrType::half) {
        // A row begins on an even byte of an aligned buffer: samples have 2 or 4 bytes.
        kernels_.floatToHalf(row, bytes / 2, reinterpret_cast<uint16_t*>(out));
        return;
      }
    }
    std::memcpy(out, row, bytes);
  }

  /// Bytes in scratch.packed, or 0 if the raw chunk is not longer.
  size_t compress(Scratch& scratch, size_t size) const {
    const size_t half = size / 2;
    scratch.split.resize(size);
    scratch.predicted.resize(size);
    scratch.packed.resize(size);
    kernels_.split(scratch.raw.data(), half, scratch.split.data(), scratch.split.data() + half);
    kernels_.predict(scratch.split.data(), size, scratch.predicted.data());
    return scratch.deflater.deflate(scratch.predicted.data(), size, scratch.packed.data());
  }

  const ExrImage& image_;
  const ExrKernels& kernels_;
  std::vector<const ExrSourceChannel*> channels_;
  size_t rowBytes_ = 0;
};

/// Packs in parallel, writes in order. False if a write failed.
bool writeChunks(exr_context_t context, const ExrImage& image) {
  const ChunkPacker packer(image);
  tbb::enumerable_thread_specific<Scratch> scratch([&] { return Scratch(image.effort); });
  const int step = exrRowsPerChunk(image.compression);
  const auto inFlight = static_cast<size_t>(4 * tbb::this_task_arena::max_concurrency());
  int nextRow = 0;
  bool good = true;
  tbb::parallel_pipeline(
      inFlight, tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order,
                                            [&](tbb::flow_control& flow) {
                                              const int row = nextRow;
                                              if (row >= image.data.height) flow.stop();
                                              nextRow = std::min(row + step, image.data.height);
                                              return row;
                                            }) &
                    tbb::make_filter<int, PackedChunk>(
                        tbb::filter_mode::parallel,
                        [&](int row) { return packer.pack(row, scratch.local()); }) &
                    tbb::make_filter<PackedChunk, void>(
                        tbb::filter_mode::serial_in_order, [&](const PackedChunk& chunk) {
                          good = good &&
                                 exr_write_scanline_chunk(context, 0, image.data.y + chunk.firstRow,
                                                          chunk.bytes.data(),
                                                          chunk.bytes.size()) == EXR_ERR_SUCCESS;
                        }));
  return good;
}

struct Context {
  exr_context_t context = nullptr;
  ~Context() {
    if (context != nullptr) exr_finish(&context);
  }
};

}  // namespace

void writeFastExr(const std::filesystem::path& path, const ExrImage& image) {
  checkExrImage(path.string(), image);
  OutputFile file(path);
  Context writer;
  exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
  settings.error_handler_fn = ignoreMessage;
  settings.user_data = &file;
  settings.write_fn = writeBytes;
  if (exr_start_write(&writer.context, path.c_str(), EXR_WRITE_FILE_DIRECTLY, &settings) !=
      EXR_ERR_SUCCESS) {
    throw OutputError(fmt::format("{}: cannot be started as an EXR file", path.string()));
  }
  try {
    writeExrHeader(path.string(), writer.context, image);
  } catch (const OutputError&) {
    file.check();  // a full disk says more than the library's reason
    throw;
  }
  const bool written = writeChunks(writer.context, image);
  const bool finished = exr_finish(&writer.context) == EXR_ERR_SUCCESS;
  file.check();
  if (!written || !finished) {
    throw OutputError(fmt::format("{}: cannot be written as an EXR file", path.string()));
  }
  file.keep();
}

}  // namespace kagefude
