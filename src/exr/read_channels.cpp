#include "exr/read_channels.h"

#include <Imath/ImathBox.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.h"
#include "base/nearest_name.h"
#include "exr/convert_planes.h"
#include "exr/fast_read.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

// Bands start at multiples of this, so that no chunk of any codec (DWAB: 256 rows) and no common
// tile is decoded twice.
constexpr int bandRows = 256;

const Channel& requireChannel(const ImageFile& file, const std::string& name) {
  if (const Channel* channel = file.findChannel(name)) return *channel;
  const auto names = file.channelNames();
  throw InputError(
      fmt::format("{} has no channel {}{}", file.path.string(), name, didYouMean(name, names)));
}

const Channel& requireIdChannel(const ImageFile& file, const std::string& name) {
  const Channel& channel = requireChannel(file, name);
  if (channel.type == PixelType::half)
    throw InputError(
        fmt::format("{} stores the id channel {} as half float, which destroys ids; render or "
                    "convert it again with 32-bit float",
                    file.path.string(), channel.name));
  return channel;
}

Imf::PixelType fileType(PixelType type) {
  if (type == PixelType::half) return Imf::HALF;
  return type == PixelType::uint ? Imf::UINT : Imf::FLOAT;
}

Imf::FrameBuffer frameBufferOf(const ImageFile& file, int part,
                               std::span<const PlaneTarget> targets) {
  Imf::FrameBuffer buffer;
  for (const PlaneTarget& target : targets) {
    if (target.channel->part != part) continue;
    const Window& window = partWindow(file, *target.channel);
    const size_t bytes = bytesOf(target);
    buffer.insert(target.channel->nameInPart,
                  Imf::Slice::Make(fileType(target.type), target.pixels,
                                   Imath::V2i(window.x, window.y), window.width, window.height,
                                   bytes, bytes * static_cast<size_t>(window.width)));
  }
  return buffer;
}

// Rows [first, end), counted from the data window's top.
void readRows(const Part& part, const Imf::FrameBuffer& buffer, int first, int end) {
  Imf::MultiPartInputFile input(part.file.c_str(), 0, false);
  Imf::InputPart inputPart(input, part.place);
  const Imath::Box2i window = inputPart.header().dataWindow();
  const Window& expected = part.dataWindow;
  if (window.min.x != expected.x || window.min.y != expected.y ||
      int64_t{window.max.x} - window.min.x + 1 != expected.width ||
      int64_t{window.max.y} - window.min.y + 1 != expected.height) {
    throw InputError(part.file.string() + " changed while it was read");
  }
  inputPart.setFrameBuffer(buffer);
  inputPart.readPixels(window.min.y + first, window.min.y + end - 1);
}

// Each band has its own stream, so that bands decode side by side on the process's thread pool and
// OpenEXR's own pool of threads is never started.
void readPart(const Part& part, const Imf::FrameBuffer& buffer) {
  const int height = part.dataWindow.height;
  const int threads = tbb::this_task_arena::max_concurrency();
  const int chunks = (height + bandRows - 1) / bandRows;
  const int grain = (chunks + threads - 1) / threads * bandRows;
  parallelRows(height, grain, [&](int first, int end) { readRows(part, buffer, first, end); });
}

ExrTarget fastTarget(const ExrPart& part, const Window& window, const PlaneTarget& target) {
  const int channel = part.channelIndex(target.channel->nameInPart);
  const int w = window.width, h = window.height;
  if (target.mask)
    return {channel, View<uint8_t>(static_cast<uint8_t*>(target.pixels), w, h), target.unknown};
  if (target.type == PixelType::half) {
    return {channel, View<uint16_t>(static_cast<uint16_t*>(target.pixels), w, h)};
  }
  if (target.type == PixelType::uint) {
    return {channel, View<uint32_t>(static_cast<uint32_t*>(target.pixels), w, h), nullptr,
            target.sparse};
  }
  return {channel, View<float>(static_cast<float*>(target.pixels), w, h), nullptr, target.sparse};
}

// False when the part is not of the plain kind that the fast path reads.
bool readFast(const FastExr& fast, const ImageFile& file, int number,
              std::span<const PlaneTarget> targets) {
  const Part& own = file.parts[static_cast<size_t>(number)];
  const auto place = static_cast<size_t>(own.place);
  if (place >= fast.parts().size() || !fast.parts()[place].readable) return false;
  const ExrPart& part = fast.parts()[place];
  const Window& window = own.dataWindow;
  std::vector<ExrTarget> wanted;
  for (const PlaneTarget& target : targets) {
    if (target.channel->part != number) continue;
    wanted.push_back(fastTarget(part, window, target));
    if (part.data != window || wanted.back().channel < 0) {
      throw InputError(own.file.string() + " changed while it was read");
    }
  }
  if (!wanted.empty()) fast.read(own.place, wanted);
  return true;
}

// Reads into planes of the file's data window. Parts that cover all of it go there straight.
void readJoined(const ImageFile& file, std::span<const PlaneTarget> targets) {
  std::vector<PlaneTarget> own(targets.begin(), targets.end());
  std::vector<std::pair<size_t, std::vector<std::byte>>> cropped;
  for (size_t i = 0; i < own.size(); ++i) {
    const Window& window = partWindow(file, *own[i].channel);
    if (window == file.dataWindow) continue;
    cropped.emplace_back(i, static_cast<size_t>(window.pixels()) * bytesOf(own[i]));
    own[i].pixels = cropped.back().second.data();
    own[i].sparse = nullptr;
  }
  readPlanes(file, own);
  for (const auto& entry : cropped) placePlane(file, own[entry.first], targets[entry.first]);
}

// For readers that know nothing but whole planes of samples: reads the others as such first.
template <class Read>
void readWholePlanes(const ImageFile& file, std::vector<PlaneTarget> targets, const Read& read) {
  std::vector<std::pair<PlaneTarget, Labels>> others;
  for (PlaneTarget& target : targets) {
    if (!target.mask && !target.sparse) continue;
    const Window& window = partWindow(file, *target.channel);
    others.emplace_back(target, Labels(window.width, window.height));
    target = {target.channel, target.type, others.back().second.row(0)};
  }
  read(targets);
  for (auto& [target, words] : others)
    copyPlane({target.channel, target.type, words.row(0)}, target,
              partWindow(file, *target.channel));
}

// Reads one part with whatever reads files of its kind. `fast` is that of the part's file.
void readPartPlanes(const ImageFile& file, int number, const std::optional<FastExr>& fast,
                    std::span<const PlaneTarget> targets) {
  const Part& part = file.parts[static_cast<size_t>(number)];
  if (!part.source && fast && readFast(*fast, file, number, targets)) return;
  std::vector<PlaneTarget> own;
  std::copy_if(targets.begin(), targets.end(), std::back_inserter(own),
               [&](const PlaneTarget& target) { return target.channel->part == number; });
  if (own.empty()) return;
  readWholePlanes(file, std::move(own), [&](std::span<const PlaneTarget> plain) {
    if (part.source)
      part.source->read(plain);
    else
      readPart(part, frameBufferOf(file, number, plain));
  });
}

}  // namespace

void readPlanes(const ImageFile& file, std::span<const PlaneTarget> targets) {
  if (targets.empty()) return;
  std::optional<FastExr> fast;
  for (size_t i = 0; i < file.parts.size(); ++i) {
    const Part& part = file.parts[i];
    try {
      const bool known = i > 0 && file.parts[i - 1].file == part.file;
      if (!known) fast = part.source ? std::nullopt : FastExr::open(part.file);
      readPartPlanes(file, static_cast<int>(i), fast, targets);
    } catch (const InputError&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& problem) {
      throw InputError(
          fmt::format("{} is truncated or damaged: {}", part.file.string(), problem.what()));
    }
  }
}

void ChannelReader::floats(const std::string& channelName, Floats& plane) {
  const Channel* channel = &requireChannel(file_, channelName);
  const Window& window = file_.dataWindow;
  plane = Floats(window.width, window.height);
  targets_.push_back({channel, PixelType::single, plane.row(0)});
}

void ChannelReader::bits(const std::string& channelName, Labels& plane) {
  const Channel* channel = &requireIdChannel(file_, channelName);
  plane = Labels(file_.dataWindow.width, file_.dataWindow.height);
  targets_.push_back({channel, channel->type, plane.row(0)});
}

void ChannelReader::sparseBits(const std::string& channelName, SparsePlane& plane) {
  const Channel* channel = &requireIdChannel(file_, channelName);
  plane = SparsePlane(file_.dataWindow.width, file_.dataWindow.height);
  targets_.push_back({channel, channel->type, nullptr, false, nullptr, &plane});
}

void ChannelReader::sparseFloats(const std::string& channelName, SparsePlane& plane) {
  const Channel* channel = &requireChannel(file_, channelName);
  plane = SparsePlane(file_.dataWindow.width, file_.dataWindow.height);
  targets_.push_back({channel, PixelType::single, nullptr, false, nullptr, &plane});
}

void ChannelReader::raw(const std::string& channelName, RawPlane& plane) {
  const Channel* channel = &requireChannel(file_, channelName);
  const Window& window = file_.dataWindow;
  plane.name = channel->name;
  plane.type = channel->type;
  void* pixels = nullptr;
  if (channel->type == PixelType::half) {
    plane.halves = Plane<uint16_t>(window.width, window.height);
    pixels = plane.halves.row(0);
  } else {
    plane.words = Labels(window.width, window.height);
    pixels = plane.words.row(0);
  }
  targets_.push_back({channel, channel->type, pixels});
}

void ChannelReader::mask(const std::string& channelName, Bytes& plane, size_t& unknown) {
  const Channel* channel = &requireChannel(file_, channelName);
  plane = Bytes(file_.dataWindow.width, file_.dataWindow.height);
  unknown = 0;
  targets_.push_back({channel, PixelType::single, plane.row(0), true, &unknown});
}

void ChannelReader::read() {
  // A channel that is asked for twice is decoded once and converted: from its native type, else
  // from floats, from a sparse plane, from a mask never.
  std::stable_sort(targets_.begin(), targets_.end(),
                   [](const PlaneTarget& a, const PlaneTarget& b) {
                     const auto loss = [](const PlaneTarget& t) {
                       return t.mask ? 3 : t.sparse ? 2 : t.type == t.channel->type ? 0 : 1;
                     };
                     return loss(a) < loss(b);
                   });
  std::vector<PlaneTarget> unique;
  std::vector<std::pair<PlaneTarget, PlaneTarget>> copies;
  std::map<const Channel*, PlaneTarget> first;
  for (const PlaneTarget& target : targets_) {
    const auto [known, isNew] = first.try_emplace(target.channel, target);
    if (isNew) {
      unique.push_back(target);
    } else {
      copies.emplace_back(known->second, target);
    }
  }
  readJoined(file_, unique);
  for (const auto& [from, to] : copies) {
    copyPlane(from, to, file_.dataWindow);
  }
  targets_.clear();
}

std::vector<Floats> readFloats(const ImageFile& file, std::span<const std::string> channelNames) {
  ChannelReader reader(file);
  std::vector<Floats> planes(channelNames.size());
  for (size_t i = 0; i < planes.size(); ++i) reader.floats(channelNames[i], planes[i]);
  reader.read();
  return planes;
}

std::vector<Labels> readBits(const ImageFile& file, std::span<const std::string> channelNames) {
  ChannelReader reader(file);
  std::vector<Labels> planes(channelNames.size());
  for (size_t i = 0; i < planes.size(); ++i) reader.bits(channelNames[i], planes[i]);
  reader.read();
  return planes;
}

std::vector<RawPlane> readRaw(const ImageFile& file, std::span<const std::string> channelNames) {
  ChannelReader reader(file);
  std::vector<RawPlane> planes(channelNames.size());
  for (size_t i = 0; i < planes.size(); ++i) reader.raw(channelNames[i], planes[i]);
  reader.read();
  return planes;
}

Labels roundIndices(View<const float> values) {
  Labels labels(values.width, values.height);
  parallelRows(values.height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      for (int x = 0; x < values.width; ++x) {
        const float index = std::floor(values(x, y) + 0.5f);
        labels(x, y) = index > 0.0f && index < 4294967296.0f ? static_cast<uint32_t>(index) : 0;
      }
    }
  });
  return labels;
}

Labels readIndices(const ImageFile& file, const std::string& channelName) {
  const std::vector<std::string> names = {channelName};
  if (requireChannel(file, channelName).type == PixelType::uint) {
    return std::move(readBits(file, names).front());
  }
  return roundIndices(readFloats(file, names).front());
}

}  // namespace kagefude
