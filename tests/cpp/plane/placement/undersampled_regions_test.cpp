// SPDX-License-Identifier: BSD-3-Clause
// Small sizes amid large ones, where no boundary and no row comes near: the mesh finds them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "plane/plane_mesher.h"
#include "plane_checks.h"

namespace carreau {
namespace {

using namespace testing;

constexpr double far_size = 0.5, near_size = 0.01, radius = 0.06, slope = 4;

/// A square of edges `far_size` with a round spot of edges `near_size` inside: about it sizes grow fourfold within an
/// edge.
PlaneCase spotted(Vec2 spot) {
  PlaneCase c = flat_square(far_size);
  c.size = [spot](Vec2 p) { return std::min(near_size + slope * std::max(norm(p - spot) - radius, 0.0), far_size); };
  return c;
}

ControlSpace space_of(const PlaneCase& c, const std::vector<Vec2>& probe_points) {
  SampledDomain domain{c.domain.vertices, {}};
  for (const PlaneEdge& e : c.domain.edges) domain.edges.emplace_back(e.a, e.b);
  ControlSpaceOptions options;
  options.probe_points = probe_points;
  Monitor monitor;
  return ControlSpace::build(
      domain,
      [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
        for (std::size_t i = 0; i < uv.size(); ++i) metric[i] = true_metric(c, uv[i]);
      },
      options, monitor);
}

class UndersampledRegions : public ::testing::TestWithParam<Vec2> {};

TEST_P(UndersampledRegions, AreMeshed) {
  const PlaneCase c = spotted(GetParam());
  const ControlSpace space = space_of(c, {GetParam() + Vec2{0.3 * radius, 0.2 * radius}});
  EXPECT_NEAR(1 / std::sqrt(space.at(GetParam()).a) / near_size, 1, 0.05);
  for (const bool frontal : {true, false}) {
    PlaneMesherOptions options;
    options.frontal = frontal;
    Monitor monitor;
    PlaneMesh mesh = mesh_plane(c.domain, space, options, monitor);
    std::vector<std::vector<Vec2>> regions;
    for (int round = 0; round < 6; ++round) {
      auto more = space.undersampled_regions(mesh.vertices.size(), [&](std::size_t v) { return mesh.vertices[v]; });
      if (more.empty()) break;
      std::move(more.begin(), more.end(), std::back_inserter(regions));
      options.undersampled = regions;
      mesh = mesh_plane(c.domain, space, options, monitor);
    }
    EXPECT_EQ(find_plane_defects(c.domain, mesh), std::vector<std::string>{});
    const auto inside = std::count_if(mesh.vertices.begin(), mesh.vertices.end(),
                                      [&](Vec2 p) { return norm(p - GetParam()) < radius; });
    const double wanted = std::numbers::pi * radius * radius / (0.5 * std::numbers::sqrt3 * near_size * near_size);
    EXPECT_GT(static_cast<double>(inside), 0.6 * wanted) << frontal;
    EXPECT_GT(measure(c, mesh).mean, 0.85);
  }
}
// One of them about a vertex that the front places.
INSTANTIATE_TEST_SUITE_P(Places, UndersampledRegions,
                         ::testing::Values(Vec2{0.37, 0.41}, Vec2{0.5, 0.5}, Vec2{0.71, 0.22}, Vec2{0.13, 0.83}));

TEST(UndersampledRegions, AreSquaresThatHoldTooFewVertices) {
  const PlaneCase c = spotted({0.37, 0.41});
  const ControlSpace space = space_of(c, {{0.37, 0.41}});
  const std::vector<Vec2> none;
  const auto count = [&](const std::vector<Vec2>& v) {
    return space.undersampled_regions(v.size(), [&](std::size_t i) { return v[i]; });
  };
  // All of the domain, whatever its squares: each place is in the spot or its own square has no smaller size.
  std::vector<Vec2> grid;
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 40; ++i) grid.push_back({(i + 0.5) / 40, (j + 0.5) / 40});
  const auto missed = count(grid);
  ASSERT_FALSE(missed.empty());
  for (const std::vector<Vec2>& places : missed) EXPECT_LT(norm(places.front() - Vec2{0.37, 0.41}), 1.5 * radius);
  EXPECT_FALSE(count(none).empty());
  EXPECT_TRUE(ControlSpace::constant({1e6, 0, 1e6}).undersampled_regions(0, [](std::size_t) { return Vec2{}; }).empty());
}

}  // namespace
}  // namespace carreau
