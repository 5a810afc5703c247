// SPDX-License-Identifier: BSD-3-Clause
// A whole increment: fields, sizes, bad input.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "pieces.h"
#include "support/error.h"
#include "variable/transfer/overlaps.h"

namespace carreau::testing {
namespace {

using namespace variable;

RemeshInput disc_input() { return input_of(disc({0, 0}, 10, 1), 0.5, 2); }

double integral(const Piece& piece, const std::vector<double>& values) {
  double sum = 0;
  for (std::size_t t = 0; t < values.size(); ++t) sum += values[t] * piece.double_area(t) / 2;
  return sum;
}

TEST(Overlaps, AreTheAreasInCommon) {
  const std::array<Vec2, 3> p{Vec2{0, 0}, Vec2{2, 0}, Vec2{0, 2}}, q{Vec2{1, 1}, Vec2{-1, 1}, Vec2{1, -1}};
  const auto part = common_part(p, q);
  EXPECT_NEAR(part.area, 1, 1e-14);  // the unit square
  EXPECT_LT(norm(part.centre - Vec2{0.5, 0.5}), 1e-14);
  EXPECT_EQ(common_part(p, {Vec2{3, 3}, Vec2{4, 3}, Vec2{3, 4}}).area, 0);
  EXPECT_EQ(common_part(p, {Vec2{2, 0}, Vec2{2, 2}, Vec2{0, 2}}).area, 0);  // a common side
}

TEST(Remesh, CarriesLinearFieldsExactly) {
  RemeshInput input = disc_input();
  RemeshField field{"linear", FieldKind::nodal, 2, {}};
  for (const Vec2& p : input.piece.vertices)
    field.values.insert(field.values.end(), {3 - 2 * p.x() + 0.5 * p.y(), p.x() + p.y()});
  input.fields = {field};
  Monitor monitor;
  const RemeshResult result = remesh(input, monitor);
  ASSERT_EQ(result.fields.size(), 1U);
  for (std::size_t v = 0; v < result.piece.vertices.size(); ++v) {
    const Vec2& p = result.piece.vertices[v];
    EXPECT_NEAR(result.fields[0].values[2 * v], 3 - 2 * p.x() + 0.5 * p.y(), 1e-12);
    EXPECT_NEAR(result.fields[0].values[2 * v + 1], p.x() + p.y(), 1e-12);
  }
}

/// The square [0, n]^2 in squares of side 1, of two triangles each; the damage of the squares in [from, to[^2 is 1.
RemeshInput square_with_a_hole(int n, int from, int to) {
  Piece piece;
  std::vector<double> damage;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) piece.vertices.emplace_back(i, j);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      piece.triangles.push_back({a, a + 1, a + n + 2});
      piece.triangles.push_back({a, a + n + 2, a + n + 1});
      const bool goes = i >= from && i < to && j >= from && j < to;
      damage.insert(damage.end(), 2, goes ? 1 : 0);
    }
  RemeshInput input = input_of(std::move(piece), 0.5, 2);
  input.damage = std::move(damage);
  return input;
}

// The sides of the hole are straight and meet in corners: every edge lies on them in every increment, and the area is exact.
TEST(Remesh, FacesLaidBareStayImposedFromIncrementToIncrement) {
  RemeshInput input = square_with_a_hole(10, 4, 6);
  input.imposed_smoothing = 0;
  Monitor monitor;
  for (int increment = 0; increment < 10; ++increment) {
    const RemeshResult result = remesh(input, monitor);
    EXPECT_EQ(find_defects(input, result), std::vector<std::string>{}) << increment;
    EXPECT_NEAR(result.summary.area, 100 - 4, 1e-12) << increment;
    double imposed = 0, free = 0;
    for (std::size_t e = 0; e < result.edges.size(); ++e) {
      const Vec2 a = result.piece.vertices[static_cast<std::size_t>(result.edges[e][0])],
                 b = result.piece.vertices[static_cast<std::size_t>(result.edges[e][1])];
      const Vec2 middle = (a + b) / 2 - Vec2(5, 5);
      const bool in_hole = std::max(std::abs(middle.x()), std::abs(middle.y())) < 2;
      EXPECT_EQ(result.edge_kinds[e], in_hole ? Kind::imposed : Kind::free_boundary) << increment;
      (in_hole ? imposed : free) += norm(b - a);
    }
    EXPECT_NEAR(imposed, 8, 1e-12);
    EXPECT_NEAR(free, 40, 1e-12);
    input.piece = result.piece, input.damage = result.damage, input.vertex_kinds = result.vertex_kinds;
  }
  input.vertex_kinds.clear();
  EXPECT_EQ(remesh(input, monitor).summary.imposed_vertices, 0);  // the piece alone does not show how it came to be
  input.vertex_kinds.assign(3, 0);
  EXPECT_THROW(remesh(input, monitor), InvalidArgument);
  input.vertex_kinds.assign(input.piece.vertices.size(), -1);
  EXPECT_THROW(remesh(input, monitor), InvalidArgument);
}

// Rounds of smoothing are for new faces: they would wear old ones away.
TEST(Remesh, FacesLaidBareEarlierAreNotSmoothedAgain) {
  RemeshInput input = square_with_a_hole(10, 4, 6);
  input.imposed_smoothing = 2;
  Monitor monitor;
  const RemeshResult first = remesh(input, monitor);
  EXPECT_GT(first.summary.area, 100 - 4 + 0.1);
  input.piece = first.piece, input.damage = first.damage, input.vertex_kinds = first.vertex_kinds;
  input.corner_angle = 1;  // all bends are corners, so that polygons are cut at their nodes
  EXPECT_NEAR(remesh(input, monitor).summary.area, first.summary.area, 1e-12);
}

TEST(Remesh, KeepsIntegralsAndBounds) {
  RemeshInput input = disc_input();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  RemeshField density{"density", FieldKind::element_conserved, 1, {}}, mean{"mean", FieldKind::element_mean, 1, {}},
      one{"one", FieldKind::element_mean, 1, {}};
  for (std::size_t t = 0; t < input.piece.triangles.size(); ++t)
    density.values.push_back(any(random)), mean.values.push_back(any(random)), one.values.push_back(4.25);
  input.fields = {density, mean, one};
  Monitor monitor;
  for (int increment = 0; increment < 20; ++increment) {
    input.h_max = increment % 2 == 0 ? 2 : 1.2;
    RemeshResult result = remesh(input, monitor);
    EXPECT_NEAR(integral(result.piece, result.fields[0].values), integral(input.piece, input.fields[0].values), 1e-10);
    for (const double x : result.fields[1].values) EXPECT_LE(std::abs(x), 1);
    for (const double x : result.fields[2].values) EXPECT_NEAR(x, 4.25, 1e-12);
    input.piece = std::move(result.piece), input.fields = std::move(result.fields);
  }
}

TEST(Remesh, MeansOfSmoothFieldsConvergeFasterThanConstants) {
  const auto error = [](double h) {
    RemeshInput input = input_of(disc({0, 0}, 10, h), h / 2, 1.3 * h);
    const auto f = [](const Vec2& p) { return std::sin(0.5 * p.x()) * std::cos(0.4 * p.y()); };
    const auto centre = [](const Piece& piece, std::size_t t) {
      Vec2 sum{0, 0};
      for (const std::int32_t v : piece.triangles[t]) sum += piece.vertices[static_cast<std::size_t>(v)];
      return Vec2(sum / 3);
    };
    RemeshField field{"f", FieldKind::element_mean, 1, {}};
    for (std::size_t t = 0; t < input.piece.triangles.size(); ++t) field.values.push_back(f(centre(input.piece, t)));
    input.fields = {field};
    Monitor monitor;
    const RemeshResult result = remesh(input, monitor);
    double squares = 0;
    for (std::size_t t = 0; t < result.piece.triangles.size(); ++t) {
      const double e = result.fields[0].values[t] - f(centre(result.piece, t));
      squares += e * e * result.piece.double_area(t) / 2;
    }
    return std::sqrt(squares);
  };
  EXPECT_GT(std::log2(error(0.8) / error(0.2)) / 2, 1.3);  // constants: 1; limits at extremes cost some of order 2
}

TEST(Remesh, SizesFollowDamageAndCurvature) {
  RemeshInput input = disc_input();
  Monitor monitor;
  for (std::size_t t = 0; t < input.piece.triangles.size(); ++t) {
    const Vec2 p = input.piece.vertices[static_cast<std::size_t>(input.piece.triangles[t][0])];
    input.damage.push_back(std::exp(-norm(p) * norm(p) / 8) * 0.99);
  }
  const std::size_t without = [&] {
    RemeshInput plain = input;
    plain.sizes_by_damage = false;
    return remesh(plain, monitor).piece.triangles.size();
  }();
  for (int i = 0; i < 3; ++i) {
    RemeshResult result = remesh(input, monitor);
    input.piece = std::move(result.piece), input.damage = std::move(result.damage);
  }
  EXPECT_GT(input.piece.triangles.size(), without + without / 2);
  const PieceQuality q =
      quality_of(input.piece, [&](Vec2 p) { return 2 - 1.5 * 0.99 * std::exp(-norm(p) * norm(p) / 8); });
  EXPECT_GT(q.q2_mean, 0.93);
  // 2 sin 8 degrees times the radius
  RemeshInput curved = input_of(disc({0, 0}, 5, 1), 0.1, 100);
  curved.gradation = 100;
  const RemeshResult round = remesh(curved, monitor);
  EXPECT_NEAR(static_cast<double>(round.edges.size()), 2 * 3.14159265 / (2 * std::sin(8 * 3.14159265 / 180)), 1);
}

TEST(Remesh, SizesFollowTheErrorOfAField) {
  RemeshInput input = disc_input();
  input.h_min = 0.3;
  RemeshField field{"front", FieldKind::nodal, 1, {}};
  const auto front = [](const Vec2& p) { return std::tanh(2 * p.x()); };
  Monitor monitor;
  input.error_field = 0;
  input.estimator.tolerance = 0.02;
  for (int i = 0; i < 4; ++i) {
    field.values.clear();
    for (const Vec2& p : input.piece.vertices) field.values.push_back(front(p));
    input.fields = {field};
    input.piece = remesh(input, monitor).piece;
  }
  double near = 0, far = 0;
  int n = 0, m = 0;
  for (std::size_t t = 0; t < input.piece.triangles.size(); ++t) {
    const Vec2 p = input.piece.vertices[static_cast<std::size_t>(input.piece.triangles[t][0])];
    if (std::abs(p.x()) < 0.7) near += input.piece.double_area(t), ++n;
    if (std::abs(p.x()) > 6) far += input.piece.double_area(t), ++m;
  }
  EXPECT_LT(near / n, 0.2 * far / m);
}

TEST(Remesh, ShortEdgesAreGradedInwards) {
  // A notch .6 wide in a square of 10: its edges are shorter than the prescribed size.
  const Piece piece = meshed({{{0, 0}, {4.7, 0}, {4.7, 0.6}, {5.3, 0.6}, {5.3, 0}, {10, 0}, {10, 10}, {0, 10}}},
                             [](Vec2) { return 3.; });
  Monitor monitor;
  const RemeshResult result = remesh(input_of(piece, 0.5, 3), monitor);
  const PieceQuality q = quality_of(result.piece, [](Vec2) { return 3.; });
  EXPECT_GT(q.q2_worst, 0.5);
}

TEST(Remesh, RunsThatCrossKeepTheirNodes) {
  // Two banks of a slit .05 wide, curved in waves that edges of size 2 do not follow.
  std::vector<Vec2> loop{{0, -5}, {10, -5}};
  const auto wave = [](double x) { return 0.4 * std::sin(2 * x); };
  for (int i = 100; i >= 1; --i) loop.emplace_back(0.1 * i, wave(0.1 * i) - 0.025);
  loop.emplace_back(0.05, 0);
  for (int i = 1; i <= 90; ++i) loop.emplace_back(0.1 * i, wave(0.1 * i) + 0.025);
  loop.insert(loop.end(), {{9, 5}, {-1, 5}, {-1, -5}});
  const Piece piece = meshed({loop}, [](Vec2) { return 2.; });
  RemeshInput input = input_of(piece, 1.9, 2);
  Monitor monitor;
  const RemeshResult result = remesh(input, monitor);
  EXPECT_NE(result.summary.boundary, Faithfulness::smooth);
  EXPECT_TRUE(find_defects(input, result).empty());
}

/// Integrals of a nodal field of two components: of its linear interpolation.
Vec2 momentum(const Piece& piece, const std::vector<double>& v) {
  Vec2 sum{0, 0};
  for (std::size_t t = 0; t < piece.triangles.size(); ++t)
    for (const std::int32_t k : piece.triangles[t])
      sum +=
          piece.double_area(t) / 6 * Vec2{v[2 * static_cast<std::size_t>(k)], v[2 * static_cast<std::size_t>(k) + 1]};
  return sum;
}

TEST(Remesh, ChangesMomentumAndVolumeLittle) {
  RemeshInput input = disc_input();
  RemeshField velocity{"velocity", FieldKind::nodal, 2, {}};
  for (const Vec2& p : input.piece.vertices)
    velocity.values.insert(velocity.values.end(), {1 + std::sin(0.2 * p.x()), std::cos(0.3 * p.y())});
  input.fields = {velocity};
  Monitor monitor;
  const Vec2 before = momentum(input.piece, velocity.values);
  double geometry = 0, volume = 0, largest = 0;
  for (int i = 0; i < 50; ++i) {
    input.h_max = 1.2 + 0.8 * std::fmod(0.618 * i, 1);
    RemeshResult result = remesh(input, monitor);
    if (i > 0) volume = std::max(volume, std::abs(result.summary.area_geometry / geometry - 1));
    geometry = result.summary.area_geometry;
    const Vec2 p = momentum(input.piece, input.fields[0].values), q = momentum(result.piece, result.fields[0].values);
    largest = std::max(largest, norm(q - p) / norm(p));
    input.piece = std::move(result.piece), input.fields = std::move(result.fields);
  }
  RecordProperty("momentum_of_one", std::to_string(largest));
  RecordProperty("momentum_of_fifty",
                 std::to_string(norm(momentum(input.piece, input.fields[0].values) - before) / norm(before)));
  EXPECT_LT(volume, 1e-4);
  EXPECT_LT(largest, 0.02);  // chords of other lengths enclose another area
}

TEST(Remesh, IsTheSameEachTime) {
  const RemeshInput input = disc_input();
  Monitor monitor;
  const RemeshResult p = remesh(input, monitor), q = remesh(input, monitor);
  EXPECT_EQ(p.piece.triangles, q.piece.triangles);
  EXPECT_EQ(p.piece.vertices, q.piece.vertices);
}

/// The sentence that rejects an input.
std::string refusal(const std::function<void(RemeshInput&)>& spoil) {
  RemeshInput input = disc_input();
  spoil(input);
  Monitor monitor;
  try {
    remesh(input, monitor);
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

TEST(Remesh, RejectsBadInputWithASentence) {
  const auto says = [](const std::function<void(RemeshInput&)>& spoil, const std::string& words) {
    const std::string sentence = refusal(spoil);
    EXPECT_NE(sentence.find(words), std::string::npos) << "'" << sentence << "' lacks '" << words << "'";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  says([](auto& in) { in.step = 0.6; }, "larger than the smallest size");
  says([](auto& in) { in.displacement.assign(in.piece.vertices.size(), Vec2{0.4, 0.4}); }, "was displaced by 0.5657");
  says([](auto& in) { in.displacement.resize(3); }, "3 displacements for");
  says([](auto& in) { std::swap(in.piece.triangles[7][0], in.piece.triangles[7][1]); }, "triangle 7 of vertices");
  says([](auto& in) { in.piece.triangles[3][2] = 100000; }, "triangle 3 has vertex 100000");
  says([](auto& in) { in.piece.triangles.push_back(in.piece.triangles[0]); }, "share");
  says([](auto& in) { in.piece.triangles.clear(); }, "no triangle");
  says([&](auto& in) { in.piece.vertices[5].x() = nan; }, "vertex 5 is not finite");
  says([](auto& in) { in.damage.assign(in.piece.triangles.size(), 1.5); }, "it must lie in [0, 1]");
  says([&](auto& in) { in.damage.assign(in.piece.triangles.size(), nan); }, "it must lie in [0, 1]");
  says([](auto& in) { in.damage.assign(4, 0.5); }, "4 values of damage");
  says([](auto& in) { in.damage.assign(in.piece.triangles.size(), 1); }, "nothing is left");
  says([](auto& in) { in.fields = {{"heat", FieldKind::nodal, 1, {1, 2, 3}}}; }, "'heat' has 3 numbers");
  says([](auto& in) { in.h_min = 0; }, "0 < h_min");
  says([](auto& in) { in.h_max = 0.1; }, "0 < h_min");
  says([](auto& in) { in.gradation = 1; }, "gradation");
  says([](auto& in) { in.error_field = 2; }, "number 2");
  says([](auto& in) { in.step = 0.1, in.tools = {{{{-20, 0}, {20, 0}}, {}, false}}; }, "deep in tool 0");
  says(
      [](auto& in) {
        in.step = 0.1, in.tools = {{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {}, true}};
      },
      "deep into the piece");
}

}  // namespace
}  // namespace carreau::testing
