// SPDX-License-Identifier: BSD-3-Clause
// Meshes of triangles' surfaces that are made in planes, and the planes themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/thread_team.h"
#include "geometry/discrete/discrete_cad.h"
#include "mesh/crossings/intersections.h"
#include "mesh/quality.h"
#include "session/session.h"
#include "surface/discrete/start_mesh.h"
#include "surface/remesh/planes/borders.h"
#include "surface/remesh/planes/chart_plane.h"
#include "surface/remesh/planes/find_charts.h"
#include "surface/remesh/planes/thresholds.h"
#include "surfaces.h"

namespace carreau::discrete {
namespace {

using namespace carreau::thresholds::planes;

/// Records the messages of a run, and whether its remeshing was parametric.
class Listener final : public Monitor {
 public:
  void message(Level, std::string_view text) override {
    if (text.starts_with("parametric remeshing: ")) in_planes = true, ++times;
    if (text.starts_with("local instead of parametric remeshing")) in_planes = false;
    crossed = crossed || text.ends_with("pairs of triangles cross");
  }
  bool in_planes = false, crossed = false;
  int times = 0;
};

struct MadeInPlanes {
  SurfaceMesh mesh;
  Delivery length;
  bool in_planes = false, crossed = false;  ///< crossed: triangles did at first
  int times = 0;                            ///< that it was made in planes
};

MadeInPlanes made_of(const FlatMesh& triangles, double size, int threads = 1, std::shared_ptr<TeamLink> team = nullptr) {
  const BuiltGeometry built = discrete_geometry(std::make_shared<const DiscreteSurface>(surface_of(triangles, {})));
  Listener listener;
  Session session(listener);
  session.set_cad(built.cad);
  session.set_model(built.model);
  session.parameters().set("threads", threads);
  session.parameters().set("verb", 100);
  session.parameters().set("hphy_flag", 1);
  session.parameters().set("hphydef", size);
  session.set_team(std::move(team));
  session.make_mesh();
  EXPECT_EQ(find_defects(session.mesh(), {.closed = false}), std::vector<std::string>{});
  return {session.mesh(), session.delivered()[EvaluationKind::length], listener.in_planes, listener.crossed, listener.times};
}

double mean_quality(const FlatMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    sum += quality_q2(at(0), at(1), at(2));
  }
  return sum / static_cast<double>(mesh.triangles.size());
}

TEST(ProjectedMeshes, ShapesAndLengthsMatchTheRequest) {
  for (const auto& [triangles, size, chi] :
       {std::tuple{sphere(12), 0.06, 2}, {torus(48, 24), 0.1, 0}, {cube(3), 0.05, 2}, {cylinder(36), 0.06, 2}}) {
    const MadeInPlanes made = made_of(triangles, size);
    EXPECT_TRUE(made.in_planes);
    const FlatMesh flat = flatten(made.mesh, false);
    EXPECT_EQ(static_cast<std::int64_t>(flat.vertices.size()) - static_cast<std::int64_t>(flat.triangles.size() / 2),
              chi);
    EXPECT_GE(mean_quality(flat), 0.985);
    EXPECT_GE(made.length.spread.p1, 1 / std::numbers::sqrt2);
    EXPECT_LE(made.length.spread.p99, std::numbers::sqrt2);
    EXPECT_NEAR(made.length.spread.mean, 1, 0.05);
    Monitor silent;
    EXPECT_EQ(find_intersections(flat.vertices, flat.triangles, {}, silent).count, 0);
  }
}

TEST(ProjectedMeshes, VerticesLieOnTheSurface) {
  for (const Vec3& p : made_of(sphere(12), 0.08).mesh.vertices) EXPECT_NEAR(norm(p), 1, 1e-4);
}

TEST(ProjectedMeshes, TheSameForAnyNumberOfThreads) {
  const SurfaceMesh one = made_of(sphere(8), 0.08, 1).mesh;
  for (const int threads : {2, 5}) {
    const SurfaceMesh other = made_of(sphere(8), 0.08, threads).mesh;
    EXPECT_EQ(one.vertices, other.vertices);
    EXPECT_EQ(flatten(one, false).triangles, flatten(other, false).triangles);
  }
}

/// The mesh of each process, or the sentence of its exception.
std::vector<std::pair<MadeInPlanes, std::string>> made_by_processes(int n, const std::function<double(int)>& size) {
  carreau::testing::CommonOfThreads common(n);
  std::vector<std::pair<MadeInPlanes, std::string>> made(static_cast<std::size_t>(n));
  std::vector<std::thread> processes;
  for (int rank = 0; rank < n; ++rank)
    processes.emplace_back([&, rank] {
      auto& [mesh, sentence] = made[static_cast<std::size_t>(rank)];
      try {
        mesh = made_of(sphere(8), size(rank), 2, std::make_shared<carreau::testing::ThreadLink>(common, rank));
      } catch (const std::exception& error) {
        sentence = error.what();
      }
    });
  for (std::thread& process : processes) process.join();
  return made;
}

TEST(ProjectedMeshes, TheSameForAnyNumberOfProcesses) {
  const SurfaceMesh one = made_of(sphere(8), 0.08, 1).mesh;
  for (const auto& [made, sentence] : made_by_processes(3, [](int) { return 0.08; })) {
    EXPECT_EQ(sentence, "");
    EXPECT_TRUE(made.in_planes);
    EXPECT_EQ(one.vertices, made.mesh.vertices);
    EXPECT_EQ(flatten(one, false).triangles, flatten(made.mesh, false).triangles);
  }
}

TEST(ProjectedMeshes, NameTheProcessWithOtherSizes) {
  for (const auto& [made, sentence] : made_by_processes(3, [](int rank) { return rank == 2 ? 0.081 : 0.08; }))
    EXPECT_NE(sentence.find("differ on rank 2"), std::string::npos) << sentence;
}

// Three triangles at an edge: edits make the mesh.
TEST(ProjectedMeshes, SurfacesThatNoPlaneShowsAreRemeshedLocally) {
  FlatMesh fins;
  fins.vertices = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  fins.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  EXPECT_FALSE(made_of(fins, 0.1).in_planes);
}

// A spindle by degrees of longitude and latitude, with a tip of .04 at which the sizes of .1 cannot turn: a cut that
// slides over the tip leaves .09 of it out.
TEST(ProjectedMeshes, ThinPartsKeepTheirEnds) {
  constexpr std::int32_t rings = 60, around = 90;
  FlatMesh spindle;
  spindle.vertices.push_back({1, 0, 0});
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < around; ++j) {
      const double a = std::numbers::pi * i / rings, b = 2 * std::numbers::pi * j / around;
      spindle.vertices.push_back({std::cos(a), 0.2 * std::sin(a) * std::sin(b), 0.2 * std::sin(a) * std::cos(b)});
    }
  spindle.vertices.push_back({-1, 0, 0});
  const auto at = [](std::int32_t i, std::int32_t j) { return 1 + (i - 1) * around + j % around; };
  const auto last = static_cast<std::int32_t>(spindle.vertices.size()) - 1;
  for (std::int32_t j = 0; j < around; ++j) {
    spindle.triangles.push_back({0, at(1, j), at(1, j + 1)});
    spindle.triangles.push_back({last, at(rings - 1, j + 1), at(rings - 1, j)});
    for (std::int32_t i = 1; i + 1 < rings; ++i) {
      spindle.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      spindle.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  const double size = 0.1;
  const MadeInPlanes made = made_of(spindle, size);
  EXPECT_TRUE(made.in_planes);
  double first = 0, end = 0;
  for (const Vec3& p : made.mesh.vertices) first = std::min(first, p.x()), end = std::max(end, p.x());
  EXPECT_LT(first, -1 + size / 2);
  EXPECT_GT(end, 1 - size / 2);
}

std::int64_t crossings_of(const SurfaceMesh& mesh) {
  const FlatMesh flat = flatten(mesh, false);
  Monitor silent;
  return find_intersections(flat.vertices, flat.triangles, {}, silent).count;
}

/// The sphere about a centre on the x axis.
void add_sphere(double radius, double x, bool inside_out, FlatMesh& to) {
  const FlatMesh unit = sphere(24);
  const auto first = static_cast<std::int32_t>(to.vertices.size());
  for (const Vec3& p : unit.vertices) to.vertices.push_back(radius * p + Vec3{x, 0, 0});
  for (const auto& [a, b, c] : unit.triangles)
    to.triangles.push_back({first + a, first + (inside_out ? c : b), first + (inside_out ? b : c)});
}

// A hole of radius .6 comes within .01 of the unit sphere, whose triangles of .3 leave it by .015: edges are halved there.
TEST(ProjectedMeshes, TrianglesThatCrossAreUntangled) {
  FlatMesh shell;
  add_sphere(1, 0, false, shell), add_sphere(0.6, 0.39, true, shell);
  const MadeInPlanes made = made_of(shell, 0.3);
  EXPECT_TRUE(made.in_planes);
  EXPECT_TRUE(made.crossed);
  EXPECT_EQ(made.times, 1);
  EXPECT_EQ(crossings_of(made.mesh), 0);
}

// Teeth of .004 to .016 whose flanks bend by 10 degrees, with fans of needles as bottom and top: curves over the flanks may not
// turn the needles over. No triangle leaves the two planes.
TEST(ProjectedMeshes, NeedlesOfPlaneFacesAreNotFolded) {
  constexpr int teeth = 40, around = 8 * teeth;
  constexpr std::array<double, 8> height{0, 0, 0, 0.083, 0.1, 0.1, 0.083, 0.042};
  constexpr double top = 0.1;
  FlatMesh gear;
  for (int i = 0; i < around; ++i)
    for (const double z : {0.0, top}) {
      const double angle = 2 * std::numbers::pi * i / around, r = 0.2 + height[static_cast<std::size_t>(i % 8)];
      gear.vertices.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
  gear.vertices.push_back({0, 0, 0}), gear.vertices.push_back({0, 0, top});
  for (std::int32_t i = 0; i < around; ++i) {
    const std::int32_t a = 2 * i, b = 2 * ((i + 1) % around), middle = 2 * around;
    gear.triangles.push_back({a, b, b + 1}), gear.triangles.push_back({a, b + 1, a + 1});
    gear.triangles.push_back({middle, b, a}), gear.triangles.push_back({middle + 1, a + 1, b + 1});
  }
  const MadeInPlanes made = made_of(gear, 0.06);
  EXPECT_TRUE(made.in_planes);
  EXPECT_EQ(crossings_of(made.mesh), 0);
  const DiscreteSurface surface = surface_of(gear, {});
  EXPECT_LT(surface.deviation(), 0.004);
}

// A disc between two fans of 1 600 needles: ways from one place to another lead through hundreds of them. A mesh in planes
// that found the wrong needle would fold there.
TEST(ProjectedMeshes, FansOfNeedlesAreNotFolded) {
  constexpr int around = 1600;
  FlatMesh disc;
  for (int i = 0; i < around; ++i)
    for (const double z : {0.0, 0.3}) {
      const double angle = 2 * std::numbers::pi * i / around;
      disc.vertices.push_back({std::cos(angle), std::sin(angle), z});
    }
  disc.vertices.push_back({0, 0, 0}), disc.vertices.push_back({0, 0, 0.3});
  for (std::int32_t i = 0; i < around; ++i) {
    const std::int32_t a = 2 * i, b = 2 * ((i + 1) % around), middle = 2 * around;
    disc.triangles.push_back({a, b, b + 1}), disc.triangles.push_back({a, b + 1, a + 1});
    disc.triangles.push_back({middle, b, a}), disc.triangles.push_back({middle + 1, a + 1, b + 1});
  }
  const MadeInPlanes made = made_of(disc, 0.06);
  EXPECT_TRUE(made.in_planes);
  EXPECT_FALSE(made.crossed);
  EXPECT_EQ(made.times, 1);
  EXPECT_EQ(crossings_of(made.mesh), 0);
}

/// The atlas of a surface as it is given.
struct Atlas {
  explicit Atlas(const FlatMesh& triangles)
      : built(discrete_geometry(std::make_shared<const DiscreteSurface>(surface_of(triangles, {})))),
        surface(dynamic_cast<const DiscreteCad&>(*built.cad)),
        refined(unrefined(surface.discrete())),
        mesh(start_mesh(built.model, surface, refined)),
        sizes{std::vector<double>(refined.vertices.size(), 1), {}, {}},
        frame(start_frame(surface, refined, mesh, sizes, {}, *built.cad, silent)),
        flat(*frame.charts, mesh, frame.jets) {}
  Monitor silent;
  BuiltGeometry built;
  const DiscreteCad& surface;
  RefinedMesh refined;
  SurfaceMesh mesh;
  MeshSizes sizes;
  RemeshingFrame frame;
  FlatAtlas flat;
};

/// Triangles of each chart that hang together, and how much their normals lean.
void expect_charts(const Atlas& atlas, const ProjectedCharts& found, double cosine) {
  std::vector<std::set<std::int32_t>> members(found.axis.size());
  for (std::int32_t t = 0; t < atlas.flat.triangles(); ++t) {
    const auto c = static_cast<std::size_t>(found.chart[static_cast<std::size_t>(t)]);
    members[c].insert(t);
    EXPECT_GE(dot(atlas.flat.normal[static_cast<std::size_t>(t)], found.axis[c]), cosine);
  }
  for (const auto& some : members) {
    ASSERT_FALSE(some.empty());
    std::set<std::int32_t> met{*some.begin()};
    std::vector<std::int32_t> queue{*some.begin()};
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (const std::int32_t u : atlas.flat.at(queue[k]).beyond)
        if (some.contains(u) && met.insert(u).second) queue.push_back(u);
    EXPECT_EQ(met, some);
  }
}

// A cap whose normals lean by a at most has the share (1 - cos a) / 2 of a sphere.
TEST(ProjectedCharts, ChartsOfASphereAreConnectedAndLeanLittle) {
  Atlas atlas(sphere(12));
  ProjectedCharts found = find_charts(atlas.flat, atlas.silent);
  EXPECT_EQ(std::ranges::count(found.kept, 1), 0);
  EXPECT_GE(static_cast<double>(found.axis.size()), 2 / (1 - loose_cosine));
  EXPECT_LE(found.axis.size(), 16U);
  expect_charts(atlas, found, loose_cosine);
  const std::size_t before = found.axis.size();
  EXPECT_TRUE(split_charts(atlas.flat, std::vector<char>(before, 1), found, atlas.silent));
  EXPECT_EQ(found.axis.size(), 2 * before);
  expect_charts(atlas, found, 0);
  merge_charts(atlas.flat, merge_cosine, {}, found, atlas.silent);
  EXPECT_LT(found.axis.size(), 2 * before);
  expect_charts(atlas, found, loose_cosine);
}

// Charts around them fall into pieces, and nothing joins them.
TEST(ProjectedCharts, KeptTrianglesAreChartsOfTheirOwn) {
  Atlas atlas(sphere(6));
  ProjectedCharts found = find_charts(atlas.flat, atlas.silent);
  std::vector<char> some(found.chart.size(), 0);
  for (std::size_t t = 0; t < some.size(); t += 7) some[t] = 1;
  EXPECT_TRUE(keep_triangles(atlas.flat, some, found));
  EXPECT_FALSE(keep_triangles(atlas.flat, some, found));
  expect_charts(atlas, found, loose_cosine);
  merge_charts(atlas.flat, merge_cosine, {}, found, atlas.silent);
  expect_charts(atlas, found, loose_cosine);
  EXPECT_EQ(found.kept, some);
  for (std::size_t t = 0; t < some.size(); t += 7) EXPECT_EQ(std::ranges::count(found.chart, found.chart[t]), 1);
}

TEST(ProjectedCharts, FacesOfACubeAreOneChartEach) {
  Atlas atlas(cube(4));
  const ProjectedCharts found = find_charts(atlas.flat, atlas.silent);
  EXPECT_EQ(found.axis.size(), 6U);
  expect_charts(atlas, found, 1 - 1e-12);
}

// Facets of a coarse sphere lean less than the sphere does at their corners.
TEST(ProjectedCharts, MergedOnesDoNotTurnOverAtTheirCorners) {
  for (const int n : {3, 4, 6, 8}) {
    Atlas atlas(sphere(n));
    ProjectedCharts found = find_charts(atlas.flat, atlas.silent);
    const std::size_t before = found.axis.size();
    ASSERT_TRUE(split_charts(atlas.flat, std::vector<char>(before, 1), found, atlas.silent));
    const std::size_t split = found.axis.size();
    merge_charts(atlas.flat, 0.05, {}, found, atlas.silent);
    EXPECT_LT(found.axis.size(), split);
    for (std::size_t t = 0; t < found.chart.size(); ++t)
      for (const Vec3& normal : atlas.flat.corner[t])
        EXPECT_GE(dot(normal, found.axis[static_cast<std::size_t>(found.chart[t])]), min_cosine - 1e-12);
  }
}

// Borders of one chart and of all charts: they contain vertices of the atlas, and between these the number of vertices that the size
// prescribes, on the surface.
TEST(ProjectedCharts, ExactBordersAreEdgesOfTheAtlasCutBySizes) {
  Atlas atlas(sphere(6));
  const ProjectedCharts found = find_charts(atlas.flat, atlas.silent);
  const std::size_t n = atlas.mesh.vertices.size();
  for (const double size : {0.02, 0.05, 4.0})
    for (const char exact : {char{1}, max_exact}) {
      const std::vector<double> sizes(n, size);
      const std::vector<char> all(found.axis.size(), exact);
      const std::vector<char> kept(n, 0);
      const auto borders =
          cut_borders({atlas.flat, found, {}, {}, sizes, all, kept, {}, *atlas.built.cad}, atlas.silent);
      ASSERT_TRUE(borders);
      double expected = 0;
      for (std::int32_t t = 0; t < atlas.flat.triangles(); ++t)
        for (int i = 0; i < 3; ++i) {
          const Charts::Triangle& here = atlas.flat.at(t);
          const std::int32_t u = here.beyond[static_cast<std::size_t>(i)];
          if (u <= t || found.chart[static_cast<std::size_t>(u)] == found.chart[static_cast<std::size_t>(t)]) continue;
          const double length = norm(atlas.flat.xyz(here.vertex[static_cast<std::size_t>((i + 1) % 3)]) -
                                     atlas.flat.xyz(here.vertex[static_cast<std::size_t>(i)]));
          expected += exact == max_exact ? 1 : std::max(1.0, std::round(length / size));
        }
      double edges = 0;
      for (const BorderChain& chain : borders->chains) edges += static_cast<double>(chain.vertices.size()) - 1;
      EXPECT_EQ(edges, expected);
      for (const SurfacePlace& p : borders->added) EXPECT_NEAR(norm(p.xyz), 1, 2e-3);
    }
}

// Each place is found in its own triangle of the plane. Over the plane z = z(x, y) the metric has the
// determinant 1 + z_x^2 + z_y^2 = 1 / n_z^2, and n is the place itself on a unit sphere.
TEST(ChartPlanes, GiveTriangleAndMetricOfEachPlace) {
  Atlas atlas(sphere(24));
  const ProjectedCharts found = find_charts(atlas.flat, atlas.silent);
  for (std::size_t c = 0; c < found.axis.size(); ++c) {
    std::vector<std::int32_t> own;
    for (std::int32_t t = 0; t < atlas.flat.triangles(); ++t)
      if (found.chart[static_cast<std::size_t>(t)] == static_cast<std::int32_t>(c)) own.push_back(t);
    const ChartPlane plane(atlas.flat, found.axis[c], own, 0.05, false);
    for (const std::int32_t t : own) {
      const Vec3& middle = atlas.flat.centre[static_cast<std::size_t>(t)];
      const auto foot = plane.find(plane.project(middle));
      ASSERT_TRUE(foot);
      EXPECT_EQ(foot->triangle, t);
      EXPECT_LT(norm(atlas.flat.flat(*foot) - middle), 1e-12);
      const double up = dot(middle, found.axis[c]) / norm(middle);
      EXPECT_NEAR(determinant(plane.metric(*foot)) * up * up, 1, 0.02);
    }
  }
}

}  // namespace
}  // namespace carreau::discrete
