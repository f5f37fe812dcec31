#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "exr/image_file.h"
#include "frame/aov_resolver.h"

namespace kagefude {

struct InspectedPass {
  std::string name;  ///< pass, with its view if it has one
  std::vector<std::string> channels;
  std::string type;  ///< half, float, uint or mixed
};

struct InspectedLayer {
  std::string name;  ///< "" for channels without a layer
  std::vector<InspectedPass> passes;
};

struct InspectedCryptomatte {
  std::string name;
  int ranks = 0;
  std::vector<std::string> names;  ///< of the manifest, sorted by id
};

struct InspectedMask {
  std::string layer;
  bool found = false;
};

struct InspectedLight {
  std::string name;
  std::string type;
  std::string arrangement;  ///< "" when it has no masks
  std::vector<InspectedMask> masks;
  std::string depthMap;  ///< file, "" when none
  bool depthMapFound = false;
  std::string truthLayer;
};

struct InspectedObject {
  std::string name;
  uint32_t index = 0;
  std::vector<std::string> materials;
};

/// Which pass serves which purpose.
struct InspectedAov {
  std::string purpose;  ///< "Position"
  std::string key;      ///< "frame.position"; "" where no look can name it
  std::string pass;     ///< "" when not found
};

enum class FindingKind { missing, warning, error };

/// Something that is missing or wrong, and what to do about it; both lower-case sentences.
struct Finding {
  FindingKind kind = FindingKind::warning;
  std::string what;
  std::string remedy;
};

/// What `kagefude inspect` shows of one frame.
struct Inspection {
  std::filesystem::path path;
  Window dataWindow, displayWindow;
  float pixelAspect = 1.0f;
  std::vector<Part> parts;
  std::vector<std::string> views;  ///< of the file, the default first; empty when it names none
  std::string view;  ///< the one that passes, Cryptomattes and masks were looked up in
  int channelCount = 0;
  std::vector<InspectedLayer> layers;
  std::vector<InspectedAov> aovs;
  std::vector<InspectedCryptomatte> cryptomattes;
  std::string sidecar;  ///< path, "" when none
  std::optional<int> frame;
  std::optional<double> fps;
  std::vector<InspectedLight> lights;
  std::vector<InspectedObject> objects;
  std::vector<Finding> findings;
};

/// Looks at a frame's headers, sidecar and depth-map files, but not at its pixels. Throws
/// InputError only when the frame itself cannot be opened; everything else that is wrong is a
/// finding.
Inspection inspectFrame(const std::filesystem::path& path, const AovNames& names = {});

/// The same as JSON; keys are the members' names, findings have kind "missing", "warning", "error".
nlohmann::json toJson(const Inspection& inspection);

}  // namespace kagefude
