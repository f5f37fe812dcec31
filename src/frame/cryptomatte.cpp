#include "frame/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "base/error.h"
#include "base/nearest_name.h"
#include "frame/aov_names.h"
#include "image/parallel.h"

namespace kagefude {
namespace {

constexpr std::string_view prefix = "cryptomatte/";

// Channels of one level (two digits), by component: id, coverage, id, coverage.
using Level = std::array<std::string, 4>;
using Levels = std::map<int, Level>;

// Every channel <stem><two digits>.<component> of the file, by stem.
std::map<std::string, Levels> levelsByStem(const ImageFile& file) {
  std::map<std::string, Levels> stems;
  for (const Channel& channel : file.channels) {
    const std::string_view name = channel.name;
    const size_t dot = name.rfind('.');
    if (dot == std::string_view::npos || dot < 3) continue;
    const int component = detail::componentOrder(name.substr(dot + 1));
    const char tens = name[dot - 2], ones = name[dot - 1];
    if (component < 0 || tens < '0' || tens > '9' || ones < '0' || ones > '9') continue;
    const std::string stem(name.substr(0, dot - 2));
    stems[stem][(tens - '0') * 10 + ones - '0'][static_cast<size_t>(component)] = channel.name;
  }
  return stems;
}

// Levels count from 00 without a gap; each brings one or two ranks.
Cryptomatte assemble(std::string key, std::string name, const Levels& levels) {
  Cryptomatte found{std::move(key), std::move(name), {}, {}};
  int expected = 0;
  for (const auto& [number, level] : levels) {
    if (number != expected++) break;
    for (size_t c = 0; c < 4; c += 2) {
      if (level[c].empty() || level[c + 1].empty()) return found;
      found.idChannels.push_back(level[c]);
      found.coverageChannels.push_back(level[c + 1]);
    }
  }
  return found;
}

bool endsWithLayer(const std::string& stem, const std::string& name) {
  return stem.size() > name.size() && stem.ends_with(name) &&
         stem[stem.size() - name.size() - 1] == '.';
}

bool looksLikeCryptomatte(const std::string& stem) {
  const size_t dot = stem.rfind('.');
  return !detail::cryptomatteStem(stem.substr(dot == std::string::npos ? 0 : dot + 1) + "00")
              .empty();
}

void checkConvention(const ImageFile& file, const Cryptomatte& found) {
  const auto check = [&](std::string_view what, std::string_view expected) {
    const auto value = file.text(fmt::format("{}{}/{}", prefix, found.key, what));
    if (value && *value != expected) {
      throw InputError(fmt::format("{} has a Cryptomatte {} whose {} is {}; only {} is understood",
                                   file.path.string(), found.name, what, *value, expected));
    }
  };
  if (found.key.empty()) return;
  check("hash", "MurmurHash3_32");
  check("conversion", "uint32_to_float32");
}

Cryptomatte chooseCryptomatte(const ImageFile& file, std::string_view name) {
  std::vector<Cryptomatte> partly;
  std::vector<std::string> known;
  for (Cryptomatte& found : listCryptomattes(file)) {
    known.push_back(found.name);
    if (found.name == name) return found;
    if (endsWithLayer(found.name, std::string(name))) partly.push_back(std::move(found));
  }
  if (partly.size() == 1) return partly.front();
  if (partly.size() > 1) {
    throw InputError(
        fmt::format("{} has a Cryptomatte {} in several layers; name it with its layer, such as {}",
                    file.path.string(), name, partly.front().name));
  }
  throw InputError(fmt::format("{} has no Cryptomatte {}{} (found: {}); turn it on in the exporter",
                               file.path.string(), name, didYouMean(name, known),
                               listNames(known)));
}

}  // namespace

std::vector<Cryptomatte> listCryptomattes(const ImageFile& file) {
  auto stems = levelsByStem(file);
  std::vector<Cryptomatte> all;
  for (const std::string& attribute : file.textNames()) {
    if (!attribute.starts_with(prefix) || !attribute.ends_with("/name")) continue;
    const std::string key = attribute.substr(
        prefix.size(), attribute.size() - prefix.size() - std::string_view("/name").size());
    const std::string name = *file.text(attribute);
    auto stem = stems.find(name);
    if (stem == stems.end()) {
      stem = std::find_if(stems.begin(), stems.end(),
                          [&](const auto& s) { return endsWithLayer(s.first, name); });
    }
    if (stem == stems.end()) continue;
    all.push_back(assemble(key, stem->first, stem->second));
    stems.erase(stem);
  }
  for (const auto& [stem, levels] : stems) {
    if (looksLikeCryptomatte(stem)) all.push_back(assemble("", stem, levels));
  }
  std::erase_if(all, [](const Cryptomatte& found) { return found.idChannels.empty(); });
  return all;
}

CryptomattePlanes requestCryptomatte(ChannelReader& reader, std::string_view name, int ranks) {
  const ImageFile& file = reader.file();
  const Cryptomatte found = chooseCryptomatte(file, name);
  checkConvention(file, found);
  const size_t all = found.idChannels.size();
  const size_t count = ranks > 0 ? std::min(all, static_cast<size_t>(ranks)) : all;
  CryptomattePlanes planes;
  planes.ids.resize(count);
  planes.coverage.resize(count);
  for (size_t i = 0; i < count; ++i) {
    reader.bits(found.idChannels[i], planes.ids[i]);
    reader.floats(found.coverageChannels[i], planes.coverage[i]);
  }
  Manifest manifest = readManifest(file, found);
  planes.names = std::move(manifest.names);
  planes.warnings = std::move(manifest.warnings);
  return planes;
}

CryptomattePlanes readCryptomatte(const ImageFile& file, std::string_view name, int ranks) {
  ChannelReader reader(file);
  CryptomattePlanes planes = requestCryptomatte(reader, name, ranks);
  reader.read();
  return planes;
}

Labels dominantIds(const CryptomattePlanes& planes) {
  if (planes.ids.empty()) return {};
  const int width = planes.ids.front().width(), height = planes.ids.front().height();
  Labels dominant(width, height);
  parallelRows(height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      for (int x = 0; x < width; ++x) {
        float most = 0.0f;
        uint32_t id = 0;
        for (size_t rank = 0; rank < planes.ids.size(); ++rank) {
          const float coverage = planes.coverage[rank](x, y);
          if (coverage > most) {
            most = coverage;
            id = planes.ids[rank](x, y);
          }
        }
        dominant(x, y) = id;
      }
    }
  });
  return dominant;
}

}  // namespace kagefude
