// SPDX-License-Identifier: BSD-3-Clause
// Adjacent edges whose lengths differ too much.
#include "surface/improve/even_edges.h"

#include <gtest/gtest.h>

#include "geometric_run.h"

namespace carreau {
namespace {

using namespace testing;

double worst_ratio(const SurfaceMesh& mesh) {
  std::vector<double> low(mesh.vertices.size(), 1e300), high(low.size(), 0);
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles)
      for (int i = 0; i < 3; ++i) {
        const std::int32_t a = face.vertex[t[i]], b = face.vertex[t[(i + 1) % 3]];
        const double l = norm(mesh.vertices[a] - mesh.vertices[b]);
        for (const std::int32_t v : {a, b}) low[v] = std::min(low[v], l), high[v] = std::max(high[v], l);
      }
  double worst = 0;
  for (std::size_t v = 0; v < low.size(); ++v) worst = std::max(worst, high[v] / low[v]);
  return worst;
}

/// A torus patch meshed with one size, one vertex inside then pulled towards a neighbour.
class PulledVertex : public ::testing::Test {
 protected:
  static constexpr double size = 0.1;
  Monitor monitor_;
  AnalyticCad cad_ = torus();
  ModelSupports supports_ = build_supports(unglued(cad_), cad_, 1, 1, monitor_);
  Model model_ = glue(unglued(cad_), traces_of(supports_), supports_.diag / 500);
  Topology topology_ = build_topology(model_, traces_of(supports_), supports_.diag / 100);
  CompositeOptions options_ = [] {
    CompositeOptions options;
    options.size = {.physical = PhysicalSizes::uniform, .hphydef = size, .hphymin = 1e-3, .hphymax = 10};
    return options;
  }();
  CompositeResult result_ = mesh_composite(model_, topology_, supports_, cad_, options_, monitor_);
  SizeRules rules_{model_, topology_, cad_, options_.size};

  void pull(double share) {
    FaceMesh& face = result_.mesh.faces[0];
    const auto inner = static_cast<std::int32_t>(result_.interfaces[0].plane.vertices.size());
    // Far from the border: all vertices of its triangles are inside.
    for (const auto& t : face.triangles) {
      if (*std::min_element(t.begin(), t.end()) < inner + 200) continue;
      face.uv[t[0]] = face.uv[t[0]] + share * (face.uv[t[1]] - face.uv[t[0]]);
      result_.mesh.vertices[face.vertex[t[0]]] = surface_at(cad_, 1, want_position, face.uv[t[0]]).s;
      return;
    }
  }
};

TEST_F(PulledVertex, GoesBackUntilLengthsAreEven) {
  const double limit = 1.01 * worst_ratio(result_.mesh);
  pull(0.5);
  ASSERT_GT(worst_ratio(result_.mesh), limit);
  const std::size_t vertices = result_.mesh.vertices.size();
  even_out_lengths(limit, GeometricLimits{}, rules_, cad_, result_, monitor_);
  EXPECT_LE(worst_ratio(result_.mesh), limit);
  EXPECT_EQ(result_.mesh.vertices.size(), vertices);
  EXPECT_EQ(find_defects(result_.mesh), std::vector<std::string>{});
  const FaceMesh& face = result_.mesh.faces[0];
  for (std::size_t v = result_.interfaces[0].plane.vertices.size(); v < face.uv.size(); ++v)
    EXPECT_LE(norm(surface_at(cad_, 1, want_position, face.uv[v]).s - result_.mesh.vertices[face.vertex[v]]), 1e-12);
  for (const double h : result_.vertex_size) EXPECT_NEAR(h, size, 1e-12);
}

TEST_F(PulledVertex, StaysWhereTheLimitAllowsIt) {
  pull(0.5);
  const SurfaceMesh before = result_.mesh;
  const CallCounts calls = cad_.counts();
  even_out_lengths(1.01 * worst_ratio(before), GeometricLimits{}, rules_, cad_, result_, monitor_);
  EXPECT_EQ(result_.mesh.vertices, before.vertices);
  EXPECT_EQ(result_.mesh.faces[0].triangles, before.faces[0].triangles);
  EXPECT_EQ(cad_.counts(), calls);
}

}  // namespace
}  // namespace carreau
