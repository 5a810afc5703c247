// SPDX-License-Identifier: BSD-3-Clause
// HDR sec. 3.4.6 with given displacement and damage.
#include "kinematics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pieces.h"

namespace carreau::testing {
namespace {

using namespace variable;

/// Figures of all increments of a run.
struct Course {
  double q2_mean = 1, q2_worst = 1;
  double in_range = 0;        ///< share of edges, mean of the increments
  double least_in_range = 1;  ///< of one increment
  double area_change = 0;     ///< from the previous boundary's geometry to the new boundary's, largest; relative
  double change_beside_removed = 0;  ///< likewise for increments that removed elements
  std::int64_t max_bound = 0, removed = 0;
  int parts = 1;
  double breaks_at = 0, first_crack = 0;  ///< mm
  double mass_error = 0;                  ///< largest, of an increment
  double place_error = 0;                 ///< of the linear field, largest
};

double mass_of(const Piece& piece, const std::vector<double>& density) {
  double sum = 0;
  for (std::size_t t = 0; t < density.size(); ++t) sum += density[t] * piece.double_area(t) / 2;
  return sum;
}

void see_summary(const RemeshSummary& s, double moved, Course& course) {
  const std::int64_t removed = s.damaged + s.at_multiple_vertices + s.dangling;
  course.removed += removed;
  if (removed > 0 && course.first_crack == 0) course.first_crack = moved;
  if (s.parts_found > 1 && course.breaks_at == 0) course.breaks_at = moved;
  course.parts = std::max(course.parts, s.parts_found);
  course.max_bound = std::max(course.max_bound, s.bound_vertices);
}

/// The new mesh has other nodes on the boundary: the area enclosed by splines through these, over the previous area.
double change_by_geometry(const RemeshInput& input, const RemeshResult& result, Monitor& monitor) {
  RemeshInput again = input;
  again.piece = result.piece;
  again.damage.clear(), again.displacement.clear(), again.fields.clear();
  return std::abs(remesh(again, monitor).summary.area_geometry / result.summary.area_geometry - 1);
}

Course run(Kinematics& kinematics, int increments) {
  Monitor monitor;
  Course course;
  kinematics.measure();
  for (int i = 1; i <= increments; ++i) {
    const RemeshInput& input = kinematics.advance();
    RemeshResult result = remesh(input, monitor);
    const auto defects = find_defects(input, result);
    EXPECT_TRUE(defects.empty()) << i << ": " << defects.front();
    const PieceQuality q = quality_of(result.piece, [&](Vec2) { return 1.; });
    course.q2_mean = std::min(course.q2_mean, q.q2_mean), course.q2_worst = std::min(course.q2_worst, q.q2_worst);
    const RemeshSummary& s = result.summary;
    see_summary(s, kinematics.moved(), course);
    course.in_range += s.in_range / increments;
    course.least_in_range = std::min(course.least_in_range, s.in_range);
    if (i % 5 == 0) {
      double& change = s.area_removed > 0 ? course.change_beside_removed : course.area_change;
      change = std::max(change, change_by_geometry(input, result, monitor));
    }
    for (std::size_t f = 0; f < result.fields.size(); ++f)
      if (result.fields[f].kind == FieldKind::element_conserved && s.area_removed == 0)
        course.mass_error = std::max(course.mass_error, std::abs(mass_of(result.piece, result.fields[f].values) /
                                                                     mass_of(input.piece, input.fields[f].values) -
                                                                 1));
    kinematics.accept(std::move(result));
  }
  for (const auto& [name, value] : {std::pair{"q2_mean", course.q2_mean},
                                    {"q2_worst", course.q2_worst},
                                    {"in_range", course.in_range},
                                    {"least_in_range", course.least_in_range},
                                    {"area_change", course.area_change},
                                    {"mass_error", course.mass_error}})
    ::testing::Test::RecordProperty(name, std::to_string(value));
  return course;
}

TEST(Kinematics, BrazilianTest) {
  const Course course = run(*brazilian_test(), 230);
  EXPECT_GE(course.q2_mean, 0.93);
  EXPECT_GE(course.q2_worst, 0.3);
  EXPECT_GE(course.in_range, 0.97);
  EXPECT_LT(course.area_change, 1e-4);
  EXPECT_LT(course.mass_error, 1e-10);
  EXPECT_NEAR(course.first_crack, 20, 0.11);
  EXPECT_EQ(course.parts, 2);
  EXPECT_GT(course.breaks_at, 20);
  EXPECT_LT(course.breaks_at, 23);
  EXPECT_GT(course.max_bound, 20);
  EXPECT_GT(course.removed, 10);
}

TEST(Kinematics, OrthogonalCutting) {
  const Course course = run(*orthogonal_cutting(), 610);
  EXPECT_GE(course.q2_mean, 0.93);
  EXPECT_GE(course.q2_worst, 0.3);
  EXPECT_GE(course.in_range, 0.97);
  EXPECT_LT(course.area_change, 1e-4);
  EXPECT_EQ(course.parts, 2);
  EXPECT_NEAR(course.breaks_at, 29.7, 0.06);
  EXPECT_GT(course.max_bound, 5);
}

}  // namespace
}  // namespace carreau::testing
