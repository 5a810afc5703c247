// SPDX-License-Identifier: BSD-3-Clause
// Large domains are meshed in pieces: no measure shows where these have met.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <set>

#include "common/thread_team.h"
#include "metric_cases.h"
#include "plane/division/coarse_domain.h"
#include "plane/division/divided_mesh.h"
#include "plane/division/undivided.h"
#include "plane/kernel/thresholds.h"
#include "plane/plane_mesher.h"
#include "plane_checks.h"

namespace carreau {
namespace {

using namespace testing;
using Defects = std::vector<std::string>;

plane::Field::Known known_of(const ControlSpace& space) {
  return {.bends = plane::Field::may_bend(space), .triangles = space.measure()};
}
PlaneMesh uncut(const PlaneDomain& domain, const ControlSpace& space) {
  Monitor monitor;
  return plane::mesh_undivided(domain, space, known_of(space), {}, monitor).mesh;
}
// In smaller pieces than usual, so that there are several.
std::optional<PlaneMesh> cut(const PlaneDomain& domain, const ControlSpace& space, int threads = 1) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  Monitor monitor;
  PlaneMesherOptions options;
  options.executor.threads = threads;
  return plane::mesh_divided(domain, space, known_of(space), options, monitor, 90'000);
}
void expect_same(const PlaneMesh& one, const PlaneMesh& other) {
  EXPECT_EQ(one.vertices, other.vertices);
  EXPECT_EQ(one.triangles, other.triangles);
}

struct Large {
  const char* name;
  PlaneCase (*make)(double);
  double size;
};
void PrintTo(const Large& l, std::ostream* out) { *out << l.name; }

PlaneCase turning(double h) { return swirl(h); }
/// Two squares that share nothing.
PlaneCase two_squares(double h) {
  PlaneCase c = flat_square(h), other = c;
  const auto n = static_cast<int>(c.domain.vertices.size());
  for (const Vec2& p : other.domain.vertices) c.domain.vertices.push_back(p + Vec2{1.5, 0.25});
  for (PlaneEdge e : other.domain.edges) {
    e.a += n, e.b += n;
    c.domain.edges.push_back(e);
  }
  c.high = c.high + Vec2{1.5, 0.25};
  return c;
}

class Divided : public ::testing::TestWithParam<Large> {};

// A fifth of a percent of degrees, a thousandth of mean shape and length: the effect of another seed of the boundary.
TEST_P(Divided, IsAsGoodAsInOnePiece) {
  const PlaneCase c = GetParam().make(GetParam().size);
  const ControlSpace space = control_space(c);
  ASSERT_GT(space.measure(), plane::triangles_a_piece);
  const auto mesh = cut(c.domain, space);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(find_plane_defects(c.domain, *mesh), Defects{});
  const PlaneQuality q = measure(c, *mesh), whole = measure(c, uncut(c.domain, space));
  SCOPED_TRACE(to_string(q) + "\n" + to_string(whole));
  EXPECT_NEAR(q.mean, whole.mean, 0.001);
  EXPECT_GT(q.p1, whole.p1 - 0.01);
  EXPECT_GT(q.worst, 0.9 * whole.worst);
  EXPECT_NEAR(q.mean_length, whole.mean_length, 0.001);
  EXPECT_GT(q.fitting, whole.fitting - 0.0005);
  EXPECT_LT(q.longest, 1.1 * whole.longest);
  EXPECT_GT(q.degree_six, whole.degree_six - 0.002);
  EXPECT_NEAR(static_cast<double>(q.triangles), static_cast<double>(whole.triangles),
              0.005 * static_cast<double>(whole.triangles));
}

TEST_P(Divided, IsTheSameForAnyNumberOfThreads) {
  const PlaneCase c = GetParam().make(GetParam().size);
  const ControlSpace space = control_space(c);
  const auto one = cut(c.domain, space, 1);
  ASSERT_TRUE(one);
  for (const int threads : {2, 3, 7}) {
    const auto several = cut(c.domain, space, threads);
    ASSERT_TRUE(several);
    expect_same(*one, *several);
  }
}

INSTANTIATE_TEST_SUITE_P(Large, Divided,
                         ::testing::Values(Large{"square", flat_square, 0.003}, Large{"paraboloid", paraboloid, 0.022},
                                           Large{"hemisphere", hemisphere, 0.0075}, Large{"torus", torus_patch, 0.0132},
                                           Large{"holes", holes, 0.0055}, Large{"internal", internal_curves, 0.0058},
                                           Large{"stretched", stretched, 0.0047}, Large{"sizes", size_field, 0.25},
                                           Large{"swirl", turning, 0.0055}, Large{"sphere", sphere_two_poles, 0.01},
                                           Large{"poles", sphere_two_poles, 0.0095},
                                           Large{"squares", two_squares, 0.004}),
                         [](const auto& of) { return std::string(of.param.name); });

/// So narrow that cuts along its middle would make it a zone as a whole.
PlaneCase strip(int length, int width) {
  constexpr double h = 1e-3;
  PlaneCase c = flat_square(h);
  c.domain = {};
  const auto side = [&](int n, Vec2 from, Vec2 step) {
    for (int k = 0; k < n; ++k) c.domain.vertices.push_back(h * (from + static_cast<double>(k) * step));
  };
  side(length, {0, 0}, {1, 0});
  side(width, {1.0 * length, 0}, {0, 1});
  side(length, {1.0 * length, 1.0 * width}, {-1, 0});
  side(width, {0, 1.0 * width}, {0, -1});
  const auto n = static_cast<int>(c.domain.vertices.size());
  for (int k = 0; k < n; ++k) c.domain.edges.push_back({.a = k, .b = (k + 1) % n});
  c.high = {h * length, h * width};
  return c;
}

TEST(Division, IsTheSameForAnyNumberOfProcesses) {
  const PlaneCase c = flat_square(0.003);
  const ControlSpace space = control_space(c);
  const auto one = cut(c.domain, space);
  ASSERT_TRUE(one);
  for (const int processes : {1, 2, 3, 7}) {
    const auto thrown = in_processes(processes, [&](Team& team) {
      Monitor monitor;
      PlaneMesherOptions options;
      options.executor.team = &team;
      const auto mesh = plane::mesh_divided(c.domain, space, known_of(space), options, monitor, 90'000);
      ASSERT_TRUE(mesh);
      expect_same(*mesh, *one);
    });
    for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "");
  }
}

TEST(Division, LeavesStripsAlone) {
  const PlaneCase c = strip(20'000, 6);
  const ControlSpace space = control_space(c);
  ASSERT_GT(space.measure(), plane::triangles_a_piece);
  Monitor monitor;
  PlaneMesherOptions options;
  options.executor.threads = 3;
  const PlaneMesh mesh = mesh_plane(c.domain, space, options, monitor);
  expect_same(mesh, uncut(c.domain, space));
}

/// Requests a stop at the checkpoint of that rank.
class StopsAt : public Monitor {
 public:
  explicit StopsAt(int rank) : rank_(rank) {}
  void checkpoint() override {
    if (seen++ == rank_) request_stop();
    Monitor::checkpoint();
  }
  int seen = 0;

 private:
  int rank_;
};

TEST(Division, Stops) {
  const PlaneCase c = flat_square(0.003);
  const ControlSpace space = control_space(c);
  PlaneMesherOptions options;
  StopsAt never(-1);
  (void)plane::mesh_divided(c.domain, space, known_of(space), options, never);
  ASSERT_GT(never.seen, 10);
  for (const int quarter : {0, 1, 2, 3}) {
    StopsAt monitor(quarter * (never.seen - 1) / 3);
    EXPECT_THROW((void)plane::mesh_divided(c.domain, space, known_of(space), options, monitor), Cancelled) << quarter;
  }
  options.executor.threads = 3;
  for (const int rank : {0, 2, 5}) {
    StopsAt monitor(rank);
    EXPECT_THROW((void)plane::mesh_divided(c.domain, space, known_of(space), options, monitor), Cancelled) << rank;
  }
}

TEST(Division, KeepsTheLimitOfTriangles) {
  const PlaneCase c = flat_square(0.003);
  const ControlSpace space = control_space(c);
  Monitor monitor;
  PlaneMesherOptions options;
  options.max_triangles = 150'000;  // more than each of the pieces has
  EXPECT_THROW((void)mesh_plane(c.domain, space, options, monitor), LimitError);
}

TEST(Division, FindsDefectsBetweenPieces) {
  PlaneCase c = two_squares(0.004);
  const ControlSpace space = control_space(c);
  for (std::size_t v = c.domain.vertices.size() / 2; v < c.domain.vertices.size(); ++v)
    c.domain.vertices[v] = c.domain.vertices[v] - Vec2{0.75, 0.1};
  Monitor monitor;
  EXPECT_THROW((void)mesh_plane(c.domain, space, {}, monitor), DomainError);
}

TEST(Division, AppliesToLargeDomains) {
  const PlaneCase c = flat_square(0.0028);
  const ControlSpace space = control_space(c);
  Monitor monitor;
  const auto mesh = plane::mesh_divided(c.domain, space, known_of(space), {}, monitor);
  ASSERT_TRUE(mesh);
  expect_same(mesh_plane(c.domain, space, {}, monitor), *mesh);
}

TEST(Division, NeedsTwoPieces) {
  const PlaneCase c = holes(0.012);
  EXPECT_FALSE(cut(c.domain, control_space(c)));
}

TEST(Division, LeavesSmallDomainsAlone) {
  const PlaneCase c = holes(0.012);
  const ControlSpace space = control_space(c);
  ASSERT_LT(space.measure(), 60'000);
  Monitor monitor;
  PlaneMesherOptions options;
  options.executor.threads = 7;
  expect_same(mesh_plane(c.domain, space, options, monitor), uncut(c.domain, space));
}

}  // namespace
}  // namespace carreau
