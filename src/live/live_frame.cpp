#include "live/live_frame.h"

#include <set>

#include "compositor/read_frame.h"
#include "compositor/scale_down.h"
#include "live/proxy.h"
#include "live/stage_keys.h"

namespace kagefude {
namespace {

/// By its name, what each strip is made of.
std::map<std::string, StageKey> stampsOf(const Look& look, const Made<Colour>& colour) {
  std::map<std::string, StageKey> stamps;
  for (const std::string& name : paintedFiles(look)) {
    StageKey& stamp = stamps[name];
    stamp.add(colour.version).add(look.colour.strip).add(look.folder.native());
    if (!isBuiltinStrip(name)) addFile(stamp, look.resolve(name));
  }
  stamps[StyleParams{}.strip].add(colour.version);
  return stamps;
}

}  // namespace

const Made<Colour>& StripShelf::colourOf(const Look& look, StageRun& run) {
  StageKey config;
  config.add(look.colourConfig());
  addFile(config, look.colourConfig());
  return colour_.at(run, "colour", std::move(config), [&] { return Colour(look.colourConfig()); });
}

Made<StripSet> StripShelf::stripsOf(const Look& look, const Made<Colour>& colour, StageRun& run) {
  std::map<std::string, StageKey> stamps = stampsOf(look, colour);
  // In the order of the styles, which is that of the strips' numbers.
  StageKey key;
  for (const std::string& name : paintedFiles(look)) key.add(name).add(stamps[name]);
  key.add(colour.version).add(look.output.background == Background::picture);
  if (set_ && key == key_) return {set_, version_};
  if (run.stop.stop_requested()) throw Superseded();
  std::set<std::string> kept;
  for (const auto& [name, stamp] : stamps_)
    if (const auto now = stamps.find(name); now != stamps.end() && now->second == stamp)
      kept.insert(name);
  set_ = set_ ? std::make_shared<StripSet>(look, *colour, *set_, kept)
              : std::make_shared<StripSet>(look, *colour);
  colourOfSet_ = colour.value;
  key_ = std::move(key);
  stamps_ = std::move(stamps);
  version_ = nextVersion();
  run.made.push_back("strips");
  return {set_, version_};
}

LivePicture LiveFrame::compose(const Look& look, StripShelf& shelf, int size,
                               std::stop_token stop) {
  StageRun run{std::move(stop)};
  LivePicture picture;
  picture.look = std::make_shared<const Look>(look);
  FramePlan plan = planFrame(look, path_, frame_, view_);
  StageKey reading;
  addReading(reading, look, plan);
  const Made<FramePlanes> planes =
      planes_.at(run, "read", std::move(reading), [&] { return readFramePlanes(plan); });
  picture.colour = shelf.colourOf(look, run);
  const Made<StripSet> strips = shelf.stripsOf(look, picture.colour, run);
  picture.step = size > 0 ? proxyStep(planes->width, planes->height, size) : 1;
  if (picture.step == 1) {
    picture.stages = whole_.compose(inRenderedPixels(look), strips, plan, planes, run);
    picture.plan = std::make_shared<const FramePlan>(std::move(plan));
  } else {
    StageKey sampling;
    sampling.add(planes.version).add(picture.step);
    const Made<FramePlanes> samples = samples_.at(
        run, "sample", std::move(sampling), [&] { return sampleFrame(*planes, picture.step); });
    plan = samplePlan(std::move(plan), picture.step);
    picture.stages = proxy_.compose(sampleLook(look, picture.step), strips, plan, samples, run);
    picture.plan = std::make_shared<const FramePlan>(std::move(plan));
  }
  picture.made = std::move(run.made);
  return picture;
}

}  // namespace kagefude
