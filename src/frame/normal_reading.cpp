#include "frame/normal_reading.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "base/error.h"

namespace kagefude::detail {
namespace {

std::string spellAxes(const NormalReading& reading) {
  std::string text;
  for (size_t i = 0; i < 3; ++i)
    text +=
        fmt::format("{}{}{}", i ? " " : "", reading.sign[i] < 0 ? "-" : "", "xyz"[reading.axis[i]]);
  return text;
}

bool hasOwnAxes(const NormalReading& reading) { return spellAxes(reading) != "x y z"; }

}  // namespace

V3f NormalReading::operator()(const V3f& given) const {
  const V3f v = unit ? given * 2.0f - V3f(1.0f) : given;
  const V3f picked(sign[0] * v[axis[0]], sign[1] * v[axis[1]], sign[2] * v[axis[2]]);
  if (!worldFromCamera) return picked;
  return V3f(worldFromCamera->direction(V3d(picked)));
}

bool NormalReading::isPlain() const { return departures() == 0; }

int NormalReading::departures() const {
  int flips = 0, moves = 0;
  for (size_t i = 0; i < 3; ++i) {
    flips += sign[i] < 0;
    moves += axis[i] != static_cast<int>(i);
  }
  return 2 * unit + 2 * worldFromCamera.has_value() + 2 * flips + 2 * moves;
}

std::string NormalReading::settings() const {
  std::vector<std::string> keys;
  if (worldFromCamera) keys.emplace_back("frame.normal_space = \"camera\"");
  if (unit) keys.emplace_back("frame.normal_range = \"0..1\"");
  if (hasOwnAxes(*this))
    keys.push_back(fmt::format("frame.normal_axes = \"{}\"", spellAxes(*this)));
  return fmt::format("{}", fmt::join(keys, " and "));
}

std::string NormalReading::sentence() const {
  std::vector<std::string> what;
  if (worldFromCamera) what.emplace_back("are in the camera's space");
  if (unit) what.emplace_back("hold 0..1 instead of -1..1");
  if (hasOwnAxes(*this)) what.emplace_back("have flipped or swapped axes");
  return fmt::format("{}", fmt::join(what, " and "));
}

NormalReading readingOf(const std::string& axes) {
  NormalReading result;
  if (axes.empty()) return result;
  std::istringstream words(axes);
  std::array<bool, 3> used{};
  size_t count = 0;
  bool good = true;
  for (std::string word; words >> word; ++count) {
    const bool negative = word.front() == '-';
    const std::string name = word.substr(word.front() == '-' || word.front() == '+');
    const size_t axis = name.size() == 1 ? std::string("xyz").find(name) : std::string::npos;
    good = good && count < 3 && axis != std::string::npos && !used[axis];
    if (!good) break;
    used[axis] = true;
    result.axis[count] = static_cast<int>(axis);
    result.sign[count] = negative ? -1.0f : 1.0f;
  }
  if (!good || count != 3)
    throw LookError(fmt::format(
        "frame.normal_axes is \"{}\"; it wants x, y and z once each, such as \"x -z y\"", axes));
  return result;
}

std::vector<NormalReading> allAxes() {
  std::vector<NormalReading> all;
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      NormalReading reading;
      reading.axis = order;
      for (size_t i = 0; i < 3; ++i) reading.sign[i] = signs >> i & 1 ? -1.0f : 1.0f;
      all.push_back(reading);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return all;
}

}  // namespace kagefude::detail
