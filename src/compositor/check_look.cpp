#include "compositor/check_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/frame_pattern.h"
#include "base/nearest_name.h"
#include "compositor/compose_frame.h"
#include "compositor/look_colour.h"
#include "compositor/look_use.h"
#include "compositor/read_frame.h"
#include "look/look_keys.h"

namespace kagefude {
namespace {

struct Comp {
  FrameResult result;
  LookUse use;
};

/// Of each style, over all frames.
struct StylesSeen {
  std::vector<bool> fit, paint, outranked;

  void add(const FrameResult& result) {
    fit.resize(result.fittingStyles.size());
    paint.resize(fit.size());
    outranked.resize(fit.size());
    for (size_t i = 0; i < fit.size(); ++i) {
      if (result.fittingStyles[i]) fit[i] = true;
      if (result.paintingStyles[i]) paint[i] = true;
      if (result.outrankedStyles[i]) outranked[i] = true;
    }
  }
};

Comp comp(const Look& look, const std::filesystem::path& frame) {
  const Colour colour = colourOf(look);
  const StripSet strips(look, colour);
  const FramePlan plan = planFrame(look, frame, frameNumberOf(frame.string()).value_or(1));
  Comp done{composeFrame(look, strips, plan, readFramePlanes(plan)), {}};
  done.use = lookUse(look, plan, done.result.fittingStyles);
  return done;
}

bool sameBits(View<const float> a, View<const float> b) {
  return a.width == b.width && a.height == b.height &&
         std::memcmp(a.data, b.data, a.pixels() * sizeof(float)) == 0;
}

bool samePicture(const FrameResult& a, const FrameResult& b) {
  return sameBits(a.colour.x, b.colour.x) && sameBits(a.colour.y, b.colour.y) &&
         sameBits(a.colour.z, b.colour.z) && sameBits(a.alpha, b.alpha);
}

/// The entry that a key belongs to: "style", 2 of "style[2].tone.gamma".
struct Entry {
  std::string list;
  size_t index = 0;
  std::string key;  ///< within it
};
std::optional<Entry> entryOf(const std::string& name) {
  const size_t open = name.find('['), close = name.find("].");
  if (open == std::string::npos || close == std::string::npos) return {};
  return Entry{name.substr(0, open), std::stoul(name.substr(open + 1, close - open - 1)),
               name.substr(close + 2)};
}

/// What a style is for, in parentheses.
std::string namesOf(const StyleParams& style) {
  if (style.index != 0) return fmt::format("(index {})", style.index);
  std::string text;
  if (!style.object.empty()) text = "object " + listNames(style.object);
  if (!style.material.empty())
    text += (text.empty() ? "material " : ", material ") + listNames(style.material);
  return text.empty() ? "(everything)" : "(" + text + ")";
}

/// Styles that fit and paint nothing: those that never will are problems.
void addIdleStyles(const Look& look, const LookUse& use, const StylesSeen& seen, LookCheck& check) {
  for (size_t i = 0; i < look.styles.size(); ++i) {
    if (!use.styles[i] || seen.paint[i]) continue;
    const std::string name = fmt::format("style {} {}", i + 1, namesOf(look.styles[i].style));
    if (!seen.fit[i])
      check.waiting.push_back(name + ": its things are not seen");
    else if (seen.outranked[i])
      check.waiting.push_back(name + ": styles of higher priority paint all that is seen of it");
    else
      check.problems.push_back(
          name + " paints nothing: styles of the same priority come first wherever it fits");
  }
}

/// "style.tone.gamma" of "style[2].tone.gamma"; "" for keys of the whole look.
std::string keyInEntries(const std::string& name) {
  const std::optional<Entry> entry = entryOf(name);
  return entry ? entry->list + "." + entry->key : "";
}

bool isTried(const std::string& name, const LookUse& use, const StylesSeen& seen) {
  const std::optional<Entry> entry = entryOf(name);
  if (!entry) {
    for (const char* key :
         {"output.layers", "output.passthrough", "output.colour", "output.compression",
          "output.quality", "output.scale", "colour.display", "colour.view", "shadow.lights"})
      if (name == key) return false;
    return true;
  }
  const std::vector<bool>& fitting = entry->list == "style" ? use.styles : use.lights;
  if (entry->index < fitting.size() && !fitting[entry->index]) return false;
  if (entry->list == "style" && entry->index < seen.paint.size() && !seen.paint[entry->index])
    return false;
  if (entry->list == "style" && entry->key == "strip") return false;
  for (const char* key : {"object", "material", "index", "name"})
    if (entry->key == key) return false;
  return true;
}

/// Whether the picture of a frame changes without the key; a frame that cannot be comped without it
/// needs it.
bool matters(const Look& without, const std::filesystem::path& frame, const FrameResult& picture) {
  try {
    return !samePicture(comp(without, frame).result, picture);
  } catch (const Error&) {
    return true;
  }
}

std::optional<Look> lookWithout(std::string_view text, const std::filesystem::path& path,
                                const std::string& key) {
  try {
    return readLookText(withoutKey(text, path, key), path, {});
  } catch (const LookError&) {
    return {};  // the others are wrong without it
  }
}

}  // namespace

LookCheck checkLook(std::string_view text, const std::filesystem::path& path,
                    std::span<const std::filesystem::path> frames,
                    const std::function<void(size_t done, size_t all)>& progress) {
  const Look look = readLookText(text, path, {});
  LookCheck check;
  LookUse use;
  StylesSeen seen;
  for (const auto& frame : frames) {
    const Comp whole = comp(look, frame);
    use.add(whole.use);
    seen.add(whole.result);
  }
  check.problems = unusedEntries(look, use);
  addIdleStyles(look, use, seen, check);
  std::vector<std::string> open;  // keys of which no frame has shown an effect
  for (const std::string& key : keysOf(text, path)) {
    if (!isTried(key, use, seen)) continue;
    const std::optional<Look> without = lookWithout(text, path, key);
    if (without && resolvedText(*without) == resolvedText(look))
      check.defaults.push_back(key);
    else if (without)
      open.push_back(key);
  }
  const size_t all = open.size() * frames.size();
  size_t done = 0;
  std::set<std::string> acting;  // keys that act in some entry
  for (const auto& frame : frames) {
    if (open.empty()) break;
    const FrameResult picture = comp(look, frame).result;
    std::erase_if(open, [&](const std::string& key) {
      progress(++done, all);
      const bool acts = matters(*lookWithout(text, path, key), frame, picture);
      if (acts) acting.insert(keyInEntries(key));
      return acts;
    });
  }
  for (const std::string& key : open) {
    const bool elsewhere = acting.contains(keyInEntries(key)) && entryOf(key);
    std::vector<std::string>& list = elsewhere ? check.waiting : check.problems;
    list.push_back(fmt::format("{} changes nothing in {}{}", key,
                               frames.size() == 1 ? "this frame" : "these frames",
                               elsewhere ? ", as it does for others" : ""));
  }
  return check;
}

}  // namespace kagefude
