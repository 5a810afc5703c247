// SPDX-License-Identifier: BSD-3-Clause
// Pairs of boxes that meet, beside a sweep along x that knows no tree.
#include "mesh/crossings/box_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "mesh/crossings/spatial_order.h"
#include "support/error.h"

namespace carreau {
namespace {

using Indices = std::array<std::int32_t, 3>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

struct Soup {
  std::vector<Vec3> vertices;
  std::vector<Indices> triangles;

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto n = static_cast<std::int32_t>(vertices.size());
    vertices.insert(vertices.end(), {a, b, c});
    triangles.push_back({n, n + 1, n + 2});
  }
  [[nodiscard]] BoxTree::Box box(std::size_t t) const {
    BoxTree::Box box;
    for (const std::int32_t v : triangles[t]) box.add(vertices[static_cast<std::size_t>(v)]);
    return box;
  }
};

std::vector<std::int32_t> all_of(const Soup& soup) {
  std::vector<std::int32_t> numbers(soup.triangles.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

Pairs found(const Soup& soup, const std::vector<std::int32_t>& numbers, int threads) {
  Monitor monitor;
  const BoxPairs near(soup.vertices, soup.triangles, numbers, monitor, threads);
  Pairs pairs;
  for (std::size_t part = 0; part < near.parts(); ++part)
    near.each(part, [&](std::size_t i, std::size_t j) { pairs.emplace_back(i, j); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Pairs by_sweep(const Soup& soup, std::vector<std::int32_t> numbers) {
  std::vector<BoxTree::Box> boxes(soup.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t) boxes[t] = soup.box(t);
  const auto low = [&](std::int32_t t) { return boxes[static_cast<std::size_t>(t)].low.x(); };
  std::sort(numbers.begin(), numbers.end(), [&](std::int32_t s, std::int32_t t) { return low(s) < low(t); });
  Pairs pairs;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    for (std::size_t l = k + 1; l < numbers.size(); ++l) {
      const auto [s, t] = std::minmax({static_cast<std::size_t>(numbers[k]), static_cast<std::size_t>(numbers[l])});
      if (low(numbers[l]) > boxes[static_cast<std::size_t>(numbers[k])].high.x()) break;
      if (!boxes[s].is_apart(boxes[t])) pairs.emplace_back(s, t);
    }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

void expect_those_of_a_sweep(const Soup& soup, const std::vector<std::int32_t>& numbers) {
  const Pairs expected = by_sweep(soup, numbers);
  for (const int threads : {1, 3}) EXPECT_TRUE(found(soup, numbers, threads) == expected) << threads;
}

/// n triangles about as large as `size`, at places of `place`.
Soup random_soup(int n, double size, const std::function<Vec3(std::mt19937&)>& place) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-size, size);
  Soup soup;
  for (int k = 0; k < n; ++k) {
    const Vec3 p = place(random);
    const auto corner = [&] { return Vec3(p + Vec3{part(random), part(random), part(random)}); };
    const Vec3 a = corner(), b = corner(), c = corner();
    soup.add(a, b, c);
  }
  return soup;
}

Vec3 in_cube(std::mt19937& random) {
  std::uniform_real_distribution<double> x(0, 1);
  const double a = x(random), b = x(random), c = x(random);
  return {a, b, c};
}
Vec3 on_sphere(std::mt19937& random) {
  std::normal_distribution<double> x;
  const double a = x(random), b = x(random), c = x(random);
  const Vec3 p{a, b, c};
  return (1 / norm(p)) * p;
}

TEST(BoxPairs, MatchASweep) {
  for (const int n : {0, 1, 2, 15, 16, 17, 33, 1000, 1025, 5000})
    expect_those_of_a_sweep(random_soup(n, n < 100 ? 0.3 : 0.02, in_cube), all_of(random_soup(n, 0.1, in_cube)));
}

// More than one thread sorts at once.
TEST(BoxPairs, MatchASweepForManyTriangles) {
  const Soup soup = random_soup(150'000, 0.003, on_sphere);
  expect_those_of_a_sweep(soup, all_of(soup));
}

// Half of all triangles lie in a millionth of a millionth of the box, and some are as large as all.
TEST(BoxPairs, MatchASweepForSizesFarApart) {
  Soup soup = random_soup(40'000, 0.004, in_cube);
  const Soup small = random_soup(100'000, 0.003, on_sphere);
  for (const Indices& t : small.triangles) {
    const auto at = [&](std::size_t i) -> Vec3 { return 1e-12 * small.vertices[static_cast<std::size_t>(t[i])]; };
    soup.add(at(0), at(1), at(2));
  }
  soup.add({0, 0, 0}, {1, 0, 0}, {0, 1, 1});
  soup.add({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5});
  expect_those_of_a_sweep(soup, all_of(soup));
}

TEST(BoxPairs, OnePlaceGivesAllPairs) {
  constexpr std::size_t n = 700;
  Soup soup;
  for (std::size_t k = 0; k < n; ++k) soup.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(found(soup, all_of(soup), 2).size(), n * (n - 1) / 2);
}

// Triangles of which most lie at one place, more than are sorted at once, and of coordinates whose differences
// overflow.
TEST(BoxPairs, MatchASweepForCoordinatesThatNoGridHolds) {
  Soup soup = random_soup(300, 1, [](std::mt19937& random) -> Vec3 { return 1e308 * on_sphere(random); });
  for (int k = 0; k < 300; ++k) soup.add({k * 1e-300, 0, 0}, {k * 1e-300, 1e-300, 0}, {k * 1e-300, 0, 1e-300});
  expect_those_of_a_sweep(soup, all_of(soup));
}

TEST(BoxPairs, PassOverOtherTriangles) {
  const Soup soup = random_soup(3000, 0.03, in_cube);
  std::vector<std::int32_t> odd;
  for (std::int32_t t = 1; t < 3000; t += 2) odd.push_back(t);
  expect_those_of_a_sweep(soup, odd);
}

TEST(SpatialOrder, IsAPermutationWithNeighboursNearForAnyNumberOfThreads) {
  const Soup soup = random_soup(200'000, 1e-4, in_cube);
  Monitor monitor;
  const std::vector<std::int32_t> order = spatial_order(soup.vertices, soup.triangles, all_of(soup), monitor, 1);
  EXPECT_EQ(order, spatial_order(soup.vertices, soup.triangles, all_of(soup), monitor, 4));
  EXPECT_EQ(std::set<std::int32_t>(order.begin(), order.end()).size(), soup.triangles.size());
  double sum = 0;
  for (std::size_t k = 0; k + 1 < order.size(); ++k)
    sum +=
        norm(soup.box(static_cast<std::size_t>(order[k])).low - soup.box(static_cast<std::size_t>(order[k + 1])).low);
  // In a row along the curve they would be a cube root of their number apart; by chance .66.
  EXPECT_LT(sum / static_cast<double>(order.size()), 3 * std::cbrt(1.0 / static_cast<double>(order.size())));
}

TEST(SpatialOrder, StopsOnRequest) {
  const Soup soup = random_soup(100, 0.1, in_cube);
  Monitor monitor;
  monitor.request_stop();
  EXPECT_THROW((void)spatial_order(soup.vertices, soup.triangles, all_of(soup), monitor, 1), Cancelled);
}

}  // namespace
}  // namespace carreau
