// SPDX-License-Identifier: BSD-3-Clause
// Edges prescribed in place of sizes: closed forms, exact lengths, one discretisation for all uses (HDR sec. 2.1, 2.3).
#include "curve/prescribed_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>

#include "curve/exact_arc.h"
#include "scene.h"
#include "support/error.h"

namespace {

using namespace carreau;
using namespace carreau::testing_cad;
using std::numbers::pi;

PrescribedEdges progression(Progression kind, int edges, double ratio = 1) {
  PrescribedEdges told;
  told.progression = kind, told.edges = edges, told.ratio = ratio;
  return told;
}

void prescribe(Scene& scene, const CurveUse& use, PrescribedEdges told) {
  scene.model.faces[static_cast<std::size_t>(use.face)].curves[static_cast<std::size_t>(use.curve)].edges =
      std::make_shared<const PrescribedEdges>(std::move(told));
}

DiscreteCurve discretised(Scene& scene) {
  SizeRules rules(scene.model, scene.topology, scene.cad, scene.sizes);
  return discretise_curve(scene.curve_model(), 0, rules);
}

PlaneCurve arc_of_radius(double r, double to) {
  return {{0, to}, [r](double t) {
            const Vec2 out{r * std::cos(t), r * std::sin(t)};
            return CurveJet{out, {-out.y(), out.x()}, -out};
          }};
}

/// Lengths of edges by a progression of this length, from its definition.
std::vector<double> lengths_of(const PrescribedEdges& told, double total) {
  std::vector<double> lengths;
  double sum = 0;
  for (int i = 0; i < told.edges; ++i) {
    const double share = told.edges > 1 ? double(i) / (told.edges - 1) : 0;
    lengths.push_back(told.progression == Progression::geometric    ? std::pow(told.ratio, i)
                      : told.progression == Progression::arithmetic ? 1 + (told.ratio - 1) * share
                                                                    : 1);
    sum += lengths.back();
  }
  for (double& length : lengths) length *= total / sum;
  return lengths;
}

const std::vector<PrescribedEdges>& progressions() {
  static const std::vector<PrescribedEdges> all{
      progression(Progression::equal, 7),           progression(Progression::equal, 1),
      progression(Progression::arithmetic, 9, 4),   progression(Progression::arithmetic, 5, 0.1),
      progression(Progression::geometric, 12, 1.3), progression(Progression::geometric, 6, 0.5),
      progression(Progression::geometric, 4, 1)};
  return all;
}

TEST(ProgressionShares, AreSumsOfTheirLengths) {
  for (const PrescribedEdges& told : progressions()) {
    const std::vector<double> shares = progression_shares(told), lengths = lengths_of(told, 1);
    ASSERT_EQ(shares.size(), lengths.size() + 1);
    EXPECT_EQ(shares.front(), 0);
    EXPECT_EQ(shares.back(), 1);
    for (std::size_t k = 0; k < lengths.size(); ++k) EXPECT_NEAR(shares[k + 1] - shares[k], lengths[k], 1e-15);
  }
}

TEST(ProgressionShares, ManyGeometricEdgesDoNotOverflow) {
  const std::vector<double> up = progression_shares(progression(Progression::geometric, 1000, 1.01));
  const std::vector<double> down = progression_shares(progression(Progression::geometric, 1000, 1 / 1.01));
  for (std::size_t k = 0; k < up.size(); ++k) EXPECT_NEAR(up[k], 1 - down[up.size() - 1 - k], 1e-13);
  EXPECT_NEAR(progression_shares(progression(Progression::geometric, 9, 1e30))[8], 1e-30, 1e-42);
}

TEST(ProgressionShares, RejectInputWithoutEdges) {
  EXPECT_THROW(progression_shares(progression(Progression::equal, 0)), InvalidArgument);
  EXPECT_THROW(progression_shares(progression(Progression::geometric, 5, 0)), InvalidArgument);
  EXPECT_THROW(progression_shares(progression(Progression::arithmetic, 5, -1)), InvalidArgument);
  EXPECT_THROW(progression_shares(progression(Progression::arithmetic, 5, std::numeric_limits<double>::infinity())),
               InvalidArgument);
  EXPECT_THROW(progression_shares(progression(Progression::geometric, 500, 1e-3)), InvalidArgument);  // underflows
}

// On z = 0: lengths in space are lengths in the plane. The pace along the line is uneven.
TEST(PrescribedEdges, ALineAndACircleHaveTheLengthsOfTheirProgression) {
  for (const PrescribedEdges& told : progressions()) {
    Scene line;
    const CurveUse on_line = line.add_use(
        line.add_face(1, flat()), PlaneCurve{{0, 1}, [](double t) {
                                               const Vec2 along{3, 4};
                                               return CurveJet{(t + t * t) * along, (1 + 2 * t) * along, 2 * along};
                                             }});
    line.add_curve({on_line});
    prescribe(line, on_line, told);
    line.build();
    const DiscreteCurve d = discretised(line);
    const std::vector<double> on_10 = lengths_of(told, 10);  // from (0, 0) to (6, 8)
    ASSERT_EQ(d.segments(), told.edges);
    for (int k = 0; k < told.edges; ++k) EXPECT_NEAR(norm(d.xyz[k + 1] - d.xyz[k]), on_10[k], 1e-10 * 10);

    Scene circle;  // three quarters
    const CurveUse on_circle = circle.add_use(circle.add_face(1, flat()), arc_of_radius(2, 1.5 * pi));
    circle.add_curve({on_circle});
    prescribe(circle, on_circle, told);
    circle.build();
    const DiscreteCurve e = discretised(circle);
    const std::vector<double> arcs = lengths_of(told, 3 * pi);
    ASSERT_EQ(e.segments(), told.edges);
    for (int k = 0; k < told.edges; ++k) {
      EXPECT_NEAR(2 * (e.t_of_use[0][k + 1] - e.t_of_use[0][k]), arcs[k], 1e-10 * 3 * pi);
      EXPECT_NEAR(norm(e.xyz[k + 1] - e.xyz[k]), 4 * std::sin(arcs[k] / 4), 1e-10 * 3 * pi);
    }
  }
}

// A parabola in space: s(x) = (x sqrt(1 + x^2) + asinh x) / 2.
TEST(PrescribedEdges, ACurvedCurveHasTheLengthsOfItsArcs) {
  Scene s = interface_between_two_faces(true);
  const PrescribedEdges told = progression(Progression::geometric, 10, 1.4);
  prescribe(s, s.topology.curves[0].uses[0], told);
  const DiscreteCurve d = discretised(s);
  const auto arc = [](double x) { return (x * std::sqrt(1 + x * x) + std::asinh(x)) / 2; };
  const std::vector<double> lengths = lengths_of(told, 2 * arc(2.5));
  ASSERT_EQ(d.segments(), 10);
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(arc(d.xyz[k + 1].x()) - arc(d.xyz[k].x()), lengths[k], 1e-10 * 2 * arc(2.5));
}

TEST(ExactArc, IsTheInverseOfItself) {
  // The parabola, slower and slower towards its ends.
  Scene s;
  const CurveUse use = s.add_use(s.add_face(1, paraboloid()), {{-1.5, 1.5}, [](double t) {
                                                                 const double x = 2.5 * std::sin(t),
                                                                              v = 2.5 * std::cos(t);
                                                                 return CurveJet{{x, 0}, {v, 0}, {-x, 0}};
                                                               }});
  s.add_curve({use});
  s.build();
  const ExactArc arc(s.cad, 1, 1, s.curve_model().support(use).t);
  const auto exact = [](double x) { return (x * std::sqrt(1 + x * x) + std::asinh(x)) / 2; };
  const double end = 2.5 * std::sin(1.5);
  EXPECT_NEAR(arc.length(), 2 * exact(end), 1e-13 * arc.length());
  for (const double share : {0.0, 0.01, 0.3, 0.5, 0.77, 1.0}) {
    const double x = s.cad.curve(1, 1, want_position, arc.t_at(share * arc.length())).c.x();
    EXPECT_NEAR(exact(end) + exact(x), share * arc.length(), 1e-13 * arc.length());
  }
}

// The second use prescribes the edges, in its own direction, and has its own parameters; the first use holds the same
// vertices.
TEST(PrescribedEdges, HoldInAllUsesOfACurve) {
  for (const bool same_pace : {true, false}) {
    Scene s = interface_between_two_faces(same_pace);
    PrescribedEdges told = progression(Progression::given, 0);
    told.t = {0.1, 0.15, 0.5, 0.875};
    prescribe(s, s.topology.curves[0].uses[1], told);
    const DiscreteCurve d = discretised(s);
    ASSERT_EQ(d.segments(), 5);
    EXPECT_TRUE(d.prescribed);
    EXPECT_EQ(d.owner, 1);
    EXPECT_EQ(d.t_of_use[1], (std::vector<double>{1, 0.875, 0.5, 0.15, 0.1, 0}));
    for (std::size_t k = 1; k < 5; ++k) {
      EXPECT_EQ(d.xyz[k], s.lifted(s.topology.curves[0].uses[1], d.uv_of_use[1][k]));
      EXPECT_NEAR(norm(d.xyz[k] - s.lifted(s.topology.curves[0].uses[0], d.uv_of_use[0][k])), 0, 1e-4);
      EXPECT_LT(d.t_of_use[0][k - 1], d.t_of_use[0][k]);
    }
  }
}

TEST(PrescribedEdges, RunAlongTheParameterOfTheirUse) {
  Scene s = interface_between_two_faces(true);
  prescribe(s, s.topology.curves[0].uses[1], progression(Progression::geometric, 4, 2));
  const DiscreteCurve d = discretised(s);
  for (std::size_t k = 1; k < 4; ++k)  // against the first use
    EXPECT_GT(d.r[k] - d.r[k - 1], 1.9 * (d.r[k + 1] - d.r[k]));
}

TEST(PrescribedEdges, AreNeitherSplitNorMoved) {
  Scene s = interface_between_two_faces(true);
  prescribe(s, s.topology.curves[0].uses[0], progression(Progression::equal, 3));
  DiscreteCurve d = discretised(s);
  const std::vector<double> before = d.r;
  EXPECT_FALSE(split_segment(d, 1, s.curve_model()));
  place_vertices(d, {0.5}, s.curve_model());
  EXPECT_EQ(d.r, before);
}

std::string refusal(Scene& scene) {
  try {
    (void)discretised(scene);
  } catch (const InvalidModel& error) {
    EXPECT_EQ(error.where().face, 0) << "a face would be left out for it";
    return error.what();
  }
  return {};
}

TEST(PrescribedEdges, ThatContradictEachOtherAreRejected) {
  Scene s = interface_between_two_faces(true);
  const std::vector<CurveUse>& uses = s.topology.curves[0].uses;
  prescribe(s, uses[0], progression(Progression::geometric, 6, 2));
  prescribe(s, uses[1], progression(Progression::geometric, 6, 2));
  EXPECT_NE(refusal(s).find("others are prescribed on curve 1 of face 1"), std::string::npos) << refusal(s);
  prescribe(s, uses[1], progression(Progression::geometric, 6, 0.5));  // the same, the other way round
  EXPECT_EQ(refusal(s), "");
  prescribe(s, uses[1], progression(Progression::geometric, 7, 0.5));
  EXPECT_NE(refusal(s), "");
}

TEST(PrescribedEdges, ThatCannotBeAreRejected) {
  Scene outside = interface_between_two_faces(true);
  PrescribedEdges told = progression(Progression::given, 0);
  told.t = {0.5, 1};
  prescribe(outside, outside.topology.curves[0].uses[0], told);
  EXPECT_NE(refusal(outside).find("its parameter 1 does not lie between 0.5 and 1"), std::string::npos);

  const auto circle_of = [](int edges) {
    Scene circle;
    const CurveUse use = circle.add_use(circle.add_face(1, flat()), arc_of_radius(1, 2 * pi));
    circle.add_curve({use}, true);
    prescribe(circle, use, progression(Progression::equal, edges));
    circle.build();
    return circle;
  };
  Scene two = circle_of(2), three = circle_of(3);
  EXPECT_NE(refusal(two).find("a closed curve needs three edges or more"), std::string::npos);
  EXPECT_EQ(refusal(three), "");

  Scene part = interface_between_two_faces(true);
  part.model.faces[0].curves[0].part_of = 1;
  prescribe(part, part.topology.curves[0].uses[0], progression(Progression::equal, 5));
  EXPECT_NE(refusal(part).find("cut it; give all parameters"), std::string::npos);
}

}  // namespace
