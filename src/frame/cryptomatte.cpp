#include "frame/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "base/error.h"
#include "base/nearest_name.h"
#include "frame/aov_names.h"
#include "frame/coverage_planes.h"
#include "frame/frame_view.h"
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

void breakOff(Cryptomatte& found, std::string_view lacks) {
  found.fault = fmt::format("Cryptomatte {} lacks the {} of rank {}", found.name, lacks,
                            found.idChannels.size() + 1);
}

// Levels count from 00 without a gap; each brings two ranks, the last one or two.
Cryptomatte assemble(std::string key, std::string name, const Levels& levels) {
  Cryptomatte found{std::move(key), std::move(name), {}, {}, 0, ""};
  int expected = 0;
  for (const auto& [number, level] : levels) {
    if (number != expected++) {
      breakOff(found, "channels");
      break;
    }
    for (size_t c = 0; c < 4; c += 2) {
      const bool noId = level[c].empty(), noCoverage = level[c + 1].empty();
      const bool atEnd = c == 2 && number == levels.rbegin()->first;
      if (noId && noCoverage && !atEnd) breakOff(found, "channels");
      if (noId != noCoverage) breakOff(found, noId ? "id channel" : "coverage channel");
      if (noId || noCoverage) return found;
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

// What one part's header says: a key of its attributes, and the name of the layer that they mean.
struct Description {
  int part = 0;
  std::string key;
  std::string name;
};

// Nuke writes the attributes of what it has read with "exr/" before them.
std::optional<std::string> keyOf(std::string_view attribute) {
  constexpr std::string_view nuke = "exr/", end = "/name";
  const size_t start = attribute.starts_with(nuke) ? nuke.size() : 0;
  const std::string_view rest = attribute.substr(start);
  if (!rest.starts_with(prefix) || !rest.ends_with(end) || rest.size() < prefix.size() + end.size())
    return std::nullopt;
  return std::string(attribute.substr(0, attribute.size() - end.size()));
}

// Those that name the frame's view, then those that name none; other views' are left out.
std::vector<Description> describedCryptomattes(const ImageFile& file) {
  std::vector<Description> own, common;
  for (const int part : file.ownParts)
    for (const std::string& attribute : file.textNames(part)) {
      const auto key = keyOf(attribute);
      if (!key) continue;
      auto [name, view] = detail::cutView(*file.textOfPart(part, attribute), file.views);
      if (!view.empty() && view != file.view) continue;
      (view.empty() ? common : own).push_back({part, *key, std::move(name)});
    }
  own.insert(own.end(), common.begin(), common.end());
  return own;
}

using Stems = std::map<std::string, Levels>;

bool liesInPart(const ImageFile& file, const Levels& levels, int part) {
  for (const auto& [number, level] : levels)
    for (const std::string& name : level)
      if (!name.empty()) return file.findChannel(name)->part == part;
  return false;
}

Stems::iterator findStem(const ImageFile& file, Stems& stems, const Description& description,
                         bool ownPart) {
  const auto fits = [&](const auto& stem, bool exact) {
    return (exact ? stem.first == description.name : endsWithLayer(stem.first, description.name)) &&
           (!ownPart || liesInPart(file, stem.second, description.part));
  };
  for (const bool exact : {true, false}) {
    const auto found =
        std::find_if(stems.begin(), stems.end(), [&](const auto& s) { return fits(s, exact); });
    if (found != stems.end()) return found;
  }
  return stems.end();
}

void checkConvention(const ImageFile& file, const Cryptomatte& found) {
  const auto check = [&](std::string_view what, std::string_view expected) {
    const auto value = file.textOfPart(found.part, fmt::format("{}/{}", found.key, what));
    if (value && *value != expected) {
      throw InputError(fmt::format("{} has a Cryptomatte {} whose {} is {}; only {} is understood",
                                   file.path.string(), found.name, what, *value, expected));
    }
  };
  if (found.key.empty()) return;
  check("hash", "MurmurHash3_32");
  check("conversion", "uint32_to_float32");
}

// All of a file, with those of which no rank is left.
std::vector<Cryptomatte> assembleAll(const ImageFile& file) {
  auto stems = levelsByStem(file);
  std::vector<Cryptomatte> all;
  const std::vector<Description> described = describedCryptomattes(file);
  // A part's header speaks for its own channels first, then for channels anywhere.
  for (const bool ownPart : {true, false})
    for (const Description& description : described) {
      const auto stem = findStem(file, stems, description, ownPart);
      if (stem == stems.end()) continue;
      all.push_back(assemble(description.key, stem->first, stem->second));
      all.back().part = description.part;
      stems.erase(stem);
    }
  for (const auto& [stem, levels] : stems) {
    if (looksLikeCryptomatte(stem)) all.push_back(assemble("", stem, levels));
  }
  return all;
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
  std::vector<Cryptomatte> all = assembleAll(file);
  std::erase_if(all, [](const Cryptomatte& found) { return found.idChannels.empty(); });
  return all;
}

std::vector<Cryptomatte> brokenCryptomattes(const ImageFile& file) {
  std::vector<Cryptomatte> all = assembleAll(file);
  std::erase_if(all, [](const Cryptomatte& found) { return found.fault.empty(); });
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

void requestCoverage(ChannelReader& reader, std::string_view name, int ranks,
                     CoveragePlanes& coverage) {
  const ImageFile& file = reader.file();
  const Cryptomatte found = chooseCryptomatte(file, name);
  checkConvention(file, found);
  const size_t count = std::min(found.idChannels.size(), static_cast<size_t>(ranks));
  reader.bits(found.idChannels[0], coverage.firstId);
  reader.floats(found.coverageChannels[0], coverage.firstShare);
  coverage.otherIds.resize(count - 1);
  coverage.otherShares.resize(count - 1);
  for (size_t i = 1; i < count; ++i) {
    reader.sparseBits(found.idChannels[i], coverage.otherIds[i - 1]);
    reader.sparseFloats(found.coverageChannels[i], coverage.otherShares[i - 1]);
  }
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
