#pragma once

#include "compositor/test_frame.h"

namespace kagefude::testing {

/// The ground z = 0 seen straight down by an orthographic camera: 8 x 8 pixels over x and y from -1
/// to 1, +Y up. One object, `Thing`, index 1.
class MapFrame : public TestFrame {
 public:
  static constexpr int side = 8;

  MapFrame() : TestFrame(side, side) {
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) setVector("Position", x, y, {across(x), -across(y), 0});
    sidecar["camera"]["type"] = "orthographic";
    // Near plane at 1, far plane at 21.
    sidecar["camera"]["clip_from_camera"] = {
        {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -0.1, -1.1}, {0, 0, 0, 1}};
  }

  /// X of a pixel's centre; Y is the same downwards.
  static float across(int pixel) { return (static_cast<float>(pixel) + 0.5f) * 2.0f / side - 1.0f; }

  void addLight(const nlohmann::json& light) { sidecar["lights"].push_back(light); }
  void addSun(const std::string& name, const V3f& direction) {
    addLight(lightJson(name, "sun", direction * -9.0f, direction, 1));
    sidecar["lights"].back()["radius"] = 0;
  }

  /// Gives the last light hard masks; `lit(x, y, k)` says which pixels see place k.
  template <class Lit>
  void addMasks(const std::string& arrangement, const std::vector<V2f>& places, const Lit& lit) {
    nlohmann::json& light = sidecar["lights"].back();
    const std::string name = light["name"];
    nlohmann::json samples = nlohmann::json::array();
    for (size_t k = 0; k < places.size(); ++k) {
      const std::string layer = "mask." + name + "." + std::to_string(k);
      Floats& mask = plane(layer + ".V");
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) mask(x, y) = lit(x, y, k) ? 1.0f : 0.0f;
      samples.push_back({{"layer", "ViewLayer." + layer},
                         {"position", light["position"]},
                         {"uv", {places[k].x, places[k].y}}});
    }
    light["masks"] = {{"arrangement", arrangement}, {"offset", 0.1}, {"samples", samples}};
    light["axes"] = {{"u", {1, 0, 0}}, {"v", {0, 1, 0}}};
  }

  /// A lid that the camera does not see, one unit above the ground's left half (x from -1 to 0).
  void addLid() {
    folder.write("lid.obj", "v -1 -2 1\nv 0 -2 1\nv 0 2 1\nv -1 2 1\nf 1 2 3 4\n");
    sidecar["casters"] = {
        {{"object", "Lid"}, {"file", "lid.obj"}, {"world_from_object", identityRows()}}};
  }

  /// The right half shows another object, `Other`, index 2.
  void addOther() {
    addObject("Other", 2, {0, -1, 0}, {1, 1, 0});
    for (int y = 0; y < side; ++y)
      for (int x = side / 2; x < side; ++x) plane("IndexOB.X")(x, y) = 2.0f;
  }
  /// The upper half shows nothing.
  void clearUpperHalf() {
    for (int y = 0; y < side / 2; ++y)
      for (int x = 0; x < side; ++x) plane("IndexOB.X")(x, y) = 0.0f;
  }
  void addBeauty(const V3f& colour, float alpha) {
    plane("Combined.R", colour.x);
    plane("Combined.G", colour.y);
    plane("Combined.B", colour.z);
    plane("Combined.A", alpha);
  }

  std::string errorOf(const std::string& look) const {
    try {
      comp(look);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
};

inline V3f colourAt(const FrameResult& result, int x, int y) { return result.colour.view()(x, y); }

}  // namespace kagefude::testing
