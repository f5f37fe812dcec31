#include "passes/edges/mean_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "passes/edges/mix_at_edges.h"

namespace kagefude {
namespace {

/// A mean nearer to the own normal than this says nothing new.
constexpr float sameNormal = 0.06f;
/// How strongly shares are held to the mixture without normals, so that the noise of the mean does
/// not choose between surfaces of nearly one direction.
constexpr float hold = 0.0005f, leastHeld = 0.01f;
/// Of its thing's coverage, what a neighbour may have without being held strongly.
constexpr float freeSide = 0.08f, freeCorner = 0.01f;
constexpr int mostExchanges = 40;
constexpr float leastExchange = 0.002f;
constexpr size_t mostThings = 4;  ///< ranks that are looked at
/// A mean that its 3x3 leaves farther away than this has seen something else as well; it is looked
/// for so far away, as dashes of a thin line may lie.
constexpr float unexplained = 0.04f;
constexpr int farthest = 8;
constexpr size_t mostFar = 2;
constexpr size_t mostShares = 9 + mostThings + mostFar;

/// A colour that the pixel may have a share of.
struct Source {
  int thing = 0;  ///< place among the pixel's ranks
  Rgba colour{};
  V3f normal{0.0f};
  float known = 0;  ///< its share in the mixture without normals
  float loose = 0;  ///< how far it may leave it
  float share = 0;
};

/// The things that a pixel's ranks name, and what may be seen of them.
struct Sources {
  std::array<Source, mostShares> all;
  size_t count = 0;
  std::array<float, mostThings> coverage{};
  std::array<uint32_t, mostThings> ids{};
  size_t things = 0;

  std::span<Source> used() { return {all.data(), count}; }
  /// The place of a thing; -1 of none of these.
  int find(uint32_t id) const {
    for (size_t i = 0; i < things; ++i)
      if (ids[i] == id) return static_cast<int>(i);
    return -1;
  }
};

/// Two sources of one thing, and how much one of them gives to the other.
struct Exchange {
  Source* from = nullptr;
  Source* to = nullptr;
  float share = 0;
  float gain = 0;
};

/// The exchange within a thing that brings its mixture nearest to `missing`.
Exchange bestExchange(std::span<Source> sources, int thing, const V3f& missing) {
  Exchange best;
  float least = std::numeric_limits<float>::max(), most = -least;
  const auto held = [](const Source& s) { return hold / (s.loose + leastHeld); };
  for (Source& s : sources) {
    if (s.thing != thing) continue;
    const float pull = missing.dot(s.normal) - held(s) * (s.share - s.known);
    if (pull > most) {
      most = pull;
      best.to = &s;
    }
    if (s.share > 0 && pull < least) {
      least = pull;
      best.from = &s;
    }
  }
  if (!best.to || !best.from || best.to == best.from) return {};
  const V3f change = best.to->normal - best.from->normal;
  const float stiff = change.dot(change) + held(*best.to) + held(*best.from);
  best.share = std::min((most - least) / stiff, best.from->share);
  best.gain = best.share * (2 * (most - least) - best.share * stiff);
  return best;
}

/// Shares of 0 and more that keep each thing's coverage, whose normals have the mean, near those
/// that are known: the best exchange, again and again. Gives what is left of the mean.
V3f solve(const V3f& mean, Sources& sources) {
  V3f missing = mean;
  for (const Source& source : sources.used()) missing -= source.normal * source.share;
  for (int i = 0; i < mostExchanges; ++i) {
    Exchange best;
    for (size_t thing = 0; thing < sources.things; ++thing) {
      const Exchange found = bestExchange(sources.used(), static_cast<int>(thing), missing);
      if (found.gain > best.gain) best = found;
    }
    if (!(best.share > leastExchange)) break;
    best.to->share += best.share;
    best.from->share -= best.share;
    missing -= (best.to->normal - best.from->normal) * best.share;
  }
  return missing;
}

class Mixer {
 public:
  Mixer(const ColourViews& colour, const MeanNormalEdges& edges)
      : colour_(colour), e_(edges), inner_(edges.surfaces) {}

  /// Whether one surface covers the pixel, and is all that the mean knows of.
  bool plain(int x, int y) const {
    const CoverageRank& first = e_.ranks[0];
    if (!(first.coverage(x, y) >= fullShare) || first.id(x, y) != e_.ownId(x, y)) return false;
    if (!inner_.plain(x, y)) return false;
    const V3f off = e_.mean(x, y) - e_.surfaces.normal(x, y);
    return !(off.dot(off) > sameNormal * sameNormal);
  }

  Rgba mixed(int x, int y) const {
    Sources sources;
    const float named = nameThings(x, y, sources);
    if (!(named > 0.0f)) return Rgba{};
    float found = 0;
    bool all = true;
    for (size_t i = 0; i < sources.things; ++i) {
      if (addSources(x, y, static_cast<int>(i), sources))
        found += sources.coverage[i];
      else
        all = false;
    }
    if (!(found > 0.0f)) return at(x, y);
    if (all && knowsRest(x, y)) {
      V3f left = solve(e_.mean(x, y), sources);
      for (size_t far = 0; far < mostFar && left.dot(left) > unexplained * unexplained; ++far) {
        if (!addExplaining(x, y, left, sources)) break;
        left = solve(e_.mean(x, y), sources);
      }
    }
    Rgba sum{};
    for (const Source& source : sources.used()) sum += source.colour * source.share;
    return sum * ((named < 1.0f ? named : 1.0f) / found);
  }

 private:
  Rgba at(int x, int y) const { return paintAt(colour_, x, y); }

  bool contains(int x, int y) const { return e_.ownId.contains(x, y); }

  /// Each thing once, in however many ranks a file names it; gives what they cover together.
  float nameThings(int x, int y, Sources& sources) const {
    float named = 0;
    for (const CoverageRank& rank : e_.ranks) {
      const float share = rank.coverage(x, y);
      const uint32_t id = rank.id(x, y);
      if (id == 0 || !(share >= smallestShare)) continue;
      int place = sources.find(id);
      if (place < 0) {
        if (sources.things == mostThings) continue;
        place = static_cast<int>(sources.things++);
        sources.ids[static_cast<size_t>(place)] = id;
      }
      sources.coverage[static_cast<size_t>(place)] += share;
      named += share;
    }
    return named;
  }

  /// Whether the mean is of nothing but the things that are painted, and of what has no surface.
  bool knowsRest(int x, int y) const {
    const V3f mean = e_.mean(x, y);
    if (!std::isfinite(mean.dot(mean))) return false;
    for (int qy = y - 1; qy <= y + 1; ++qy)
      for (int qx = x - 1; qx <= x + 1; ++qx)
        if (contains(qx, qy) && e_.ownId(qx, qy) == 0 && e_.surfaces.normal(qx, qy) != V3f(0.0f))
          return false;
    return true;
  }

  void add(Source source, Sources& sources) const {
    source.share = source.known;
    sources.all[sources.count++] = source;
  }

  bool addSources(int x, int y, int thing, Sources& sources) const {
    const auto place = static_cast<size_t>(thing);
    if (e_.ownId(x, y) == sources.ids[place]) {
      addOwn(x, y, thing, sources);
      return true;
    }
    return addNear(x, y, thing, sources) || addFar(x, y, thing, sources);
  }

  void addOwn(int x, int y, int thing, Sources& sources) const {
    const auto place = static_cast<size_t>(thing);
    const float coverage = sources.coverage[place];
    std::array<double, 8> shares{};
    if (!inner_.plain(x, y)) shares = inner_.shares(x, y);
    double total = 0;
    for (const double share : shares) total += share;
    const auto own = static_cast<float>(1 - total) * coverage;
    add({thing, at(x, y), e_.surfaces.normal(x, y), own, std::max(own, coverage / 2)}, sources);
    for (size_t i = 0; i < shares.size(); ++i) {
      const int qx = x + edgeSteps[i].x, qy = y + edgeSteps[i].y;
      if (!contains(qx, qy) || e_.ownId(qx, qy) != sources.ids[place]) continue;
      const float known = static_cast<float>(shares[i]) * coverage;
      const float loose = (i < 4 ? freeSide : freeCorner) * coverage;
      add({thing, at(qx, qy), e_.surfaces.normal(qx, qy), known, std::max(known, loose)}, sources);
    }
  }

  /// Each of the thing's pixels in the 3x3; false when there is none.
  bool addNear(int x, int y, int thing, Sources& sources) const {
    const auto place = static_cast<size_t>(thing);
    const size_t before = sources.count;
    for (int qy = y - 1; qy <= y + 1; ++qy)
      for (int qx = x - 1; qx <= x + 1; ++qx)
        if (contains(qx, qy) && e_.ownId(qx, qy) == sources.ids[place])
          add({thing, at(qx, qy), e_.surfaces.normal(qx, qy)}, sources);
    const float each = sources.coverage[place] / static_cast<float>(sources.count - before);
    for (Source& s : sources.used().subspan(before)) s.known = s.loose = s.share = each;
    return sources.count > before;
  }

  /// The pixel farther away, of a thing that is seen here, that explains most of what is left of
  /// the mean where it takes the place of some of its thing; the nearer of equals.
  bool addExplaining(int x, int y, const V3f& left, Sources& sources) const {
    std::array<V3f, mostThings> shown;
    shown.fill(V3f(0.0f));
    for (const Source& s : sources.used())
      shown[static_cast<size_t>(s.thing)] +=
          s.normal * (s.share / sources.coverage[static_cast<size_t>(s.thing)]);
    Source best;
    float most = 0.05f * left.dot(left);  // less is not worth it
    for (int qy = y - farthest; qy <= y + farthest; ++qy)
      for (int qx = x - farthest; qx <= x + farthest; ++qx) {
        if (!contains(qx, qy) || (std::abs(qx - x) < 2 && std::abs(qy - y) < 2)) continue;
        const int thing = sources.find(e_.ownId(qx, qy));
        if (thing < 0) continue;
        const V3f normal = e_.surfaces.normal(qx, qy);
        const V3f change = normal - shown[static_cast<size_t>(thing)];
        const float length = change.dot(change), along = left.dot(change);
        if (!(along > 0 && length > 0)) continue;
        const float share = std::min(along / length, sources.coverage[static_cast<size_t>(thing)]);
        const auto away = static_cast<float>((qx - x) * (qx - x) + (qy - y) * (qy - y));
        const float explained = share * (2 * along - share * length) / (1 + away / 64);
        if (explained <= most) continue;
        most = explained;
        best = {thing, at(qx, qy), normal, 0.0f, share};
      }
    if (!(best.loose > 0)) return false;
    add(best, sources);
    return true;
  }

  /// The mean of the thing's pixels in the 5x5, else of the nearest square that has some, as one.
  bool addFar(int x, int y, int thing, Sources& sources) const {
    for (int reach = 2; reach <= farthest; ++reach)
      if (addMean(x, y, thing, reach, sources)) return true;
    return false;
  }

  bool addMean(int x, int y, int thing, int reach, Sources& sources) const {
    const auto place = static_cast<size_t>(thing);
    Source mean{thing};
    float count = 0;
    for (int qy = y - reach; qy <= y + reach; ++qy)
      for (int qx = x - reach; qx <= x + reach; ++qx)
        if (contains(qx, qy) && e_.ownId(qx, qy) == sources.ids[place]) {
          mean.colour += at(qx, qy);
          mean.normal += e_.surfaces.normal(qx, qy);
          ++count;
        }
    if (count == 0) return false;
    mean.colour /= count;
    mean.normal *= 1 / count;
    mean.known = mean.loose = sources.coverage[place];
    add(mean, sources);
    return true;
  }

  const ColourViews& colour_;
  const MeanNormalEdges& e_;
  const InnerEdges inner_;
};

}  // namespace

void blendByMeanNormals(const PaintViews& paint, const MeanNormalEdges& edges) {
  const ColourViews colour{paint.r, paint.g, paint.b, paint.a};
  const Mixer mixer(colour, edges);
  mixAtEdges(
      paint, [&](int x, int y) { return mixer.plain(x, y); },
      [&](int x, int y) { return mixer.mixed(x, y); });
}

}  // namespace kagefude
