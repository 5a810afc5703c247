// SPDX-License-Identifier: BSD-3-Clause
// Unit meshes in anisotropic fields: lengths and quality measured in the field itself.
#include <gtest/gtest.h>

#include <algorithm>

#include "metric_cases.h"
#include "plane/plane_mesher.h"
#include "plane_checks.h"

namespace carreau::testing {
namespace {

struct Asked {
  const char* name;
  MetricCase (*make)(double h, double ratio);
  double h, ratio;
};

class AnisotropicField : public ::testing::TestWithParam<Asked> {};

// A straight edge follows a curved layer when its sagitta is small beside the size across: ratio 100 on a circle of
// radius 0.5 needs h = 1e-4 (edges of 0.01, sagitta 2.5e-5).
TEST_P(AnisotropicField, GetsUnitEdgesAndGoodTriangles) {
  const MetricCase c = GetParam().make(GetParam().h, GetParam().ratio);
  Monitor monitor;
  const PlaneMesh mesh = mesh_plane(c.domain, control_space(c), {}, monitor);
  EXPECT_EQ(find_plane_defects(c.domain, mesh), std::vector<std::string>{});
  const MetricQuality q = measure(c, mesh);
  EXPECT_GE(q.fitting, 0.97) << to_string(q);
  EXPECT_GE(q.mean, 0.93) << to_string(q);
  EXPECT_GE(q.worst, 0.2) << to_string(q);
  EXPECT_NEAR(q.mean_length, 1, 0.02) << to_string(q);
}

INSTANTIATE_TEST_SUITE_P(
    Plane, AnisotropicField,
    ::testing::Values(Asked{"line_2", layer_on_line, 0.01, 2}, Asked{"line_10", layer_on_line, 0.003, 10},
                      Asked{"line_100", layer_on_line, 0.0006, 100}, Asked{"circle_2", layer_on_circle, 0.01, 2},
                      Asked{"circle_10", layer_on_circle, 0.003, 10}, Asked{"circle_100", layer_on_circle, 0.0001, 100},
                      Asked{"spiral_2", layer_on_spiral, 0.01, 2}, Asked{"spiral_10", layer_on_spiral, 0.003, 10},
                      Asked{"spiral_100", layer_on_spiral, 0.0001, 100}, Asked{"sine_10", layer_on_sine, 0.006, 10}),
    [](const auto& parameter) { return parameter.param.name; });

// The worst triangle is one of a hundred thousand: that it is good enough must not hang on the last digit of a size.
TEST(AnisotropicField, TheWorstTriangleIsNoMatterOfLuck) {
  for (const auto make : {layer_on_circle, layer_on_spiral})
    for (const double by : {1.003, 1.006, 1.012, 1.018}) {
      const MetricCase c = make(0.0001 * by, 100);
      Monitor monitor;
      const MetricQuality q = measure(c, mesh_plane(c.domain, control_space(c), {}, monitor));
      EXPECT_GE(q.worst, 0.2) << c.name << ", " << by << ": " << to_string(q);
    }
}

// Nothing is promised about lengths: the field turns faster than straight edges can follow.
TEST(AnisotropicField, ARatioOfAThousandGivesAValidMesh) {
  for (const auto make : {layer_on_line, layer_on_circle, layer_on_spiral}) {
    const MetricCase c = make(0.0001, 1000);
    Monitor monitor;
    const PlaneMesh mesh = mesh_plane(c.domain, control_space(c), {}, monitor);
    EXPECT_EQ(find_plane_defects(c.domain, mesh), std::vector<std::string>{}) << c.name;
  }
}

// Vertices put on edges are on them up to rounding. No triangle is left between an edge and its own middle, even if the
// lengths of its sides look good, each by the tensor in its middle.
TEST(AnisotropicField, FieldsThatEdgesCannotFollowLeaveNoFlatTriangle) {
  for (const bool frontal : {true, false})
    for (const double ratio : {50.0, 100.0, 200.0}) {
      const MetricCase c = rings(0.002, ratio);
      Monitor monitor;
      const PlaneMesh mesh = mesh_plane(c.domain, control_space(c), {.frontal = frontal}, monitor);
      EXPECT_EQ(find_plane_defects(c.domain, mesh), std::vector<std::string>{});
      int flat = 0;
      for (const auto& t : mesh.triangles) {
        const Vec2 p = mesh.vertices[t[0]], u = mesh.vertices[t[1]] - p, v = mesh.vertices[t[2]] - p;
        flat += cross(u, v) < 1e-12 * std::max({dot(u, u), dot(v, v), dot(v - u, v - u)}) ? 1 : 0;
      }
      EXPECT_EQ(flat, 0) << "of " << mesh.triangles.size();
    }
}

// Turning the coordinates turns the mesh: a constant tensor is an affine map of the isotropic case.
TEST(AnisotropicField, AConstantTensorIsAsGoodAsNone) {
  for (const double ratio : {1.0, 3.0, 10.0}) {
    const MetricCase c = constant_stretch(0.004, ratio);
    Monitor monitor;
    const MetricQuality q = measure(c, mesh_plane(c.domain, control_space(c), {}, monitor));
    EXPECT_GE(q.mean, 0.996) << to_string(q);
    EXPECT_GE(q.p1, 0.94) << to_string(q);
    EXPECT_GE(q.fitting, 0.999) << to_string(q);
  }
}

}  // namespace
}  // namespace carreau::testing
