// SPDX-License-Identifier: BSD-3-Clause
// The box tree against all boxes one by one.
#include "support/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "support/error.h"

namespace carreau {
namespace {

using Box = BoxTree::Box;

struct Boxes {
  std::vector<Box> boxes;
  std::vector<Vec3> centres;
};

/// Every third box equals its predecessor.
Boxes random_boxes(int n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 1), side(0, 0.1);
  Boxes all;
  for (int k = 0; k < n; ++k) {
    Box box;
    if (k % 3 == 2) {
      box = all.boxes.back();
    } else {
      const Vec3 p{place(random), place(random), 0.1 * place(random)};
      box.add(p);
      box.add(p + Vec3{side(random), side(random), side(random)});
    }
    all.boxes.push_back(box);
    all.centres.push_back(0.5 * (box.low + box.high));
  }
  return all;
}

TEST(BoxTree, FindsTheLeastDistanceOfAllBoxes) {
  for (const int n : {1, 4, 5, 9, 100, 3000}) {
    const Boxes all = random_boxes(n);
    const BoxTree tree(all.boxes, all.centres);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-0.5, 1.5);
    for (int k = 0; k < 100; ++k) {
      const Vec3 p{place(random), place(random), place(random)};
      double least = infinity, found = infinity;
      for (const Box& box : all.boxes) least = std::min(least, box.squared_distance(p));
      int looked_at = 0;
      tree.nearest_first(
          [&](std::int32_t node) { return tree.node(static_cast<std::size_t>(node)).box.squared_distance(p); },
          [&](double bound) { return bound < found; },
          [&](const BoxTree::Node& leaf) {
            ++looked_at;
            for (const std::int32_t b : tree.things(leaf)) found = std::min(found, all.boxes[b].squared_distance(p));
          });
      ASSERT_EQ(found, least);
      EXPECT_LE(looked_at, n < 3000 ? n : 200);
    }
  }
}

TEST(BoxTree, FindsAllBoxesThatMeetOne) {
  const Boxes all = random_boxes(3000);
  const BoxTree tree(all.boxes, all.centres);
  for (const double x : {0., 0.3, 0.9, 2.}) {
    const Box asked{{x, 0.2, 0}, {x + 0.1, 0.4, 0.05}};
    std::set<std::int32_t> found, expected;
    tree.all_that_meet([&](const Box& box) { return !box.is_apart(asked); },
                       [&](const BoxTree::Node& leaf) {
                         for (const std::int32_t b : tree.things(leaf)) {
                           if (all.boxes[b].is_apart(asked)) continue;
                           EXPECT_TRUE(found.insert(b).second);
                         }
                       });
    for (int b = 0; b < 3000; ++b)
      if (!all.boxes[b].is_apart(asked)) expected.insert(b);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(found.empty(), x > 1.2);
  }
}

TEST(BoxTree, EmptyTreeFindsNothing) {
  const BoxTree tree;
  EXPECT_TRUE(tree.empty());
  tree.all_that_meet([](const Box&) { return true; }, [](const BoxTree::Node&) { FAIL(); });
  tree.nearest_first([](std::int32_t) { return 0.; }, [](double) { return true; },
                     [](const BoxTree::Node&) { FAIL(); });
}

TEST(BoxTree, StopsOnRequest) {
  const Boxes all = random_boxes(300'000);
  Monitor stop;
  stop.request_stop();
  EXPECT_THROW(BoxTree(all.boxes, all.centres, &stop), Cancelled);
}

}  // namespace
}  // namespace carreau
