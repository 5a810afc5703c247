// SPDX-License-Identifier: BSD-3-Clause
// A face with an unchanged request gets its patch of the previous round; a face with a different request does not.
#include "pipeline/base/known_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace carreau {
namespace {

/// The requests for two faces: a triangle with one short edge to grow from.
struct Asked {
  Asked() {
    domain.plane.vertices = {{0, 0}, {1, 0}, {0, 1}};
    for (int i = 0; i < 3; ++i) {
      PlaneEdge edge;
      edge.a = i, edge.b = (i + 1) % 3, edge.curve = i;
      domain.plane.edges.push_back(edge);
      domain.origin.push_back({.corner = i});
    }
    domain.size = {0.5, 0.5, 0.5};
    domain.physical = domain.size;
    input.domain = &domain;
    input.curve_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    grow_from = {{{0, 0, 0}, {1, 0, 0}, 0.1}};
  }
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;

  FaceDomain domain;
  PatchInput input;
  std::vector<EdgeSizes::Source> grow_from;
};

FaceOutcome outcome_of(std::size_t triangles) {
  FaceOutcome outcome;
  outcome.patch.emplace();
  outcome.patch->plane.vertices = {{0, 0}, {1, 0}, {0, 1}, {.25, .25}};
  outcome.patch->xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {.25, .25, 1}};
  outcome.patch->size = {0.5, 0.4, 0.3, 0.2};
  outcome.patch->plane.triangles.assign(triangles, {0, 1, 3});
  outcome.remark = "made in another way";
  return outcome;
}

const std::vector<std::optional<ControlSpace>> spaces{ControlSpace::constant({4, 0, 4}), ControlSpace::constant({4, 0, 4})};

/// The assembled mesh of face 0. Vertices of space have other numbers than in the patch. The triangles that `flattened` numbers are apart.
CompositeResult assembled(const PatchMesh& patch, const std::vector<std::int32_t>& flattened = {}) {
  CompositeResult result;
  result.mesh.faces.resize(2);
  FaceMesh& face = result.mesh.faces[0];
  face.uv = patch.plane.vertices;
  const auto n = static_cast<std::int32_t>(face.uv.size());
  result.mesh.vertices.resize(face.uv.size()), result.vertex_size.resize(face.uv.size());
  for (std::int32_t v = 0; v < n; ++v) {
    face.vertex.push_back(n - 1 - v);
    result.mesh.vertices[n - 1 - v] = patch.xyz[v], result.vertex_size[n - 1 - v] = patch.size[v];
  }
  for (std::size_t t = 0; t < patch.plane.triangles.size(); ++t) {
    const bool flat = std::find(flattened.begin(), flattened.end(), static_cast<std::int32_t>(t)) != flattened.end();
    (flat ? face.flattened : face.triangles).push_back(patch.plane.triangles[t]);
  }
  return result;
}

KnownPatches knowing(const Asked& asked, const FaceOutcome& outcome) {
  KnownPatches known;
  known.begin(2);
  known.keep(0, asked.input, asked.grow_from);
  known.keep(0, outcome);
  known.complete(assembled(*outcome.patch));
  known.rely_on(&spaces);
  known.begin(2);  // the next round
  return known;
}

TEST(KnownPatches, AreUsedForEqualRequests) {
  const Asked asked;
  const KnownPatches known = knowing(asked, outcome_of(1));
  EXPECT_FALSE(known.find(1, asked.input, asked.grow_from));
  EXPECT_FALSE(known.find(2, asked.input, asked.grow_from));
  EXPECT_FALSE(known.find(0, asked.input, {}));
  const auto same = known.find(0, asked.input, asked.grow_from);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->patch->plane.triangles.size(), 1U);
  EXPECT_EQ(same->remark, "made in another way");
  EXPECT_TRUE(same->space);
}

TEST(KnownPatches, AreNotUsedForOtherRequests) {
  const Asked before;
  const KnownPatches known = knowing(before, outcome_of(1));
  const std::vector<std::function<void(Asked&)>> changes{
      [](Asked& a) { a.domain.plane.vertices[1].x() = 2; },   [](Asked& a) { a.domain.plane.vertices.push_back({1, 1}); },
      [](Asked& a) { a.domain.plane.edges[0].b = 2; },        [](Asked& a) { a.domain.plane.edges.pop_back(); },
      [](Asked& a) { a.domain.origin[2].corner = 7; },        [](Asked& a) { a.domain.size[0] = 0.4; },
      [](Asked& a) { a.domain.physical[0] = 0.4; },           [](Asked& a) { a.input.curve_xyz[2].z() = 1e-9; },
      [](Asked& a) { a.grow_from[0].h = 0.05; },              [](Asked& a) { a.grow_from[0].b.z() = 1; },
      [](Asked& a) { a.grow_from.push_back(a.grow_from[0]); }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    SCOPED_TRACE(i);
    Asked asked;
    EXPECT_TRUE(known.find(0, asked.input, asked.grow_from));
    changes[i](asked);
    EXPECT_FALSE(known.find(0, asked.input, asked.grow_from));
  }
}

TEST(KnownPatches, AreThePatchesBeforeTheAssembly) {
  const Asked asked;
  FaceOutcome outcome = outcome_of(0);
  outcome.patch->plane.triangles = {{0, 1, 3}, {1, 0, 2}, {1, 2, 3}, {2, 0, 3}, {2, 1, 0}};
  KnownPatches known;
  known.begin(2);
  known.keep(0, asked.input, asked.grow_from);
  known.keep(0, outcome);
  known.rely_on(&spaces);
  EXPECT_FALSE(known.find(0, asked.input, asked.grow_from));  // not assembled
  known.keep_flattened({{1, 4}, {}});
  known.complete(assembled(*outcome.patch, {1, 4}));
  const auto same = known.find(0, asked.input, asked.grow_from);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->patch->plane.vertices, outcome.patch->plane.vertices);
  EXPECT_EQ(same->patch->plane.triangles, outcome.patch->plane.triangles);
  EXPECT_EQ(same->patch->xyz, outcome.patch->xyz);
  EXPECT_EQ(same->patch->size, outcome.patch->size);
}

TEST(KnownPatches, ForgetPatchesThatTheAssemblyChanged) {
  const Asked asked;
  const FaceOutcome outcome = outcome_of(1);
  KnownPatches known;
  known.begin(2);
  known.keep(0, asked.input, asked.grow_from);
  known.keep(0, outcome);
  known.rely_on(&spaces);
  PatchMesh more = *outcome.patch;
  more.plane.vertices.push_back({.5, 0}), more.xyz.push_back({.5, 0, 0}), more.size.push_back(.5);
  known.complete(assembled(more));
  EXPECT_FALSE(known.find(0, asked.input, asked.grow_from));
}

TEST(KnownPatches, LargeModelsAreNotKept) {
  const Asked asked;
  EXPECT_TRUE(knowing(asked, outcome_of(thresholds::crossings::max_known)).find(0, asked.input, asked.grow_from));
  EXPECT_FALSE(knowing(asked, outcome_of(thresholds::crossings::max_known + 1)).find(0, asked.input, asked.grow_from));
  // A patch that replaces another patch needs no more than its own room.
  KnownPatches known = knowing(asked, outcome_of(thresholds::crossings::max_known));
  known.keep(0, asked.input, asked.grow_from);
  known.keep(0, outcome_of(thresholds::crossings::max_known));
  known.complete(assembled(*outcome_of(thresholds::crossings::max_known).patch));
  EXPECT_TRUE(known.find(0, asked.input, asked.grow_from));
  known.keep(1, asked.input, asked.grow_from);
  known.keep(1, outcome_of(1));
  known.complete(assembled(*outcome_of(1).patch));
  EXPECT_FALSE(known.find(1, asked.input, asked.grow_from));
  known.end();
  known.begin(2);
  EXPECT_FALSE(known.find(0, asked.input, asked.grow_from));
}

}  // namespace
}  // namespace carreau
