#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <span>

#include "compositor/scale_down.h"
#include "frame/cryptomatte.h"

namespace kagefude {
namespace {

float floatOf(uint32_t bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

uint32_t bitsOf(float value) {
  uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

Floats toFloats(const RawPlane& plane) {
  const bool half = plane.type == PixelType::half;
  const int width = half ? plane.halves.width() : plane.words.width();
  const int height = half ? plane.halves.height() : plane.words.height();
  Floats values(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      values(x, y) = half ? imath_half_to_float(plane.halves(x, y)) : floatOf(plane.words(x, y));
  return values;
}

void setFloats(View<const float> values, RawPlane& plane) {
  const bool half = plane.type == PixelType::half;
  if (half) plane.halves = Plane<uint16_t>(values.width, values.height);
  if (!half) plane.words = Plane<uint32_t>(values.width, values.height);
  for (int y = 0; y < values.height; ++y)
    for (int x = 0; x < values.width; ++x) {
      if (half)
        plane.halves(x, y) = imath_float_to_half(values(x, y));
      else
        plane.words(x, y) = bitsOf(values(x, y));
    }
}

/// How a channel is brought down.
enum class Way { share, mean, standing, motion };

std::string component(const std::string& channel) {
  const size_t dot = channel.rfind('.');
  std::string last = dot == std::string::npos ? channel : channel.substr(dot + 1);
  std::transform(last.begin(), last.end(), last.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return last;
}

bool isOneOf(const std::string& name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Channels of passes that are known to hold no colours, and of motion, by the table of names.
struct DataChannels {
  std::set<std::string> standing, motion, masks;

  explicit DataChannels(const FramePlan& plan) {
    for (const AovKind kind : {AovKind::position, AovKind::normal, AovKind::depth,
                               AovKind::objectIndex, AovKind::materialIndex, AovKind::surface})
      add(plan.image, kind, standing);
    add(plan.image, AovKind::vector, motion);
    for (const Aov* aov : {&plan.position, &plan.normal})
      standing.insert(aov->channels.begin(), aov->channels.end());
    for (const FrameLight& light : plan.lights)
      masks.insert(light.maskChannels.begin(), light.maskChannels.end());
  }

  Way wayOf(const RawPlane& plane) const {
    if (masks.contains(plane.name)) return Way::mean;
    if (motion.contains(plane.name)) return Way::motion;
    if (plane.type == PixelType::uint || standing.contains(plane.name)) return Way::standing;
    const std::string last = component(plane.name);
    if (isOneOf(last, {"x", "y", "z", "w", "u", "v"})) {
      const bool light = plane.name.starts_with("mask.") || plane.name.starts_with("truth.");
      return light ? Way::mean : Way::standing;
    }
    return isOneOf(last, {"r", "g", "b", "a", "red", "green", "blue", "alpha"}) ? Way::share
                                                                                : Way::mean;
  }

 private:
  static void add(const ImageFile& image, AovKind kind, std::set<std::string>& channels) {
    try {
      if (const auto aov = findAov(image, {}, kind))
        channels.insert(aov->channels.begin(), aov->channels.end());
    } catch (const std::exception&) {
      // Several layers have such a pass: what their components are called decides.
    }
  }
};

/// What an id covers of a square.
struct Cover {
  uint32_t id;
  double share;
};

/// Ids and coverage of one Cryptomatte, by rank, ranked anew by what each covers of the square.
void rankAnew(const Downscale& squares, int scale, const std::vector<RawPlane*>& ids,
              const std::vector<RawPlane*>& coverage) {
  const Window& window = squares.window();
  std::vector<Floats> shares, smallShares;
  std::vector<Labels> smallIds;
  for (size_t rank = 0; rank < ids.size(); ++rank) {
    shares.push_back(toFloats(*coverage[rank]));
    smallShares.emplace_back(window.width, window.height, 0.0f);
    smallIds.emplace_back(window.width, window.height, 0u);
  }
  parallelRows(window.height, [&](int first, int end) {
    std::vector<Cover> found;
    for (int y = first; y < end; ++y)
      for (int x = 0; x < window.width; ++x) {
        found.clear();
        const BoxSpan across = squares.across(x), down = squares.down(y);
        for (size_t rank = 0; rank < ids.size(); ++rank)
          for (int v = down.first; v < down.end; ++v)
            for (int u = across.first; u < across.end; ++u) {
              const uint32_t id = ids[rank]->words(u, v);
              const float share = shares[rank](u, v);
              if (!(share > 0) || !std::isfinite(share)) continue;
              const auto known = std::find_if(found.begin(), found.end(),
                                              [&](const Cover& cover) { return cover.id == id; });
              if (known == found.end())
                found.push_back({id, share});
              else
                known->share += share;
            }
        std::sort(found.begin(), found.end(), [](const Cover& a, const Cover& b) {
          return a.share != b.share ? a.share > b.share : a.id < b.id;
        });
        for (size_t rank = 0; rank < std::min(found.size(), ids.size()); ++rank) {
          smallIds[rank](x, y) = found[rank].id;
          smallShares[rank](x, y) = static_cast<float>(found[rank].share / (scale * scale));
        }
      }
  });
  for (size_t rank = 0; rank < ids.size(); ++rank) {
    ids[rank]->words = std::move(smallIds[rank]);
    setFloats(smallShares[rank], *coverage[rank]);
  }
}

/// The planes that belong to Cryptomattes whose ids are whole, brought down; their names.
std::set<std::string> scaleCryptomattes(const Downscale& squares, int scale, const FramePlan& plan,
                                        std::vector<RawPlane>& planes) {
  std::map<std::string, RawPlane*> byName;
  for (RawPlane& plane : planes) byName[plane.name] = &plane;
  std::set<std::string> done;
  for (const Cryptomatte& matte : listCryptomattes(plan.image)) {
    std::vector<RawPlane*> ids, coverage;
    for (size_t rank = 0; rank < std::min(matte.idChannels.size(), matte.coverageChannels.size());
         ++rank) {
      const auto id = byName.find(matte.idChannels[rank]);
      const auto share = byName.find(matte.coverageChannels[rank]);
      const bool whole = id != byName.end() && share != byName.end() &&
                         !id->second->words.empty() && !done.contains(id->first) &&
                         share->second->type != PixelType::uint;
      if (!whole) continue;
      ids.push_back(id->second);
      coverage.push_back(share->second);
      done.insert({id->first, share->first});
    }
    if (!ids.empty()) rankAnew(squares, scale, ids, coverage);
  }
  return done;
}

void clearNonFinite(Floats& values) {
  for (float& value : std::span(values.row(0), values.view().pixels()))
    if (!std::isfinite(value)) value = 0;
}

void scaleChannel(const Downscale& squares, int scale, View<const uint32_t> standing, Way way,
                  RawPlane& plane) {
  if (way == Way::share || way == Way::mean) {
    Floats values = toFloats(plane);
    clearNonFinite(values);
    setFloats(way == Way::share ? squares.share(values) : squares.mean(values), plane);
    return;
  }
  if (plane.type == PixelType::half)
    plane.halves = squares.pick<uint16_t>(plane.halves, standing);
  else
    plane.words = squares.pick<uint32_t>(plane.words, standing);
  if (way != Way::motion || plane.type == PixelType::uint) return;
  Floats motion = toFloats(plane);
  for (float& value : std::span(motion.row(0), motion.view().pixels()))
    value /= static_cast<float>(scale);
  setFloats(motion, plane);
}

}  // namespace

void scaleDown(const Downscale& squares, int scale, View<const uint32_t> standing,
               const FramePlan& plan, std::vector<RawPlane>& planes) {
  const DataChannels data(plan);
  const std::set<std::string> mattes = scaleCryptomattes(squares, scale, plan, planes);
  for (RawPlane& plane : planes)
    if (!mattes.contains(plane.name))
      scaleChannel(squares, scale, standing, data.wayOf(plane), plane);
}

}  // namespace kagefude
