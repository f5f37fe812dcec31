#include "live/live_frame.h"

#include "compositor/read_frame.h"
#include "compositor/scale_down.h"
#include "live/proxy.h"
#include "live/stage_keys.h"

namespace kagefude {
namespace {

void addStrips(StageKey& key, const Look& look) {
  key.add(look.folder.native()).add(look.colour.strip).add(look.styles.size());
  for (const StyleLook& style : look.styles) {
    key.add(style.style.strip);
    if (!isBuiltinStrip(style.style.strip)) addFile(key, look.resolve(style.style.strip));
  }
}

}  // namespace

const Made<LiveStrips>& StripShelf::stripsOf(const Look& look, StageRun& run) {
  StageKey config;
  config.add(look.colourConfig());
  addFile(config, look.colourConfig());
  const Made<Colour> colour =
      colour_.at(run, "colour", std::move(config), [&] { return Colour(look.colourConfig()); });
  StageKey strips;
  strips.add(colour.version);
  addStrips(strips, look);
  return strips_.at(run, "strips", std::move(strips),
                    [&] { return std::make_shared<const LiveStrips>(look, colour.value); });
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
  picture.strips = shelf.stripsOf(look, run);
  picture.step = size > 0 ? proxyStep(planes->width, planes->height, size) : 1;
  if (picture.step == 1) {
    picture.stages = whole_.compose(inRenderedPixels(look), picture.strips, plan, planes, run);
    picture.plan = std::make_shared<const FramePlan>(std::move(plan));
  } else {
    StageKey sampling;
    sampling.add(planes.version).add(picture.step);
    const Made<FramePlanes> samples = samples_.at(
        run, "sample", std::move(sampling), [&] { return sampleFrame(*planes, picture.step); });
    plan = samplePlan(std::move(plan), picture.step);
    picture.stages =
        proxy_.compose(sampleLook(look, picture.step), picture.strips, plan, samples, run);
    picture.plan = std::make_shared<const FramePlan>(std::move(plan));
  }
  picture.made = std::move(run.made);
  return picture;
}

}  // namespace kagefude
