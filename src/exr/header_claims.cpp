#include "exr/header_claims.h"

#include <OpenEXR/openexr.h>
#include <fmt/format.h>

#include <fstream>
#include <map>
#include <string>

#include "base/error.h"
#include "base/plain_file.h"

namespace kagefude {
namespace {

constexpr size_t longestName = 255;

/// Bytes of the types that have one length, as OpenEXR's file layout lists them.
const std::map<std::string, uint64_t, std::less<>> fixedSizes = {
    {"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
    {"compression", 1}, {"double", 8},   {"envmap", 1},
    {"float", 4},       {"int", 4},      {"keycode", 28},
    {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
    {"m44f", 64},       {"m44d", 128},   {"rational", 8},
    {"tiledesc", 9},    {"timecode", 8}, {"v2i", 8},
    {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
    {"v3f", 12},        {"v3d", 24},     {"deepImageState", 1}};

/// A cursor over the headers. A read beyond the end, or a name that is none, ends the walk.
class HeaderWalk {
 public:
  HeaderWalk(const std::filesystem::path& path, uint64_t fileBytes)
      : path_(path), bytes_(fileBytes), file_(path, std::ios::binary) {}

  void run() {
    constexpr uint32_t magic = 20000630, severalParts = 0x1000;
    const uint32_t first = word(), flags = word();
    if (!file_ || first != magic) return;
    const bool several = (flags & severalParts) != 0;
    for (bool more = true; more; more = several && more) {
      more = header();
      if (!disorder_.empty()) refuseDisorder(several);
      ++part_;
    }
  }

 private:
  /// One part's attributes; false at the empty header that ends a list of parts, and at trouble.
  bool header() {
    bool any = false;
    partName_.clear();
    for (std::string name = text(); file_ && !name.empty(); name = text()) {
      any = true;
      const std::string type = text();
      const uint32_t size = word();
      if (!file_) return false;
      const auto at = static_cast<uint64_t>(file_.tellg());
      if (size > bytes_ - std::min(at, bytes_))
        throw InputError(fmt::format(
            "{} cannot be read as an EXR file: its attribute {} claims {} bytes, and the "
            "file has {}",
            path_.string(), name, size, bytes_));
      if (name == "name" && type == "string") noteName(size);
      const uint64_t taken = takenBytes(type, size);
      if (name == "channels") disorder_ = listed_;
      if (taken != size)
        throw InputError(
            fmt::format("{} cannot be read as an EXR file: its attribute {} has {} "
                        "bytes, and a {} there takes {}",
                        path_.string(), name, size, type, taken));
      file_.clear();
      file_.seekg(static_cast<std::streamoff>(at + size));
    }
    return any && file_.good();
  }

  /// How many bytes OpenEXR takes for a value of `type` that stands here and is said to have
  /// `size`. It goes by the value and not by the size: where the two differ it would find claims of
  /// its own in the bytes that follow.
  uint64_t takenBytes(const std::string& type, uint32_t size) {
    const auto fixed = fixedSizes.find(type);
    if (fixed != fixedSizes.end()) return fixed->second;
    if (type == "preview") {
      const uint64_t width = word(), height = word();
      return 8 + 4 * width * height;
    }
    if (type == "chlist") return channelBytes();
    if (type == "stringvector") return textBytes(size);
    return size;
  }
  /// Pixels lie in the order of their channels' names (strcmp's), which libraries take for granted:
  /// they sort the list, and would give each channel another one's pixels.
  uint64_t channelBytes() {
    constexpr uint64_t afterName = 16;
    uint64_t bytes = 1;
    std::string before;
    listed_.clear();
    for (std::string name = text(); file_ && !name.empty(); name = text()) {
      if (name == before) listed_ = fmt::format("lists channel {} twice", name);
      if (name < before && listed_.empty())
        listed_ = fmt::format(
            "lists channel {} after {}, but an EXR has its channels, and their "
            "pixels, in the order of the names",
            name, before);
      before = name;
      bytes += name.size() + 1 + afterName;
      file_.seekg(afterName, std::ios::cur);
    }
    return bytes;
  }
  uint64_t textBytes(uint32_t size) {
    uint64_t bytes = 0;
    while (file_ && bytes < size) {
      const uint32_t length = word();
      bytes += 4 + uint64_t{length};
      file_.seekg(static_cast<std::streamoff>(length), std::ios::cur);
    }
    return bytes;
  }

  void noteName(uint32_t size) {
    const auto at = file_.tellg();
    partName_.resize(std::min<size_t>(size, longestName));
    file_.read(partName_.data(), static_cast<std::streamsize>(partName_.size()));
    file_.seekg(at);
  }
  [[noreturn]] void refuseDisorder(bool several) const {
    const std::string name = partName_.empty() ? "" : fmt::format(" ({})", partName_);
    const std::string part = several ? fmt::format("its part {}{}", part_ + 1, name) : "it";
    throw InputError(fmt::format("{} cannot be read as an EXR file: {} {}; write it again",
                                 path_.string(), part, disorder_));
  }

  uint32_t word() {
    unsigned char b[4] = {};
    file_.read(reinterpret_cast<char*>(b), 4);
    return b[0] | uint32_t{b[1]} << 8 | uint32_t{b[2]} << 16 | uint32_t{b[3]} << 24;
  }

  std::string text() {
    std::string result;
    for (int c = file_.get(); file_ && c != 0; c = file_.get()) {
      result += static_cast<char>(c);
      if (result.size() > longestName) file_.setstate(std::ios::failbit);
    }
    return result;
  }

  const std::filesystem::path& path_;
  uint64_t bytes_;
  std::ifstream file_;
  int part_ = 0;
  std::string partName_;
  std::string listed_;    ///< what is wrong with the list of channels that was walked over last
  std::string disorder_;  ///< what is wrong with the part's own list
};

void ignoreMessage(exr_const_context_t, exr_result_t, const char*) {}

struct Context {
  exr_context_t handle = nullptr;
  ~Context() {
    if (handle) exr_finish(&handle);
  }
};

bool partIsWhole(exr_const_context_t file, int part, uint64_t fileBytes) {
  exr_storage_t storage;
  exr_attr_box2i_t window;
  int32_t rows = 0;
  if (exr_get_storage(file, part, &storage) != EXR_ERR_SUCCESS) return false;
  if (storage != EXR_STORAGE_SCANLINE) return true;  // ours are scanlines
  if (exr_get_data_window(file, part, &window) != EXR_ERR_SUCCESS ||
      exr_get_scanlines_per_chunk(file, part, &rows) != EXR_ERR_SUCCESS || rows < 1)
    return false;
  for (int64_t y = window.min.y; y <= window.max.y; y += rows) {
    exr_chunk_info_t chunk;
    if (exr_read_scanline_chunk_info(file, part, static_cast<int>(y), &chunk) != EXR_ERR_SUCCESS ||
        chunk.data_offset + chunk.packed_size > fileBytes)
      return false;
  }
  return true;
}

}  // namespace

void checkHeaderClaims(const std::filesystem::path& path, uint64_t fileBytes) {
  HeaderWalk(path, fileBytes).run();
}

bool isWholeExr(const std::filesystem::path& path) {
  const uint64_t bytes = requirePlainFile(path);
  checkHeaderClaims(path, bytes);
  exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
  settings.error_handler_fn = ignoreMessage;
  settings.flags =
      EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE | EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
  Context file;
  if (exr_start_read(&file.handle, path.c_str(), &settings) != EXR_ERR_SUCCESS)
    throw InputError(fmt::format("{} cannot be read as an EXR file", path.string()));
  int parts = 0;
  if (exr_get_count(file.handle, &parts) != EXR_ERR_SUCCESS) return false;
  for (int part = 0; part < parts; ++part)
    if (!partIsWhole(file.handle, part, bytes)) return false;
  return true;
}

}  // namespace kagefude
