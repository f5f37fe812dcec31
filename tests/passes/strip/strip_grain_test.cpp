#include "passes/strip/strip_grain.h"

#include <gtest/gtest.h>

#include "passes/brush/brush_scene.h"
#include "passes/brush/grain_lookup.h"
#include "passes/strip/strip_paint.h"

namespace kagefude {
namespace {

using test::BrushScene;

std::vector<Strip> oneStrip(Strip strip) {
  std::vector<Strip> strips;
  strips.push_back(std::move(strip));
  return strips;
}

/// A gradient with its own noise in every row, smooth enough to be seen without filtering.
Strip gradientStrip() {
  Floats values(256, 256);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x)
      values(x, y) = 0.9f - 0.7f * static_cast<float>(y) / 255.0f +
                     0.1f * (strokeNoise(5, static_cast<float>(x % 256) * 0.25f,
                                         static_cast<float>(y) * 0.25f) -
                             0.5f);
  return makeStrip(values, values, values);
}

BrushScene groundOfTone(float tone) {
  BrushScene scene = test::ground(128, 1.0f);
  scene.tone.fill(tone);
  return scene;
}

Floats strokesAt(const std::vector<Strip>& strips, float tone, BrushParams::Grain grain) {
  BrushAnchor anchor = test::straightAnchor(0.25f);
  anchor.points[0].position = {0, 50, 0};
  BrushParams params;
  params.grain = grain;
  Floats picture = groundOfTone(tone).paint(std::span(&anchor, 1), strips, params).r;
  const float mean = stripRowMean(strips[0], tone)[0];
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) picture(x, y) -= mean;
  return picture;
}

double correlation(const Floats& a, const Floats& b) {
  double ab = 0, aa = 0, bb = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      ab += double(a(x, y)) * double(b(x, y));
      aa += double(a(x, y)) * double(a(x, y));
      bb += double(b(x, y)) * double(b(x, y));
    }
  return ab / std::sqrt(aa * bb);
}

TEST(StripGrain, EveryToneGetsItsRowsMeanAndSpread) {
  const PaintedStrip painted = paintStrip(stripPreset("soft"));
  const Strip strip = makeStrip(painted.r, painted.g, painted.b);
  const StripGrain& grain = strip.grain;
  const StripGrain::Level& full = grain.levels.front();
  for (int y = 40; y < strip.height(); y += 60) {
    const float tone = 1.0f - (static_cast<float>(y) + 0.5f) / static_cast<float>(strip.height());
    double own = 0, ownSquares = 0, given = 0, givenSquares = 0, count = 0;
    for (int x = 0; x < strip.width(); ++x) {
      const double c = double(strip.levels[0].texels(x, y)[0]);
      own += c / strip.width();
      ownSquares += c * c / strip.width();
    }
    for (int i = 0; i < full.width * full.height; i += 7, ++count) {
      const float value =
          (static_cast<float>(
               grain.pool.row(0)[grainTexel(i % full.width, i / full.width, full.tilesAcross())] &
               255) -
           128.0f) *
          grain.perStep;
      const double c = double(grainColour(grain, tone, value, 0)[0]);
      given += c;
      givenSquares += c * c;
    }
    given /= count;
    const double ownSpread = std::sqrt(ownSquares - own * own);
    const double spread = std::sqrt(givenSquares / count - given * given);
    EXPECT_NEAR(given, own, 0.02) << y;
    EXPECT_NEAR(spread / ownSpread, 1.0, 0.15) << y;
  }
}

TEST(StripGrain, StrokesStayWhenTheToneChanges) {
  const auto strips = oneStrip(gradientStrip());
  const auto before = strokesAt(strips, 0.4f, BrushParams::Grain::object),
             after = strokesAt(strips, 0.6f, BrushParams::Grain::object);
  EXPECT_GT(correlation(before, after), 0.97);
  const auto slidBefore = strokesAt(strips, 0.4f, BrushParams::Grain::tone),
             slidAfter = strokesAt(strips, 0.6f, BrushParams::Grain::tone);
  EXPECT_LT(correlation(slidBefore, slidAfter), 0.5);
}

TEST(StripGrain, FlatToneHasNoStraightBands) {
  const auto strips = oneStrip(gradientStrip());
  const Floats picture = strokesAt(strips, 0.5f, BrushParams::Grain::object);
  const Floats banded = strokesAt(strips, 0.5f, BrushParams::Grain::tone);
  double changes = 0, bandChanges = 0;
  for (int y = 1; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      changes += std::fabs(double(picture(x, y)) - double(picture(x, y - 1)));
      bandChanges += std::fabs(double(banded(x, y)) - double(banded(x, y - 1)));
    }
  EXPECT_LT(bandChanges, 1e-3 * changes) << "strokes along the tone do not change across it";
}

TEST(StripGrain, StripWithoutStrokesGivesItsRows) {
  Floats values(16, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 16; ++x) values(x, y) = 1.0f - static_cast<float>(y) / 63.0f;
  const auto strips = oneStrip(makeStrip(values, values, values));
  for (const float tone : {0.2f, 0.5f, 0.9f}) {
    const Floats picture = strokesAt(strips, tone, BrushParams::Grain::object);
    for (int x = 0; x < 128; ++x) ASSERT_NEAR(picture(x, 40), 0.0f, 1e-5f);
  }
}

TEST(StripGrain, EveryLevelKeepsTheMeanNearZero) {
  const Strip strip = test::noiseStrip(96, 80);
  for (const StripGrain::Level& level : strip.grain.levels) {
    double sum = 0;
    for (int i = 0; i < level.width * level.height; ++i)
      sum +=
          double(strip.grain.pool.row(0)[level.offset + grainTexel(i % level.width, i / level.width,
                                                                   level.tilesAcross())] &
                 255) -
          128.0;
    EXPECT_NEAR(sum / (level.width * level.height), 0.0, 0.51);
  }
}

// A picture against the mean of one eight times as fine: what filtering has to come near.
TEST(StripGrain, FilteringMatchesSupersampling) {
  const auto strips = oneStrip(gradientStrip());
  constexpr int side = 64, finer = 8;
  const auto scene = [](int pixels) {
    BrushScene made(pixels, pixels);  // a floor that runs away from the eye
    for (int y = 0; y < pixels; ++y)
      for (int x = 0; x < pixels; ++x) {
        const float across = (static_cast<float>(x) + 0.5f) / static_cast<float>(pixels) - 0.5f;
        const float down = (static_cast<float>(y) + 0.5f) / static_cast<float>(pixels);
        const float depth = 1.0f / (0.25f + 0.75f * down);
        made.position.set(x, y, {across * depth, depth, 0});
        made.normal.set(x, y, {0, 0, 1});
        made.tone(x, y) = 0.3f + 0.4f * down;
      }
    return made;
  };
  BrushAnchor anchor = test::straightAnchor(0.12f);
  anchor.points[0].position = {0, 50, 0};
  const Floats picture = scene(side).paint(std::span(&anchor, 1), strips, {}).r;
  const Floats fine = scene(side * finer).paint(std::span(&anchor, 1), strips, {}).r;
  double squares = 0, strokes = 0, worst = 0;
  for (int y = 1; y < side - 1; ++y)
    for (int x = 1; x < side - 1; ++x) {
      double mean = 0;
      for (int j = 0; j < finer; ++j)
        for (int i = 0; i < finer; ++i) mean += double(fine(x * finer + i, y * finer + j));
      mean /= finer * finer;
      const double error = double(picture(x, y)) - mean;
      squares += error * error;
      worst = std::max(worst, std::fabs(error));
      const double tone = 0.3 + 0.4 * (y + 0.5) / side;
      const double stroke = mean - double(stripRowMean(strips[0], static_cast<float>(tone))[0]);
      strokes += stroke * stroke;
    }
  EXPECT_LT(std::sqrt(squares), 0.35 * std::sqrt(strokes));
  EXPECT_LT(worst, 0.03) << "of a strip whose strokes span 0.1";
}

// Zooming out by two octaves in small steps with strokes of constant size on the screen.
TEST(StripGrain, ZoomKeepsContrastAndGrain) {
  const PaintedStrip painted = paintStrip(stripPreset("fine"));
  const auto strips = oneStrip(makeStrip(painted.r, painted.g, painted.b));
  BrushSubject subject;
  subject.boundsMin = {-20, -20, -1};
  subject.boundsMax = {20, 20, 1};
  subject.hasBounds = true;
  subject.referencePoints = {{0, 500, 0}};
  Light light;
  light.position = {0, 500, 50};
  BrushParams params;
  params.size = BrushParams::Size::screen;
  params.stripPixels = 256;
  std::vector<double> contrasts, grains;
  for (float octave = 0; octave <= 2.0f; octave += 0.125f) {
    const float halfSize = exp2Of(octave);
    BrushScene scene = test::ground(256, halfSize);
    scene.tone.fill(0.6f);
    subject.worldPerPixel = 2.0f * halfSize / 256;
    const BrushAnchor anchor = makeBrushAnchor(subject, light, params);
    const Floats picture = scene.paint(std::span(&anchor, 1), strips, params).r;
    double sum = 0, squares = 0, slopes = 0;
    for (int y = 1; y < 255; ++y)
      for (int x = 1; x < 255; ++x) {
        const double value = double(picture(x, y));
        sum += value;
        squares += value * value;
        slopes += std::pow(double(picture(x, y + 1)) - double(picture(x, y - 1)), 2);
      }
    const double count = 254.0 * 254.0;
    const double variance = squares / count - sum * sum / count / count;
    contrasts.push_back(std::sqrt(variance));
    grains.push_back(std::sqrt(variance * count / slopes));
  }
  const double contrast = contrasts[contrasts.size() / 2];
  for (size_t i = 0; i < contrasts.size(); ++i) {
    EXPECT_NEAR(contrasts[i] / contrast, 1.0, 0.15) << i;
    EXPECT_NEAR(grains[i] / grains[0], 1.0, 0.45) << i << ": within an octave's two sizes";
  }
}

}  // namespace
}  // namespace kagefude
