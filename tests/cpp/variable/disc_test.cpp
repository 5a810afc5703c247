// A disc that nothing happens to.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "pieces.h"

namespace carreau::testing {
namespace {

using namespace variable;

TEST(Disc, KeepsItsRadiusOverFiftyRemeshings) {
  for (const double h_max : {6.0, 2.0}) {
    Piece piece = disc({0, 0}, 25, 2);
    Monitor monitor;
    double largest_change = 0;
    for (int i = 0; i < 50; ++i) {
      const RemeshInput input = input_of(piece, 1, h_max);
      const auto start = std::chrono::steady_clock::now();
      RemeshResult result = remesh(input, monitor);
      const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
      const auto defects = find_defects(input, result);
      ASSERT_TRUE(defects.empty()) << defects.front();
      if (i > 0)
        largest_change = std::max(largest_change, std::abs(result.summary.area / result.summary.area_given - 1));
      piece = std::move(result.piece);
      if (i % 10 == 0) {
        const PieceQuality q = quality_of(piece, [&](Vec2) { return h_max; });
        std::printf("%d: %zu triangles %.2f ms, Q2 %.4f %.4f in range %.4f\n", i, piece.triangles.size(), ms, q.q2_mean, q.q2_worst, q.in_range);
      }
    }
    double error = 0;
    for (const auto& [a, b] : remesh(input_of(piece, 1, h_max), monitor).edges)
      error = std::max(error, std::abs(norm(piece.vertices[static_cast<std::size_t>(a)]) / 25 - 1));
    std::printf("radius %g change of area %g\n", error, largest_change);
    EXPECT_LT(error, 1e-3);
  }
}

}  // namespace
}  // namespace carreau::testing
