#include "frame/lossy_passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "frame/aov_names.h"
#include "frame/cryptomatte.h"

namespace kagefude {
namespace {

bool isData(const PassChannels& pass) {
  constexpr std::array<AovKind, 7> data = {
      AovKind::position,    AovKind::normal,        AovKind::rest,  AovKind::depth,
      AovKind::objectIndex, AovKind::materialIndex, AovKind::vector};
  return std::any_of(data.begin(), data.end(),
                     [&](AovKind kind) { return detail::aliasRank(kind, pass.pass) >= 0; });
}

bool needsAllBits(const PassChannels& pass) {
  return detail::aliasRank(AovKind::position, pass.pass) >= 0 ||
         detail::aliasRank(AovKind::rest, pass.pass) >= 0 ||
         detail::aliasRank(AovKind::objectIndex, pass.pass) >= 0;
}

std::set<int> partsWithData(const ImageFile& file, const std::vector<PassChannels>& passes) {
  std::set<int> parts;
  const auto addAll = [&](const std::vector<std::string>& channels) {
    for (const std::string& name : channels) parts.insert(file.findChannel(name)->part);
  };
  for (const PassChannels& pass : passes)
    if (isData(pass)) addAll(pass.channels);
  for (const Cryptomatte& found : listCryptomattes(file)) addAll(found.idChannels);
  return parts;
}

bool isHalf(const ImageFile& file, const PassChannels& pass) {
  return std::all_of(pass.channels.begin(), pass.channels.end(), [&](const std::string& name) {
    return file.findChannel(name)->type == PixelType::half;
  });
}

}  // namespace

std::vector<LossyPass> lossyPasses(const ImageFile& file) {
  constexpr std::array<std::string_view, 5> lossy = {"dwaa", "dwab", "pxr24", "b44", "b44a"};
  const std::vector<PassChannels> passes = listPasses(file);
  std::vector<LossyPass> result;
  for (const int number : partsWithData(file, passes)) {
    const Part& part = file.parts[static_cast<size_t>(number)];
    if (std::find(lossy.begin(), lossy.end(), part.compression) == lossy.end()) continue;
    result.push_back(
        {fmt::format("data passes are packed with {}, which loses bits{}", part.compression,
                     part.name.empty() ? "" : " in part " + part.name),
         "render with zip, zips or piz"});
  }
  for (const PassChannels& pass : passes)
    if (needsAllBits(pass) && isHalf(file, pass))
      result.push_back({fmt::format("{} is stored as half float, which keeps 11 bits", pass.pass),
                        "render with 32-bit float"});
  return result;
}

}  // namespace kagefude
