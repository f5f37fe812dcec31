#include "passes/light_shape/disc_places.h"

#include <algorithm>
#include <cmath>

namespace kagefude {
namespace {

constexpr int groupSize = 8;
/// Radius of a group, and by how much of its spacing it is turned.
struct Group {
  double radius, turn;
};
constexpr Group groups[] = {{1, 0},    {0.5, 0.5},  {1, 0.5},  {0.75, 0},
                            {0.25, 0}, {0.75, 0.5}, {1, 0.25}, {1, 0.75}};

}  // namespace

std::vector<V2f> discPlaces(int count) {
  std::vector<V2f> places{{0, 0}};
  for (const Group& group : groups) {
    const int left = std::min(groupSize, count - static_cast<int>(places.size()));
    for (int i = 0; i < left; ++i) {
      const double angle = 2 * M_PI * (i + group.turn) / left;
      places.emplace_back(static_cast<float>(group.radius * std::cos(angle)),
                          static_cast<float>(group.radius * std::sin(angle)));
    }
  }
  return places;
}

}  // namespace kagefude
