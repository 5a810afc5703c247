// SPDX-License-Identifier: BSD-3-Clause
// Unit meshes of surfaces under smooth size fields, sizes h to 10 h: near 20 000 triangles with gradation 1.3 (a slope
// of 0.26), near 100 000 with a slope of 0.11. Lengths are measured on the surfaces, against the field itself.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "common/graded_cases.h"

namespace carreau {
namespace {

using namespace testing;

class GradedSizes : public ::testing::TestWithParam<std::tuple<NamedSurface, NamedField>> {};

struct Asked {
  double slope, triangles, q2, p1, six;
};

void expect_unit(const NamedSurface& surface, const NamedField& field, const Asked& asked) {
  const GradedRun run(surface, field.size, asked.slope, asked.triangles);
  EXPECT_EQ(find_defects(run.session->mesh()), std::vector<std::string>{});
  const MeshEvaluation& delivered = run.session->delivered();
  EXPECT_NEAR(delivered[EvaluationKind::length].spread.mean, 1, 0.01);
  EXPECT_GE(delivered.share_in_range(), 0.998);
  EXPECT_EQ(delivered.folded_triangles, 0);
  const QualitySummary quality = summarise_quality(run.session->exported());
  EXPECT_NEAR(static_cast<double>(quality.triangles), asked.triangles, 0.03 * asked.triangles);
  EXPECT_GE(quality.q2.mean, asked.q2);
  EXPECT_GE(quality.q2.p1, asked.p1);
  EXPECT_GE(quality.q2.min, 0.6);
  EXPECT_GE(quality.degree6, asked.six);
}

TEST_P(GradedSizes, Slope026Near20000Triangles) {
  expect_unit(std::get<0>(GetParam()), std::get<1>(GetParam()), {0.26, 20000, 0.985, 0.90, 0.86});
}

TEST_P(GradedSizes, Slope011Near100000Triangles) {
  expect_unit(std::get<0>(GetParam()), std::get<1>(GetParam()), {0.11, 100000, 0.991, 0.925, 0.91});
}

INSTANTIATE_TEST_SUITE_P(Surfaces, GradedSizes,
                         ::testing::Combine(::testing::ValuesIn(graded_surfaces), ::testing::ValuesIn(size_fields)),
                         [](const auto& instance) {
                           return std::string(std::get<0>(instance.param).name) + "_" +
                                  std::get<1>(instance.param).name;
                         });

}  // namespace
}  // namespace carreau
