// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/arrangement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "balls_from_files.h"
#include "geometry/molecule/areas.h"
#include "support/error.h"

namespace carreau::molecule {
namespace {

constexpr double pi = std::numbers::pi;

Arrangement of(const std::vector<Ball>& balls, int threads = 1) {
  Monitor silent;
  return arrange(balls, threads, silent);
}

std::vector<Ball> random_balls(int n, double density, unsigned seed) {
  std::mt19937 random(seed);
  const double side = std::cbrt(n / density);
  std::uniform_real_distribution<double> place(0, side), radius(1, 2);
  std::vector<Ball> balls;
  for (int i = 0; i < n; ++i) balls.push_back({{place(random), place(random), place(random)}, radius(random)});
  return balls;
}

/// A rotation by three angles, and a shift.
std::vector<Ball> turned(std::vector<Ball> balls, double a, double b) {
  for (Ball& ball : balls) {
    const Vec3 p = ball.centre;
    const Vec3 q{std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y(), p.z()};
    ball.centre =
        Vec3{q.x() + 3, std::cos(b) * q.y() - std::sin(b) * q.z() - 7, std::sin(b) * q.y() + std::cos(b) * q.z() + 1};
  }
  return balls;
}

double lens_area(double r, double d) { return 2 * (2 * pi * r * r + pi * r * d); }

TEST(Arrange, TwoBallsHaveOneCircleAndTheAreaOfTwoCaps) {
  const Arrangement vws = of({{{0, 0, 0}, 1.7}, {{1.5, 0, 0}, 1.7}});
  ASSERT_EQ(vws.circles.size(), 1U);
  EXPECT_TRUE(vws.vertices.empty());
  EXPECT_NEAR(vws.circles[0].radius, std::sqrt(1.7 * 1.7 - 0.75 * 0.75), 1e-15);
  EXPECT_NEAR(measure(vws).area, lens_area(1.7, 1.5), 1e-12);
  EXPECT_NEAR(measure(vws).area, 52.3389, 5e-5);
  const Arrangement sas = of({{{0, 0, 0}, 3.1}, {{1.5, 0, 0}, 3.1}});
  EXPECT_NEAR(measure(sas).area, 149.9796, 5e-5);
  EXPECT_NEAR(sas.circles[0].radius, 3.00791, 5e-6);
  EXPECT_EQ(sas.euler_number(), 2);
}

TEST(Arrange, VolumeOfTwoBallsIsTheirSumLessTheLens) {
  const double r = 1.7, d = 1.5, lens = pi * (4 * r + d) * (2 * r - d) * (2 * r - d) / 12;
  EXPECT_NEAR(measure(of({{{4, 5, 6}, r}, {{4, 5, 6 + d}, r}})).volume, 2 * 4 * pi * r * r * r / 3 - lens, 1e-12);
}

TEST(Arrange, MoleculesHaveTheAreasAndVolumesOfSampling) {
  const UnionMeasures caffeine = measure(of(read_balls("caffeine.xyzr"))),
                      around = measure(of(read_balls("caffeine.xyzr", 1.4)));
  EXPECT_NEAR(caffeine.area, 219.08, 2e-4 * 219.08);
  EXPECT_NEAR(caffeine.volume, 171.31, 2e-4 * 171.31);
  EXPECT_NEAR(around.area, 387.87, 2e-4 * 387.87);
  EXPECT_NEAR(around.volume, 588.82, 2e-4 * 588.82);
  const UnionMeasures dna = measure(of(read_balls("1bna.xyzr"))), wet = measure(of(read_balls("1bna.xyzr", 1.4)));
  EXPECT_NEAR(dna.area, 5614.9, 2e-4 * 5614.9);
  EXPECT_NEAR(dna.volume, 4844.6, 2e-4 * 4844.6);
  EXPECT_NEAR(wet.area, 4659.5, 2e-4 * 4659.5);
  EXPECT_NEAR(wet.volume, 11545.9, 2e-4 * 11545.9);
  EXPECT_EQ(std::count_if(wet.ball_area.begin(), wet.ball_area.end(), [](double a) { return a > 0; }), 385);
}

TEST(Arrange, CountsThePairsThatMeet) {
  EXPECT_EQ(of(read_balls("caffeine.xyzr")).meeting_pairs, 84U);
  EXPECT_EQ(of(read_balls("caffeine.xyzr", 1.4)).meeting_pairs, 207U);
  EXPECT_EQ(of(read_balls("1bna.xyzr")).meeting_pairs, 1751U);
  EXPECT_EQ(of(read_balls("1bna.xyzr", 1.4)).meeting_pairs, 9077U);
}

TEST(Arrange, AreasDoNotDependOnTheAxes) {
  for (const double probe : {0.0, 1.4}) {
    const std::vector<Ball> balls = read_balls("1bna.xyzr", probe);
    const UnionMeasures m = measure(of(balls)), t = measure(of(turned(balls, 0.7, 1.9)));
    EXPECT_NEAR(m.area, t.area, 1e-9 * m.area);
    EXPECT_NEAR(m.volume, t.volume, 1e-9 * m.volume);
    ASSERT_EQ(m.component_area.size(), t.component_area.size());
    for (std::size_t i = 0; i < balls.size(); ++i) EXPECT_NEAR(m.ball_area[i], t.ball_area[i], 1e-9 * m.area);
  }
}

/// Shares of points of each sphere that no ball covers.
TEST(Arrange, AgreesWithSamplingOfRandomBalls) {
  for (const double density : {0.01, 0.05, 0.2}) {
    const std::vector<Ball> balls = random_balls(300, density, 5);
    const Arrangement a = of(balls);
    const UnionMeasures m = measure(a);
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    constexpr int samples = 4000;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      int bare = 0;
      for (int s = 0; s < samples; ++s) {
        Vec3 n{normal(random), normal(random), normal(random)};
        n /= norm(n);
        const Vec3 p = balls[i].centre + balls[i].radius * n;
        bool covered = false;
        for (std::size_t j = 0; j < balls.size() && !covered; ++j)
          covered = j != i && norm(p - balls[j].centre) < balls[j].radius;
        bare += covered ? 0 : 1;
      }
      const double whole = 4 * pi * balls[i].radius * balls[i].radius, share = m.ball_area[i] / whole;
      EXPECT_NEAR(share, bare / double(samples), 5 * std::sqrt((share * (1 - share) + 1e-4) / samples));
    }
    for (std::size_t c = 0; c < a.components.size(); ++c) {
      const double r = balls[a.components[c].ball].radius;
      EXPECT_GT(m.component_area[c], 0);
      EXPECT_LE(m.component_area[c], 4 * pi * r * r * (1 + 1e-12));
    }
    for (std::size_t s = 0; s < m.shell_volume.size(); ++s) EXPECT_NE(m.shell_volume[s], 0);
  }
}

TEST(Arrange, VerticesAndArcsLieOnTheirSpheresAndInNone) {
  const std::vector<Ball> balls = read_balls("1bna.xyzr", 1.4);
  const Arrangement a = of(balls);
  for (const Vertex& v : a.vertices)
    for (const int b : v.balls) EXPECT_NEAR(norm(v.x - balls[b].centre), balls[b].radius, 1e-12);
  for (const Arc& arc : a.arcs) {
    EXPECT_GT(arc.b, arc.a);
    const Vec3 p = a.circles[arc.circle].point((arc.a + arc.b) / 2);
    for (const Ball& ball : balls) EXPECT_GT(norm(p - ball.centre), ball.radius - 1e-12);
  }
  EXPECT_EQ(2 * a.arcs.size(), 3 * a.vertices.size() + 2 * std::count_if(a.arcs.begin(), a.arcs.end(),
                                                                         [](const Arc& arc) { return arc.whole(); }));
}

TEST(Arrange, EulerNumberCountsShells) {
  EXPECT_EQ(of(read_balls("caffeine.xyzr", 1.4)).euler_number(), 2);
  EXPECT_EQ(of(read_balls("caffeine.xyzr")).euler_number(), 0);  // a hydrogen touches an oxygen: a handle
  std::vector<Ball> ring;                                        // a torus of balls
  for (int k = 0; k < 12; ++k) ring.push_back({{4 * std::cos(k * pi / 6), 4 * std::sin(k * pi / 6), 0}, 1.3});
  EXPECT_EQ(of(ring).euler_number(), 0);
  ring.push_back({{50, 0, 0}, 2});
  EXPECT_EQ(of(ring).euler_number(), 2);
  std::vector<Ball> shell;  // a cage of balls about a cavity
  for (int k = 0; k < 200; ++k) {
    const double z = 1 - (2 * k + 1) / 200.0, r = std::sqrt(1 - z * z), turn = 2.399963 * k;
    shell.push_back({Vec3{6 * r * std::cos(turn), 6 * r * std::sin(turn), 6 * z}, 1.6});
  }
  const Arrangement cage = of(shell);
  const UnionMeasures m = measure(cage);
  EXPECT_EQ(cage.euler_number(), 4);
  ASSERT_EQ(m.shell_volume.size(), 2U);
  EXPECT_LT(m.shell_volume[0] * m.shell_volume[1], 0);
}

TEST(Arrange, ConcentricEqualAndHeldBallsCountOnce) {
  const double alone = 4 * pi * 4;
  EXPECT_NEAR(measure(of({{{1, 2, 3}, 2}, {{1, 2, 3}, 2}})).area, alone, 1e-12);
  EXPECT_NEAR(measure(of({{{1, 2, 3}, 1}, {{1, 2, 3}, 2}, {{1.5, 2, 3}, 0.2}, {{2, 2, 3}, 1}})).area, alone, 1e-12);
  const Arrangement a = of({{{1, 2, 3}, 1}, {{1, 2, 3}, 2}});
  EXPECT_EQ(a.held_by, (std::vector<int>{1, -1}));
  EXPECT_EQ(a.components.size(), 1U);
}

TEST(Arrange, TouchingBallsAreApart) {
  const Arrangement a = of({{{0, 0, 0}, 1}, {{3, 0, 0}, 2}});
  EXPECT_TRUE(a.circles.empty());
  EXPECT_EQ(a.euler_number(), 4);
  EXPECT_TRUE(a.moved.empty());
}

TEST(Arrange, FourSpheresThroughAPointAreDecidedAsOneSetOfBalls) {
  const std::vector<Ball> square{{{0, 0, 0}, 1.2}, {{1, 0, 0}, 1.2}, {{0, 1, 0}, 1.2}, {{1, 1, 0}, 1.2}};
  const Arrangement a = of(square);
  EXPECT_EQ(a.moved.size(), 4U);
  EXPECT_EQ(a.euler_number(), 2);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(a.balls[i].radius, 1.2, 3e-9);
  const UnionMeasures m = measure(a);
  for (const double area : m.ball_area) EXPECT_NEAR(area, m.area / 4, 1e-6);
}

TEST(Arrange, ACrystalOfEqualBallsIsDecided) {
  constexpr int n = 4;
  std::vector<Ball> balls;  // a cubic lattice: at each square four spheres meet in two points
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z) balls.push_back({{2.0 * x, 2.0 * y, 2.0 * z}, 1.5});
  const Arrangement a = of(balls);
  const UnionMeasures m = measure(a);
  EXPECT_EQ(a.moved.size(), balls.size());
  EXPECT_EQ(m.shell_volume.size(), 1U + (n - 1) * (n - 1) * (n - 1));
  std::vector<Ball> moved = turned(balls, 0.3, 0.4);
  EXPECT_NEAR(measure(of(moved)).area, m.area, 1e-6 * m.area);
}

TEST(Arrange, DoesNotDependOnThreads) {
  const std::vector<Ball> balls = random_balls(2000, 0.1, 9);
  const Arrangement one = of(balls, 1), two = of(balls, 3);
  EXPECT_EQ(measure(one).area, measure(two).area);
  EXPECT_EQ(one.vertices.size(), two.vertices.size());
}

TEST(Arrange, RejectsInvalidBalls) {
  const auto sentence = [](const std::vector<Ball>& balls) -> std::string {
    try {
      of(balls);
    } catch (const InvalidArgument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(sentence({}), "there is no atom");
  EXPECT_EQ(sentence({{{0, 0, 0}, 1}, {{0, 0, 0}, 0}}), "atom 2: the radius is 0; it must be positive and finite");
  EXPECT_EQ(sentence({{{0, 0, 0}, INFINITY}}), "atom 1: the radius is inf; it must be positive and finite");
  EXPECT_EQ(sentence({{{0, NAN, 0}, 1}}), "atom 1: the centre is not finite");
  EXPECT_NE(sentence({{{0, 0, 0}, 1}, {{0, 0, 0}, 1e-10}}), "");
}

}  // namespace
}  // namespace carreau::molecule
