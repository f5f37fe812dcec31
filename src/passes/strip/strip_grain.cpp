#include "passes/strip/strip_grain.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "image/parallel.h"

namespace kagefude {
namespace {

constexpr float leastDeviation = 0.25f;  ///< of the strongest row's
constexpr int mostToneRows = 256;

float brightness(const Rgba& c) {
  const float luminance = 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
  return luminance > 0.0f ? std::sqrt(luminance) : 0.0f;
}

/// Deviation of every texel from its row's mean, and each row's root mean square of it.
struct Deviations {
  Floats values;
  std::vector<float> rms;
};

Deviations deviationsOf(View<const Rgba> texels) {
  Deviations result{Floats(texels.width, texels.height),
                    std::vector<float>(static_cast<size_t>(texels.height))};
  parallelRows(texels.height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      double sum = 0, squares = 0;
      for (int x = 0; x < texels.width; ++x) sum += double(brightness(texels(x, y)));
      const float mean = static_cast<float>(sum / texels.width);
      for (int x = 0; x < texels.width; ++x) {
        const float value = brightness(texels(x, y)) - mean;
        result.values(x, y) = value;
        squares += double(value) * double(value);
      }
      result.rms[static_cast<size_t>(y)] = static_cast<float>(std::sqrt(squares / texels.width));
    }
  });
  return result;
}

/// Whether a row has two values only, give or take, as lines on paper have: seven of ten texels lie
/// within 6 % of its range from its least or its greatest one. Of strokes with a bell of values
/// next to none do.
bool hasTwoValues(const float* values, int width) {
  const auto [least, most] = std::minmax_element(values, values + width);
  const float near = 0.06f * (*most - *least);
  const auto count = std::count_if(
      values, values + width,
      [&, low = *least, high = *most](float v) { return v - low <= near || high - v <= near; });
  return 10 * count >= 7 * width;
}

/// Replaces a row's values by their ranks, evenly spread about 0 with variance 1; equal ones share
/// the mean of theirs, so that a row of two values keeps them.
void rankValues(float* values, int width) {
  std::vector<int> order(static_cast<size_t>(width));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return values[a] < values[b]; });
  std::vector<float> ranks(static_cast<size_t>(width));
  double squares = 0;
  for (size_t i = 0, end = 0; i < order.size(); i = end) {
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    const float rank = static_cast<float>(i + end) / static_cast<float>(width) - 1.0f;
    for (size_t k = i; k < end; ++k) ranks[static_cast<size_t>(order[k])] = rank;
    squares += static_cast<double>(end - i) * rank * rank / width;
  }
  const float scale = squares > 0 ? static_cast<float>(1.0 / std::sqrt(squares)) : 0.0f;
  for (int x = 0; x < width; ++x) values[x] = ranks[static_cast<size_t>(x)] * scale;
}

/// The grain of the rows that have strokes, each of variance 1.
Floats grainOf(const Deviations& deviations) {
  const float strongest = *std::max_element(deviations.rms.begin(), deviations.rms.end());
  std::vector<int> rows;
  for (size_t y = 0; y < deviations.rms.size(); ++y)
    if (deviations.rms[y] > 1e-4f && deviations.rms[y] >= leastDeviation * strongest)
      rows.push_back(static_cast<int>(y));
  if (rows.empty()) return Floats(1, 1, 0.0f);
  Floats grain(deviations.values.width(), static_cast<int>(rows.size()));
  for (int y = 0; y < grain.height(); ++y) {
    const int from = rows[static_cast<size_t>(y)];
    const float scale = 1.0f / deviations.rms[static_cast<size_t>(from)];
    for (int x = 0; x < grain.width(); ++x) grain(x, y) = deviations.values(x, from) * scale;
    if (hasTwoValues(grain.row(y), grain.width())) rankValues(grain.row(y), grain.width());
  }
  return grain;
}

/// Half the size each way, by area.
Floats halved(const Floats& fine) {
  const int width = std::max(1, fine.width() / 2), height = std::max(1, fine.height() / 2);
  Floats coarse(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int x0 = x * fine.width() / width, x1 = (x + 1) * fine.width() / width;
      const int y0 = y * fine.height() / height, y1 = (y + 1) * fine.height() / height;
      float sum = 0;
      for (int j = y0; j < y1; ++j)
        for (int i = x0; i < x1; ++i) sum += fine(i, j);
      coarse(x, y) = sum / static_cast<float>((x1 - x0) * (y1 - y0));
    }
  return coarse;
}

uint32_t toByte(float grain) {
  const float steps = grain * (1.0f / StripGrain::perStep) + 128.5f;
  return static_cast<uint32_t>(std::clamp(steps, 1.0f, 255.0f));
}

void pack(const Floats& grain, const StripGrain::Level& level, uint32_t* texels) {
  std::fill_n(texels, level.texels(), 0u);
  for (int y = 0; y < level.height; ++y)
    for (int x = 0; x < level.width; ++x) {
      const int right = x + 1 < level.width ? x + 1 : 0, below = std::min(y + 1, level.height - 1);
      texels[grainTexel(x, y, level.tilesAcross())] =
          toByte(grain(x, y)) | toByte(grain(right, y)) << 8 | toByte(grain(x, below)) << 16 |
          toByte(grain(right, below)) << 24;
    }
}

void packChain(Floats grain, StripGrain& result) {
  std::vector<Floats> chain;
  chain.push_back(std::move(grain));
  while (chain.back().width() > 1 || chain.back().height() > 1)
    chain.push_back(halved(chain.back()));
  int texels = 0;
  for (const Floats& level : chain) {
    result.levels.push_back({level.width(), level.height(), texels});
    texels += result.levels.back().texels();
  }
  result.pool = Plane<uint32_t>(texels, 1);
  for (size_t i = 0; i < chain.size(); ++i)
    pack(chain[i], result.levels[i], result.pool.row(0) + result.levels[i].offset);
}

/// Share of the grain's texels below each border between two columns of the colours.
std::vector<float> sharesBelow(const Floats& grain) {
  std::array<float, StripGrain::columns - 1> borders;
  for (size_t i = 0; i < borders.size(); ++i)
    borders[i] =
        (2.0f * static_cast<float>(i + 1) - static_cast<float>(StripGrain::columns)) *
        StripGrain::reach / static_cast<float>(StripGrain::columns - 1);
  std::array<size_t, StripGrain::columns> inColumn{};
  const size_t texels = grain.view().pixels();
  for (const float* value = grain.row(0); value != grain.row(0) + texels; ++value) {
    size_t column = 0;
    for (const float border : borders) column += *value >= border;
    ++inColumn[column];
  }
  std::vector<float> shares{0.0f};
  size_t below = 0;
  for (size_t i = 0; i < borders.size(); ++i) {
    below += inColumn[i];
    shares.push_back(static_cast<float>(below) / static_cast<float>(texels));
  }
  shares.push_back(1.0f);
  return shares;
}

/// Colours of one row by rising brightness, averaged over the shares of each column.
void rankRow(const Rgba* texels, int width, const std::vector<float>& shares, Rgba* colours) {
  // Brightness is 0 or more, so its bits are in its order; equal ones stay in the row's.
  std::vector<uint64_t> order(static_cast<size_t>(width));
  for (int x = 0; x < width; ++x)
    order[static_cast<size_t>(x)] =
        uint64_t{std::bit_cast<uint32_t>(brightness(texels[x]))} << 32 | static_cast<uint32_t>(x);
  std::sort(order.begin(), order.end());
  const float count = static_cast<float>(width);
  for (size_t i = 0; i + 1 < shares.size(); ++i) {
    // At least one texel's worth, so that a column without a share takes its neighbours' colour.
    const float middle = 0.5f * (shares[i] + shares[i + 1]) * count;
    const float half = std::max(0.5f * (shares[i + 1] - shares[i]) * count, 0.5f);
    const float from = std::clamp(middle - half, 0.0f, count - 1.0f);
    const float to = std::clamp(middle + half, from + 1.0f, count);
    Rgba sum{};
    for (int k = static_cast<int>(from); k < width && static_cast<float>(k) < to; ++k) {
      const float share =
          std::min(static_cast<float>(k + 1), to) - std::max(static_cast<float>(k), from);
      sum += texels[static_cast<uint32_t>(order[static_cast<size_t>(k)])] * share;
    }
    colours[i] = sum * (1.0f / (to - from));
  }
}

/// Fewer rows, by area.
void shrinkRows(View<const Rgba> fine, View<Rgba> coarse) {
  const double scale = static_cast<double>(fine.height) / coarse.height;
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x) {
      Rgba sum{};
      for (int j = static_cast<int>(y * scale); j < fine.height && j < (y + 1) * scale; ++j) {
        const double share =
            std::min<double>(j + 1, (y + 1) * scale) - std::max<double>(j, y * scale);
        sum += fine(x, j) * static_cast<float>(share / scale);
      }
      coarse(x, y) = sum;
    }
}

void packColours(View<const Rgba> ranked, StripGrain& result) {
  while (2 * result.toneRows <= std::min(ranked.height, mostToneRows)) {
    result.toneRows *= 2;
    ++result.lastToneLevel;
  }
  result.colours = Plane<Rgba>(StripGrain::columns, 2 * result.toneRows);
  View<const Rgba> finer = ranked;
  for (int level = 0; level <= result.lastToneLevel; ++level) {
    const View<Rgba> rows(result.colours.row(toneLevelRow(result.toneRows, level)),
                          StripGrain::columns, result.toneRows >> level);
    shrinkRows(finer, rows);
    finer = rows;
  }
}

}  // namespace

StripGrain makeStripGrain(View<const Rgba> texels) {
  StripGrain result;
  Floats grain = grainOf(deviationsOf(texels));
  const std::vector<float> shares = sharesBelow(grain);
  Plane<Rgba> ranked(StripGrain::columns, texels.height);
  parallelRows(texels.height, [&](int first, int end) {
    for (int y = first; y < end; ++y) rankRow(texels.row(y), texels.width, shares, ranked.row(y));
  });
  packColours(ranked, result);
  packChain(std::move(grain), result);
  return result;
}

}  // namespace kagefude
