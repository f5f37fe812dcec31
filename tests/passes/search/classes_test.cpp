#include "passes/search/classes.h"

#include <gtest/gtest.h>

#include <array>

#include "base/error.h"

namespace kagefude {
namespace {

TEST(ShadowClasses, AgreementOfMasksDecides) {
  Bytes a(4, 1, 1), b(4, 1, 1);
  Labels labels(4, 1, 5);
  a(0, 0) = b(0, 0) = 0;
  b(1, 0) = 0;
  a(2, 0) = 255;
  labels(3, 0) = 0;
  const std::array<View<const uint8_t>, 2> masks{a.view(), b.view()};
  const Bytes classes = classifyShadow(masks, labels);
  const auto at = [&](int x) { return static_cast<ShadowClass>(classes(x, 0)); };
  EXPECT_EQ(at(0), ShadowClass::umbra);
  EXPECT_EQ(at(1), ShadowClass::penumbra);
  EXPECT_EQ(at(2), ShadowClass::lit) << "any value but 0 sees the light";
  EXPECT_EQ(at(3), ShadowClass::background);
}

TEST(ShadowClasses, RefusesNoMasksAndOtherSizes) {
  const Labels labels(4, 1, 5);
  EXPECT_THROW(classifyShadow({}, labels), InputError);
  const Bytes small(3, 1, 1);
  const std::array<View<const uint8_t>, 1> masks{small.view()};
  EXPECT_THROW(classifyShadow(masks, labels), InputError);
}

}  // namespace
}  // namespace kagefude
