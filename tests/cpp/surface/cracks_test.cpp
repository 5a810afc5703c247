// SPDX-License-Identifier: BSD-3-Clause
// Internal curves as cracks: both sides are free, tips hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "session_of_size.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
using testing::arc;
using testing::rectangle;
using testing::segment;

SurfaceJet saddle_jet(Vec2 p) {
  return {{p.x(), p.y(), p.x() * p.y() / 4}, {1, 0, p.y() / 4}, {0, 1, p.x() / 4}, {0, 0, 0}, {0, 0, 0.25}, {0, 0, 0}};
}

/// [0, 4]^2 with internal curves behind its four sides.
struct Cracked {
  AnalyticCad cad;
  Monitor monitor;
  std::unique_ptr<Session> session;

  Cracked(const std::vector<testing::AnalyticCurve>& inside, int cracks, const std::string& element = "p1", bool uncut_side = true) {
    std::vector<testing::AnalyticCurve> curves = rectangle({0, 0}, {4, 4});
    if (!uncut_side)  // the lower side has a vertex in its middle
      curves = {segment({0, 0}, {2, 0}), segment({2, 0}, {4, 0}), segment({4, 0}, {4, 4}), segment({4, 4}, {0, 4}), segment({0, 4}, {0, 0})};
    const std::size_t sides = curves.size();
    curves.insert(curves.end(), inside.begin(), inside.end());
    cad.faces[1] = {saddle_jet, curves};
    session = testing::session_of_size(cad, 0.4, monitor);
    Model model = testing::unglued(cad);
    for (std::size_t c = sides; c < curves.size(); ++c) model.faces[0].curves[c].type = CurveType::internal;
    session->set_model(model);
    session->parameters().set("cracks", cracks);
    session->parameters().set("element", element);
    session->make_mesh();
  }
  [[nodiscard]] const SurfaceMesh& mesh() const { return session->mesh(); }
  /// Vertices - edges + triangles, and edges with one triangle.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> euler_and_open() const {
    std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
    std::set<std::int32_t> used;
    for (const FaceMesh& face : mesh().faces)
      for (const auto& t : face.triangles)
        for (int i = 0; i < 3; ++i) {
          used.insert(face.vertex[t[i]]);
          ++uses[std::minmax(face.vertex[t[i]], face.vertex[t[(i + 1) % 3]])];
        }
    const auto open = std::count_if(uses.begin(), uses.end(), [](const auto& each) { return each.second == 1; });
    return {static_cast<std::int64_t>(used.size() - uses.size() + mesh().triangle_count()), open};
  }
};

const std::vector<testing::AnalyticCurve> buried{segment({1, 2}, {3, 2.5})};

TEST(Cracks, AreWeldedUnlessRequested) {
  const Cracked welded(buried, 0), open(buried, 1);
  EXPECT_EQ(welded.euler_and_open().first, 1);
  EXPECT_EQ(welded.mesh().triangle_count(), open.mesh().triangle_count());
}

TEST(Cracks, InsideAFaceHaveTwoSidesAndTwoTips) {
  const Cracked welded(buried, 0), open(buried, 1);
  const auto edges = static_cast<std::int64_t>(welded.mesh().curves[4].vertices.size()) - 1;
  ASSERT_GT(edges, 3);
  EXPECT_EQ(find_defects(open.mesh()), std::vector<std::string>{});
  EXPECT_EQ(open.mesh().vertices.size(), welded.mesh().vertices.size() + static_cast<std::size_t>(edges) - 1);
  EXPECT_EQ(open.euler_and_open(), (std::pair<std::int64_t, std::int64_t>{0, welded.euler_and_open().second + 2 * edges}));  // a ring
  ASSERT_EQ(open.mesh().curves.size(), 6U);
  const CurveMesh &left = open.mesh().curves[4], &right = open.mesh().curves[5];
  EXPECT_EQ(left.ref, right.ref);
  ASSERT_EQ(left.vertices.size(), right.vertices.size());
  for (std::size_t k = 0; k < left.vertices.size(); ++k) {
    EXPECT_EQ(open.mesh().vertices[left.vertices[k]], open.mesh().vertices[right.vertices[k]]);
    EXPECT_EQ(left.vertices[k] == right.vertices[k], k == 0 || k + 1 == left.vertices.size()) << k;
  }
  // Triangles of the left side lie on the left.
  const FaceMesh& face = open.mesh().faces[0];
  for (const auto& t : face.triangles)
    for (int i = 0; i < 3; ++i) {
      const auto at = std::ranges::find(left.vertices, face.vertex[t[i]]);
      if (at == left.vertices.begin() || at >= left.vertices.end() - 1) continue;
      const Vec2 middle = (face.uv[t[0]] + face.uv[t[1]] + face.uv[t[2]]) / 3;
      EXPECT_GT(cross(Vec2{2, 0.5}, middle - Vec2{1, 2}), 0);
    }
}

TEST(Cracks, OpenWhereTheyReachABorder) {
  const Cracked open({segment({2, 0}, {2, 3})}, 1, "p1", false);
  EXPECT_EQ(find_defects(open.mesh()), std::vector<std::string>{});
  EXPECT_EQ(open.euler_and_open().first, 1);  // a disc with a slit is a disc
  std::size_t mouths = 0;
  for (const Vec3& p : open.mesh().vertices) mouths += p == Vec3(2, 0, 0) ? 1 : 0;
  EXPECT_EQ(mouths, 2U);
}

TEST(Cracks, ThatMeetPartAsManyAsTheyAre) {
  // A cross, whose middle belongs to four parts; and a closed loop, which cuts out a disc.
  const Cracked cross_of_four({segment({2, 2}, {3, 2}), segment({2, 2}, {2, 3}), segment({2, 2}, {1, 2}), segment({2, 2}, {2, 1})}, 1);
  EXPECT_EQ(find_defects(cross_of_four.mesh()), std::vector<std::string>{});
  std::size_t middles = 0;
  for (const Vec3& p : cross_of_four.mesh().vertices) middles += norm(p - Vec3(2, 2, 1)) < 1e-12 ? 1 : 0;
  EXPECT_EQ(middles, 4U);
  EXPECT_EQ(cross_of_four.euler_and_open().first, 0);
  const Cracked loop({arc({2, 2}, 1, 0, std::numbers::pi), arc({2, 2}, 1, std::numbers::pi, 2 * std::numbers::pi)}, 1);
  EXPECT_EQ(find_defects(loop.mesh()), std::vector<std::string>{});
  EXPECT_EQ(loop.euler_and_open().first, 1);  // a ring and a disc
}

TEST(Cracks, OpenInAllElements) {
  for (const char* element : {"p2", "q1.0", "q1.1", "q2.0"}) {
    const Cracked welded(buried, 0, element), open(buried, 1, element);
    EXPECT_EQ(find_defects(open.mesh()), std::vector<std::string>{}) << element;
    const auto edges = welded.mesh().curves[4].vertices.size() - 1;
    EXPECT_EQ(open.mesh().vertices.size(), welded.mesh().vertices.size() + edges - 1) << element;
    if (!welded.mesh().mid_vertices.empty()) {
      EXPECT_EQ(open.mesh().mid_vertices.size(), welded.mesh().mid_vertices.size() + edges) << element;
    }
    EXPECT_EQ(open.mesh().cell_count(), welded.mesh().cell_count()) << element;
  }
}

TEST(Cracks, AreMeasuredLikeOtherCurves) {
  const Cracked open({arc({2, 2}, 1, 0, std::numbers::pi)}, 1);
  const MeshEvaluation& d = open.session->delivered();
  std::int64_t on_crack = 0;
  for (const std::size_t c : {std::size_t{4}, std::size_t{5}}) on_crack += static_cast<std::int64_t>(open.mesh().curves[c].vertices.size()) - 1;
  std::int64_t known = 0;
  for (const double x : d[EvaluationKind::curve_deviation].values) known += x > 1e-3 ? 1 : 0;
  EXPECT_EQ(known, on_crack);  // sides of the square are straight in space
}

}  // namespace
}  // namespace carreau
