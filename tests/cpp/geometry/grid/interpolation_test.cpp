// SPDX-License-Identifier: BSD-3-Clause
// Coons patches through the nodes of grids (HDR sec. 4.7.2).
#include <gtest/gtest.h>

#include <random>

#include "geometry/grid/coons_surface.h"
#include "geometry/grid/differences.h"
#include "grid_test_support.h"

namespace carreau::grid {
namespace {

constexpr double pi = std::numbers::pi;

SurfaceJet at(const GridGeometry& made, int face, double u, double v) {
  return surface_at(*made.built.cad, face, want_position | want_first | want_second, {u, v});
}

TEST(Coons, BicubicPolynomialsAreReproducedWithTheirDerivatives) {
  // With exact derivatives at the nodes, on uneven knots.
  const auto f = [](double u, double v) -> Vec3 {
    return {u * u * u * v - v * v, 1 + u * v * v * v, u * u * u * v * v * v - 2 * u * u * v + u};
  };
  CoonsSurface surface{{0, 0.3, 1.7, 2}, {0, 1, 1.5}, {}};
  for (const double v : surface.v)
    for (const double u : surface.u)
      surface.nodes.push_back({f(u, v),
                               {3 * u * u * v, v * v * v, 3 * u * u * v * v * v - 4 * u * v + 1},
                               {u * u * u - 2 * v, 3 * u * v * v, 3 * u * u * u * v * v - 2 * u * u},
                               {3 * u * u, 3 * v * v, 9 * u * u * v * v - 4 * u}});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < 200; ++k) {
    const double u = 2 * share(random), v = 1.5 * share(random);
    const SurfaceJet s = surface.at({u, v});
    EXPECT_LE(norm(s.s - f(u, v)), 1e-13);
    EXPECT_LE(norm(s.su - Vec3{3 * u * u * v, v * v * v, 3 * u * u * v * v * v - 4 * u * v + 1}), 1e-12);
    EXPECT_LE(norm(s.svv - Vec3{-2, 6 * u * v, 6 * u * u * u * v}), 1e-11);
    EXPECT_LE(norm(s.suv - Vec3{3 * u * u, 3 * v * v, 9 * u * u * v * v - 4 * u}), 1e-11);
    EXPECT_LE(norm(s.suu - Vec3{6 * u * v, 0, 6 * u * v * v * v - 4 * v}), 1e-11);
  }
}

TEST(Coons, DifferencesAreExactForParabolasOnUnevenKnots) {
  std::vector<Sample> line;
  for (const double x : {0.0, 0.1, 0.5, 2.0, 2.2}) line.push_back({x, Vec3{x * x - x, 3 * x, 2 - x * x}});
  const std::vector<Vec3> d = line_derivatives(line, std::vector<char>(5, 1), false);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_LE(norm(d[k] - Vec3{2 * line[k].x - 1, 3, -2 * line[k].x}), 1e-13);
}

TEST(Coons, PlanesAndTheRulingsOfACylinderAreExact) {
  const GridGeometry plane = build({block_of(5, 4, [](int i, int j) -> Vec3 { return {i * i + 2.0 * j, j * 1.0, 3.0 * j - i * i}; })});
  const SurfaceJet p = at(plane, 1, 1.3, 2.6);
  EXPECT_NEAR(p.s.z(), 3 * p.s.y() - (p.s.x() - 2 * p.s.y()), 1e-13);
  const GridGeometry cylinder = build({block_of(9, 4, [](int i, int j) -> Vec3 {
    return {std::cos(0.2 * i), std::sin(0.2 * i), 0.7 * j};
  })});
  for (const double v : {0.2, 1.5, 2.9}) {
    const SurfaceJet s = at(cylinder, 1, 3.4, v);
    EXPECT_LE(norm(s.s - Vec3{at(cylinder, 1, 3.4, 0).s + Vec3{0, 0, 0.7 * v}}), 1e-14);
    EXPECT_LE(norm(s.svv), 1e-13);
  }
}

TEST(Coons, CellsMeetWithC1) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  const GridGeometry made = build({block_of(
      6, 5, [&](int i, int j) -> Vec3 { return {i + noise(random), j + noise(random), noise(random)}; })});
  constexpr double near = 1e-9;
  for (const double v : {0.5, 1.7, 3.3})
    for (int i = 1; i < 5; ++i) {
      const SurfaceJet left = at(made, 1, i - near, v), right = at(made, 1, i + near, v);
      EXPECT_LE(norm(left.s - right.s), 1e-8);
      EXPECT_LE(norm(left.su - right.su), 1e-7);
      EXPECT_LE(norm(left.sv - right.sv), 1e-7);
      EXPECT_GT(norm(left.suu - right.suu), 1e-3);  // and no more than C1
    }
}

/// Largest distance from the unit sphere of the surface through n x n of its cells.
double error_of_sphere(int n, const Options& options) {
  const GridGeometry made = build({block_of(n + 1, n + 1, [n](int i, int j) -> Vec3 {
                                    const double a = 0.3 + 0.9 * i / n, b = -0.5 + 1.0 * j / n;
                                    return {std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)};
                                  })},
                                  options);
  double largest = 0;
  for (int i = 0; i < 4 * n; ++i)
    for (int j = 0; j < 4 * n; ++j)
      largest = std::max(largest, std::abs(norm(at(made, 1, (i + 0.5) / 4, (j + 0.5) / 4).s) - 1));
  return largest;
}

/// Largest error of the second derivatives of z = sin(2 x) cos(y) over the unit square of n x n cells.
double error_of_second_derivatives(int n, const Options& options) {
  const GridGeometry made = build({block_of(n + 1, n + 1, [n](int i, int j) -> Vec3 {
                                    const double x = double(i) / n, y = double(j) / n;
                                    return {x, y, std::sin(2 * x) * std::cos(y)};
                                  })},
                                  options);
  double largest = 0;
  for (int i = 0; i < 4 * n; ++i)
    for (int j = 0; j < 4 * n; ++j) {
      const double u = (i + 0.5) / 4, v = (j + 0.5) / 4, x = u / n, y = v / n;
      const SurfaceJet s = at(made, 1, u, v);
      for (const auto& [found, exact] : {std::pair{s.suu.z(), -4 * std::sin(2 * x) * std::cos(y)}, {s.suv.z(), -2 * std::cos(2 * x) * std::sin(y)},
                                         {s.svv.z(), -std::sin(2 * x) * std::cos(y)}})
        largest = std::max(largest, std::abs(found * n * n - exact));
    }
  return largest;
}

TEST(Coons, ASampledSphereConvergesAtThirdOrderAndFergusonsIsWorse) {
  const double coarse = error_of_sphere(8, {}), fine = error_of_sphere(16, {}), finest = error_of_sphere(32, {});
  EXPECT_GT(std::log2(coarse / fine), 2.9);
  EXPECT_GT(std::log2(fine / finest), 2.9);
  // Without cross derivatives the error is the error of the twist, of order two.
  EXPECT_GT(error_of_sphere(32, {.cross_derivatives = false}), 3 * finest);
}

TEST(Splines, ReproduceCubicPolynomialsOnUnevenKnots) {
  const auto f = [](double x) -> Vec3 { return {x * x * x, 2 - x * x * x + 3 * x, x * x}; };
  std::vector<Sample> line;
  for (const double x : {0.0, 0.1, 0.5, 2.0, 2.2, 3.1}) line.push_back({x, f(x)});
  for (const Sample& s : line) {
    const std::size_t k = std::size_t(&s - line.data());
    const Vec3 d = spline_derivatives(line, std::vector<char>(6, 1), false)[k];
    EXPECT_LE(norm(d - Vec3{3 * s.x * s.x, 3 - 3 * s.x * s.x, 2 * s.x}), 1e-13);
  }
  // On each side of a missing node four points determine a cubic.
  for (const double x : {3.5, 4.0, 4.6, 5.0, 5.1}) line.push_back({x, f(x)});
  std::vector<char> there(line.size(), 1);
  there[5] = 0, line[5].p = {std::nan(""), 0, 0};
  const std::vector<Vec3> d = spline_derivatives(line, there, false);
  for (std::size_t k = 0; k < line.size(); ++k)
    if (there[k] != 0) {
      EXPECT_NEAR(d[k].x(), 3 * line[k].x * line[k].x, 1e-11);
    }
  // Prescribed derivatives at both ends of three points: the cubic of Hermite in each half has one second derivative.
  const std::vector<Sample> three{{0, {0, 0, 0}}, {1, {1, 0, 0}}, {3, {27, 0, 0}}};
  const std::vector<std::optional<Vec3>> ends{Vec3{0, 0, 0}, std::nullopt, Vec3{27, 0, 0}};
  EXPECT_NEAR(spline_derivatives(three, std::vector<char>(3, 1), false, ends)[1].x(), 3, 1e-14);
}

TEST(Splines, OfClosedLinesHaveTheDerivativesOfModes) {
  // The spline of sin(m x) through n even points of a period has slopes m cos(m x) (3 sin a / a) / (2 + cos a), a = 2 pi m / n.
  constexpr int n = 12;
  for (const int m : {1, 2, 5}) {
    std::vector<Sample> line;
    for (int k = 0; k <= n; ++k) line.push_back({2 * pi * k / n, Vec3{std::sin(m * 2 * pi * (k % n) / n), 0, 0}});
    const double a = 2 * pi * m / n, share = 3 * std::sin(a) / (a * (2 + std::cos(a)));
    const std::vector<Vec3> d = spline_derivatives(line, std::vector<char>(n + 1, 1), true);
    for (int k = 0; k <= n; ++k) EXPECT_NEAR(d[std::size_t(k)].x(), m * std::cos(m * line[std::size_t(k)].x) * share, 1e-13);
    // With one point missing the line goes on across its joint: three points on the other side know its slope there.
    std::vector<char> there(n + 1, 1);
    there[6] = 0;
    const std::vector<Vec3> open = spline_derivatives(line, there, true);
    EXPECT_EQ(open.front(), open.back());
    if (m == 1) {
      EXPECT_NEAR(open[0].x(), 1, 2e-3);
    }
  }
}

TEST(Splines, BicubicPolynomialsAreExactAndCellsMeetWithC2) {
  const auto f = [](double u, double v) -> Vec3 { return {u * u * u * v - v * v, 1 + u * v * v * v, u * u * u * v * v * v - 2 * u * u * v + u}; };
  const GridGeometry exact = build({block_of(6, 5, [&](int i, int j) { return f(i, j); })}, {.splines = true});
  for (const double u : {0.2, 2.5, 4.9})
    for (const double v : {0.1, 1.7, 3.6}) {
      const SurfaceJet s = at(exact, 1, u, v);
      EXPECT_LE(norm(s.s - f(u, v)), 1e-10);
      EXPECT_LE(norm(s.suv - Vec3{3 * u * u, 3 * v * v, 9 * u * u * v * v - 4 * u}), 1e-9);
      EXPECT_LE(norm(s.suu - Vec3{6 * u * v, 0, 6 * u * v * v * v - 4 * v}), 1e-9);
    }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  const Block rough = block_of(7, 6, [&](int i, int j) -> Vec3 { return {i + noise(random), j + noise(random), noise(random)}; });
  constexpr double near = 1e-9;
  for (const bool lengths : {false, true}) {
    const GridGeometry made = build({rough}, {.lengths = lengths, .splines = true});
    const Interval u = made.built.cad->curve_interval(1, 1), v = made.built.cad->curve_interval(1, 2);
    // Lines between cells are unknown with lengths: second derivatives change by no more than their slopes allow.
    for (int k = 0; k < 400; ++k) {
      const double x = u.b * (k + 0.5) / 400;
      for (const double y : {0.13 * v.b, 0.41 * v.b, 0.77 * v.b}) {
        const double step = u.b / 4000;
        const SurfaceJet a = at(made, 1, x, y), b = at(made, 1, x + step, y);
        EXPECT_LE(norm(a.suu - b.suu), 60 * step);
        EXPECT_LE(norm(a.suv - b.suv), 60 * step);
        EXPECT_LE(norm(a.svv - b.svv), 60 * step);
      }
    }
    for (int i = 1; !lengths && i < 6; ++i)
      for (const double y : {0.5, 1.7, 4.3}) {
        const SurfaceJet left = at(made, 1, i - near, y), right = at(made, 1, i + near, y);
        for (const Vec3& jump : {Vec3(left.suu - right.suu), Vec3(left.suv - right.suv), Vec3(left.svv - right.svv)}) EXPECT_LE(norm(jump), 1e-7);
      }
  }
}

TEST(Splines, ConvergeAtFourthOrderAndTheirSecondDerivativesAtSecond) {
  const Options splines{.splines = true};
  EXPECT_GT(std::log2(error_of_sphere(8, splines) / error_of_sphere(16, splines)), 3.7);
  EXPECT_GT(std::log2(error_of_sphere(16, splines) / error_of_sphere(32, splines)), 3.7);
  const double coarse = error_of_second_derivatives(16, splines), fine = error_of_second_derivatives(32, splines);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
  // Differences: order one.
  EXPECT_LT(std::log2(error_of_second_derivatives(16, {}) / error_of_second_derivatives(32, {})), 1.2);
  EXPECT_LT(10 * fine, error_of_second_derivatives(32, {}));
}

/// Two halves of one grid, the second one turned by `turns` quarters and mirrored if requested.
std::vector<Block> halves(int turns, bool mirrored) {
  const auto at = [](double i, double j) -> Vec3 { return {i, j, std::sin(0.5 * i) * std::cos(0.4 * j)}; };
  const Block left = block_of(6, 8, at);
  const auto right = [&](int i, int j) -> Vec3 { return at(5 + i, j); };  // 7 x 8 nodes
  constexpr int m = 7, n = 8;
  Block turned;
  if (turns % 2 == 0)
    turned = block_of(m, n, [&](int i, int j) -> Vec3 {
      return turns == 0 ? right(i, mirrored ? n - 1 - j : j) : right(m - 1 - i, mirrored ? j : n - 1 - j);
    });
  else
    turned = block_of(n, m, [&](int i, int j) -> Vec3 {
      return turns == 1 ? right(j, mirrored ? i : n - 1 - i) : right(m - 1 - j, mirrored ? n - 1 - i : i);
    });
  return {left, turned};
}

SurfaceJet at_curve(const GridGeometry& made, std::size_t face, std::size_t curve, double share) {
  const int ref = made.built.model.faces[face].ref, ic = static_cast<int>(curve) + 1;
  const Interval interval = made.built.cad->curve_interval(ref, ic);
  const Vec2 uv = made.built.cad->curve(ref, ic, want_position, share * interval.b).c;
  return surface_at(*made.built.cad, ref, want_position | want_first, uv);
}

struct Shared {
  double gap = 0;
  double angle = 0;  ///< its sine
};

/// Largest distance between two blocks along the curve that they share, and largest angle of their normals there.
Shared along_shared_curve(const GridGeometry& made) {
  Shared worst;
  int found = 0;
  const std::vector<Face>& faces = made.built.model.faces;
  for (std::size_t a = 0; a < faces[0].curves.size(); ++a)
    for (std::size_t b = 0; b < faces[1].curves.size(); ++b) {
      if (faces[0].curves[a].ref != faces[1].curves[b].ref) continue;
      ++found;
      const bool same = faces[0].curves[a].end1 == faces[1].curves[b].end1;
      for (double share = 0; share <= 1; share += 1.0 / 64) {
        const SurfaceJet s = at_curve(made, 0, a, share), t = at_curve(made, 1, b, same ? share : 1 - share);
        worst.gap = std::max(worst.gap, norm(s.s - t.s));
        worst.angle = std::max(worst.angle, norm(cross(unit_normal(s), unit_normal(t))));
      }
    }
  EXPECT_EQ(found, 1);
  return worst;
}

TEST(Coons, BlocksShareCurvesAndOnRequestTangentPlanesHoweverTheyAreTurned) {
  for (int turns = 0; turns < 4; ++turns)
    for (const bool mirrored : {false, true})
      for (const bool lengths : {false, true}) {
        const Shared free = along_shared_curve(build(halves(turns, mirrored), {.lengths = lengths}));
        EXPECT_LE(free.gap, 1e-13) << turns << mirrored << lengths;
        EXPECT_GT(free.angle, 1e-4);
        const Shared joined = along_shared_curve(build(halves(turns, mirrored), {.lengths = lengths, .join_angle = 0.5}));
        EXPECT_LE(joined.gap, 1e-13);
        EXPECT_LE(joined.angle, 1e-12) << turns << mirrored << lengths;
      }
}

TEST(Coons, JoinedHalvesAreTheWholeGrid) {
  const GridGeometry joined = build(halves(0, false), {.join_angle = 0.5});
  const GridGeometry whole = build({block_of(12, 8, [](double i, double j) -> Vec3 {
    return {i, j, std::sin(0.5 * i) * std::cos(0.4 * j)};
  })});
  for (const double u : {4.2, 4.9, 5.0, 5.1, 6.8})
    for (const double v : {0.3, 3.5, 6.6}) {
      const SurfaceJet part = u <= 5 ? at(joined, 1, u, v) : at(joined, 2, u - 5, v), all = at(whole, 1, u, v);
      EXPECT_LE(norm(part.s - all.s), 1e-13);
      EXPECT_LE(norm(part.su - all.su), 1e-13);
    }
}

TEST(Splines, JoinedBlocksShareTangentPlanesAndStayC2Inside) {
  for (int turns = 0; turns < 4; ++turns)
    for (const bool mirrored : {false, true}) {
      const GridGeometry joined = build(halves(turns, mirrored), {.join_angle = 0.5, .splines = true});
      const Shared border = along_shared_curve(joined);
      EXPECT_LE(border.gap, 1e-13) << turns << mirrored;
      EXPECT_LE(border.angle, 1e-12) << turns << mirrored;
      constexpr double near = 1e-9;
      for (const double v : {0.3, 3.5, 6.6})
        for (int i = 1; i < 5; ++i) {
          const SurfaceJet left = at(joined, 1, i - near, v), right = at(joined, 1, i + near, v);
          for (const Vec3& jump : {Vec3(left.suu - right.suu), Vec3(left.suv - right.suv), Vec3(left.svv - right.svv)}) EXPECT_LE(norm(jump), 1e-7);
        }
    }
}

TEST(Coons, AnEdgeSharperThanTheAngleStays) {
  const auto roof = [](double i, double j) -> Vec3 { return {i, j, -std::abs(i - 5)}; };
  const Block left = block_of(6, 4, roof), right = block_of(6, 4, [&](int i, int j) { return roof(i + 5, j); });
  EXPECT_NEAR(along_shared_curve(build({left, right}, {.join_angle = 80 * pi / 180})).angle, 1, 1e-12);  // 90 degrees
  EXPECT_LE(along_shared_curve(build({left, right}, {.join_angle = 100 * pi / 180})).angle, 1e-12);
}

}  // namespace
}  // namespace carreau::grid
