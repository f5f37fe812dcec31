// EXR in and out against OIIO: contenders take turns inside one benchmark, and the counters are
// medians and ratios of medians, because only ratios within one run mean anything.
#include <OpenImageIO/imageio.h>
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "contest.h"
#include "exr/fast_read.h"
#include "exr/fast_write.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

constexpr int width = 3840;
constexpr int height = 2160;

/// Noise in [-1, 1] that depends on its arguments alone.
float noise(int x, int y, int seed) {
  uint32_t h = static_cast<uint32_t>(x) * 0x9e3779b1u ^ static_cast<uint32_t>(y) * 0x85ebca77u ^
               static_cast<uint32_t>(seed) * 0xc2b2ae3du;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  h ^= h >> 12;
  return static_cast<float>(h & 0xffffffu) / 8388608.0f - 1.0f;
}

/// One of 21 objects: a ground and 20 discs.
int objectAt(int x, int y) {
  for (int i = 0; i < 20; ++i) {
    const int cx = 200 + (i * 733) % (width - 400);
    const int cy = 150 + (i * 419) % (height - 300);
    const int r = 90 + 13 * i;
    if ((x - cx) * (x - cx) + (y - cy) * (y - cy) < r * r) return i + 1;
  }
  return 0;
}

float floatOfBits(uint32_t bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// What a renderer puts in one channel: smooth with noise in the last bits for colour and
/// geometry, flat for ids.
float sample(int channel, int x, int y, int id) {
  const float u = static_cast<float>(x) / width, v = static_cast<float>(y) / height;
  const float bend = static_cast<float>(id);
  switch (channel) {
    case 0:
    case 1:
    case 2:
      return 0.3f + 0.2f * std::sin(5 * u + bend) + 0.1f * v + 0.01f * noise(x, y, channel);
    case 3:
      return 1;
    case 4:
      return 20 * u - 10 + 0.3f * bend * v;
    case 5:
      return 3 + v * bend;
    case 6:
      return 12 * v + std::sin(u * bend);
    case 7:
    case 8:
    case 9:
      return std::sin(bend + 3 * u * static_cast<float>(channel - 6) * (id ? 1.0f : 0.0f));
    case 10:
      return 10 + 8 * v - 0.2f * bend;
    case 11:
      return u * 4 - std::floor(u * 4);
    case 12:
      return v * 4 - std::floor(v * 4);
    case 13:
      return bend;
    case 14:
    case 16:
    case 18:
      return id == 0 && channel > 14
                 ? 0
                 : floatOfBits(0x3f000000u + static_cast<uint32_t>(id) * 0x3c6ef37u);
    default:
      return channel == 15 ? 1.0f : 0.0f;
  }
}

const char* const names[20] = {"ViewLayer.Combined.R",
                               "ViewLayer.Combined.G",
                               "ViewLayer.Combined.B",
                               "ViewLayer.Combined.A",
                               "ViewLayer.Position.X",
                               "ViewLayer.Position.Y",
                               "ViewLayer.Position.Z",
                               "ViewLayer.Normal.X",
                               "ViewLayer.Normal.Y",
                               "ViewLayer.Normal.Z",
                               "ViewLayer.Depth.Z",
                               "ViewLayer.UV.U",
                               "ViewLayer.UV.V",
                               "ViewLayer.IndexOB.X",
                               "ViewLayer.CryptoObject00.r",
                               "ViewLayer.CryptoObject00.g",
                               "ViewLayer.CryptoObject00.b",
                               "ViewLayer.CryptoObject00.a",
                               "ViewLayer.CryptoObject01.r",
                               "ViewLayer.CryptoObject01.g"};

std::vector<Floats> makeFrame(int channels) {
  std::vector<Floats> planes;
  for (int c = 0; c < channels; ++c) planes.emplace_back(width, height);
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      for (int x = 0; x < width; ++x) {
        const int id = objectAt(x, y);
        for (int c = 0; c < channels; ++c)
          planes[static_cast<size_t>(c)](x, y) = sample(c, x, y, id);
      }
    }
  });
  return planes;
}

std::string benchFile(const char* name) {
  return (std::filesystem::temp_directory_path() / name).string();
}

ExrImage imageOf(const std::vector<Floats>& planes, ExrEffort effort) {
  ExrImage image;
  image.data = image.display = {0, 0, width, height};
  image.effort = effort;
  for (size_t c = 0; c < planes.size(); ++c) {
    image.channels.push_back({names[c], ExrType::float32, planes[c].view()});
  }
  return image;
}

OIIO::ImageSpec specOf(int channels) {
  OIIO::ImageSpec spec(width, height, channels, OIIO::TypeFloat);
  spec.channelnames.assign(names, names + channels);
  spec["compression"] = "zip";
  return spec;
}

std::unique_ptr<float[]> interleaved(const std::vector<Floats>& planes) {
  const size_t channels = planes.size();
  std::unique_ptr<float[]> pixels(new float[static_cast<size_t>(width) * height * channels]);
  for (size_t c = 0; c < channels; ++c) {
    const float* plane = planes[c].row(0);
    for (size_t i = 0; i < static_cast<size_t>(width) * height; ++i) {
      pixels[i * channels + c] = plane[i];
    }
  }
  return pixels;
}

void oiioRead(const std::string& path, bool core) {
  OIIO::attribute("openexr:core", core ? 1 : 0);
  const auto input = OIIO::ImageInput::open(path);
  const int channels = input->spec().nchannels;
  std::unique_ptr<float[]> pixels(
      new float[static_cast<size_t>(width) * height * static_cast<size_t>(channels)]);
  input->read_image(0, 0, 0, channels, OIIO::TypeFloat, pixels.get());
  benchmark::DoNotOptimize(pixels.get());
}

void fastRead(const std::string& path, int channels) {
  const auto file = FastExr::open(path);
  std::vector<int> wanted;
  for (int c = 0; c < channels; ++c) wanted.push_back(c);
  const auto planes = file->readFloats(0, wanted);
  benchmark::DoNotOptimize(planes.data());
}

void exrRead4K20(benchmark::State& state) {
  const std::string path = benchFile("kagefude_bench_read.exr");
  {
    const auto pixels = interleaved(makeFrame(20));
    const auto output = OIIO::ImageOutput::create(path);
    output->open(path, specOf(20));
    output->write_image(OIIO::TypeFloat, pixels.get());
  }
  for (auto _ : state) {
    const auto t = bench::contest({[&] { fastRead(path, 20); }, [&] { oiioRead(path, false); },
                                   [&] { oiioRead(path, true); }, [&] { fastRead(path, 4); }});
    state.counters["ours_ms"] = 1e3 * t[0];
    state.counters["ours_4ch_ms"] = 1e3 * t[3];
    state.counters["oiio_ms"] = 1e3 * t[1];
    state.counters["oiio_core_ms"] = 1e3 * t[2];
    state.counters["ratio_oiio"] = t[1] / t[0];
    state.counters["ratio_core"] = t[2] / t[0];
    const bool passed = t[1] / t[0] >= 3.5 && t[2] / t[0] >= 2;
    state.SetLabel(passed ? "gates 3.5 and 2: passed" : "gates 3.5 and 2: MISSED");
  }
  std::filesystem::remove(path);
}

/// Writes `channels` channels; the argument of the contest is each effort.
void exrWrite(benchmark::State& state) {
  const auto channels = static_cast<int>(state.range(0));
  const auto planes = makeFrame(channels);
  const auto pixels = interleaved(planes);
  const std::string ours = benchFile("kagefude_bench_ours.exr");
  const std::string theirs = benchFile("kagefude_bench_oiio.exr");
  double sizes[3] = {};
  const auto write = [&](ExrEffort effort) {
    writeFastExr(ours, imageOf(planes, effort));
    sizes[static_cast<int>(effort)] = static_cast<double>(std::filesystem::file_size(ours));
  };
  for (auto _ : state) {
    const auto t =
        bench::contest({[&] { write(ExrEffort::fast); }, [&] { write(ExrEffort::balanced); },
                        [&] { write(ExrEffort::small); },
                        [&] {
                          const auto output = OIIO::ImageOutput::create(theirs);
                          output->open(theirs, specOf(channels));
                          output->write_image(OIIO::TypeFloat, pixels.get());
                        }});
    const auto oiioSize = static_cast<double>(std::filesystem::file_size(theirs));
    const char* const labels[3] = {"fast", "balanced", "small"};
    for (int i = 0; i < 3; ++i) {
      state.counters[std::string(labels[i]) + "_ms"] = 1e3 * t[static_cast<size_t>(i)];
      state.counters[std::string(labels[i]) + "_ratio"] = t[3] / t[static_cast<size_t>(i)];
      state.counters[std::string(labels[i]) + "_size"] = sizes[i] / oiioSize;
    }
    state.counters["oiio_ms"] = 1e3 * t[3];
    const bool passed = t[3] / t[0] >= 5 && t[3] / t[2] >= 2.5;
    state.SetLabel(passed ? "gates 5 (fast) and 2.5 (small): passed"
                          : "gates 5 (fast) and 2.5 (small): MISSED");
  }
  std::filesystem::remove(ours);
  std::filesystem::remove(theirs);
}

BENCHMARK(exrRead4K20)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(exrWrite)->Arg(4)->Arg(20)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kagefude
