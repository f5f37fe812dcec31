#include "live/strip_shelf.h"

#include <algorithm>
#include <set>

#include "compositor/look_colour.h"
#include "live/stage_keys.h"
#include "look/light_strip.h"

namespace kagefude {
namespace {

/// By its name, what each strip is made of.
std::map<std::string, StageKey> stampsOf(const Look& look, const Made<Colour>& colour) {
  std::map<std::string, StageKey> stamps;
  const auto stamp = [&](const std::string& name) {
    StageKey key;
    key.add(colour.version).add(look.colour.strip).add(look.folder.native());
    if (!isBuiltinStrip(name)) addFile(key, look.resolve(name));
    stamps.insert_or_assign(name, std::move(key));
  };
  stamp(StyleParams{}.strip);
  for (const std::string& name : paintedFiles(look)) stamp(name);
  return stamps;
}

size_t bytesOf(const Strip& strip) {
  constexpr size_t bytesOfPixel = 30;  // strip.h
  return bytesOfPixel * static_cast<size_t>(strip.width()) * static_cast<size_t>(strip.height());
}

}  // namespace

const Made<Colour>& StripShelf::colourOf(const Look& look, StageRun& run) {
  StageKey config;
  config.add(look.colourConfig());
  addFile(config, look.colourConfig());
  return colour_.at(run, "colour", std::move(config), [&] { return kagefude::colourOf(look); });
}

Made<StripSet> StripShelf::stripsOf(const Look& look, const Made<Colour>& colour, StageRun& run) {
  std::map<std::string, StageKey> stamps = stampsOf(look, colour);
  // In the order of the styles, which is that of the strips' numbers.
  StageKey key;
  for (const std::string& name : paintedFiles(look)) key.add(name).add(stamps[name]);
  key.add(colour.version).add(look.output.background == Background::picture);
  if (set_ && key == key_) return {set_, version_};
  if (run.stop.stop_requested()) throw Superseded();
  // What can fail comes first, so that the set stays as it was.
  StripSet::Loaded fresh = loadMissing(look, *colour, stamps);
  putAside();
  StripSet::Loaded loaded = takeSpare(stamps);
  loaded.merge(fresh);
  set_ = std::make_shared<StripSet>(look, *colour, loaded);
  letGo();
  colourOfSet_ = colour.value;
  key_ = std::move(key);
  stamps_ = std::move(stamps);
  version_ = nextVersion();
  run.made.push_back("strips");
  return {set_, version_};
}

/// The strips that are neither in the set nor spare, or were made of something else.
StripSet::Loaded StripShelf::loadMissing(Look look, const Colour& colour,
                                         const std::map<std::string, StageKey>& stamps) const {
  const auto isThere = [&](const std::string& name) {
    const StageKey& wanted = stamps.at(name);
    const auto inSet = stamps_.find(name);
    return (set_ && inSet != stamps_.end() && inSet->second == wanted) ||
           std::any_of(spare_.begin(), spare_.end(), [&](const Spare& spare) {
             return spare.name == name && spare.stamp == wanted;
           });
  };
  for (StyleLook& style : look.styles)
    std::erase_if(style.style.lightStrips, [&](const std::string& entry) {
      const std::string strip = lightStripFrom(entry).strip;
      return strip.empty() || isThere(strip);
    });
  // Entries stay, for messages say where in the look the others stand.
  for (StyleLook& style : look.styles)
    if (isThere(style.style.strip)) style.style.strip = StyleParams{}.strip;  // loads nothing
  for (LightLook& light : look.lights)
    if (!light.light.strip.empty() && isThere(light.light.strip)) light.light.strip.clear();
  if (const std::string ground = groundFile(look); !ground.empty() && isThere(ground))
    look.output.background = Background::beauty;  // shows no file of its own
  return StripSet(look, colour).release();
}

/// The set's strips become spare ones.
void StripShelf::putAside() {
  if (!set_) return;
  for (auto& [name, strip] : set_->release())
    spare_.push_front({name, stamps_[name], std::move(strip)});
  set_.reset();
}

/// Those that would be loaded alike.
StripSet::Loaded StripShelf::takeSpare(const std::map<std::string, StageKey>& stamps) {
  StripSet::Loaded loaded;
  for (auto spare = spare_.begin(); spare != spare_.end();) {
    const auto wanted = stamps.find(spare->name);
    const bool fits = wanted != stamps.end() && wanted->second == spare->stamp;
    if (fits) loaded.emplace(spare->name, std::move(spare->strip));
    spare = fits ? spare_.erase(spare) : spare + 1;
  }
  return loaded;
}

/// The oldest go, and those whose file has changed since: another one of the name has followed.
void StripShelf::letGo() {
  size_t bytes = 0;
  std::set<std::string> seen;
  for (auto spare = spare_.begin(); spare != spare_.end();) {
    const bool newest = seen.insert(spare->name).second;
    if (newest) bytes += bytesOf(spare->strip);
    spare = newest && bytes <= mostSpare_ ? spare + 1 : spare_.erase(spare);
  }
}

}  // namespace kagefude
