#include "compositor/look_use.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/glob.h"
#include "base/nearest_name.h"

namespace kagefude {
namespace {

using Names = std::set<std::string>;

void join(std::vector<bool>& all, const std::vector<bool>& more) {
  all.resize(std::max(all.size(), more.size()));
  for (size_t i = 0; i < more.size(); ++i)
    if (more[i]) all[i] = true;
}

Names namesIn(const std::map<uint32_t, std::string>& listed) {
  Names names;
  for (const auto& [id, name] : listed) names.insert(name);
  return names;
}

bool matchesSome(const std::vector<std::string>& patterns, const Names& names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return matchesAny(name, patterns); });
}

bool isListed(const StyleParams& style, const FramePlan& plan, const LookUse& use) {
  if (style.index != 0)
    return plan.sidecar && plan.sidecar->findObject(static_cast<uint32_t>(style.index));
  return (style.object.empty() || matchesSome(style.object, use.objects)) &&
         (style.material.empty() || matchesSome(style.material, use.materials));
}

std::vector<bool> fitting(const std::vector<std::string>& patterns, const Names& names) {
  std::vector<bool> result;
  for (const std::string& pattern : patterns) result.push_back(matchesSome({pattern}, names));
  return result;
}

std::string nearest(const std::vector<std::string>& wanted, const Names& known) {
  const std::vector<std::string> names(known.begin(), known.end());
  for (const std::string& name : wanted)
    if (const std::string hint = didYouMean(name, names); !hint.empty()) return hint;
  return fmt::format(" (there: {})", listNames(names));
}

std::string describe(const StyleParams& style, const LookUse& use) {
  if (style.index != 0) return fmt::format("index {}", style.index);
  std::string text;
  if (!style.object.empty())
    text = fmt::format("object {}{}", listNames(style.object), nearest(style.object, use.objects));
  if (!style.material.empty())
    text += fmt::format("{}material {}{}", text.empty() ? "" : ", ", listNames(style.material),
                        nearest(style.material, use.materials));
  return text;
}

void addUnfit(const char* key, const std::vector<std::string>& patterns,
              const std::vector<bool>& fits, const Names& known, std::vector<std::string>& texts) {
  for (size_t i = 0; i < patterns.size() && i < fits.size(); ++i)
    if (!fits[i])
      texts.push_back(fmt::format("{} names {}, which fits nothing in the whole run{}", key,
                                  patterns[i], nearest({patterns[i]}, known)));
}

}  // namespace

void LookUse::add(const LookUse& other) {
  join(styles, other.styles);
  join(lights, other.lights);
  join(shadowLights, other.shadowLights);
  objects.insert(other.objects.begin(), other.objects.end());
  materials.insert(other.materials.begin(), other.materials.end());
  lightNames.insert(other.lightNames.begin(), other.lightNames.end());
}

LookUse lookUse(const Look& look, const FramePlan& plan, std::vector<bool> styles) {
  LookUse use;
  use.objects = namesIn(plan.listedNames);
  use.materials = namesIn(plan.listedMaterials);
  for (const FrameLight& light : plan.lights) use.lightNames.insert(light.name);
  if (plan.sidecar)
    for (const SidecarLight& light : plan.sidecar->lights) use.lightNames.insert(light.name);
  use.styles = std::move(styles);
  use.styles.resize(look.styles.size());
  for (size_t i = 0; i < look.styles.size(); ++i)
    if (isListed(look.styles[i].style, plan, use)) use.styles[i] = true;
  for (const LightLook& light : look.lights)
    // One that the look describes whole is a light, also where it is switched off.
    use.lights.push_back(!light.light.position.empty() || !light.light.direction.empty() ||
                         matchesSome({light.light.name}, use.lightNames));
  use.shadowLights = fitting(look.shadow.lights, use.lightNames);
  return use;
}

std::vector<std::string> unusedEntries(const Look& look, const LookUse& use) {
  std::vector<std::string> texts;
  for (size_t i = 0; i < use.styles.size(); ++i)
    if (!use.styles[i])
      texts.push_back(fmt::format("style {} fits nothing in the whole run: {}", i + 1,
                                  describe(look.styles[i].style, use)));
  std::vector<std::string> lights;
  for (const LightLook& light : look.lights) lights.push_back(light.light.name);
  addUnfit("a [[light]]", lights, use.lights, use.lightNames, texts);
  addUnfit("shadow.lights", look.shadow.lights, use.shadowLights, use.lightNames, texts);
  return texts;
}

}  // namespace kagefude
