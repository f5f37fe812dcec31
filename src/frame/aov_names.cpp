#include "frame/aov_names.h"

#include <algorithm>
#include <cctype>
#include <span>

namespace kagefude::detail {
namespace {

using Names = std::span<const std::string_view>;

// Plain names (see plainName) by renderer, the likelier first. Blender 2.8 to 4 call passes in the
// file IndexOB, DiffCol ...; later ones and the File Output node use the long names.
constexpr std::string_view positions[] = {"position", "p",   "pworld",     "worldposition",
                                          "worldpos", "pos", "pointworld", "worldpositions"};
constexpr std::string_view normals[] = {"normal",      "n",  "nworld",        "normals",
                                        "worldnormal", "nn", "shadingnormal", "smoothnormal",
                                        "bumpnormals"};
constexpr std::string_view depths[] = {"depth", "z", "zdepth", "depthz"};
constexpr std::string_view objectIndices[] = {"indexob", "objectindex", "objectid", "objid",
                                              "nodeid",  "renderid",    "id",       "primid"};
constexpr std::string_view materialIndices[] = {"indexma", "materialindex", "materialid", "mtlid",
                                                "matid"};
constexpr std::string_view vectors[] = {"vector", "motionvector", "velocity", "motion", "dpdtime"};
constexpr std::string_view albedos[] = {"diffcol",       "diffusecolor", "albedo",
                                        "diffusealbedo", "basecolor",    "diffusefilter"};
constexpr std::string_view beauties[] = {"combined", "",    "image", "rgba",
                                         "beauty",   "rgb", "ci",    "c"};
constexpr std::string_view shadows[] = {"shadow", "rawshadow", "shadows"};
constexpr std::string_view cryptoObjects[] = {"cryptoobject", "cryptomatteobject"};
constexpr std::string_view cryptoMaterials[] = {"cryptomaterial", "cryptomattematerial"};

// Houdini, Karma; Arnold, RenderMan, V-Ray's usual user element; MoonRay.
constexpr std::string_view rests[] = {"rest",  "restposition", "pref",  "refp",
                                      "wpref", "worldrest",    "posref"};
constexpr std::string_view uvs[] = {"uv", "st", "texcoord"};
constexpr std::string_view emissions[] = {"emit", "emission", "selfillumination"};
constexpr std::string_view instanceRandoms[] = {"instancerandom", "objectrandom"};

// Passes that serve no purpose here, but must be told from layers and views.
constexpr std::string_view otherPasses[] = {"mist",
                                            "noisyimage",
                                            "denoisingnormal",
                                            "meannormal",
                                            "denoisingalbedo",
                                            "ao",
                                            "env",
                                            "diffdir",
                                            "diffind",
                                            "glosscol",
                                            "glossdir",
                                            "glossind",
                                            "transcol",
                                            "transdir",
                                            "transind",
                                            "volumedir",
                                            "volumeind",
                                            "subsurfacedir",
                                            "subsurfaceind",
                                            "alpha",
                                            "debugsamplecount",
                                            "denoisingdepth",
                                            "shadowcatcher",
                                            "cryptoasset",
                                            "diffuse",
                                            "diffusedirect",
                                            "diffuseindirect",
                                            "specular",
                                            "reflection",
                                            "refraction",
                                            "transmission",
                                            "lighting",
                                            "sss",
                                            "background"};

Names namesOf(AovKind kind) {
  switch (kind) {
    case AovKind::position:
      return positions;
    case AovKind::normal:
      return normals;
    case AovKind::depth:
      return depths;
    case AovKind::objectIndex:
      return objectIndices;
    case AovKind::materialIndex:
      return materialIndices;
    case AovKind::vector:
      return vectors;
    case AovKind::albedo:
      return albedos;
    case AovKind::beauty:
      return beauties;
    case AovKind::shadow:
      return shadows;
    case AovKind::cryptoObject:
      return cryptoObjects;
    case AovKind::cryptoMaterial:
      return cryptoMaterials;
    case AovKind::rest:
      return rests;
    case AovKind::uv:
      return uvs;
    case AovKind::instanceRandom:
      return instanceRandoms;
    case AovKind::emission:
      return emissions;
    case AovKind::surface:
      return {};
  }
  return {};
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::string plainName(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    if (c == '_' || c == '-' || c == ' ') continue;
    plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return plain;
}

int aliasRank(AovKind kind, std::string_view passName) {
  const Names names = namesOf(kind);
  const auto found = std::find(names.begin(), names.end(), plainName(passName));
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

bool isKnownPass(std::string_view passName) {
  if (passName.empty()) return false;
  if (!cryptomatteStem(passName).empty()) return true;
  const auto inTable = [&](AovKind kind) { return aliasRank(kind, passName) >= 0; };
  return std::any_of(searchedKinds.begin(), searchedKinds.end(), inTable) ||
         std::find(std::begin(otherPasses), std::end(otherPasses), plainName(passName)) !=
             std::end(otherPasses);
}

int componentOrder(std::string_view suffix) {
  constexpr std::string_view orders[] = {"x", "y", "z", "w",   "r",     "g",    "b",
                                         "a", "u", "v", "red", "green", "blue", "alpha"};
  constexpr int ranks[] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 0, 1, 2, 3};
  const std::string plain = plainName(suffix);
  const auto found = std::find(std::begin(orders), std::end(orders), plain);
  return found == std::end(orders) ? -1 : ranks[found - std::begin(orders)];
}

std::string_view cryptomatteStem(std::string_view passName) {
  const size_t size = passName.size();
  if (size < 3 || !isDigit(passName[size - 1]) || !isDigit(passName[size - 2])) return {};
  const std::string_view stem = passName.substr(0, size - 2);
  return plainName(stem).find("crypto") == std::string::npos ? std::string_view() : stem;
}

}  // namespace kagefude::detail
