// SPDX-License-Identifier: BSD-3-Clause
// A disc that nothing happens to.
#include <gtest/gtest.h>

#include <cmath>

#include "pieces.h"

namespace carreau::testing {
namespace {

using namespace variable;

TEST(Disc, KeepsItsRadiusOverFiftyRemeshings) {
  constexpr double radius = 25;
  Piece piece = disc({0, 0}, radius, 2);
  Monitor monitor;
  double error = 0, change = 0, geometry = 0;
  for (int i = 0; i < 50; ++i) {
    // Other sizes each time, so that nodes lie elsewhere.
    const double h_max = 6 - 3.5 * std::fmod(0.618 * i, 1);
    const RemeshInput input = input_of(piece, 1, h_max);
    RemeshResult result = remesh(input, monitor);
    const auto defects = find_defects(input, result);
    ASSERT_TRUE(defects.empty()) << defects.front();
    const PieceQuality q = quality_of(result.piece, [&](Vec2) { return h_max; });
    EXPECT_GE(q.q2_mean, 0.93);
    EXPECT_GE(q.q2_worst, 0.3);
    EXPECT_GE(q.in_range, 0.97);
    if (i > 0) change = std::max(change, std::abs(result.summary.area_geometry / geometry - 1));
    geometry = result.summary.area_geometry;
    piece = std::move(result.piece);
    for (const auto& [a, b] : result.edges)
      error = std::max(error, std::abs(norm(piece.vertices[static_cast<std::size_t>(a)]) / radius - 1));
  }
  EXPECT_LT(error, 1e-3);
  EXPECT_LT(change, 1e-4);
  RecordProperty("radius", std::to_string(error));
  RecordProperty("area", std::to_string(change));
}

TEST(Disc, AreaOfItsGeometryIsOfFourthOrder) {
  const auto error = [](int n) {
    Monitor monitor;
    const double h = 2 * 3.14159265358979 / n;
    const auto result = remesh(input_of(meshed({circle({0, 0}, 1, n)}, [&](Vec2) { return h; }), h / 2, h), monitor);
    return std::abs(result.summary.area_geometry / 3.14159265358979 - 1);
  };
  EXPECT_GT(std::log2(error(24) / error(48)), 3.7);
}

}  // namespace
}  // namespace carreau::testing
