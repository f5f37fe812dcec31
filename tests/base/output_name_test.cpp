#include "base/output_name.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace kagefude {
namespace {

TEST(OutputName, SuffixesMeanWhatTheySay) {
  requireSuffix("out/shot.####.exr", ".exr", "--output");
  requireSuffix("A.EXR", ".exr", "--output");
  for (const char* wrong : {"x.png", "x", "look.toml", ".exr", "x.exr/y"})
    EXPECT_THROW(requireSuffix(wrong, ".exr", "--output"), UsageError) << wrong;
}

}  // namespace
}  // namespace kagefude
