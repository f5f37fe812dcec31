#include "look/draft_look.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/printable.h"
#include "image/oklab.h"
#include "look/look_sections.h"
#include "look/toml_text.h"
#include "passes/edges/outline.h"

namespace kagefude {
namespace {

constexpr float sameColour = 0.06f;  ///< Oklab
constexpr float headroom = 1.15f;  ///< of the brightest row above what is brightest but for lights
constexpr size_t largeThings = 24, mostStrips = 64;

float difference(const V3f& linearA, const V3f& linearB) {
  return (oklabOfLinear(linearA) - oklabOfLinear(linearB)).length();
}

/// Things that share a style, and what the style names them by.
struct Group {
  std::vector<std::string> objects, materials;
  int index = 0;
  DraftThing thing;  ///< the largest of them, with all their pixels
};

bool largerFirst(const DraftThing& a, const DraftThing& b) {
  if (a.pixels != b.pixels) return a.pixels > b.pixels;
  return a.object != b.object ? a.object < b.object : a.material < b.material;
}

void addPixels(const DraftThing& more, DraftThing& thing) {
  thing.pixels += more.pixels;
  thing.rimPixels += more.rimPixels;
  thing.brightTone = std::max(thing.brightTone, more.brightTone);
}

Group groupOf(const DraftThing& thing, bool byMaterial, bool byObject) {
  Group group{{}, {}, 0, thing};
  if (byMaterial) group.materials = {thing.material};
  if (byObject && !thing.object.empty()) group.objects = {thing.object};
  if (group.materials.empty() && group.objects.empty()) group.index = static_cast<int>(thing.index);
  return group;
}

/// One group for each material whose objects look alike; else for each object of it.
void addMaterial(std::vector<DraftThing> things, std::vector<Group>& groups) {
  std::sort(things.begin(), things.end(), largerFirst);
  const bool alike = std::all_of(things.begin(), things.end(), [&](const DraftThing& t) {
    return difference(t.colour, things.front().colour) <= sameColour;
  });
  if (!alike) {
    for (const DraftThing& thing : things) groups.push_back(groupOf(thing, true, true));
    return;
  }
  Group group = groupOf(things.front(), true, false);
  for (size_t i = 1; i < things.size(); ++i) addPixels(things[i], group.thing);
  groups.push_back(std::move(group));
}

std::vector<Group> groupThings(const std::vector<DraftThing>& things) {
  std::map<std::string, std::vector<DraftThing>> materials;
  std::map<std::string, std::vector<DraftThing>> objects;
  std::vector<Group> groups;
  for (const DraftThing& thing : things) {
    if (!thing.material.empty())
      materials[thing.material].push_back(thing);
    else if (!thing.object.empty())
      objects[thing.object].push_back(thing);
    else if (thing.index != 0)
      groups.push_back(groupOf(thing, false, false));
  }
  for (const auto& [name, own] : materials) addMaterial(own, groups);
  for (auto& [name, own] : objects) {
    for (size_t i = 1; i < own.size(); ++i) addPixels(own[i], own.front());
    groups.push_back(groupOf(own.front(), false, true));
  }
  std::sort(groups.begin(), groups.end(),
            [](const Group& a, const Group& b) { return largerFirst(a.thing, b.thing); });
  return groups;
}

/// The earlier group whose strip a small thing takes; null for one of its own.
Group* sharedBy(std::vector<Group>& kept, const Group& group) {
  const auto nearer = [&](const Group& a, const Group& b) {
    return difference(a.thing.colour, group.thing.colour) <
           difference(b.thing.colour, group.thing.colour);
  };
  const auto nearest = std::min_element(kept.begin(), kept.end(), nearer);
  if (nearest == kept.end() || kept.size() < largeThings) return nullptr;
  const bool near = difference(nearest->thing.colour, group.thing.colour) <= sameColour;
  return near || kept.size() >= mostStrips ? &*nearest : nullptr;
}

struct Style {
  const Group* group = nullptr;
  std::string strip;
  float mappingDistance = 0;
};

std::string fileStem(const Group& group) {
  const std::string& name = !group.materials.empty() ? group.materials.front()
                            : !group.objects.empty() ? group.objects.front()
                                                     : fmt::format("index {}", group.index);
  std::string stem;
  for (const char c : name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (plain)
      stem += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    else if (!stem.empty() && stem.back() != '-')
      stem += '-';
    if (stem.size() >= 48) break;
  }
  while (!stem.empty() && stem.back() == '-') stem.pop_back();
  return stem.empty() ? "thing" : stem;
}

std::string freeName(const std::string& stem, std::set<std::string>& taken) {
  std::string name = stem;
  for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{}-{}", stem, i);
  return name + ".png";
}

/// Width of a thing's strip on the screen, pixels: the preset's share of the picture's height, less
/// on smaller things.
float stripOnScreen(const LookPreset& preset, const DraftFrame& frame, const DraftThing& thing) {
  const float height = static_cast<float>(frame.height);
  const float side = std::sqrt(static_cast<float>(thing.pixels)) / (0.5f * height);
  return preset.strokeSize * height * powerOf(std::clamp(side, 0.02f, 1.2f), preset.followsSize);
}

bool hasStrokes(const LookPreset& preset) {
  return std::none_of(preset.keys.begin(), preset.keys.end(), [](const PresetKey& key) {
    return key.section == "brush" && key.key == "contrast" && key.value == "0";
  });
}

/// World units from the axis at which the strip goes round once.
float mappingDistance(const LookPreset& preset, const DraftFrame& frame, const DraftThing& thing) {
  if (!hasStrokes(preset)) return 0;
  return stripOnScreen(preset, frame, thing) * thing.pixelWidth / (2.0f * pi);
}

/// The same strokes in fewer pixels.
StripPaintParams halved(StripPaintParams strip) {
  strip.width /= 2;
  strip.height /= 2;
  strip.strokeWidth = std::max(1.0f, 0.5f * strip.strokeWidth);
  strip.strokeLength *= 0.5f;
  strip.toothSize = std::max(1.0f, 0.5f * strip.toothSize);
  return strip;
}

/// Comments begin in one column.
std::string keyLine(const std::string& key, const std::string& value, std::string_view why) {
  const std::string line = fmt::format("{} = {}", key, value);
  return why.empty() ? line + "\n" : fmt::format("{:<32} # {}\n", line, why);
}

/// The least that a key takes.
double leastOf(const PresetKey& key) {
  for (const LookSection& section : lookSections)
    if (section.table->pass == key.section)
      for (const Parameter& parameter : section.table->parameters)
        if (parameter.name == key.key) return parameter.minimum;
  return 0;
}

float pixelsOf(const PresetKey& key, int height) {
  const float least = std::max(0.8f, static_cast<float>(leastOf(key)));
  return std::max(key.ofHeight * static_cast<float>(height), least);
}

std::string valueOf(const PresetKey& key, int height) {
  if (!key.value.empty()) return std::string(key.value);
  const float pixels = pixelsOf(key, height);
  if (key.section == "smooth") return fmt::format("{}", static_cast<int>(std::lround(pixels)));
  return fmt::format("{:.1f}", pixels);
}

std::string sectionsText(const LookPreset& preset, const DraftFrame& frame) {
  const int height = frame.height / frame.scale;
  std::string text, section;
  for (const PresetKey& key : preset.keys) {
    if (key.section == "smooth" && !frame.smooths) continue;
    if (section != key.section) text += fmt::format("\n[{}]\n", section = key.section);
    text += keyLine(std::string(key.key), valueOf(key, height), key.why);
  }
  return text;
}

std::string namesText(const std::vector<std::string>& names) {
  if (names.size() == 1) return tomlString(names.front());
  std::vector<std::string> quoted;
  for (const std::string& name : names) quoted.push_back(tomlString(name));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

std::string hexOf(const V3f& linear) {
  const auto byte = [](float v) {
    return static_cast<int>(std::clamp(srgbOfLinear(v), 0.0f, 1.0f) * 255.0f + 0.5f);
  };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(linear.x), byte(linear.y), byte(linear.z));
}

/// The tone that is brightest on a large thing which is lit less than the rest; 0 for others.
float ownWhite(const DraftFrame& frame, const DraftThing& thing) {
  const double all = static_cast<double>(frame.width) * frame.height;
  if (static_cast<double>(thing.pixels) < 0.1 * all) return 0;
  return thing.brightTone < 0.75f * frame.brightTone ? std::max(headroom * thing.brightTone, 0.2f)
                                                     : 0;
}

/// Width of a thing's outlines, pixels: the preset's, less on things that are narrower than three
/// of them, for lines on both sides would be all that is left; 0 where they would be hairs.
float outlineWidth(const LookPreset& preset, const DraftFrame& frame, const DraftThing& thing) {
  constexpr float narrowest = 3.0f;
  float line = OutlineParams{}.width;
  for (const PresetKey& key : preset.keys)
    if (key.section == "outline" && key.key == "width")
      line = pixelsOf(key, frame.height / frame.scale);
  if (thing.rimPixels == 0) return line;
  const float width = 2.0f * static_cast<float>(thing.pixels) /
                      static_cast<float>(thing.rimPixels * static_cast<size_t>(frame.scale));
  if (width < narrowest) return 0;
  return width < 3.0f * line ? std::max(0.2f * width, 0.5f) : line;
}

std::string outlineText(const LookPreset& preset, const DraftFrame& frame,
                        const DraftThing& thing) {
  if (preset.outlineLightness < 0) return "";
  const float width = outlineWidth(preset, frame, thing);
  if (width <= 0) return "";
  const V3f line = presetOutline(preset, thing.colour);
  std::string text =
      fmt::format("outline_colour = [{:.3f}, {:.3f}, {:.3f}]\n", line.x, line.y, line.z);
  DraftThing broad;
  if (width < outlineWidth(preset, frame, broad))
    text += keyLine("outline.width", fmt::format("{:.1f}", width), "for it is thin");
  return text;
}

std::string styleText(const LookPreset& preset, const DraftFrame& frame, const Style& style) {
  const Group& group = *style.group;
  const double share = 100.0 * static_cast<double>(group.thing.pixels) /
                       (static_cast<double>(frame.width) * frame.height);
  std::string text =
      fmt::format("\n# {:.1f} % of the frame; its colour is {}{}\n[[style]]\n", share,
                  hexOf(group.thing.colour),
                  group.thing.fromBeauty ? ", as the picture shows it, for it has no albedo" : "");
  if (!group.objects.empty()) text += "object = " + namesText(group.objects) + "\n";
  if (!group.materials.empty()) text += "material = " + namesText(group.materials) + "\n";
  if (group.index != 0) text += fmt::format("index = {}\n", group.index);
  text += "strip = " + tomlString(style.strip) + "\n";
  if (style.mappingDistance > 0)
    text += keyLine("brush.mapping_distance", fmt::format("{:.4g}", style.mappingDistance),
                    "world units; twice as much, strokes twice as large");
  if (const float white = ownWhite(frame, group.thing); white > 0)
    text += keyLine("tone.white", fmt::format("{:.2f}", white), "it is lit less than the rest");
  text += outlineText(preset, frame, group.thing);
  return text;
}

std::string headText(const LookPreset& preset, const DraftFrame& frame) {
  const float white = headroom * frame.brightTone;
  return fmt::format(
             "# {}: {}.\n"
             "# Made by `kagefude look new` from {}: colours are the things' own there, sizes fit\n"
             "# its {} x {} pixels. `kagefude passes` lists every key, `kagefude live` turns "
             "them.\n"
             "kagefude = 1\n",
             preset.name, preset.sentence, printable(frame.name), frame.width, frame.height) +
         (frame.scale > 1 ? "\n[output]\n" + keyLine("scale", fmt::format("{}", frame.scale),
                                                     "of frames that were exported larger")
                          : "") +
         (white < 0.99f ? "\n[tone]\n" +
                              keyLine("white", fmt::format("{:.2f}", std::max(white, 0.5f)),
                                      "what is brightest in the frame takes the strips' upper rows")
                        : "") +
         sectionsText(preset, frame);
}

std::string restText(const LookPreset& preset, const std::string& strip) {
  std::string text =
      "\n# What the frame does not show, and has no style above.\n[[style]]\nobject = \"*\"\n"
      "priority = -1\n";
  text += "strip = " + tomlString(strip) + "\n";
  if (preset.inColour) text += keyLine("colour", "\"multiply\"", "by each surface's own colour");
  if (preset.outlineLightness >= 0) {
    const V3f line = presetOutline(preset, V3f(0.2f));
    text += fmt::format("outline_colour = [{:.3f}, {:.3f}, {:.3f}]\n", line.x, line.y, line.z);
  }
  return text;
}

}  // namespace

DraftLook draftLook(const LookPreset& preset, const DraftFrame& frame,
                    const std::string& stripFolder) {
  std::vector<Group> kept;
  for (Group& group : groupThings(frame.things)) {
    Group* const shared = sharedBy(kept, group);
    const bool named = group.index == 0 && (group.objects.empty() || group.materials.empty());
    if (!shared || !named || shared->index != 0 ||
        shared->objects.empty() != group.objects.empty() ||
        shared->materials.empty() != group.materials.empty()) {
      kept.push_back(std::move(group));
      continue;
    }
    shared->objects.insert(shared->objects.end(), group.objects.begin(), group.objects.end());
    shared->materials.insert(shared->materials.end(), group.materials.begin(),
                             group.materials.end());
    addPixels(group.thing, shared->thing);
  }
  DraftLook draft;
  draft.text = headText(preset, frame);
  std::set<std::string> taken{"other"};
  int seed = 0;
  for (const Group& group : kept) {
    const std::string file = freeName(fileStem(group), taken);
    StripPaintParams strip = presetStrip(preset, group.thing.colour, ++seed);
    const bool small =
        2.0f * stripOnScreen(preset, frame, group.thing) < static_cast<float>(strip.width);
    draft.strips.push_back({file, small ? halved(strip) : strip});
    draft.text +=
        styleText(preset, frame,
                  {&group, stripFolder + "/" + file, mappingDistance(preset, frame, group.thing)});
  }
  draft.strips.push_back({"other.png", presetStrip(preset, V3f(1.0f), ++seed)});
  draft.text += restText(preset, stripFolder + "/other.png");
  return draft;
}

}  // namespace kagefude
