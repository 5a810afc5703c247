// SPDX-License-Identifier: BSD-3-Clause
// Taubin's filter against its closed form (HDR sec. 4.7.1).
#include "geometry/grid/smoothing.h"

#include <gtest/gtest.h>

#include <random>

#include "grid_test_support.h"

namespace carreau::grid {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Smoothing voltaire{.rounds = 2000, .inward = 0.06, .outward = 0.061};

/// The remainder after `rounds` rounds of mode m of a closed line of 144 values.
double left_of_mode(int m, int rounds) {
  constexpr int n = 144;
  std::vector<double> values(n);
  for (int i = 0; i < n; ++i) values[i] = 1 + std::cos(2 * pi * m * i / n);
  for (int round = 0; round < rounds; ++round) smooth_line(values, true, voltaire);
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += values[i] * std::cos(2 * pi * m * i / n);
  return 2 * sum / n / (2 * m == n ? 2 : 1);
}

TEST(Smoothing, ModesOfAClosedLineAreMultipliedByTheFilter) {
  for (const int m : {1, 5, 10, 12, 20, 72}) {
    const double k = 1 - std::cos(2 * pi * m / 144);
    const double exact = std::pow((1 - voltaire.inward * k) * (1 + voltaire.outward * k), voltaire.rounds);
    EXPECT_NEAR(left_of_mode(m, voltaire.rounds), exact, 1e-9) << m;
  }
  EXPECT_NEAR(left_of_mode(1, 2000), 1.0019, 5e-5);
  EXPECT_NEAR(left_of_mode(12, 2000), 1.1463, 5e-5);
  EXPECT_NEAR(left_of_mode(20, 2000), 0.8028, 5e-5);
  EXPECT_NEAR(left_of_mode(72, 2000), 8.9e-12, 1e-12);
}

TEST(Smoothing, NeighboursOfPointsWeighByTheOtherDistance) {
  // HDR: mean = (d2 P(i-1) + d1 P(i+1)) / (d1 + d2). A point of a straight line stays where it is, however uneven.
  std::vector<Vec3> line{{0, 0, 0}, {1, 2, 0}, {4, 8, 0}, {4.5, 9, 0}, {10, 20, 0}};
  const std::vector<Vec3> before = line;
  smooth_line(line, false, voltaire);
  for (std::size_t k = 0; k < line.size(); ++k) EXPECT_LE(norm(line[k] - before[k]), 1e-14);
  std::vector<Vec3> bent{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}};
  smooth_line(bent, false, {.rounds = 1, .inward = 0.5, .outward = 0});
  EXPECT_LE(norm(bent[1] - Vec3{1, 0.5, 0}), 1e-15);
  EXPECT_EQ(bent[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(bent[2], (Vec3{2, 0, 0}));
}

/// Sum of squares of fourth differences of the radii along rows.
double roughness(const Block& block) {
  const auto radius = [&](int i, int j) { return norm(block.node((i + block.columns - 1) % (block.columns - 1), j)); };
  double sum = 0;
  constexpr int ends = 12;  // bottom and top keep their points, and their noise with them
  for (int j = ends; j < block.rows - ends; ++j)
    for (int i = 0; i + 1 < block.columns; ++i) {
      const double along = radius(i - 2, j) - 4 * radius(i - 1, j) + 6 * radius(i, j) - 4 * radius(i + 1, j) + radius(i + 2, j);
      sum += along * along;
    }
  return sum;
}

/// Inside the radii over the unit circle's angles and z, by the rule of trapezes.
double volume(const Block& block) {
  double sum = 0;
  for (int j = 0; j + 1 < block.rows; ++j)
    for (int i = 0; i + 1 < block.columns; ++i) {
      const auto r2 = [&](int a, int b) {
        const Vec3& p = block.node(a, b);
        return p.x() * p.x() + p.y() * p.y();
      };
      sum += (r2(i, j) + r2(i + 1, j) + r2(i, j + 1) + r2(i + 1, j + 1)) / 8 * (block.node(i, j + 1).z() - block.node(i, j).z());
    }
  return sum * 2 * pi / (block.columns - 1);
}

Block noisy_scan(int around = 180, int up = 144) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.01);
  Block block = block_of(around + 1, up, [&](int i, int j) -> Vec3 {
    const double theta = 2 * pi * i / around, z = -0.95 + 1.9 * j / (up - 1), r = std::sqrt(1 - z * z) * (1 + noise(random));
    return {r * std::cos(theta), r * std::sin(theta), z};
  });
  for (int j = 0; j < block.rows; ++j) block.nodes[block.index(around, j)] = block.node(0, j);
  block.measured = Measured::radii;
  return block;
}

TEST(Smoothing, NoiseOfAScanGoesAndItsVolumeStays) {
  Monitor silent;
  const Block before = noisy_scan();
  const Closed closed = closed_directions(before, 1e-12);
  EXPECT_TRUE(closed.columns);
  EXPECT_FALSE(closed.rows);
  Block taubin = before, laplace = before;
  smooth_block(taubin, closed, voltaire, silent);
  smooth_block(laplace, closed, {.rounds = 2000, .inward = 0.06, .outward = 0}, silent);
  EXPECT_EQ(taubin.node(5, 0).z(), before.node(5, 0).z());
  const double exact = pi * (1.9 - 2 * 0.95 * 0.95 * 0.95 / 3);
  EXPECT_NEAR(volume(taubin), exact, 0.005 * exact);
  EXPECT_LT(volume(laplace), 0.97 * exact);
  EXPECT_LT(roughness(taubin), 1e-3 * roughness(before));
}

TEST(Smoothing, RadiiWeighByDistancesOnRequest) {
  Monitor silent;
  // One round of three nodes: the middle moves to the mean that the paper defines, with distances in space.
  Block three = block_of(3, 2, [](int i, int j) -> Vec3 {
    const double theta = 0.1 * i, r = i == 2 ? 2 : 1 + 0.3 * i;
    return {r * std::cos(theta), r * std::sin(theta), double(j)};
  });
  three.measured = Measured::radii;
  const double d1 = norm(three.node(1, 0) - three.node(0, 0)), d2 = norm(three.node(2, 0) - three.node(1, 0));
  Block even = three;
  smooth_block(three, {}, {.rounds = 1, .inward = 0.5, .outward = 0, .by_distance = true}, silent);
  smooth_block(even, {}, {.rounds = 1, .inward = 0.5, .outward = 0}, silent);
  EXPECT_NEAR(std::hypot(three.node(1, 0).x(), three.node(1, 0).y()), (1.3 + (d2 * 1 + d1 * 2) / (d1 + d2)) / 2, 1e-15);
  EXPECT_NEAR(std::hypot(even.node(1, 0).x(), even.node(1, 0).y()), (1.3 + 1.5) / 2, 1e-15);
  // The scan of a noisy sphere: the noise goes and the volume stays, as with even weights.
  const Block before = noisy_scan(60, 48);
  const Closed closed = closed_directions(before, 1e-12);
  Block by_distance = before;
  Smoothing weighted = voltaire;
  weighted.by_distance = true;
  smooth_block(by_distance, closed, weighted, silent);
  const double exact = pi * (1.9 - 2 * 0.95 * 0.95 * 0.95 / 3);
  EXPECT_NEAR(volume(by_distance), exact, 0.005 * exact);
  EXPECT_LT(roughness(by_distance), 1e-3 * roughness(before));
}

TEST(Smoothing, MissingNodesEndLines) {
  Monitor silent;
  Block block = block_of(7, 2, [](int i, int j) -> Vec3 { return {double(i), double(j), i % 2 == 0 ? 0.0 : 1.0}; });
  block.measured = Measured::heights;
  block.nodes[block.index(3, 1)].z() = std::nan("");
  smooth_block(block, {}, {.rounds = 1, .inward = 0.5, .outward = 0}, silent);
  EXPECT_TRUE(std::isnan(block.node(3, 1).z()));
  EXPECT_EQ(block.node(2, 1).z(), 0);  // an end now
  EXPECT_GT(block.node(1, 1).z(), 0);
  EXPECT_LT(block.node(1, 1).z(), 1);
}

TEST(Smoothing, AStopIsObeyed) {
  Monitor monitor;
  Block block = noisy_scan();
  monitor.request_stop();
  EXPECT_THROW(smooth_block(block, {}, voltaire, monitor), Cancelled);
}

}  // namespace
}  // namespace carreau::grid
