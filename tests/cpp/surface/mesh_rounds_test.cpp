// SPDX-License-Identifier: BSD-3-Clause
// The loop over whole meshes: requests of inspectors are meshed, and the best mesh stays.
#include "pipeline/mesh_rounds.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>

#include "common/analytic_cad.h"
#include "mesh/surface_mesh.h"
#include "model/topology.h"

namespace carreau {
namespace {

using testing::AnalyticCad;

/// A unit square in space, with edges of a half.
struct Square {
  Square() {
    cad.faces[1] = {[this](Vec2 p) {
                      ++evaluations;
                      return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
                    },
                    testing::rectangle({0, 0}, {1, 1})};
    supports = build_supports(testing::unglued(cad), cad, 0.5, 1, monitor);
    model = glue(testing::unglued(cad), traces_of(supports), 1e-9);
    topology = build_topology(model, traces_of(supports), 1e-9);
    options.size = {.physical = PhysicalSizes::uniform, .hphydef = 0.5, .hphymin = 1e-3, .hphymax = 10};
    options.crossing_rounds = 1;
    run.emplace(model, topology, supports, cad, options, PeriodicModel{}, monitor);
    discretise_curves(*run);
    find_narrow(*run);
    rounds.emplace(*run);
    rounds->mesh_first();
  }
  Square(const Square&) = delete;
  Square& operator=(const Square&) = delete;

  [[nodiscard]] std::size_t boundary_edges() const {
    std::size_t edges = 0;
    for (const CurveMesh& curve : run->result.mesh.curves) edges += curve.vertices.size() - 1;
    return edges;
  }

  std::atomic<std::int64_t> evaluations{0};
  AnalyticCad cad;
  Monitor monitor;
  Model model;
  ModelSupports supports;
  Topology topology;
  CompositeOptions options;
  std::optional<CompositeRun> run;
  std::optional<MeshRounds> rounds;
};

/// Requests the same thing a number of times, and judges by a script.
class Scripted final : public Inspector {
 public:
  int rounds = 0;
  bool better = true, survives = false, keeps = false;
  std::function<RefinementRequests(const CompositeRun&)> request;
  int inspected = 0, kept = 0, reported = 0;

  void inspect(CompositeRun& /*run*/) override { ++inspected; }
  [[nodiscard]] bool is_better(const CompositeRun& /*run*/) const override { return better; }
  void keep() override { ++kept; }
  [[nodiscard]] std::optional<RefinementRequests> requests(const CompositeRun& run) override {
    if (rounds-- == 0) return {};
    return request(run);
  }
  [[nodiscard]] bool continues_after_failure() override { return survives; }
  [[nodiscard]] bool keeps_patches() const override { return keeps; }
  void report(CompositeRun& /*run*/) override { ++reported; }
};

/// Halves of all edges of all curves.
RefinementRequests halve_all(const CompositeRun& run) {
  RefinementRequests requests;
  for (std::size_t c = 0; c < run.cut_curves.size(); ++c)
    for (int k = 0; k < run.cut_curves[c].segments(); ++k) requests.segments.emplace_back(static_cast<std::int32_t>(c), k);
  return requests;
}

TEST(MeshRounds, HalveTheEdgesThatAreRequested) {
  Square square;
  ASSERT_EQ(square.boundary_edges(), 8U);
  Scripted inspector;
  inspector.rounds = 3;
  inspector.request = halve_all;
  square.rounds->refine(inspector);
  EXPECT_EQ(square.boundary_edges(), 64U);
  EXPECT_EQ(inspector.inspected, 4);
  EXPECT_EQ(inspector.kept, 4);
  EXPECT_EQ(inspector.reported, 1);
  EXPECT_EQ(find_defects(square.run->result.mesh, {.closed = false, .limit = 1}), std::vector<std::string>{});
}

TEST(MeshRounds, GiveTheFirstMeshBackWhenNoneIsBetter) {
  Square square;
  const std::vector<Vec3> before = square.run->result.mesh.vertices;
  Scripted inspector;
  inspector.rounds = 2;
  inspector.better = false;
  inspector.request = halve_all;
  square.rounds->refine(inspector);
  EXPECT_EQ(inspector.inspected, 3);
  EXPECT_EQ(inspector.kept, 1);
  EXPECT_EQ(square.run->result.mesh.vertices, before);
  EXPECT_EQ(square.run->curves.front().segments(), 2);  // the input of that mesh, too
}

TEST(MeshRounds, EndWithARoundThatCannotBeMeshed) {
  Square square;
  const std::vector<Vec3> before = square.run->result.mesh.vertices;
  Scripted inspector;
  inspector.rounds = 5;
  inspector.request = [](const CompositeRun& run) {
    RefinementRequests requests = halve_all(run);
    requests.max_triangles = 1;
    return requests;
  };
  square.rounds->refine(inspector);
  EXPECT_EQ(inspector.inspected, 1);
  EXPECT_EQ(inspector.rounds, 4);
  EXPECT_EQ(square.run->result.mesh.vertices, before);
  EXPECT_GT(square.run->options.max_triangles, 1);

  inspector.rounds = 5, inspector.survives = true;
  square.rounds->refine(inspector);
  EXPECT_EQ(inspector.rounds, -1);
  EXPECT_EQ(square.run->result.mesh.vertices, before);
}

TEST(MeshRounds, BeginAgainWithTheFirstCurves) {
  Square square;
  const std::vector<Vec3> before = square.run->result.mesh.vertices;
  Scripted inspector;
  inspector.rounds = 3;
  inspector.request = [&](const CompositeRun& run) {
    if (inspector.rounds > 0) return halve_all(run);
    return RefinementRequests{.first_curves = true};
  };
  square.rounds->refine(inspector);
  EXPECT_EQ(square.run->result.mesh.vertices, before);
}

// A round that requests nothing meshes no face, unless an inspector before it may have changed patches or spaces.
TEST(MeshRounds, KeepPatchesOfFacesThatDoNotChange) {
  std::int64_t evaluations[2] = {};
  for (const bool keeps : {false, true}) {
    Square square;
    const std::vector<Vec3> before = square.run->result.mesh.vertices;
    Scripted first, second;
    first.keeps = keeps;
    square.rounds->refine(first);
    second.rounds = 1;
    second.request = [](const CompositeRun& /*run*/) { return RefinementRequests{}; };
    const std::int64_t first_mesh = square.evaluations;
    square.rounds->refine(second);
    evaluations[keeps ? 1 : 0] = square.evaluations - first_mesh;
    EXPECT_EQ(square.run->result.mesh.vertices, before);
  }
  EXPECT_GT(evaluations[0], 0);
  EXPECT_EQ(evaluations[1], 0);
}

// After a discarded mesh the patches of the kept mesh are made again: a later round never mixes both.
TEST(MeshRounds, ForgetPatchesOfADiscardedMesh) {
  Square square;
  const std::vector<Vec3> before = square.run->result.mesh.vertices;
  Scripted first, second;
  first.keeps = true, first.better = false, first.rounds = second.rounds = 1;
  first.request = halve_all;
  second.request = [](const CompositeRun& /*run*/) { return RefinementRequests{}; };
  square.rounds->refine(first);
  square.rounds->refine(second);
  EXPECT_EQ(square.run->result.mesh.vertices, before);
}

// Sizes grow from the place: the mesh has more vertices, and the boundary has the same.
TEST(MeshRounds, RefineInsideFaces) {
  Square square;
  const std::size_t before = square.run->result.mesh.vertices.size();
  Scripted inspector;
  inspector.rounds = 1;
  inspector.request = [](const CompositeRun& /*run*/) {
    const Vec3 middle{0.5, 0.5, 0};
    return RefinementRequests{.sizes = {{{middle, middle, 0.05}}}};
  };
  square.rounds->refine(inspector);
  EXPECT_GT(square.run->result.mesh.vertices.size(), 2 * before);
  EXPECT_EQ(square.boundary_edges(), 8U);
}

}  // namespace
}  // namespace carreau
