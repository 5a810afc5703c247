// The figures that the plane mesher must reach: Q2 in space (HDR eq. 1.6), edge lengths over sizes, degrees.
#include <gtest/gtest.h>

#include "plane/plane_mesher.h"
#include "plane_checks.h"

namespace carreau {
namespace {

using namespace testing;

PlaneQuality quality_of(const PlaneCase& c, bool frontal = true) {
  Monitor monitor;
  PlaneMesherOptions options;
  options.frontal = frontal;
  const PlaneMesh mesh = mesh_plane(c.domain, control_space(c, 0.005), options, monitor);
  EXPECT_EQ(find_plane_defects(c.domain, mesh), std::vector<std::string>{});
  return measure(c, mesh);
}

TEST(Quality, OfTheManualsParaboloid) {
  const PlaneCase c = paraboloid(0.15462);
  EXPECT_EQ(c.domain.edges.size(), 216U);
  const PlaneQuality q = quality_of(c);
  SCOPED_TRACE(to_string(q));
  EXPECT_NEAR(static_cast<double>(q.triangles), 4980, 0.06 * 4980);
  EXPECT_GE(q.mean, 0.989);
  EXPECT_GE(q.p1, 0.92);
  EXPECT_GE(q.worst, 0.6);
  EXPECT_GE(q.degree_six, 0.89);
}

struct Fine {
  const char* name;
  PlaneCase (*make)(double);
  double size;
};
void PrintTo(const Fine& f, std::ostream* out) { *out << f.name; }

class FineQuality : public ::testing::TestWithParam<Fine> {};

TEST_P(FineQuality, MeetsTheFiguresAskedAt100000Triangles) {
  const PlaneQuality q = quality_of(GetParam().make(GetParam().size));
  SCOPED_TRACE(to_string(q));
  EXPECT_NEAR(static_cast<double>(q.triangles), 100000, 5000);
  EXPECT_GE(q.mean, 0.996);
  EXPECT_GE(q.p1, 0.94);
  EXPECT_GE(q.worst, 0.6);
  EXPECT_GE(q.degree_six, 0.96);
  EXPECT_NEAR(q.mean_length, 1, 0.01);
  EXPECT_GE(q.fitting, 0.999);
}

INSTANTIATE_TEST_SUITE_P(Smooth, FineQuality,
                         ::testing::Values(Fine{"paraboloid", paraboloid, 0.03558},
                                           Fine{"hemisphere", hemisphere, 0.01205},
                                           Fine{"torus", torus_patch, 0.02135}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace carreau
