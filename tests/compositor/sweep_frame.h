#pragma once

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "compositor/test_frame.h"
#include "look/look_sections.h"

namespace kagefude::testing {

/// A ball before a ground that has a step and rises into a roof, under one lamp with everything
/// that a shadow method may want.
class SweepFrame {
 public:
  static constexpr int width = 32, height = 24;

  SweepFrame() {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        put(x, y, (float(x) + 0.5f - 16) / 4, (12 - float(y) - 0.5f) / 4);
    frame.sidecar["objects"].clear();
    frame.addObject("Ball", 1, {-4, -1, -1}, {0, 1, 2});
    frame.addObject("Ground", 2, {-4, -3, 0}, {4, 3, 0.01f});
    frame.sidecar["objects"][1]["flat"] = true;
    frame.addObject("Rise", 3, {-4, -3, -0.3f}, {4, 3, 2.4f});
    frame.sidecar["world"] = {{"radiance", {0.3, 0.3, 0.3}}};
    frame.sidecar["camera"]["type"] = "orthographic";
    frame.sidecar["camera"]["clip_from_camera"] = {
        {0.25, 0, 0, 0}, {0, 1.0 / 3, 0, 0}, {0, 0, -0.02, -1}, {0, 0, 0, 1}};
    frame.folder.write("card.obj", "v -1 -1 4\nv 1 -1 4\nv 1 1 4\nv -1 1 4\nf 1 2 3\nf 1 3 4\n");
    frame.sidecar["casters"] = {
        {{"object", "Ball"}, {"file", "card.obj"}, {"world_from_object", identityRows()}}};
    writeDepthMap();
    addLight("Key", {2, 1, 9}, 0);
  }

  void put(int x, int y, float px, float py) {
    const float r2 = (px + 2) * (px + 2) + py * py;
    const bool ball = r2 < 1;
    V3f p(px, py, py > 1.5f ? -0.3f : 0.0f), n(0, 0, 1);
    if (ball) {
      p.z = 1 + std::sqrt(1 - r2);
      n = V3f(px + 2, py, p.z - 1);
    } else if (px > 2) {
      p.z += (px - 2) * 1.2f;
      n = V3f(-1.2f, 0, 1).normalized();
    }
    frame.setVector("Position", x, y, p);
    frame.setVector("Normal", x, y, n);
    const bool level = py <= 1.5f && px <= 2;
    frame.plane("IndexOB.X")(x, y) = ball ? 1.0f : level ? 2.0f : 3.0f;
    frame.plane("UV.U")(x, y) = float(x + 1) / width;
    frame.plane("UV.V")(x, y) = float(y + 1) / height;
    for (const char* name : {"DiffCol.R", "DiffCol.G", "DiffCol.B"})
      frame.plane(name)(x, y) = 0.25f + 0.5f * float(x) / width;
    for (const char* name : {"Emit.R", "Emit.G", "Emit.B"}) frame.plane(name)(x, y) = 0.02f;
  }

  /// A disc that hides what the masks hide, and a card so low that they need not, over the ground.
  void writeDepthMap() const {
    Floats depth(16, 16, 9.0f);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        const float dx = float(x) - 2.4f, dy = float(y) - 9.0f;
        if (dx * dx + dy * dy < 5)
          depth(x, y) = 5.0f;
        else if (x >= 4 && x < 12 && y >= 4 && y < 12)
          depth(x, y) = 7.5f;
      }
    frame.writeDepthMap("depth.exr", depth);
  }

  void addLight(const std::string& name, const V3f& position, int shift) {
    nlohmann::json light = lightJson(name, "point", position, {0, 0, -1}, 100);
    light["radius"] = 0.5;
    light["axes"] = {{"u", {1, 0, 0}}, {"v", {0, 1, 0}}};
    light["depth_map"] = depthMapJson(position, 16, 2);
    frame.sidecar["lights"].push_back(light);
    mask(name, frame.sidecar["lights"].back(), "disc", 9, shift);
  }

  /// Masks whose shadow moves with their place.
  void mask(const std::string& name, nlohmann::json& light, const std::string& arrangement,
            int count, int shift) {
    nlohmann::json samples = nlohmann::json::array();
    for (int k = 0; k < count; ++k) {
      double u = 0, v = 0;
      if (arrangement == "pair") u = k == 0 ? 1 : -1;
      if (arrangement == "line") u = 2.0 * k / (count - 1) - 1;
      if (arrangement == "disc" && k > 0) {
        u = std::cos(2 * M_PI * (k - 1) / (count - 1));
        v = std::sin(2 * M_PI * (k - 1) / (count - 1));
      }
      const std::string layer = name + "." + arrangement + std::to_string(k);
      Floats& plane = frame.plane(layer + ".R", 1.0f);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const double dx = x - 12 - shift - 3 * u, dy = y - 11 - 3 * v;
          const bool thin = std::fabs(x - 24 - 2 * u) < 1 && y > 4;
          plane(x, y) = dx * dx + dy * dy < 40 || thin ? 0.0f : 1.0f;
        }
      samples.push_back(
          {{"layer", "ViewLayer." + layer}, {"uv", {u, v}}, {"position", light["position"]}});
    }
    light["masks"] = {{"arrangement", arrangement}, {"offset", 0.5}, {"samples", samples}};
  }

  void arrange(const std::string& arrangement, int count) {
    mask("Key", frame.sidecar["lights"][0], arrangement, count, 0);
  }

  std::string blobFile() const {
    const Floats half(8, 8, 0.3f);
    writePng(frame.folder / "blob.png", half, half, half);
    return "blob.png";
  }

  static std::vector<std::string> candidates(const Parameter& p) {
    std::vector<std::string> all;
    if (p.type == ValueType::boolean) all = {"true", "false"};
    if (p.type == ValueType::choice)
      for (const std::string_view name : p.choices) all.push_back("\"" + std::string(name) + "\"");
    const bool whole = p.type == ValueType::integer;
    if (whole || p.type == ValueType::number)
      for (const double share : {0.0, 0.001, 0.01, 0.1, 0.5, 1.0}) {
        const double value = p.minimum + share * (std::min(p.maximum, 1e4) - p.minimum);
        all.push_back(fmt::format("{}", whole ? std::floor(value) : value));
      }
    if (p.type == ValueType::numbers && p.count == 3) all = {"[0.1, 0.5, 0.9]"};
    return all;
  }

  TestFrame frame{width, height};
};

/// Sections that want two masks rather than a disc of them.
inline bool takesPair(const std::string& section) {
  return section == "pair" || section == "pair_depth" || section == "smooth";
}

/// What a section wants before it can do anything.
inline std::string contextOf(const std::string& section) {
  const std::string start = "[shadow]\nmethod = \"";
  if (section == "planar" || section == "blob")
    return start + section + "\"\nreceiver = \"Ground\"\n";
  if (section == "pair" || section == "pair_depth" || section == "pcf" || section == "pcss" ||
      section == "coverage" || section == "volume")
    return start + section + "\"\n";
  if (section == "paper") return "output.background = \"paper\"\npaper.strength = 0.8\n";
  return "";
}

/// What a key wants beside its section's context, as overrides are written.
inline const std::map<std::string, std::string> companions = {
    {"smooth.h", "smooth.all_methods = true\n"},
    {"pair.step", "pair.search = \"grid\"\n"},
    {"pair.adaptive", "pair.search = \"grid\"\npair.step = 8\n"},
    {"outline.objects", "outline.depth_step = 0\noutline.crease_angle = 180\n"},
    {"brush.blend_width", "brush.mapping = \"polar\"\n"},
    {"brush.pole_fade", "brush.mapping = \"polar\"\n"},
    {"brush.strip_pixels", "brush.size = \"screen\"\n"},
    {"brush.uv_size", "brush.ground = \"uv\"\n"},
    {"brush.stretch", "brush.ground = \"uv\"\nbrush.uv_size = 0.01\n"},
    {"brush.point_blend", "brush.points = 4\nbrush.mapping = \"polar\"\n"},
    {"brush.points", "brush.mapping = \"polar\"\n"},
    {"brush.cross_fade", "brush.mapping = \"polar\"\n"},
    {"brush.max_probes", "brush.mapping = \"polar\"\nbrush.mapping_distance = 0.05\n"},
    {"brush.filter", "brush.mapping = \"polar\"\n"},
    {"edges.overrun", "edges.rough = 3\n"},
    {"edges.dry_width", "edges.dry = 1\n"},
    {"edges.rim_strength", "edges.rim = 6\n"},
    {"edges.lost_tone", "edges.lost = 6\n"},
    {"edges.size", "edges.rough = 3\n"},
    {"tint.shadow_strength", "tint.shadow = [0.2, 0.3, 0.9]\n"},
};

}  // namespace kagefude::testing
