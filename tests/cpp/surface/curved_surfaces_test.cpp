// SPDX-License-Identifier: BSD-3-Clause
// Unit meshes by both principal radii of whole surfaces: poles where sizes differ by direction, ridges, inflections on
// the samples of curves.
#include <gtest/gtest.h>

#include "geometric_run.h"

namespace carreau {
namespace {

using namespace testing;
using Kind = EvaluationKind;
constexpr double pi = std::numbers::pi;

AnalyticCad whole_ellipsoid(Vec3 axes) {
  return one_face([axes](Vec2 p) { return ellipsoid_jet(p, axes); }, rectangle({0, -pi / 2}, {2 * pi, pi / 2}));
}

/// One sheet, x^2 + y^2 = 1 + z^2.
AnalyticCad hyperboloid() {
  return one_face(
      [](Vec2 p) {
        const double c = std::cos(p.x()), s = std::sin(p.x()), ch = std::cosh(p.y()), sh = std::sinh(p.y());
        return SurfaceJet{{ch * c, ch * s, sh},  {-ch * s, ch * c, 0}, {sh * c, sh * s, ch},
                          {-ch * c, -ch * s, 0}, {-sh * s, sh * c, 0}, {ch * c, ch * s, sh}};
      },
      rectangle({0, -1}, {2 * pi, 1}));
}

/// z = a sin(2 u) cos(3 v): the quarters of its borders are inflections.
AnalyticCad wave() {
  return one_face(
      [](Vec2 p) {
        const double a = 0.4, s = std::sin(2 * p.x()), c = std::cos(2 * p.x()), t = std::sin(3 * p.y()),
                     d = std::cos(3 * p.y());
        return SurfaceJet{{p.x(), p.y(), a * s * d}, {1, 0, 2 * a * c * d},  {0, 1, -3 * a * s * t},
                          {0, 0, -4 * a * s * d},    {0, 0, -6 * a * c * t}, {0, 0, -9 * a * s * d}};
      },
      rectangle({0, 0}, {2 * pi, 2 * pi}));
}

void expect_unit(const AnalyticCad& cad, const char* rule, double gradation, double share_in_range) {
  SCOPED_TRACE(std::string(rule) + ", gradation " + std::to_string(gradation));
  const GeometricRun run(cad, [&](Parameters& p) {
    p.set("geo_metric", 1);
    p.set("geo_rule", rule);
    p.set("eps_chord", 1e-3);
    p.set("geo_guarantee", 0);
    p.set("gradation", gradation);
  });
  const MeshEvaluation& d = run.session->delivered();
  EXPECT_GE(d.share_in_range(), share_in_range);
  EXPECT_GE(d[Kind::metric_quality].spread.mean, 0.93);
  EXPECT_GE(d[Kind::metric_quality].spread.min, 0.2);
  EXPECT_EQ(d.folded_triangles, 0);
}

// At the poles of most sizes differ by direction, up to 10 times.
const Vec3 half_axes[] = {{1, 1, 10}, {1, 2, 2}, {1, 5, 5}, {1, 10, 10}, {1, 2, 5}, {1, 3, 10}};

TEST(CurvedSurfaces, WholeEllipsoidsHaveUnitMeshes) {
  for (const Vec3& axes : half_axes)
    for (const char* rule : {"angle", "chord"})
      for (const double gradation : {0.0, 1.3}) {
        SCOPED_TRACE("1, " + std::to_string(axes.y()) + ", " + std::to_string(axes.z()));
        expect_unit(whole_ellipsoid(axes), rule, gradation, 0.97);
      }
}

TEST(CurvedSurfaces, SaddlesAndWavesHaveUnitMeshesUnderAGradation) {
  for (const char* rule : {"angle", "chord"}) {
    expect_unit(hyperboloid(), rule, 1.3, 0.97);
    expect_unit(wave(), rule, 1.3, 0.97);
  }
}

}  // namespace
}  // namespace carreau
