// SPDX-License-Identifier: BSD-3-Clause
#include "support/error.h"

#include <gtest/gtest.h>

namespace carreau {
namespace {

TEST(Error, SentenceStartsWithTheEntities) {
  const CallbackError error({.face = 3, .curve_index = 2, .curve = 17, .t = 0.5}, "surf0 returned NaN");
  EXPECT_STREQ(error.what(), "face 3, curve 2 (reference 17), t = 0.5: surf0 returned NaN");
}

TEST(Error, NamesFileAndLine) {
  const FileError error({.file = "x.pardom", .line = 12}, "the number of curves is negative");
  EXPECT_STREQ(error.what(), "x.pardom, line 12: the number of curves is negative");
}

TEST(Error, HasNoPrefixWithoutEntities) {
  EXPECT_STREQ(Cancelled("stopped by the host").what(), "stopped by the host");
}

}  // namespace
}  // namespace carreau
