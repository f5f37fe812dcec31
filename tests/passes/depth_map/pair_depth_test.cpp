#include "passes/depth_map/pair_depth.h"

#include <gtest/gtest.h>

#include "passes/depth_map/half_floor.h"
#include "passes/light_shape/light_share.h"

namespace kagefude {
namespace {

Floats pairOf(const HalfFloor& scene, const Bytes& farMask, const Bytes& nearMask) {
  const MaskPair masks{farMask, nearMask, {V3f(0, 0, 10), V3f(0, 0, 0.2f), HalfFloor::radius}};
  return pairDepthVisibility(masks, scene.position, scene.normal, scene.labels, scene.labels,
                             scene.map, {});
}

TEST(PairDepth, WhereMasksBearItOutTheMapGivesTheWidth) {
  HalfFloor scene;
  scene.blockLeft();
  const Bytes mask = scene.maskTo(0);
  const Floats v = pairOf(scene, mask, mask);
  for (int i = 0; i < HalfFloor::count; ++i)
    EXPECT_NEAR(v(i, 0), discShare(scene.x(i) / HalfFloor::radius), 0.03f) << i;
}

TEST(PairDepth, WhatTheMapLosesTheMasksHold) {
  const HalfFloor scene;  // the map shows no blocker: it touches the floor
  const Bytes mask = scene.maskTo(1);
  const Floats v = pairOf(scene, mask, mask);
  for (int i = 0; i < HalfFloor::count; ++i) EXPECT_EQ(v(i, 0), scene.x(i) > 1 ? 1.0f : 0.0f) << i;
}

TEST(PairDepth, WhatOnlyOneMaskContradictsIsTheMean) {
  const HalfFloor scene;
  const Bytes lit = scene.maskTo(-100), dark = scene.maskTo(100);
  // No site of either kind: the search gives 1/2, the map 1.
  const Floats v = pairOf(scene, lit, dark);
  for (int i = 0; i < HalfFloor::count; ++i) EXPECT_EQ(v(i, 0), 0.75f) << i;
}

}  // namespace
}  // namespace kagefude
