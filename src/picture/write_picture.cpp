#include "picture/write_picture.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/printable.h"
#include "base/temp_file.h"
#include "image/parallel.h"
#include "picture/cut_file.h"
#include "picture/picture_worker.h"
#include "picture/shared_pixels.h"

namespace kagefude {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw OutputError(fmt::format("{} cannot be written: {}", path.string(), why));
}

float heldInRange(float value) {
  // NaN fails both comparisons and becomes 0.
  return value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
}

/// Pixel by pixel, as OpenImageIO takes them.
void interleave(std::span<const View<const float>> planes, bool hold, float* out) {
  const size_t count = planes.size();
  for (size_t c = 0; c < count; ++c)
    parallelRows(planes[c].height, [&](int first, int end) {
      for (int y = first; y < end; ++y) {
        const float* const in = planes[c].row(y);
        float* to = out + static_cast<size_t>(y) * planes[c].width * count + c;
        for (int x = 0; x < planes[c].width; ++x, to += count)
          *to = hold ? heldInRange(in[x]) : in[x];
      }
    });
}

WorkerLease workerFor(const std::filesystem::path& path) {
  try {
    return WorkerLease();
  } catch (const InputError& problem) {
    refuse(path, problem.what());
  }
}

SharedPixels sharedPixels(const std::filesystem::path& path, size_t bytes) {
  try {
    return SharedPixels(bytes);
  } catch (const std::system_error& limit) {
    refuse(path, limit.what());
  }
}

/// What the file system says to some more bytes of the file; "" when it takes them. Encoders end,
/// or write on, without saying that a disk is full.
std::string whyNoMore(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file < 0) return "";
  const std::vector<char> more(size_t{1} << 16);
  int error = 0;
  for (size_t done = 0; done < more.size() && error == 0;) {
    const ssize_t written = ::write(file, more.data() + done, more.size() - done);
    if (written > 0)
      done += static_cast<size_t>(written);
    else if (written == 0 || errno != EINTR)
      error = written < 0 ? errno : ENOSPC;
  }
  if (error == 0 && ::fsync(file) != 0) error = errno;
  ::close(file);
  return error == 0 ? "" : std::generic_category().message(error);
}

}  // namespace

void writePicture(const std::filesystem::path& path, const PictureHeader& header,
                  std::span<const View<const float>> planes, const MetadataSource* metadata) {
  if (planes.size() != header.channels.size() || planes.empty())
    refuse(path, "it has not one plane for each channel");
  for (const View<const float>& plane : planes)
    if (plane.width != header.dataWindow.width || plane.height != header.dataWindow.height)
      refuse(path, "its planes are of different sizes");
  const SampleType type = header.channels.front().type;
  const size_t bytes = planes.front().pixels() * planes.size() * sizeof(float);
  const SharedPixels shared = sharedPixels(path, bytes);
  interleave(planes, type != SampleType::half && type != SampleType::single,
             reinterpret_cast<float*>(shared.data()));
  TempFile file(path);
  WorkerLease worker = workerFor(path);
  constexpr uint64_t harmless = uint64_t{1} << 30;  // codecs of films keep several pictures
  nlohmann::json request = {{"do", "write"},
                            {"path", std::filesystem::absolute(file.path()).string()},
                            {"name", path.filename().string()},
                            {"header", toJson(header)},
                            {"bytes", bytes}};
  if (metadata)
    request["metadata"] = {std::filesystem::absolute(metadata->file).string(), metadata->part};
  const nlohmann::json answer =
      worker->ask(std::move(request), {harmless + 6 * bytes, 600}, shared.descriptor());
  if (answer.contains("error")) {
    if (const std::string full = whyNoMore(file.path()); !full.empty()) refuse(path, full);
    std::string words = answer.at("error");
    const std::string temporary = file.path().filename().string();
    for (size_t at = 0; (at = words.find(temporary, at)) != std::string::npos;)
      words.replace(at, temporary.size(), path.filename().string());
    refuse(path, printable(words));
  }
  std::error_code unknown;
  if (isCutShort(file.path(), header, std::filesystem::file_size(file.path(), unknown)) ||
      unknown) {
    const std::string full = whyNoMore(file.path());
    refuse(path, full.empty() ? "not all of it was taken by the disk; is it full?" : full);
  }
  file.commit();
}

}  // namespace kagefude
