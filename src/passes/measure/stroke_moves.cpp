#include "passes/measure/stroke_moves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kagefude {

double StrokeMoves::Sum::ratio() const { return strokes > 0 ? std::sqrt(change / strokes) : 0; }

void StrokeMoves::add(int frame, View<const uint32_t> ids, Vec3View strokes,
                      const WarpError& error) {
  std::map<uint32_t, Sum> sums;
  for (int y = 0; y < ids.height; ++y)
    for (int x = 0; x < ids.width; ++x) {
      const float change = error.perPixel(x, y);
      if (!(change >= 0.0f)) continue;
      const V3d here(strokes(x, y));
      Sum& sum = sums[ids(x, y)];
      sum.change += double{change} * double{change};
      sum.strokes += here.dot(here) / 3;
      ++sum.pixels;
      if (change <= sum.most) continue;
      sum.most = change;
      sum.x = x;
      sum.y = y;
    }
  for (const auto& [id, sum] : sums) {
    if (sum.pixels < fewest) continue;
    Object& object = objects_[id];
    object.all.change += sum.change;
    object.all.strokes += sum.strokes;
    object.all.pixels += sum.pixels;
    if (sum.ratio() <= object.worst) continue;
    object.worst = sum.ratio();
    object.worstFrame = frame;
    object.x = sum.x;
    object.y = sum.y;
  }
  addPicture(ids, error, sums);
}

void StrokeMoves::addPicture(View<const uint32_t> ids, const WarpError& error,
                             const std::map<uint32_t, Sum>& sums) {
  if (squares_.empty()) {
    squares_ = Floats(ids.width, ids.height, 0.0f);
    counts_ = Floats(ids.width, ids.height, 0.0f);
  }
  for (int y = 0; y < ids.height; ++y)
    for (int x = 0; x < ids.width; ++x) {
      const float change = error.perPixel(x, y);
      if (!(change >= 0.0f)) continue;
      const Sum& sum = sums.at(ids(x, y));
      const double own = sum.strokes / static_cast<double>(sum.pixels);
      if (own > 0) squares_(x, y) += static_cast<float>(double{change} * double{change} / own);
      counts_(x, y) += 1.0f;
    }
}

std::vector<ObjectMoves> StrokeMoves::objects(const std::map<uint32_t, std::string>& names) const {
  std::vector<ObjectMoves> result;
  for (const auto& [id, object] : objects_) {
    const auto name = names.find(id);
    const auto pixels = static_cast<double>(object.all.pixels);
    result.push_back({id, name == names.end() ? "" : name->second, object.all.pixels,
                      std::sqrt(object.all.change / pixels), object.all.ratio(), object.worst,
                      object.worstFrame, object.x, object.y});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const ObjectMoves& a, const ObjectMoves& b) { return a.ratio > b.ratio; });
  return result;
}

Floats StrokeMoves::picture() const {
  if (squares_.empty()) return {};
  Floats result(squares_.width(), squares_.height(), std::numeric_limits<float>::quiet_NaN());
  for (size_t i = 0; i < squares_.view().pixels(); ++i)
    if (counts_.row(0)[i] > 0.0f)
      result.row(0)[i] = std::sqrt(squares_.row(0)[i] / counts_.row(0)[i]);
  return result;
}

}  // namespace kagefude
