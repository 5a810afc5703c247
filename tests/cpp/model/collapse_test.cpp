// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "models.h"

namespace carreau {
namespace {

using namespace testing;

using Remarks = std::vector<std::string>;

/// Two squares side by side; between them a side of length 1 and a step of length 0.01 that both have.
AnalyticCad squares_with_step() {
  AnalyticCad cad;
  cad.faces[1] = flat({segment({0, 0}, {1, 0}), segment({1, 0}, {1, 1}), segment({1, 1}, {1, 1.01}),
                       segment({1, 1.01}, {0, 1.01}), segment({0, 1.01}, {0, 0})});
  cad.faces[2] = flat({segment({1, 0}, {2, 0}), segment({2, 0}, {2, 1.01}), segment({2, 1.01}, {1, 1.01}),
                       segment({1, 1.01}, {1, 1}), segment({1, 1}, {1, 0})});
  return cad;
}

TEST(CollapseTinyCurves, MakesTheEndsOfAShortCurveOnePointInAllFaces) {
  const AnalyticCad cad = squares_with_step();
  const Model model = glue(unglued(cad), traces_of(cad), 1e-4);
  Remarks remarks;
  const Model result = collapse_tiny_curves(model, traces_of(cad), 0.02, &remarks);
  EXPECT_EQ(remarks,
            Remarks{"face 1, curve 3 (reference 3): the curve is eliminated: its length 0.010000000000000009 is "
                    "below eps_collapse"});
  EXPECT_TRUE(find_model_defects(result).empty());
  // Ranks are the host's names of curves: none is lost.
  for (std::size_t f = 0; f < 2; ++f) EXPECT_EQ(result.faces[f].curves.size(), 5U);
  EXPECT_TRUE(result.faces[0].curves[2].collapsed);
  EXPECT_TRUE(result.faces[1].curves[3].collapsed);
  EXPECT_EQ(result.faces[0].curves[2].end1, 4);
  EXPECT_EQ(result.faces[0].curves[2].end2, 4);
  EXPECT_EQ(result.faces[0].curves[3].end1, 4);
  EXPECT_EQ(result.faces[1].curves[2].end2, 4);

  const Topology topology = build_topology(result, traces_of(cad), 0.005);  // below the length that was collapsed
  EXPECT_TRUE(topology.curves[2].degenerate);
  EXPECT_EQ(topology.curves[2].uses.size(), 2U);
  EXPECT_EQ(euler_number(topology, result), 1);
  const Topology before = build_topology(model, traces_of(cad), 0.005);
  EXPECT_EQ(topology.points.size(), before.points.size() - 1);
}

TEST(CollapseTinyCurves, DoesNothingForZero) {
  const AnalyticCad cad = squares_with_step();
  const Model model = glue(unglued(cad), traces_of(cad), 1e-4);
  Remarks remarks;
  const Model result = collapse_tiny_curves(model, traces_of(cad), 0, &remarks);
  EXPECT_EQ(references(result), references(model));
  for (const Face& face : result.faces)
    for (const FaceCurve& curve : face.curves) EXPECT_FALSE(curve.collapsed);
  EXPECT_TRUE(remarks.empty());
}

TEST(CollapseTinyCurves, FollowsChainsOfTinyCurves) {
  AnalyticCad cad;
  cad.faces[1] = flat({segment({0, 0}, {1, 0}), segment({1, 0}, {1, 0.01}), segment({1, 0.01}, {0.99, 0.02}),
                       segment({0.99, 0.02}, {0, 1}), segment({0, 1}, {0, 0})});
  const Model model = glue(unglued(cad), traces_of(cad), 1e-4);
  const Model result = collapse_tiny_curves(model, traces_of(cad), 0.02);
  EXPECT_EQ(references(result), (std::vector<std::vector<int>>{{1, 1, 2}, {2, 2, 2}, {3, 2, 2}, {4, 2, 8}, {5, 8, 1}}));
  const Topology topology = build_topology(result, traces_of(cad), 0.01);
  EXPECT_EQ(topology.points.size(), 3U);
}

TEST(CollapseTinyCurves, KeepsLoopsThatWouldVanish) {
  AnalyticCad cad;
  auto curves = rectangle({0, 0}, {1, 1});
  curves.push_back(arc({0.5, 0.5}, 0.001, 0, pi));
  curves.push_back(arc({0.5, 0.5}, 0.001, pi, 2 * pi));
  cad.faces[1] = flat(curves);
  const Model model = glue(unglued(cad), traces_of(cad), 1e-5);
  Remarks remarks;
  const Model result = collapse_tiny_curves(model, traces_of(cad), 0.02, &remarks);
  EXPECT_EQ(references(result), references(model));
  EXPECT_FALSE(result.faces[0].curves[4].collapsed);
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_TRUE(contains(remarks[0], "a whole loop of face 1 would vanish")) << remarks[0];
}

TEST(CollapseTinyCurves, KeepsInternalCurves) {
  AnalyticCad cad;
  auto curves = rectangle({0, 0}, {1, 1});
  curves.push_back(segment({0.5, 0.5}, {0.5, 0.501}));
  cad.faces[1] = flat(curves);
  Model model = unglued(cad);
  model.faces[0].curves[4].type = CurveType::internal;
  model = glue(model, traces_of(cad), 1e-5);
  Remarks remarks;
  const Model result = collapse_tiny_curves(model, traces_of(cad), 0.02, &remarks);
  EXPECT_FALSE(result.faces[0].curves[4].collapsed);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_TRUE(contains(remarks[0], "it is inside face 1")) << remarks[0];
}

TEST(CollapseTinyCurves, IgnoresPointsThatHaveNoLength) {
  const Model model = glue(unglued(cone()), traces_of(cone()), 0.01);
  Remarks remarks;
  const Model result = collapse_tiny_curves(model, traces_of(cone()), 1e-3, &remarks);
  EXPECT_EQ(references(result), references(model));
  EXPECT_TRUE(remarks.empty());
}

TEST(CollapseTinyCurves, RejectsANegativeLength) {
  EXPECT_THROW(collapse_tiny_curves(unglued(paraboloid()), traces_of(paraboloid()), -1), InvalidArgument);
}

}  // namespace
}  // namespace carreau
