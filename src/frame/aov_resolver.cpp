#include "frame/aov_resolver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/nearest_name.h"
#include "frame/aov_names.h"
#include "frame/cryptomatte.h"

namespace kagefude {
namespace {

using namespace detail;

struct KindRow {
  std::string_view name;
  std::string_view key;
  size_t fewest;  ///< channels
  size_t most;
  std::string AovNames::*member;
};

constexpr size_t any = 4096;
constexpr std::array<KindRow, 16> kindRows = {{
    {"Position", "position", 3, 3, &AovNames::position},
    {"Normal", "normal", 3, 3, &AovNames::normal},
    {"Depth", "depth", 1, 1, &AovNames::depth},
    {"Object Index", "object_index", 1, 1, &AovNames::objectIndex},
    {"Material Index", "material_index", 1, 1, &AovNames::materialIndex},
    {"Vector", "vector", 2, 4, &AovNames::vector},
    {"Diffuse Color", "albedo", 3, 3, &AovNames::albedo},
    {"Combined", "beauty", 3, 4, &AovNames::beauty},
    {"Shadow", "shadow", 1, 3, &AovNames::shadow},
    {"Cryptomatte Object", "crypto_object", 2, any, &AovNames::cryptoObject},
    {"Cryptomatte Material", "crypto_material", 2, any, &AovNames::cryptoMaterial},
    {"surface id", "surface", 1, 1, &AovNames::surface},
    {"Rest", "rest", 3, 4, &AovNames::rest},
    {"UV", "uv", 2, 2, &AovNames::uv},
    {"Instance Random", "instance_random", 1, 1, &AovNames::instanceRandom},
    {"Emission", "emission", 3, 3, &AovNames::emission},
}};

const KindRow& rowOf(AovKind kind) { return kindRows[static_cast<size_t>(kind)]; }

bool isCryptomatte(AovKind kind) {
  return kind == AovKind::cryptoObject || kind == AovKind::cryptoMaterial;
}

std::string joined(const std::string& layer, const std::string& pass) {
  return layer.empty() ? pass : (pass.empty() ? layer : layer + "." + pass);
}

std::string fullName(const PassChannels& pass) { return joined(pass.layer, pass.pass); }

std::vector<PassChannels> cryptomattePasses(const ImageFile& file) {
  std::vector<PassChannels> passes;
  for (const Cryptomatte& found : listCryptomattes(file)) {
    const size_t dot = found.name.rfind('.');
    const bool layered = dot != std::string::npos;
    PassChannels pass{layered ? found.name.substr(0, dot) : "",
                      layered ? found.name.substr(dot + 1) : found.name,
                      "",
                      {}};
    for (size_t rank = 0; rank < found.idChannels.size(); ++rank) {
      pass.channels.push_back(found.idChannels[rank]);
      pass.channels.push_back(found.coverageChannels[rank]);
    }
    passes.push_back(std::move(pass));
  }
  return passes;
}

std::vector<PassChannels> candidatesOf(const ImageFile& file, AovKind kind) {
  return isCryptomatte(kind) ? cryptomattePasses(file) : listPasses(file);
}

Aov finish(const ImageFile& file, AovKind kind, const PassChannels& pass) {
  const KindRow& row = rowOf(kind);
  Aov aov{pass.pass.empty() && pass.layer.empty() ? "RGBA" : fullName(pass), pass.channels};
  if (aov.channels.size() < row.fewest) {
    throw InputError(fmt::format(
        "{} has only {} of the {} channels that a {} pass needs in {} ({})", file.path.string(),
        aov.channels.size(), row.fewest, row.name, aov.name, listNames(aov.channels)));
  }
  if (aov.channels.size() > row.most) aov.channels.resize(row.most);
  return aov;
}

bool isHelperLayer(const std::string& layer) {
  return layer.starts_with("mask.") || layer.starts_with("truth.");
}

bool hasPass(const std::vector<PassChannels>& passes, const std::string& layer, AovKind kind) {
  return std::any_of(passes.begin(), passes.end(), [&](const PassChannels& p) {
    return p.layer == layer && aliasRank(kind, p.pass) >= 0;
  });
}

const PassChannels* bestIn(const std::vector<PassChannels>& passes, const std::string& layer,
                           AovKind kind) {
  const PassChannels* best = nullptr;
  for (const PassChannels& pass : passes) {
    const int rank = aliasRank(kind, pass.pass);
    if (pass.layer != layer || rank < 0) continue;
    if (!best || rank < aliasRank(kind, best->pass)) best = &pass;
  }
  return best;
}

// The bare colour of the frame's first part where the part's name says nothing to us: what every
// viewer shows as the picture.
const PassChannels* firstPicture(const ImageFile& file, const std::vector<PassChannels>& passes) {
  for (const PassChannels& pass : passes) {
    const Channel& channel = *file.findChannel(pass.channels.front());
    if (channel.part == file.ownParts.front() && plainName(channel.nameInPart) == "r" &&
        pass.channels.size() >= 3 && !isKnownPass(pass.pass))
      return &pass;
  }
  return nullptr;
}

template <class Keep>
void keepIfAny(std::vector<std::string>& layers, const Keep& keep) {
  std::vector<std::string> kept;
  std::copy_if(layers.begin(), layers.end(), std::back_inserter(kept), keep);
  if (!kept.empty()) layers = std::move(kept);
}

// The layer to look in when none is named; nothing when no layer has the pass.
std::optional<std::string> chooseLayer(const ImageFile& file, const AovNames& names, AovKind kind,
                                       const std::vector<PassChannels>& candidates) {
  std::vector<std::string> layers;
  for (const PassChannels& pass : candidates) {
    const bool known = std::find(layers.begin(), layers.end(), pass.layer) != layers.end();
    if (!known && aliasRank(kind, pass.pass) >= 0) layers.push_back(pass.layer);
  }
  if (layers.empty()) return std::nullopt;
  keepIfAny(layers, [](const std::string& layer) { return !isHelperLayer(layer); });
  if (kind == AovKind::beauty) {
    keepIfAny(layers,
              [&](const std::string& l) { return !names.layer.empty() && l == names.layer; });
    keepIfAny(layers, [](const std::string& layer) { return layer.empty(); });
    keepIfAny(layers, [](const std::string& layer) { return plainName(layer) == "beauty"; });
  }
  const auto passes = listPasses(file);
  keepIfAny(layers, [&](const std::string& layer) {
    return hasPass(passes, layer, AovKind::position) && hasPass(passes, layer, AovKind::normal);
  });
  if (layers.size() > 1) {
    throw InputError(fmt::format("{} has a {} pass in the layers {}; say which with frame.{}",
                                 file.path.string(), rowOf(kind).name, listNames(layers),
                                 kind == AovKind::beauty ? "beauty_layer" : "layer"));
  }
  return layers.front();
}

Aov findNamed(const ImageFile& file, const AovNames& names, AovKind kind,
              const std::vector<PassChannels>& candidates) {
  const std::string& wanted = names.of(kind);
  const std::string& layer =
      kind == AovKind::beauty && !names.beautyLayer.empty() ? names.beautyLayer : names.layer;
  std::vector<const PassChannels*> found;
  std::vector<std::string> known;
  for (const PassChannels& pass : candidates) {
    known.push_back(fullName(pass));
    if (known.back() == wanted) return finish(file, kind, pass);
    if (pass.pass == wanted && (layer.empty() || pass.layer == layer)) found.push_back(&pass);
  }
  if (found.size() == 1) return finish(file, kind, *found.front());
  if (found.empty() && file.findChannel(wanted)) {
    return finish(file, kind, {"", wanted, "", {wanted}});
  }
  if (found.size() > 1) {
    throw InputError(fmt::format("{} has several passes {}; write {} with its layer, such as {}",
                                 file.path.string(), wanted, aovKey(kind),
                                 fullName(*found.front())));
  }
  throw InputError(fmt::format("{} has no pass {}{}, which {} names", file.path.string(), wanted,
                               didYouMean(wanted, known), aovKey(kind)));
}

std::string describeLayers(const std::vector<PassChannels>& passes, const std::string& layer) {
  const auto layers = listLayers(passes);
  std::vector<std::string> inLayer;
  for (const PassChannels& pass : passes) {
    if (pass.layer == layer) inLayer.push_back(pass.pass.empty() ? "RGBA" : pass.pass);
  }
  const std::string place = layer.empty() ? "passes without a layer" : "passes in " + layer;
  return fmt::format("layers: {}; {}: {}", listNames(layers), place, listNames(inLayer));
}

// Passes with enough channels for a kind that no table knows: what it may go by here.
std::vector<std::string> unknownPasses(const std::vector<PassChannels>& passes,
                                       const std::string& layer, AovKind kind) {
  std::vector<std::string> names;
  for (const PassChannels& pass : passes) {
    const bool fits = pass.channels.size() >= rowOf(kind).fewest &&
                      pass.channels.size() <= rowOf(kind).most && !isCryptomatte(kind);
    if (fits && !pass.pass.empty() && !isKnownPass(pass.pass) && !isHelperLayer(fullName(pass)) &&
        (layer.empty() || pass.layer == layer))
      names.push_back(fullName(pass));
  }
  return names;
}

// The layer whose passes an error lists: the given one, else where the data seems to be.
std::string layerToDescribe(const std::vector<PassChannels>& passes, const std::string& given) {
  if (!given.empty()) return given;
  for (const AovKind kind : {AovKind::position, AovKind::normal, AovKind::depth})
    for (const PassChannels& pass : passes)
      if (aliasRank(kind, pass.pass) >= 0 && !isHelperLayer(pass.layer)) return pass.layer;
  const auto layers = listLayers(passes);
  return layers.empty() ? "" : layers.front();
}

[[noreturn]] void reportMissing(const ImageFile& file, const AovNames& names, AovKind kind) {
  const auto passes = listPasses(file);
  const auto layers = listLayers(passes);
  const std::string& given =
      kind == AovKind::beauty && !names.beautyLayer.empty() ? names.beautyLayer : names.layer;
  if (!given.empty() && std::find(layers.begin(), layers.end(), given) == layers.end()) {
    throw InputError(fmt::format("{} has no layer {}{} (layers: {})", file.path.string(), given,
                                 didYouMean(given, layers), listNames(layers)));
  }
  const std::vector<std::string> candidates = unknownPasses(passes, given, kind);
  std::vector<std::string> known;
  for (const PassChannels& pass : passes) known.push_back(pass.pass);
  const std::string unknown =
      candidates.empty() ? "" : fmt::format("; not known by name: {}", listNames(candidates));
  throw InputError(
      fmt::format("{} has no {} pass{} ({}{}); turn it on in the exporter or name it with {}{}",
                  file.path.string(), aovName(kind), didYouMean(aovName(kind), known),
                  describeLayers(passes, layerToDescribe(passes, given)), unknown, aovKey(kind),
                  candidates.empty() ? "" : fmt::format(" = \"{}\"", candidates.front())));
}

}  // namespace

const std::string& AovNames::of(AovKind kind) const { return this->*rowOf(kind).member; }

std::string_view aovName(AovKind kind) { return rowOf(kind).name; }

std::string aovKey(AovKind kind) { return fmt::format("frame.{}", rowOf(kind).key); }

std::optional<Aov> findAov(const ImageFile& file, const AovNames& names, AovKind kind) {
  const auto candidates = candidatesOf(file, kind);
  if (!names.of(kind).empty()) return findNamed(file, names, kind, candidates);
  const bool beauty = kind == AovKind::beauty;
  std::optional<std::string> layer = beauty ? names.beautyLayer : names.layer;
  if (layer->empty()) layer = chooseLayer(file, names, kind, candidates);
  const PassChannels* found = layer ? bestIn(candidates, *layer, kind) : nullptr;
  if (!found && beauty && layer.value_or("").empty()) found = firstPicture(file, candidates);
  if (!found) return std::nullopt;
  return finish(file, kind, *found);
}

bool isWorldRest(const AovNames& names, std::string_view pass) {
  if (names.restSpace != RestSpace::automatic) return names.restSpace == RestSpace::world;
  return plainName(pass.substr(pass.rfind('.') + 1)).starts_with('w');
}

Aov requireAov(const ImageFile& file, const AovNames& names, AovKind kind) {
  if (auto aov = findAov(file, names, kind)) return *std::move(aov);
  reportMissing(file, names, kind);
}

std::string requireMaskChannel(const ImageFile& file, const std::string& layer) {
  const auto passes = listPasses(file);
  if (const PassChannels* shadow = bestIn(passes, layer, AovKind::shadow)) {
    return shadow->channels.front();
  }
  std::vector<const PassChannels*> inLayer;
  for (const PassChannels& pass : passes) {
    if (fullName(pass) == layer) return pass.channels.front();
    if (pass.layer == layer) inLayer.push_back(&pass);
  }
  if (inLayer.size() == 1) return inLayer.front()->channels.front();
  if (file.findChannel(layer)) return layer;
  const auto layers = listLayers(passes);
  if (!inLayer.empty()) {
    throw InputError(fmt::format("{} has no Shadow pass in layer {} ({}); export the masks again",
                                 file.path.string(), layer, describeLayers(passes, layer)));
  }
  throw InputError(fmt::format("{} has no mask layer {}{} (layers: {}); export the masks again",
                               file.path.string(), layer, didYouMean(layer, layers),
                               listNames(layers)));
}

}  // namespace kagefude
