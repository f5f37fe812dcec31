#include "sequence/check_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/nearest_name.h"
#include "compositor/motion_frame.h"
#include "exr/read_channels.h"
#include "passes/measure/stroke_measure.h"
#include "sequence/frame_range.h"

namespace kagefude {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// One finished frame with what is known of its surfaces.
struct Finished {
  Vec3Plane picture;
  Floats tone;
  MotionFrame motion;
  Vec3Plane plain;
};

std::vector<int> framesOf(const CheckRequest& request) {
  if (!request.comped.hasFrame() || !request.aovs.hasFrame())
    throw UsageError(
        fmt::format("{} names one file; a sequence is wanted, such as shot.####.exr",
                    (request.comped.hasFrame() ? request.aovs : request.comped).text()));
  std::vector<int> frames;
  if (request.frames)
    frames = *request.frames;
  else
    for (const auto& [frame, path] : request.comped.scan()) frames.push_back(frame);
  std::sort(frames.begin(), frames.end());
  if (frames.size() < 2)
    throw UsageError(fmt::format("{} gives {} frames; at least two are compared",
                                 request.comped.text(), frames.size()));
  for (size_t i = 1; i < frames.size(); ++i)
    if (frames[i] != frames[i - 1] + 1)
      throw UsageError(
          fmt::format("frame {} does not follow frame {}: motion vectors reach back by one frame, "
                      "so {} is needed (give --frames)",
                      frames[i], frames[i - 1], describeFrames({frames[i - 1] + 1})));
  return frames;
}

std::filesystem::path existing(const FramePattern& pattern, int frame) {
  const std::filesystem::path path = pattern.path(frame);
  if (!std::filesystem::exists(path))
    throw InputError(fmt::format("frame {}: {} is missing", frame, path.string()));
  return path;
}

Vec3Plane readUnstyled(const FramePattern& pattern, int frame, const Finished& finished) {
  const ImageFile image = openImage(existing(pattern, frame));
  if (image.width != finished.tone.width() || image.height != finished.tone.height())
    throw InputError(fmt::format("frame {}: {} is of {}x{} pixels, and the styled frame of {}x{}",
                                 frame, image.path.string(), image.width, image.height,
                                 finished.tone.width(), finished.tone.height()));
  std::vector<Floats> planes = readFloats(image, std::vector<std::string>{"R", "G", "B"});
  Vec3Plane result;
  result.x = std::move(planes[0]);
  result.y = std::move(planes[1]);
  result.z = std::move(planes[2]);
  return result;
}

Finished readFinished(const CheckRequest& request, int frame) {
  const ImageFile image = openImage(existing(request.comped, frame));
  if (!image.findChannel(request.tone))
    throw InputError(fmt::format(
        "frame {}: {} has no layer {} (channels: {}){}; comp with output.layers = [\"{}\"]", frame,
        image.path.string(), request.tone, listNames(image.channelNames()),
        didYouMean(request.tone, image.channelNames()), request.tone));
  const std::vector<std::string> names{"R", "G", "B", request.tone};
  std::vector<Floats> planes = readFloats(image, names);
  Finished result;
  result.picture.x = std::move(planes[0]);
  result.picture.y = std::move(planes[1]);
  result.picture.z = std::move(planes[2]);
  result.tone = std::move(planes[3]);
  result.motion = readMotionFrame(request.look, existing(request.aovs, frame), frame);
  if (result.motion.ids.width() != image.width || result.motion.ids.height() != image.height)
    throw InputError(fmt::format("frame {}: {} is of {}x{} pixels, and its rendered frame of {}x{}",
                                 frame, image.path.string(), image.width, image.height,
                                 result.motion.ids.width(), result.motion.ids.height()));
  return result;
}

double errorOf(const Vec3Plane& now, const Vec3Plane& before, const PreviousPlaces& places) {
  const View<const float> current[] = {now.x, now.y, now.z};
  const View<const float> previous[] = {before.x, before.y, before.z};
  const WarpError error = warpError(current, previous, places);
  return error.pixels > 0 ? error.rmse : unknown;
}

Floats difference(View<const float> a, View<const float> b) {
  Floats result(a.width, a.height);
  for (size_t i = 0; i < a.pixels(); ++i) result.row(0)[i] = a.data[i] - b.data[i];
  return result;
}

/// The picture less what it would be without strokes.
Vec3Plane strokesOf(const Finished& frame) {
  Vec3Plane strokes;
  strokes.x = difference(frame.picture.x, frame.plain.x);
  strokes.y = difference(frame.picture.y, frame.plain.y);
  strokes.z = difference(frame.picture.z, frame.plain.z);
  return strokes;
}

CheckedFrame compareFrames(int frame, const Finished& now, const Finished* before,
                           StrokeMoves& moves) {
  CheckedFrame checked;
  checked.frame = frame;
  checked.picture = checked.plain = checked.tone = checked.strokes = unknown;
  const StrokeMeasure strokes = measureStrokes(now.motion.ids, now.picture, now.plain);
  checked.contrast = strokes.contrast;
  checked.grain = strokes.grain;
  if (!before) return checked;
  const PreviousPlaces places = previousPlaces(now.motion, before->motion);
  checked.picture = errorOf(now.picture, before->picture, places);
  checked.plain = errorOf(now.plain, before->plain, places);
  const Vec3Plane own = strokesOf(now), ownBefore = strokesOf(*before);
  const View<const float> current[] = {own.x, own.y, own.z};
  const View<const float> previous[] = {ownBefore.x, ownBefore.y, ownBefore.z};
  const WarpError change = warpError(current, previous, places);
  if (change.pixels > 0) checked.strokes = change.rmse;
  moves.add(frame, now.motion.ids, own, change);
  const View<const float> tone[] = {now.tone}, toneBefore[] = {before->tone};
  const WarpError error = warpError(tone, toneBefore, places);
  if (error.pixels > 0) checked.tone = error.rmse;
  const View<const uint32_t> ids = now.motion.ids;
  const auto background = std::count(ids.data, ids.data + ids.pixels(), 0u);
  const double surfaces = static_cast<double>(ids.pixels()) - static_cast<double>(background);
  checked.compared = surfaces > 0 ? static_cast<double>(places.pixels) / surfaces : 0;
  return checked;
}

std::vector<double> known(const std::vector<CheckedFrame>& frames, double CheckedFrame::*value) {
  std::vector<double> values;
  for (const CheckedFrame& frame : frames)
    if (std::isfinite(frame.*value)) values.push_back(frame.*value);
  return values;
}

double meanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

void spread(const std::vector<double>& values, double& median, double& low, double& high) {
  median = medianOf(values);
  if (!(median > 0)) return;
  low = *std::min_element(values.begin(), values.end()) / median;
  high = *std::max_element(values.begin(), values.end()) / median;
}

void summarise(CheckResult& result) {
  const std::vector<double> pictures = known(result.frames, &CheckedFrame::picture);
  result.picture = meanOf(pictures);
  result.plain = meanOf(known(result.frames, &CheckedFrame::plain));
  result.tone = meanOf(known(result.frames, &CheckedFrame::tone));
  result.strokes = meanOf(known(result.frames, &CheckedFrame::strokes));
  result.excess = result.picture - result.plain;
  result.median = medianOf(pictures);
  for (const CheckedFrame& frame : result.frames)
    if (frame.picture > 0 && frame.picture / result.median > result.jump) {
      result.jump = frame.picture / result.median;
      result.jumpFrame = frame.frame;
    }
  spread(known(result.frames, &CheckedFrame::contrast), result.contrast, result.contrastLow,
         result.contrastHigh);
  spread(known(result.frames, &CheckedFrame::grain), result.grain, result.grainLow,
         result.grainHigh);
}

}  // namespace

CheckResult checkSequence(const CheckRequest& request) {
  const std::vector<int> frames = framesOf(request);
  for (const int frame : frames) existing(request.comped, frame);  // before any is worked on
  ToneColours colours;
  for (const int frame : frames) {
    if (request.unstyled) break;
    const Finished finished = readFinished(request, frame);
    colours.add(finished.motion.ids, finished.tone, finished.picture);
  }
  CheckResult result;
  StrokeMoves moves;
  std::map<uint32_t, std::string> names;
  std::optional<Finished> before;
  for (const int frame : frames) {
    Finished now = readFinished(request, frame);
    now.plain = request.unstyled ? readUnstyled(*request.unstyled, frame, now)
                                 : colours.plain(now.motion.ids, now.tone);
    result.frames.push_back(compareFrames(frame, now, before ? &*before : nullptr, moves));
    names.insert(now.motion.names.begin(), now.motion.names.end());
    if (before && before->motion.sidecar && now.motion.sidecar && !request.look.scene.sizes())
      noteShotBreaks(*before->motion.sidecar, *now.motion.sidecar, frame, result.breaks);
    before = std::move(now);
  }
  summarise(result);
  result.objects = moves.objects(names);
  result.moves = moves.picture();
  return result;
}

}  // namespace kagefude
