// SPDX-License-Identifier: BSD-3-Clause
#include "support/error.h"

#include <gtest/gtest.h>

#include "support/place_in_sentence.h"

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

TEST(Error, PlacesAreReadFromSentences) {
  for (const Where& where : {Where{.face = 3, .curve_index = 2, .curve = 17, .t = 0.5}, Where{.face = 12, .uv = Vec2{-0.1, 1e-7}}})
    for (const char* before : {"", "no face could be meshed: "})
      EXPECT_EQ(place_in_sentence(before + where.prefix() + "the loop crosses itself: u = 7").prefix(), where.prefix());
  for (const char* none : {"", "no surface 3: face", "the surface 3 of face 2"}) EXPECT_EQ(place_in_sentence(none).face, 0) << none;
}

TEST(Error, HasNoPrefixWithoutEntities) {
  EXPECT_STREQ(Cancelled("stopped by the host").what(), "stopped by the host");
}

}  // namespace
}  // namespace carreau
