// SPDX-License-Identifier: BSD-3-Clause
// Sizes by direction on surfaces given as triangles: unit lengths in the metric, and as many triangles as its density
// prescribes.
#include <gtest/gtest.h>

#include <numbers>

#include "common/field_source.h"
#include "geometry/discrete/discrete_cad.h"
#include "mesh/flat_mesh.h"
#include "metric/metric3_algebra.h"
#include "session/session.h"
#include "size/geometric_metric.h"
#include "support/infinity.h"
#include "surface/discrete/curvature_tensors.h"
#include "surfaces.h"

namespace carreau::discrete {
namespace {

using std::numbers::pi;

BuiltGeometry built_on(const FlatMesh& mesh) {
  return discrete_geometry(std::make_shared<const DiscreteSurface>(surface_of(mesh)));
}

/// Edges of unit length in a triangle that is equilateral in the metric.
constexpr double unit_area = 0.43301270189221932;

struct DirectedRun {
  Monitor silent;
  Session session{silent};

  explicit DirectedRun(const BuiltGeometry& built) {
    session.set_cad(built.cad);
    session.set_model(built.model);
    session.parameters().set("measure", 1);
  }
  /// The metric of space everywhere.
  void prescribe(std::function<Metric3(Vec3)> metric) {
    session.parameters().set("hphy_flag", 1);
    session.parameters().set("hphydef", 1.0);
    session.parameters().set("hphymin", 1e-3);
    session.parameters().set("hphymax", 1e3);
    session.set_prescription_source(std::make_shared<testing::FieldSource>(
        testing::field_of_space([metric = std::move(metric)](Vec3 p) { return Prescription::of_space(metric(p)); })));
  }
  void curvature(double angle, double hmax) {
    session.parameters().set("hphy_flag", 0);
    session.parameters().set("hgeo_flag", 1);
    session.parameters().set("geo_metric", 1);
    session.parameters().set("angle_mesh", angle);
    session.parameters().set("hgeomin", 1e-3);
    session.parameters().set("hgeomax", hmax);
  }
  const SurfaceMesh& mesh() {
    session.make_mesh();
    EXPECT_EQ(find_defects(session.mesh(), {.closed = true}), std::vector<std::string>{});
    return session.mesh();
  }
};

double share_in_range(const std::vector<double>& lengths) {
  const auto in =
      std::ranges::count_if(lengths, [](double l) { return l >= std::numbers::sqrt2 / 2 && l <= std::numbers::sqrt2; });
  return static_cast<double>(in) / static_cast<double>(lengths.size());
}

void expect_unit(const MeshEvaluation& delivered, double share, double mean_shape) {
  EXPECT_GE(share_in_range(delivered[EvaluationKind::length].values), share);
  EXPECT_GE(delivered[EvaluationKind::metric_quality].spread.mean, mean_shape);
}

// A constant metric of space makes of the sphere a spheroid of half axes 1 / h1, 1 / h1, 1 / h3: unit triangles have
// its area.
TEST(DirectedMeshes, AConstantMetricOnASphereCountsAsASpheroid) {
  for (const double ratio : {3.0, 6.0}) {
    const double h1 = 0.1, h3 = ratio * h1, a = 1 / h1, c = 1 / h3;
    DirectedRun run(built_on(sphere(8)));
    run.prescribe([=](const Vec3&) { return Metric3{1 / (h1 * h1), 0, 0, 1 / (h1 * h1), 0, 1 / (h3 * h3)}; });
    const SurfaceMesh& mesh = run.mesh();
    const double e = std::sqrt(1 - c * c / (a * a));
    const double area = 2 * pi * a * a * (1 + (1 - e * e) / e * std::atanh(e));  // oblate
    EXPECT_NEAR(static_cast<double>(mesh.triangle_count()) / (area / unit_area), 1, 0.06);
    expect_unit(run.session.delivered(), 0.95, 0.93);
  }
}

// Sizes by curvature: around a torus the density is 1 / (h1 h2), with the sizes that the rule has for both radii in
// closed form.
TEST(DirectedMeshes, CurvatureOfATorusIsFollowedByDirection) {
  constexpr double R = 2, r = 0.7, largest = 0.6;
  const GeometricRule rule{.criterion = GeometricCriterion::angle, .anisotropic = true, .angle_deg = 8};
  DirectedRun run(built_on(torus(64, 32)));
  run.curvature(8, largest);
  const SurfaceMesh& mesh = run.mesh();
  // Trapezoids around the tube: exact to rounding for smooth functions.
  double wanted = 0, isotropic = 0;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double v = 2 * pi * i / n, rho = R + r * std::cos(v), k2 = std::abs(std::cos(v)) / rho;
    const auto sizes = geometric_sizes(rule, r, k2 > 0 ? 1 / k2 : infinity);
    const double h1 = std::min(sizes[0], largest), h2 = std::min(sizes[1], largest);
    const double ring = 2 * pi * rho * r * 2 * pi / n;
    wanted += ring / (h1 * h2) / unit_area;
    isotropic += ring / (h1 * h1) / unit_area;
  }
  EXPECT_NEAR(static_cast<double>(mesh.triangle_count()) / wanted, 1, 0.12);
  EXPECT_LT(static_cast<double>(mesh.triangle_count()), 0.5 * isotropic);
  expect_unit(run.session.delivered(), 0.95, 0.92);
}

// The smaller of both sizes counts along each principal direction: a prescribed size of no direction cuts the long ones.
TEST(DirectedMeshes, CurvatureAndPrescribedSizesAreCombined) {
  constexpr double R = 2, r = 0.7, prescribed = 0.3;
  const GeometricRule rule{.criterion = GeometricCriterion::angle, .anisotropic = true, .angle_deg = 8};
  DirectedRun run(built_on(torus(64, 32)));
  run.curvature(8, 10);
  run.prescribe([](const Vec3&) { return isotropic_metric3(prescribed); });
  double wanted = 0;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double v = 2 * pi * i / n, rho = R + r * std::cos(v), k2 = std::abs(std::cos(v)) / rho;
    const auto sizes = geometric_sizes(rule, r, k2 > 0 ? 1 / k2 : infinity);
    const double h1 = std::min(sizes[0], prescribed), h2 = std::min(sizes[1], prescribed);
    wanted += 2 * pi * rho * r * 2 * pi / n / (h1 * h2) / unit_area;
  }
  EXPECT_NEAR(static_cast<double>(run.mesh().triangle_count()) / wanted, 1, 0.12);
  expect_unit(run.session.delivered(), 0.95, 0.92);
}

// On the side of a cylinder edges lie around it or along it: sizes by direction meet at the rims, where the caps are
// flat.
TEST(DirectedMeshes, ACylinderKeepsItsRimsUnderLongTriangles) {
  const double s = 2 * std::sin(8 * pi / 180);
  DirectedRun run(built_on(cylinder(48)));
  run.curvature(8, 0.8);
  const SurfaceMesh& mesh = run.mesh();
  EXPECT_EQ(mesh.curves.size(), 2u);
  for (const CurveMesh& curve : mesh.curves) EXPECT_NEAR(static_cast<double>(curve.vertices.size() - 1), 2 * pi / s, 2);
  for (const Vec3& p : mesh.vertices) EXPECT_LE(std::hypot(p.x(), p.y()), 1 + 2e-4);
  // Fewer than half the triangles of the smaller size everywhere.
  const double isotropic = (2 * pi * 2 + 2 * pi) / (s * s) / unit_area;
  EXPECT_LT(static_cast<double>(mesh.triangle_count()), 0.7 * isotropic);
  EXPECT_GE(share_in_range(run.session.delivered()[EvaluationKind::length].values), 0.85);
}

TEST(DirectedMeshes, GradationBoundsGrowingSizes) {
  // Across x = 0 the size along x falls to a tenth.
  const auto metric = [](const Vec3& p) {
    const double h = std::abs(p.x()) < 0.05 ? 0.03 : 0.3;
    return Metric3{1 / (h * h), 0, 0, 1 / 0.09, 0, 1 / 0.09};
  };
  std::int64_t count[2];
  for (const int graded : {0, 1}) {
    DirectedRun run(built_on(sphere(24)));
    run.prescribe(metric);
    run.session.parameters().set("gradation", graded != 0 ? 1.3 : 0.0);
    count[graded] = static_cast<std::int64_t>(run.mesh().triangle_count());
    if (graded != 0) expect_unit(run.session.delivered(), 0.9, 0.85);
  }
  EXPECT_GT(count[1], count[0]);
}

TEST(DirectedMeshes, TheSameForAnyNumberOfThreads) {
  std::vector<Vec3> known;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const int threads : {1, 4}) {
    DirectedRun run(built_on(torus(24, 12)));
    run.curvature(12, 0.8);
    run.session.parameters().set("threads", threads);
    const SurfaceMesh& mesh = run.mesh();
    const FlatMesh flat = flatten(mesh, false);
    if (threads == 1) known = mesh.vertices, triangles = flat.triangles;
    EXPECT_EQ(mesh.vertices, known);
    EXPECT_EQ(flat.triangles, triangles);
  }
}

// A size that sources give without direction counts as it did.
TEST(DirectedMeshes, SizesWithoutDirectionNeedNoMetric) {
  DirectedRun told(built_on(torus(24, 12))), uniform(built_on(torus(24, 12)));
  told.prescribe([](const Vec3&) { return isotropic_metric3(0.2); });
  uniform.session.parameters().set("hphydef", 0.2);
  const std::size_t a = told.mesh().triangle_count(), b = uniform.mesh().triangle_count();
  EXPECT_NEAR(static_cast<double>(a) / static_cast<double>(b), 1, 0.01);  // sizes differ in the last places
}

// The tensor of a torus: 1 / r across, cos v / (R + r cos v) around. The convergence has first order: the diagonals all
// run one way.
TEST(CurvatureTensors, ConvergeOnATorus) {
  constexpr double R = 2, r = 0.7;
  double before = 0;
  for (const int n : {24, 48, 96}) {
    const DiscreteSurface surface = surface_of(torus(2 * n, n));
    const CurvatureTensors tensors(surface);
    double worst = 0;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(surface.triangles()); ++t) {
      const Vec3 p = surface.mesh().at(surface.mesh().corner(t, 0));
      const double rho = std::hypot(p.x(), p.y()), cosine = (rho - R) / r, sine = p.z() / r;
      const Vec3 out{p.x() / rho, p.y() / rho, 0}, across = Vec3{0, 0, cosine} - sine * out,
                                                   around{-out.y(), out.x(), 0};
      const PlaneCurvature k = tensors.at(t, {0, 0}, across, around);
      const double sign = dot(surface.normal(t, 0), cosine * out + Vec3{0, 0, sine}) > 0 ? 1 : -1;
      worst = std::max({worst, std::abs(k.a - sign / r), std::abs(k.c - sign * cosine / rho), std::abs(k.b)});
    }
    if (before > 0) {
      EXPECT_LT(worst, before / 2);
    }
    before = worst;
  }
  EXPECT_LT(before, 0.02);
}

}  // namespace
}  // namespace carreau::discrete
