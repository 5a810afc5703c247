// SPDX-License-Identifier: BSD-3-Clause
// Surfaces whose curvature or parametrisation is singular at a place of their boundary: sizes by the geometry are
// bounded there, whatever rule they come from, and no gradation makes them vanish.
#include <gtest/gtest.h>

#include "geometric_run.h"
#include "support/infinity.h"

namespace carreau {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi, hgeomin = 0.05;

/// Its apex is exactly degenerate.
AnalyticCad cone() {
  return one_face(
      [](Vec2 p) {
        const double c = std::cos(p.x()), s = std::sin(p.x()), v = p.y();
        return SurfaceJet{{v * c, v * s, v}, {-v * s, v * c, 0}, {c, s, 1}, {-v * c, -v * s, 0}, {-s, c, 0}, {}};
      },
      rectangle({0, 0}, {2 * pi, 1}));
}
AnalyticCad half_cone() {
  AnalyticCad c = cone();
  c.faces[1].curves = rectangle({0, 0}, {pi, 1});
  return c;
}

/// Below its apex; a triangle of (u, v), one side of which is the apex.
AnalyticCad slanted_cone() {
  AnalyticCad c = cone();
  c.faces[1].curves = {segment({0, -1}, {2 * pi, 0}), segment({2 * pi, 0}, {0, 0}), segment({0, 0}, {0, -1})};
  return c;
}

const Surface singular[] = {
    {"cone", cone}, {"half_cone", half_cone}, {"slanted_cone", slanted_cone}, {"sphere", sphere}};

class Apex : public ::testing::TestWithParam<Surface> {};

TEST_P(Apex, IsMeshedByEveryGeometricRule) {
  for (const char* rule : {"angle", "chord", "both", "radii"})
    for (const int by_direction : {0, 1})
      for (const int guarantee : {0, 1})
        for (const double gradation : {0., 1.1}) {
          SCOPED_TRACE(std::string(rule) + (by_direction != 0 ? " by direction" : "") +
                       (guarantee != 0 ? ", guaranteed" : "") + (gradation != 0 ? ", graded" : ""));
          const GeometricRun run(GetParam().make(), [&](Parameters& p) {
            p.set("geo_rule", rule);
            p.set("geo_metric", by_direction);
            p.set("geo_guarantee", guarantee);
            p.set("gradation", gradation);
            p.set("angle_mesh", 25.0);
            p.set("eps_chord", 2e-2);
            p.set("hphy_flag", 1);
            p.set("hphydef", 0.06);
            p.set("hphymin", 0.006);
            p.set("hphymax", 0.57);
            p.set("hgeomin", hgeomin);
            p.set("hgeomax", 0.57);
          });
          const FaceMesh& face = run.session->mesh().faces[0];
          EXPECT_EQ(face.why, "");
          EXPECT_GT(face.triangles.size(), 10U);
          double shortest = infinity;
          for (const auto& t : face.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
              const std::int32_t a = face.vertex[t[k]], b = face.vertex[t[(k + 1) % 3]];
              const auto& xyz = run.session->mesh().vertices;
              if (a != b) shortest = std::min(shortest, norm(xyz[a] - xyz[b]));
            }
          EXPECT_GT(shortest, 0.5 * hgeomin);
        }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Apex, ::testing::ValuesIn(singular),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace carreau
