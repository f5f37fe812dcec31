#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "compositor/compose_frame.h"
#include "compositor/read_frame.h"
#include "compositor/write_frame.h"
#include "exr/write_image.h"
#include "test_folder.h"

namespace kagefude::testing {

inline nlohmann::json identityRows() {
  return {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
}

inline nlohmann::json pointOf(const V3f& p) { return {p.x, p.y, p.z}; }

/// A light of the JSON; its subject is a unit sphere round the origin.
inline nlohmann::json lightJson(const std::string& name, const std::string& type,
                                const V3f& position, const V3f& direction, double energy) {
  nlohmann::json light = {{"name", name},
                          {"type", type},
                          {"position", pointOf(position)},
                          {"direction", pointOf(direction)},
                          {"radius", 0.1},
                          {"color", {1, 1, 1}},
                          {"energy", energy},
                          {"shadow", true},
                          {"subject", {{"center", {0, 0, 0}}, {"radius", 1}}}};
  if (type == "spot") light["cone"] = {{"angle", 2.5}, {"blend", 0}};
  return light;
}

/// A depth map of `size` x `size` pixels in depth.exr, seen from `position` along -z; half of its
/// field is 1 wide at the distance `focal`.
inline nlohmann::json depthMapJson(const V3f& position, int size, double focal) {
  nlohmann::json lightFromWorld = identityRows();
  for (int k = 0; k < 3; ++k) lightFromWorld[k][3] = -position[k];
  return {
      {"file", "depth.exr"},
      {"channel", "Z"},
      {"resolution", {size, size}},
      {"projection", "perspective"},
      {"light_from_world", lightFromWorld},
      {"clip_from_light", {{focal, 0, 0, 0}, {0, focal, 0, 0}, {0, 0, -1, -0.2}, {0, 0, -1, 0}}}};
}

/// A frame of a few pixels, as a renderer and the exporter would leave it: an EXR and its JSON.
/// Every pixel shows object 1, `Thing`, at the origin, until a test says otherwise.
class TestFrame {
 public:
  explicit TestFrame(int width, int height = 1) : width_(width), height_(height) {
    for (const char* name : {"Position.X", "Position.Y", "Position.Z", "Normal.X", "Normal.Y"})
      plane(name);
    plane("Normal.Z", 1.0f);
    plane("IndexOB.X", 1.0f);
    sidecar = {{"kagefude", 1},
               {"frame", 1},
               {"fps", 24},
               {"resolution", {width, height}},
               {"camera",
                {{"type", "perspective"},
                 {"position", {0, 0, 10}},
                 {"direction", {0, 0, -1}},
                 {"camera_from_world", identityRows()},
                 {"clip_from_camera", identityRows()}}},
               {"lights", nlohmann::json::array()},
               {"objects", nlohmann::json::array()}};
    sidecar["camera"]["camera_from_world"][2][3] = -10;
    addObject("Thing", 1, {-1, -1, -1}, {1, 1, 1});
  }

  /// The channel of this full name, made when it is first asked for.
  Floats& channel(const std::string& name, float value = 0.0f) {
    return planes_.try_emplace(name, Floats(width_, height_, value)).first->second;
  }
  /// The channel "ViewLayer.<name>".
  Floats& plane(const std::string& name, float value = 0.0f) {
    return channel("ViewLayer." + name, value);
  }
  /// Positions of a floor at z = 0 that is seen from above, eight pixels a unit round the origin.
  void layFloor() {
    const V3f corner(0.5f * static_cast<float>(width_ - 1), 0.5f * static_cast<float>(height_ - 1),
                     0);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        setVector(
            "Position", x, y,
            {(static_cast<float>(x) - corner.x) / 8, (corner.y - static_cast<float>(y)) / 8, 0});
  }
  void setVector(const std::string& name, int x, int y, const V3f& v) {
    plane(name + ".X")(x, y) = v.x;
    plane(name + ".Y")(x, y) = v.y;
    plane(name + ".Z")(x, y) = v.z;
  }
  void addObject(const std::string& name, int index, const V3f& low, const V3f& high) {
    sidecar["objects"].push_back({{"name", name},
                                  {"index", index},
                                  {"world_from_object", identityRows()},
                                  {"bounds", {{"min", pointOf(low)}, {"max", pointOf(high)}}},
                                  {"reference_point", {0, 0, 0}}});
  }

  void writeDepthMap(const std::string& name, const Floats& depth) const {
    OutputImage image;
    image.dataWindow = image.displayWindow = {0, 0, depth.width(), depth.height()};
    image.channels = {floatChannel("Z", PixelType::single, depth)};
    writeExr(folder / name, image);
  }

  std::filesystem::path write() const {
    OutputImage image;
    image.dataWindow = image.displayWindow = {0, 0, width_, height_};
    for (const auto& [name, plane] : planes_)
      image.channels.push_back(floatChannel(name, PixelType::single, plane));
    for (const auto& [name, plane] : labels_) image.channels.push_back(labelChannel(name, plane));
    const std::filesystem::path path = folder / "frame.exr";
    writeExr(path, image);
    folder.write("frame.json", withJson ? sidecar.dump() : "{}");
    if (!withJson) std::filesystem::remove(folder / "frame.json");
    return path;
  }

  /// Makes "ViewLayer.<name>" a channel of whole numbers.
  Labels& numbers(const std::string& name) {
    planes_.erase("ViewLayer." + name);
    return labels_.try_emplace("ViewLayer." + name, Labels(width_, height_, 0u)).first->second;
  }

  FrameResult comp(const std::string& lookText, const std::vector<std::string>& set = {}) const {
    const std::filesystem::path path = write();
    folder.write("look.toml", lookText);
    const Look look = readLook(folder / "look.toml", set);
    const Colour colour(look.colourConfig());
    const StripSet strips(look, colour);
    const FramePlan plan = planFrame(look, path, 1);
    return composeFrame(look, strips, plan, readFramePlanes(plan));
  }

  /// The tone that the strokes follow.
  Floats tone(const std::string& lookText) const {
    FrameResult result = comp("output.layers = [\"brush.tone\"]\n" + lookText);
    return layer(result, "brush.tone");
  }

  static Floats layer(FrameResult& result, const std::string& name) {
    for (NamedPlane& own : result.layers)
      if (own.name == name) return std::move(own.plane.floats);
    ADD_FAILURE() << "the result has no layer " << name;
    return {};
  }

  nlohmann::json sidecar;
  bool withJson = true;
  TestFolder folder;

 private:
  int width_, height_;
  std::map<std::string, Floats> planes_;
  std::map<std::string, Labels> labels_;
};

}  // namespace kagefude::testing
