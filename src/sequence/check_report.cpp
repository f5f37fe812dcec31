#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/printed_json.h"
#include "base/temp_file.h"
#include "picture/draw_plot.h"
#include "picture/png_file.h"
#include "sequence/check_sequence.h"

namespace kagefude {
namespace {

// A value that is not known becomes null.
nlohmann::ordered_json frameJson(const CheckedFrame& f) {
  return {{"frame", f.frame},     {"compared", f.compared}, {"picture", f.picture},
          {"unstyled", f.plain},  {"tone", f.tone},         {"strokes", f.strokes},
          {"excess", f.excess()}, {"contrast", f.contrast}, {"grain", f.grain}};
}

nlohmann::ordered_json objectJson(const ObjectMoves& o) {
  return {{"name", o.name},
          {"pixels", o.pixels},
          {"change", o.change},
          {"ratio", o.ratio},
          {"worst_frame", o.worstFrame},
          {"worst_ratio", o.worst},
          {"worst_pixel", {o.worstX, o.worstY}}};
}

uint16_t sample(float value) {
  return static_cast<uint16_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

}  // namespace

std::string checkJson(const CheckResult& r) {
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  for (const CheckedFrame& frame : r.frames) frames.push_back(frameJson(frame));
  nlohmann::ordered_json objects = nlohmann::ordered_json::array();
  for (const ObjectMoves& object : r.objects) objects.push_back(objectJson(object));
  nlohmann::ordered_json breaks = nlohmann::ordered_json::array();
  for (const ShotBreak& found : r.breaks)
    breaks.push_back({{"frames", found.frames}, {"says", found.sentence()}});
  const nlohmann::ordered_json json = {
      {"warp_error",
       {{"picture", r.picture},
        {"unstyled", r.plain},
        {"tone", r.tone},
        {"strokes", r.strokes},
        {"excess", r.excess}}},
      {"jump", {{"largest_to_median", r.jump}, {"frame", r.jumpFrame}, {"median", r.median}}},
      {"strokes",
       {{"contrast", {{"median", r.contrast}, {"low", r.contrastLow}, {"high", r.contrastHigh}}},
        {"grain", {{"median", r.grain}, {"low", r.grainLow}, {"high", r.grainHigh}}}}},
      {"objects", objects},
      {"breaks", breaks},
      {"frames", frames}};
  return printedJson(json);
}

void drawMoves(const CheckResult& result, const std::filesystem::path& path) {
  constexpr float unrelated = 1.41421356f;
  constexpr uint16_t notCompared = 64;
  PngPicture picture{result.moves.width(), result.moves.height(), 3, 8, {}};
  for (size_t i = 0; i < result.moves.view().pixels(); ++i) {
    const float move = 3 * result.moves.row(0)[i] / unrelated;
    for (int channel = 0; channel < 3; ++channel)
      picture.samples.push_back(std::isnan(move) ? notCompared
                                                 : sample(move - static_cast<float>(channel)));
  }
  const std::vector<unsigned char> bytes = encodePng(picture, {});
  writeFileAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void plotCheck(const CheckResult& result, const std::filesystem::path& path) {
  std::vector<int> places;
  PlotCurve picture{"finished picture", {0.95f, 0.62f, 0.25f}, {}},
      plain{"unstyled tone", {0.45f, 0.70f, 0.90f}, {}},
      excess{"excess", {0.60f, 0.85f, 0.45f}, {}};
  PlotCurve strokes{"strokes alone", {0.60f, 0.60f, 0.60f}, {}};
  PlotCurve contrast{"contrast of the strokes", {0.90f, 0.50f, 0.60f}, {}};
  PlotCurve grain{"grain in pixels", {0.75f, 0.65f, 0.95f}, {}};
  for (const CheckedFrame& frame : result.frames) {
    places.push_back(frame.frame);
    picture.values.push_back(frame.picture);
    plain.values.push_back(frame.plain);
    excess.values.push_back(frame.excess());
    strokes.values.push_back(frame.strokes);
    contrast.values.push_back(frame.contrast);
    grain.values.push_back(frame.grain);
  }
  writePlot(path, places,
            {{"Warp error against the frame before (scene-linear, RMS)",
              {picture, plain, excess, strokes}},
             {"Strokes: RMS luminance, of the picture's", {contrast}},
             {"Strokes: mean wavelength", {grain}}});
}

}  // namespace kagefude
