// SPDX-License-Identifier: BSD-3-Clause
// Keys by which the optimiser knows triangles, edges and stars again.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

#include "plane/optimise/memo.h"

namespace carreau::plane {
namespace {

PlaceKey triangle(const std::array<Vec2, 3>& p) {
  return key_of_triangle(key_of_place(p[0]), key_of_place(p[1]), key_of_place(p[2]));
}

// A triangle has one key from each of its corners, and a different key when it is turned over or one corner moves by
// the last bit.
TEST(Memo, KeysOfTrianglesDependOnPlacesAndTurn) {
  const Vec2 a{0, 0}, b{1, 0}, c{0.5, 1};
  EXPECT_EQ(triangle({a, b, c}), triangle({b, c, a}));
  EXPECT_EQ(triangle({a, b, c}), triangle({c, a, b}));
  EXPECT_NE(triangle({a, b, c}), triangle({a, c, b}));
  EXPECT_NE(triangle({a, b, c}), triangle({a, b, Vec2{0.5, 1 + 0x1p-52}}));
}

// A diagonal is the same from both of its sides; the other one of the quadrilateral is not.
TEST(Memo, KeysOfDiagonalsDiffer) {
  const PlaceKey a = key_of_place({0, 0}), b = key_of_place({1, 1}), c = key_of_place({0, 1}), d = key_of_place({1, 0});
  EXPECT_EQ(key_of_diagonal(c, a, b, d), key_of_diagonal(d, b, a, c));
  EXPECT_NE(key_of_diagonal(c, a, b, d), key_of_diagonal(a, d, c, b));
}

// Coordinates of regular grids have few bits: all their triangles have different keys even so.
TEST(Memo, TrianglesOfAGridHaveKeysOfTheirOwn) {
  constexpr int n = 64;
  std::set<PlaceKey> keys;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto at = [&](int di, int dj) { return Vec2{(i + di) / 64., (j + dj) / 64.}; };
      keys.insert({triangle({at(0, 0), at(1, 0), at(0, 1)}), triangle({at(1, 1), at(0, 1), at(1, 0)}),
                   triangle({at(0, 0), at(1, 0), at(1, 1)}), triangle({at(0, 0), at(1, 1), at(0, 1)})});
    }
  EXPECT_EQ(keys.size(), 4U * n * n);
}

TEST(Memo, UnknownKeysAreNotFound) {
  Memo<double> memo;
  memo.clear();
  const PlaceKey known = key_of_place({0.25, 0.5}), other = key_of_place({0.5, 0.25});
  EXPECT_EQ(memo.find(known), nullptr);
  memo.put(known, 0.75);
  ASSERT_NE(memo.find(known), nullptr);
  EXPECT_EQ(*memo.find(known), 0.75);
  EXPECT_EQ(memo.find(other), nullptr);
  memo.clear();
  EXPECT_EQ(memo.find(known), nullptr);
}

}  // namespace
}  // namespace carreau::plane
