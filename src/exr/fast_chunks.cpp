#include "exr/fast_chunks.h"

#include <OpenEXR/openexr.h>
#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <climits>
#include <cstring>
#include <mutex>

#include "base/error.h"
#include "exr/fast_deflate.h"
#include "exr/fast_kernels.h"

namespace kagefude {
namespace {

/// A run of bytes in each row of a chunk: one channel, and who wants it.
struct ChannelRun {
  ExrType type;
  size_t bytes;
  std::vector<const ExrTarget*> targets;
};

/// What a thread keeps from chunk to chunk.
struct Scratch {
  Inflater inflater;
  std::vector<uint8_t> packed;
  std::vector<uint8_t> unpacked;
  std::vector<uint8_t> row;
};

/// The topmost failure of all threads. Chunks below it need not be read; those above it must be,
/// so that the message does not depend on the schedule.
class FirstFailure {
 public:
  bool above(int chunk) const { return chunk_.load(std::memory_order_relaxed) < chunk; }
  void record(int chunk, std::string message) {
    const std::lock_guard lock(mutex_);
    if (chunk >= chunk_.load(std::memory_order_relaxed)) return;
    chunk_.store(chunk, std::memory_order_relaxed);
    message_ = std::move(message);
  }
  void rethrow() const {
    if (chunk_.load() != INT_MAX) throw InputError(message_);
  }

 private:
  std::atomic<int> chunk_ = INT_MAX;
  std::mutex mutex_;
  std::string message_;
};

/// The row of a plane that holds samples just as the file does, or null if they are converted.
uint8_t* rawRow(const ExrTarget& target, ExrType type, int y) {
  if (target.sparse) return nullptr;
  return std::visit(
      [&](const auto& view) {
        using Pixel = std::remove_reference_t<decltype(*view.data)>;
        const bool converted = std::is_same_v<Pixel, uint8_t> ||
                               (std::is_same_v<Pixel, float> && type != ExrType::float32);
        return converted ? nullptr : reinterpret_cast<uint8_t*>(view.row(y));
      },
      target.pixels);
}

void uintsToFloats(const uint8_t* in, size_t n, float* out) {
  for (size_t x = 0; x < n; ++x) {
    uint32_t value;
    std::memcpy(&value, in + x * sizeof value, sizeof value);
    out[x] = static_cast<float>(value);
  }
}

void toFloats(const ExrKernels& kernels, ExrType type, const uint8_t* row, size_t n, float* out) {
  if (type == ExrType::half)
    kernels.halfToFloat(reinterpret_cast<const uint16_t*>(row), n, out);
  else
    uintsToFloats(row, n, out);
}

/// A block at a time, so that floats that are no one's wish stay in the cache. Gives how many are
/// NaN or Inf.
size_t toMask(const ExrKernels& kernels, ExrType type, const uint8_t* row, size_t n, uint8_t* out) {
  if (type == ExrType::float32) return kernels.floatToMask(row, n, out);
  constexpr size_t block = 1024;
  float values[block];
  const auto bytes = static_cast<size_t>(exrTypeBytes(type));
  size_t unknown = 0;
  for (size_t x = 0; x < n; x += block) {
    const size_t count = std::min(block, n - x);
    toFloats(kernels, type, row + x * bytes, count, values);
    unknown += kernels.floatToMask(reinterpret_cast<const uint8_t*>(values), count, out + x);
  }
  return unknown;
}

/// Chunks are read side by side; those that have anything to add are damaged, hence rare.
void addUnknown(const ExrTarget& target, size_t unknown) {
  if (unknown > 0 && target.unknown) std::atomic_ref(*target.unknown) += unknown;
}

void toSparse(const ExrKernels& kernels, const ExrTarget& target, const ChannelRun& run,
              const uint8_t* row, int y) {
  if (run.type == ExrType::float32 || std::holds_alternative<View<uint32_t>>(target.pixels))
    return target.sparse->setRow(y, row);
  std::vector<float> values(run.bytes / static_cast<size_t>(exrTypeBytes(run.type)));
  toFloats(kernels, run.type, row, values.size(), values.data());
  target.sparse->setRow(y, values.data());
}

/// Stores one row of a channel, as it is in the file, in all planes that want it but have not
/// received it in place.
void storeRow(const ExrKernels& kernels, const ChannelRun& run, const uint8_t* row, int y) {
  for (const ExrTarget* target : run.targets) {
    if (uint8_t* raw = rawRow(*target, run.type, y)) {
      if (raw != row) std::memcpy(raw, row, run.bytes);
      continue;
    }
    const size_t n = run.bytes / static_cast<size_t>(exrTypeBytes(run.type));
    if (target->sparse)
      toSparse(kernels, *target, run, row, y);
    else if (const auto* mask = std::get_if<View<uint8_t>>(&target->pixels))
      addUnknown(*target, toMask(kernels, run.type, row, n, mask->row(y)));
    else
      toFloats(kernels, run.type, row, n, std::get<View<float>>(target->pixels).row(y));
  }
}

class ChunkReader {
 public:
  ChunkReader(const ExrSource& source, std::span<const ExrTarget> targets)
      : source_(source), kernels_(fastestExrKernels()) {
    for (const ExrChannel& channel : source.part.channels) {
      const size_t width = static_cast<size_t>(source.part.data.width);
      runs_.push_back({channel.type, width * static_cast<size_t>(exrTypeBytes(channel.type)), {}});
      rowBytes_ += runs_.back().bytes;
    }
    for (const ExrTarget& target : targets) addTarget(target);
  }

  int rowsPerChunk() const { return exrRowsPerChunk(source_.part.compression); }
  int chunks() const {
    const int64_t rows = source_.part.data.height;
    return static_cast<int>((rows + rowsPerChunk() - 1) / rowsPerChunk());
  }

  void read(int chunk, Scratch& scratch) const {
    const int firstRow = chunk * rowsPerChunk();
    const int rows = std::min(rowsPerChunk(), source_.part.data.height - firstRow);
    const size_t size = rowBytes_ * static_cast<size_t>(rows);
    const size_t packedSize = readPacked(firstRow, rows, size, scratch);
    if (packedSize == size) {  // also what a codec stores if it cannot shrink a chunk
      spreadRaw(scratch.packed.data(), firstRow, rows);
      return;
    }
    unpack(firstRow, packedSize, size, scratch);
    spreadPredicted(firstRow, rows, scratch);
  }

 private:
  int scanlineOfRow(int row) const { return source_.part.data.y + row; }

  [[noreturn]] void fail(int firstRow, std::string_view what) const {
    throw InputError(
        fmt::format("{}: the chunk of scanline {}{} {}", source_.path, scanlineOfRow(firstRow),
                    source_.index > 0 ? fmt::format(" of part {}", source_.index) : "", what));
  }

  void addTarget(const ExrTarget& target) {
    const Window& window = source_.part.data;
    const int count = static_cast<int>(runs_.size());
    if (target.channel < 0 || target.channel >= count) {
      throw InputError(fmt::format("{}: channel {} was asked for, but the part has {}",
                                   source_.path, target.channel, count));
    }
    ChannelRun& run = runs_[static_cast<size_t>(target.channel)];
    const bool halfView = std::holds_alternative<View<uint16_t>>(target.pixels);
    const bool uintView = std::holds_alternative<View<uint32_t>>(target.pixels);
    const bool sizeFits = std::visit(
        [&](const auto& v) { return v.width == window.width && v.height == window.height; },
        target.pixels);
    const bool isHalf = run.type == ExrType::half;
    if (!sizeFits || (halfView && !isHalf) || (uintView && isHalf)) {
      throw InputError(
          fmt::format("{}: the plane for channel {} cannot hold it", source_.path,
                      source_.part.channels[static_cast<size_t>(target.channel)].name));
    }
    run.targets.push_back(&target);
  }

  /// Reads the packed bytes of a chunk into the scratch; their number, between 1 and `size`.
  size_t readPacked(int firstRow, int rows, size_t size, Scratch& scratch) const {
    exr_chunk_info_t info = {};
    if (exr_read_scanline_chunk_info(source_.context, source_.index, scanlineOfRow(firstRow),
                                     &info) != EXR_ERR_SUCCESS) {
      fail(firstRow, "is missing or damaged");
    }
    if (info.start_y != scanlineOfRow(firstRow) || info.height != rows ||
        info.unpacked_size != size) {
      fail(firstRow, "is not where the header says");
    }
    const bool mustBeWhole = source_.part.compression == ExrCompression::none;
    if (info.packed_size == 0 || info.packed_size > size ||
        (mustBeWhole && info.packed_size != size)) {
      fail(firstRow,
           fmt::format("holds {} packed bytes for {} bytes of pixels", info.packed_size, size));
    }
    scratch.packed.resize(std::max<size_t>(scratch.packed.size(), info.packed_size));
    if (exr_read_chunk(source_.context, source_.index, &info, scratch.packed.data()) !=
        EXR_ERR_SUCCESS) {
      fail(firstRow, "cannot be read; the file may be cut off");
    }
    return info.packed_size;
  }

  void unpack(int firstRow, size_t packedSize, size_t size, Scratch& scratch) const {
    scratch.unpacked.resize(std::max(scratch.unpacked.size(), size));
    uint8_t* const out = scratch.unpacked.data();
    const bool whole = source_.part.compression == ExrCompression::rle
                           ? unpackRunLengths(scratch.packed.data(), packedSize, out, size)
                           : scratch.inflater.inflate(scratch.packed.data(), packedSize, out, size);
    if (!whole) fail(firstRow, "is damaged: it does not unpack");
  }

  void spreadRaw(const uint8_t* bytes, int firstRow, int rows) const {
    for (int y = firstRow; y < firstRow + rows; ++y) {
      for (const ChannelRun& run : runs_) {
        storeRow(kernels_, run, bytes, y);
        bytes += run.bytes;
      }
    }
  }

  /// Undoes predictor and byte split of the scratch's unpacked chunk on the way to the planes.
  void spreadPredicted(int firstRow, int rows, Scratch& scratch) const {
    // Samples have 2 or 4 bytes, so a chunk has an even number and both halves the same length.
    const size_t half = rowBytes_ * static_cast<size_t>(rows) / 2;
    const uint8_t* low = scratch.unpacked.data();
    const uint8_t* high = low + half;
    ExrCarry carry;
    // The second half goes on where the first ends; 128s, one a byte, cancel in pairs.
    carry.high =
        static_cast<uint8_t>(carry.low + kernels_.sumBytes(low, half) + (half % 2 ? 128 : 0));
    for (int y = firstRow; y < firstRow + rows; ++y) {
      for (const ChannelRun& run : runs_) {
        const size_t n = run.bytes / 2;
        if (run.targets.empty()) {
          skip(low, high, n, carry);
        } else {
          uint8_t* row = rawRow(*run.targets.front(), run.type, y);
          if (row == nullptr) {
            scratch.row.resize(std::max(scratch.row.size(), run.bytes));
            row = scratch.row.data();
          }
          kernels_.unpack(low, high, n, carry, row);
          storeRow(kernels_, run, row, y);
        }
        low += n;
        high += n;
      }
    }
  }

  void skip(const uint8_t* low, const uint8_t* high, size_t n, ExrCarry& carry) const {
    const int odd = n % 2 ? 128 : 0;
    carry.low = static_cast<uint8_t>(carry.low + kernels_.sumBytes(low, n) + odd);
    carry.high = static_cast<uint8_t>(carry.high + kernels_.sumBytes(high, n) + odd);
  }

  const ExrSource& source_;
  const ExrKernels& kernels_;
  std::vector<ChannelRun> runs_;
  size_t rowBytes_ = 0;
};

}  // namespace

void readExrChunks(const ExrSource& source, std::span<const ExrTarget> targets) {
  if (!source.part.readable) {
    throw InputError(
        fmt::format("{}: part {} is not one that the fast path reads", source.path, source.index));
  }
  const ChunkReader reader(source, targets);
  tbb::enumerable_thread_specific<Scratch> scratch;
  FirstFailure failure;
  tbb::parallel_for(0, reader.chunks(), [&](int chunk) {
    if (failure.above(chunk)) return;
    try {
      reader.read(chunk, scratch.local());
    } catch (const InputError& error) {
      failure.record(chunk, error.what());
    }
  });
  failure.rethrow();
}

}  // namespace kagefude
