// Adjacent edges whose lengths differ too much, and the parts of a mesh that change for their sake.
#include "surface/improve/adjacent_lengths.h"

#include <gtest/gtest.h>

#include "geometric_run.h"
#include "surface/improve/local_mesh.h"

namespace carreau {
namespace {

using namespace testing;

/// The unit square as n x n cells of two triangles each; its border is one closed curve.
SurfaceMesh square_mesh(int n) {
  SurfaceMesh mesh;
  FaceMesh face;
  face.ref = 1, face.status = FaceStatus::meshed;
  const auto at = [n](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      face.uv.push_back({x, y});
      face.vertex.push_back(at(i, j));
      mesh.vertices.push_back({x, y, 0});
    }
  mesh.vertex_ref.assign(mesh.vertices.size(), 0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      face.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      face.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  CurveMesh border{.ref = 1, .vertices = {}, .uses = {{0, false}}};
  for (int k = 0; k < n; ++k) border.vertices.push_back(at(k, 0));
  for (int k = 0; k < n; ++k) border.vertices.push_back(at(n, k));
  for (int k = n; k > 0; --k) border.vertices.push_back(at(k, n));
  for (int k = n; k >= 0; --k) border.vertices.push_back(at(0, k));
  mesh.curves.push_back(border);
  mesh.faces.push_back(face);
  return mesh;
}

TEST(LocalMesh, KnowsWhatIsAroundCentresAndWhatMayMove) {
  SurfaceMesh mesh = square_mesh(4);
  const std::vector<std::int32_t> centre{12};
  const LocalMesh local(mesh, centre, 1);
  EXPECT_EQ(local.ring(12), (std::vector<std::int32_t>{6, 7, 11, 13, 17, 18}));
  EXPECT_EQ(local.fan(12).size(), 6U);
  EXPECT_FALSE(local.is_known(0));
  ASSERT_TRUE(local.inside(12));
  EXPECT_FALSE(local.inside(6)) << "its own neighbours are not known";
  const LocalMesh all(mesh, centre, 4);
  EXPECT_TRUE(all.inside(6));
  EXPECT_FALSE(all.inside(1)) << "it is on the border";
}

TEST(LocalMesh, SwapsAndDivisionsKeepTheMeshSoundAndCanBeTakenBack) {
  SurfaceMesh mesh = square_mesh(4);
  const std::vector<std::int32_t> centre{12};
  LocalMesh local(mesh, centre, 4);
  int swaps = 0, divisions = 0, imposed = 0;
  const std::vector<LocalMesh::Place> places = local.fan(6);
  for (const LocalMesh::Place p : places)
    for (int side = 0; side < 3; ++side) {
      const SurfaceMesh before = mesh;
      const auto quad = local.quad(p, side);
      if (!quad) {
        ++imposed;
        continue;
      }
      if (local.swap(*quad)) {
        ++swaps;
        EXPECT_EQ(find_defects(mesh), std::vector<std::string>{});
        local.restore(*quad);
      }
      EXPECT_EQ(mesh.faces[0].triangles, before.faces[0].triangles);
      const auto middle = local.divide(*quad);
      ASSERT_TRUE(middle);
      ++divisions;
      const auto [a, b, c, d] = local.corners(*quad);
      mesh.vertices.back() = 0.5 * (mesh.vertices[a] + mesh.vertices[b]);
      EXPECT_EQ(find_defects(mesh), std::vector<std::string>{});
      std::vector<std::int32_t> corners{a, b, c, d};
      std::sort(corners.begin(), corners.end());
      EXPECT_EQ(local.ring(local.global(*middle)), corners);
      local.unite(*quad);
      EXPECT_EQ(mesh.faces[0].triangles, before.faces[0].triangles);
      EXPECT_EQ(mesh.vertices, before.vertices);
      EXPECT_EQ(mesh.faces[0].vertex, before.faces[0].vertex);
    }
  // Diagonals of squares have another one; other edges are diagonals of parallelograms without: their triangles would
  // have no area.
  EXPECT_GT(swaps, 0);
  EXPECT_EQ(divisions + imposed, 18);
  EXPECT_EQ(imposed, 2) << "the sides on the border";
}

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
  even_out_lengths(limit, rules_, cad_, result_, monitor_);
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
  even_out_lengths(1.01 * worst_ratio(before), rules_, cad_, result_, monitor_);
  EXPECT_EQ(result_.mesh.vertices, before.vertices);
  EXPECT_EQ(result_.mesh.faces[0].triangles, before.faces[0].triangles);
  EXPECT_EQ(cad_.counts(), calls);
}

}  // namespace
}  // namespace carreau
