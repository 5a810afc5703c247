// SPDX-License-Identifier: BSD-3-Clause
// Edits keep the topology, the imposed edges and the adjacency, and can be undone exactly.
#include "mesh/editable_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "mesh/quality.h"

namespace carreau {
namespace {

using Triangle = EditableMesh::Triangle;
using Place = EditableMesh::Place;
using Edge = std::array<std::int32_t, 2>;

/// [0, 2] x [0, 1] as two faces of n x n cells of two triangles each; curves: the border, of two corners, and the side
/// between the faces.
SurfaceMesh two_faces(int n) {
  SurfaceMesh mesh;
  const int columns = 2 * n + 1;
  const auto at = [&](int i, int j) { return j * columns + i; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i < columns; ++i) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      mesh.vertices.push_back({x, y, 0.1 * x * x});
    }
  mesh.vertex_ref.assign(mesh.vertices.size(), 0);
  for (int f = 0; f < 2; ++f) {
    FaceMesh face;
    face.ref = f + 1, face.status = FaceStatus::meshed;
    const auto local = [&](int i, int j) { return j * (n + 1) + i; };
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        face.uv.push_back({static_cast<double>(i) / n, static_cast<double>(j) / n});
        face.vertex.push_back(at(i + f * n, j));
        if (i == n || j == n) continue;
        face.triangles.push_back({local(i, j), local(i + 1, j), local(i + 1, j + 1)});
        face.triangles.push_back({local(i, j), local(i + 1, j + 1), local(i, j + 1)});
      }
    mesh.faces.push_back(face);
  }
  CurveMesh left{.ref = 1, .vertices = {}, .uses = {{0, false}}}, right{.ref = 2, .vertices = {}, .uses = {{1, false}}};
  CurveMesh between{.ref = 3, .vertices = {}, .uses = {{0, false}, {1, false}}};
  for (int k = n; k > 0; --k) left.vertices.push_back(at(k, n));
  for (int k = n; k > 0; --k) left.vertices.push_back(at(0, k));
  for (int k = 0; k <= n; ++k) left.vertices.push_back(at(k, 0));
  for (int k = n; k < 2 * n; ++k) right.vertices.push_back(at(k, 0));
  for (int k = 0; k < n; ++k) right.vertices.push_back(at(2 * n, k));
  for (int k = 2 * n; k >= n; --k) right.vertices.push_back(at(k, n));
  for (int k = 0; k <= n; ++k) between.vertices.push_back(at(n, k));
  mesh.curves = {left, right, between};
  return mesh;
}

std::vector<std::int32_t> all_vertices(const SurfaceMesh& mesh) {
  std::vector<std::int32_t> all(mesh.vertices.size());
  for (std::size_t v = 0; v < all.size(); ++v) all[v] = static_cast<std::int32_t>(v);
  return all;
}

/// Vertices - edges + triangles after collapses.
int euler_number(const SurfaceMesh& mesh) {
  std::set<std::int32_t> vertices;
  std::set<Edge> edges;
  int triangles = 0;
  for (const FaceMesh& face : mesh.faces)
    for (const Triangle& t : face.triangles) {
      if (t[0] < 0) continue;
      ++triangles;
      for (int i = 0; i < 3; ++i) {
        const std::int32_t a = face.vertex[t[i]], b = face.vertex[t[(i + 1) % 3]];
        vertices.insert(a);
        edges.insert({std::min(a, b), std::max(a, b)});
      }
    }
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + triangles;
}

bool has_edge(const SurfaceMesh& mesh, std::int32_t v, std::int32_t w) {
  for (const FaceMesh& face : mesh.faces)
    for (const Triangle& t : face.triangles)
      if (t[0] >= 0) {
        const auto is = [&](std::int32_t k) {
          return std::any_of(t.begin(), t.end(), [&](std::int32_t c) { return face.vertex[c] == k; });
        };
        if (is(v) && is(w)) return true;
      }
  return false;
}

/// The adjacency of vertices agrees with the triangles.
void expect_adjacency(const EditableMesh& editable, const SurfaceMesh& mesh) {
  std::vector<std::vector<std::array<std::int32_t, 2>>> fans(mesh.vertices.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t t = 0; t < mesh.faces[f].triangles.size(); ++t)
      for (const std::int32_t v : mesh.faces[f].triangles[t])
        if (v >= 0)
          fans[mesh.faces[f].vertex[v]].push_back({static_cast<std::int32_t>(f), static_cast<std::int32_t>(t)});
  for (std::size_t v = 0; v < fans.size(); ++v) {
    std::vector<std::array<std::int32_t, 2>> known;
    for (const Place p : editable.fan(static_cast<std::int32_t>(v))) known.push_back({p.face, p.triangle});
    std::sort(known.begin(), known.end());
    EXPECT_EQ(known, fans[v]) << "vertex " << v;
  }
}

void expect_same(const SurfaceMesh& p, const SurfaceMesh& q) {
  EXPECT_EQ(p.vertices, q.vertices);
  EXPECT_EQ(p.vertex_ref, q.vertex_ref);
  for (std::size_t f = 0; f < p.faces.size(); ++f) {
    EXPECT_EQ(p.faces[f].uv, q.faces[f].uv);
    EXPECT_EQ(p.faces[f].vertex, q.faces[f].vertex);
    EXPECT_EQ(p.faces[f].triangles, q.faces[f].triangles);
  }
}

/// Random numbers that are the same everywhere.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::int32_t below(std::size_t n) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::int32_t>((state_ >> 33) % n);
  }
  double share() { return below(1 << 20) / static_cast<double>(1 << 20); }

 private:
  std::uint64_t state_;
};

struct Counts {
  int swaps = 0, splits = 0, moves = 0, collapses = 0;
};

/// Exact signs alone let triangles become as flat as rounding: two halves of an edge and its middle.
bool is_shapely(const SurfaceMesh& mesh) {
  for (const FaceMesh& face : mesh.faces)
    for (const Triangle& t : face.triangles)
      if (t[0] >= 0 && quality_q2(mesh.vertices[face.vertex[t[0]]], mesh.vertices[face.vertex[t[1]]],
                                  mesh.vertices[face.vertex[t[2]]]) < 1e-3)
        return false;
  return true;
}

/// One edit of any kind anywhere, if it can be.
void edit_somewhere(SurfaceMesh& mesh, EditableMesh& editable, Dice& dice, Counts& counts) {
  const std::int32_t f = dice.below(mesh.faces.size());
  FaceMesh& face = mesh.faces[f];
  const Place p{f, dice.below(face.triangles.size())};
  const int side = dice.below(3);
  const Triangle t = editable.at(p);
  if (t[0] < 0) return;
  const std::int32_t a = t[side], b = t[(side + 1) % 3];
  switch (dice.below(4)) {
    case 0:
      if (const auto q = editable.quad(p, side)) counts.swaps += editable.swap(*q) ? 1 : 0;
      break;
    case 1:
      if (const auto q = editable.quad(p, side)) {
        const double s = 0.3 + 0.4 * dice.share();
        const Vec2 uv = lerp(face.uv[a], face.uv[b], s);
        if (!editable.can_split(*q, uv)) break;
        editable.split(*q, uv, lerp(mesh.vertices[face.vertex[a]], mesh.vertices[face.vertex[b]], s));
        ++counts.splits;
      }
      break;
    case 2:
      if (const auto v = editable.inside(face.vertex[a])) {
        const double s = 0.4 * dice.share();
        const Vec2 uv = lerp(face.uv[a], face.uv[b], s);
        if (!editable.can_move(*v, uv)) break;
        editable.move(*v, uv, lerp(mesh.vertices[face.vertex[a]], mesh.vertices[face.vertex[b]], s));
        ++counts.moves;
      }
      break;
    default:
      counts.collapses += editable.collapse(face.vertex[a], face.vertex[b]) ? 1 : 0;
  }
}

TEST(EditableMesh, KnowsStarsOfCentresAndMovableVertices) {
  SurfaceMesh mesh = two_faces(4);
  const std::vector<std::int32_t> centre{20};  // in the middle of the first face, whose vertices are nine a row
  const EditableMesh local(mesh, centre, 1);
  EXPECT_EQ(local.ring(20), (std::vector<std::int32_t>{10, 11, 19, 21, 29, 30}));
  EXPECT_EQ(local.fan(20).size(), 6U);
  EXPECT_FALSE(local.is_known(0));
  ASSERT_TRUE(local.inside(20));
  EXPECT_FALSE(local.inside(10)) << "its own neighbours are not known";
  const EditableMesh all(mesh, centre, 8);
  EXPECT_TRUE(all.inside(10));
  EXPECT_FALSE(all.inside(1)) << "it is on the border";
  EXPECT_FALSE(all.inside(13)) << "it is between the faces";
}

TEST(EditableMesh, RandomEditsKeepTopologyImposedEdgesAndAdjacency) {
  Counts counts;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SurfaceMesh mesh = two_faces(4);
    EditableMesh editable(mesh, all_vertices(mesh), 0);
    Dice dice(seed);
    for (int k = 0; k < 300; ++k) {
      const std::size_t edits = editable.edits();
      edit_somewhere(mesh, editable, dice, counts);
      if (!is_shapely(mesh)) editable.undo(edits);
    }
    EXPECT_EQ(euler_number(mesh), 1);
    expect_adjacency(editable, mesh);
    editable.compact();
    EXPECT_EQ(find_defects(mesh), std::vector<std::string>{}) << "seed " << seed;
    // Curves may have lost vertices to collapses along them, but go where they went.
    for (const CurveMesh& curve : mesh.curves) {
      EXPECT_GE(curve.vertices.size(), 2U);
      for (std::size_t k = 1; k < curve.vertices.size(); ++k)
        EXPECT_TRUE(has_edge(mesh, curve.vertices[k - 1], curve.vertices[k]));
    }
    EXPECT_EQ(mesh.vertices[mesh.curves[2].vertices.front()], (Vec3{1, 0, 0.1}));
    EXPECT_EQ(mesh.vertices[mesh.curves[2].vertices.back()], (Vec3{1, 1, 0.1}));
    EXPECT_EQ(euler_number(mesh), 1);
  }
  for (const int n : {counts.swaps, counts.splits, counts.moves, counts.collapses}) EXPECT_GT(n, 400);
}

TEST(EditableMesh, UndoRestoresTheMeshBitForBitAfterAnyEdits) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SurfaceMesh mesh = two_faces(4);
    EditableMesh editable(mesh, all_vertices(mesh), 0);
    Dice dice(seed);
    Counts counts;
    const SurfaceMesh first = mesh;
    for (int k = 0; k < 50; ++k) edit_somewhere(mesh, editable, dice, counts);
    const SurfaceMesh second = mesh;
    const std::size_t edits = editable.edits();
    for (int k = 0; k < 100; ++k) edit_somewhere(mesh, editable, dice, counts);
    EXPECT_GT(editable.edits(), edits);
    editable.undo(edits);
    expect_same(mesh, second);
    expect_adjacency(editable, mesh);
    editable.undo(0);
    expect_same(mesh, first);
    expect_adjacency(editable, mesh);
    for (const CurveMesh& curve : mesh.curves)
      for (std::size_t k = 1; k < curve.vertices.size(); ++k)
        EXPECT_TRUE(editable.is_imposed(curve.vertices[k - 1], curve.vertices[k]));
  }
}

std::set<std::set<std::int32_t>> as_sets(const std::vector<Triangle>& triangles) {
  std::set<std::set<std::int32_t>> all;
  for (const Triangle& t : triangles) all.insert({t.begin(), t.end()});
  return all;
}

TEST(EditableMesh, TwoSwapsOfAnEdgeGiveTheSameTriangles) {
  SurfaceMesh mesh = two_faces(3);
  EditableMesh editable(mesh, all_vertices(mesh), 0);
  const auto before = as_sets(mesh.faces[0].triangles);
  const std::vector<Triangle> numbered = mesh.faces[0].triangles;
  int swapped = 0;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.faces[0].triangles.size()); ++t)
    for (int side = 0; side < 3; ++side) {
      const auto q = editable.quad({0, t}, side);
      if (!q || !editable.swap(*q)) continue;
      ++swapped;
      EXPECT_NE(as_sets(mesh.faces[0].triangles), before);
      // The new diagonal runs from d to c in the first triangle.
      const auto back = editable.quad({0, q->t}, 1);
      ASSERT_TRUE(back && editable.swap(*back));
      EXPECT_EQ(as_sets(mesh.faces[0].triangles), before);
      editable.undo(0);
      EXPECT_EQ(mesh.faces[0].triangles, numbered);
    }
  EXPECT_EQ(swapped, 42) << "21 edges inside, all diagonals of parallelograms, from both sides";
}

TEST(EditableMesh, EdgesOfCurvesAreNoQuadsAndEndsOfCurvesStay) {
  SurfaceMesh mesh = two_faces(3);
  EditableMesh editable(mesh, all_vertices(mesh), 0);
  for (const CurveMesh& curve : mesh.curves)
    for (std::size_t k = 1; k < curve.vertices.size(); ++k) {
      const std::int32_t v = curve.vertices[k - 1], w = curve.vertices[k];
      EXPECT_TRUE(editable.is_imposed(v, w));
      for (const Place p : editable.fan(v)) {
        const int i = editable.rank_in(p, v);
        for (const int side : {i, (i + 2) % 3})
          if (const auto q = editable.quad(p, side)) {
            const auto c = editable.corners(*q);
            EXPECT_FALSE((c[0] == v && c[1] == w) || (c[0] == w && c[1] == v));
          }
      }
    }
  for (const CurveMesh& curve : mesh.curves)
    for (const std::int32_t end : {curve.vertices.front(), curve.vertices.back()})
      for (const std::int32_t w : editable.ring(end)) EXPECT_FALSE(editable.can_collapse(end, w));
}

TEST(EditableMesh, ACurveBetweenTwoFacesIsShortenedInBoth) {
  SurfaceMesh mesh = two_faces(4);
  EditableMesh editable(mesh, all_vertices(mesh), 0);
  const std::vector<std::int32_t> chain = mesh.curves[2].vertices;
  ASSERT_EQ(chain.size(), 5U);
  ASSERT_TRUE(editable.collapse(chain[2], chain[1]));
  EXPECT_TRUE(editable.is_imposed(chain[1], chain[3]));
  editable.compact();
  EXPECT_EQ(find_defects(mesh), std::vector<std::string>{});
  EXPECT_EQ(mesh.curves[2].vertices.size(), 4U);
  for (const FaceMesh& face : mesh.faces) EXPECT_EQ(face.triangles.size(), 31U) << "one triangle less on each side";
}

TEST(EditableMesh, AVertexOfACurveDoesNotLeaveIt) {
  SurfaceMesh mesh = two_faces(4);
  EditableMesh editable(mesh, all_vertices(mesh), 0);
  const std::int32_t v = mesh.curves[2].vertices[2];
  for (const std::int32_t w : editable.ring(v))
    EXPECT_EQ(editable.can_collapse(v, w), w == mesh.curves[2].vertices[1] || w == mesh.curves[2].vertices[3]);
}

/// Triangles of space whose corners have no (u, v): all are judged in space.
struct Solid {
  std::vector<Vec3> xyz;
  std::vector<Triangle> triangles;
  std::vector<Vec2> uv;
  std::vector<char> mixed;

  Solid(std::vector<Vec3> positions, std::vector<Triangle> of)
      : xyz(std::move(positions)), triangles(std::move(of)), uv(xyz.size(), Vec2{0, 0}), mixed(triangles.size(), 1) {}
  EditableMesh editable() { return {{{&uv, &triangles, nullptr, &mixed}}, xyz, {}, {}}; }
};

TEST(LinkCondition, RejectsEveryEdgeOfATetrahedron) {
  Solid solid({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
  const EditableMesh editable = solid.editable();
  for (std::int32_t v = 0; v < 4; ++v)
    for (std::int32_t w = 0; w < 4; ++w) EXPECT_FALSE(editable.can_collapse(v, w));
}

TEST(LinkCondition, LetsAnOctahedronBecomeATetrahedronAndNoLess) {
  Solid solid({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
              {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}});
  EditableMesh editable = solid.editable();
  int collapses = 0;
  for (bool again = true; again;) {
    again = false;
    for (std::int32_t v = 0; v < 6 && !again; ++v)
      for (std::int32_t w = 0; w < 6 && !again; ++w)
        if (again = editable.collapse(v, w); again) ++collapses;
  }
  EXPECT_EQ(collapses, 2);
  const std::vector<std::int32_t> number = editable.compact();
  EXPECT_EQ(solid.xyz.size(), 4U);
  EXPECT_EQ(solid.triangles.size(), 4U);
  EXPECT_EQ(std::count(number.begin(), number.end(), -1), 2);
}

/// `layers` rings of triangles between circles of n vertices; its borders are not imposed.
struct Annulus {
  std::vector<Vec2> uv;
  std::vector<Vec3> xyz;
  std::vector<Triangle> triangles;
  int n;

  Annulus(int count, int layers) : n(count) {
    for (int k = 0; k <= layers; ++k)
      for (int i = 0; i < n; ++i) {
        const double a = 2 * std::numbers::pi * i / n, r = 1 + 0.3 * k;
        uv.push_back({r * std::cos(a), r * std::sin(a)});
        xyz.push_back({r * std::cos(a), r * std::sin(a), 0});
      }
    for (int k = 0; k < layers; ++k)
      for (int i = 0; i < n; ++i) {
        const int p = k * n + i, q = k * n + (i + 1) % n;
        triangles.push_back({p, p + n, q});
        triangles.push_back({q, p + n, q + n});
      }
  }
  EditableMesh editable() { return {{{&uv, &triangles}}, xyz, {}, {}}; }
};

TEST(LinkCondition, RejectsEdgesThatPinchAnAnnulusOrShutItsHole) {
  Annulus one(8, 1);
  const EditableMesh thin = one.editable();
  for (std::int32_t i = 0; i < one.n; ++i)
    for (const std::int32_t w : thin.ring(i))
      if (w >= one.n) {
        EXPECT_FALSE(thin.can_collapse(i, w)) << "both borders would meet in a vertex";
        EXPECT_FALSE(thin.can_collapse(w, i));
      }
  Annulus hole(3, 3);
  const EditableMesh thick = hole.editable();
  for (std::int32_t i = 0; i < 3; ++i) EXPECT_FALSE(thick.can_collapse(i, (i + 1) % 3)) << "the hole has three sides";
  Annulus two(8, 2);
  EditableMesh wide = two.editable();
  int inwards = 0;
  for (std::int32_t i = two.n; i < 2 * two.n; ++i)
    for (const std::int32_t w : std::vector(wide.ring(i))) inwards += wide.can_collapse(i, w) ? 1 : 0;
  EXPECT_GT(inwards, 0) << "a vertex inside can go to a border";
}

/// Two squares of one triangulation whose vertices on the border between them have two (u, v) each.
struct Joined {
  std::vector<Vec2> uv;
  std::vector<std::int32_t> vertex;
  std::vector<Triangle> triangles;
  std::vector<char> mixed;
  std::vector<Vec3> xyz;

  explicit Joined(const SurfaceMesh& mesh) : xyz(mesh.vertices) {
    for (const FaceMesh& face : mesh.faces) {
      const auto first = static_cast<std::int32_t>(uv.size());
      uv.insert(uv.end(), face.uv.begin(), face.uv.end());
      vertex.insert(vertex.end(), face.vertex.begin(), face.vertex.end());
      for (const Triangle& t : face.triangles) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    mixed.assign(triangles.size(), 0);
  }
};

TEST(EditableMesh, EditsEdgesBetweenFacesOnRequest) {
  const SurfaceMesh mesh = two_faces(4);
  Joined joined(mesh);
  std::vector<Edge> imposed;
  std::vector<std::int32_t> corners;
  for (const int c : {0, 1})
    for (std::size_t k = 0; k < mesh.curves[c].vertices.size(); ++k) {
      const std::int32_t v = mesh.curves[c].vertices[k];
      if (k > 0) imposed.push_back({mesh.curves[c].vertices[k - 1], v});
      const Vec3 p = mesh.vertices[v];
      if ((p.x() == 0 || p.x() == 2) && (p.y() == 0 || p.y() == 1)) corners.push_back(v);
    }
  EditableMesh editable({{&joined.uv, &joined.triangles, &joined.vertex, &joined.mixed}}, joined.xyz, imposed, corners);
  const std::vector<std::int32_t>& between = mesh.curves[2].vertices;
  // Each edge between the faces is swapped there and back.
  for (std::size_t k = 1; k < between.size(); ++k) {
    const auto before = as_sets(joined.triangles);
    for (const Place p : std::vector(editable.fan(between[k - 1]))) {
      const auto q = editable.quad(p, editable.rank_in(p, between[k - 1]));
      if (!q || !q->mixed) continue;
      const std::size_t edits = editable.edits();
      ASSERT_TRUE(editable.swap(*q));
      EXPECT_NE(as_sets(joined.triangles), before);
      EXPECT_EQ(joined.mixed[q->t] + joined.mixed[q->u], 2);
      editable.undo(edits);
      EXPECT_EQ(as_sets(joined.triangles), before);
      EXPECT_EQ(joined.mixed[q->t] + joined.mixed[q->u], 0);
    }
  }
  // All vertices inside go, wherever they lie: the border between the faces leaves no trace.
  for (bool again = true; again;) {
    again = false;
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(joined.xyz.size()); ++v) {
      if (editable.fan(v).empty()) continue;
      for (const std::int32_t w : editable.ring(v))
        if (editable.collapse(v, w)) {
          again = true;
          break;
        }
    }
  }
  editable.compact();
  EXPECT_EQ(joined.xyz.size(), 4U) << "the corners of the two squares together";
  EXPECT_EQ(joined.triangles.size(), 2U);
}

TEST(EditableMesh, APatchInThePlaneKeepsItsDomain) {
  PlaneDomain domain;
  domain.vertices = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 4; ++i) domain.edges.push_back({i, (i + 1) % 4});
  PlaneMesh mesh{domain.vertices, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  mesh.vertices.push_back({0.5, 0.4});
  std::vector<Vec3> xyz;
  for (const Vec2& p : mesh.vertices) xyz.push_back({p.x(), p.y(), p.x() * p.y()});
  EditableMesh editable(domain, mesh, xyz);
  for (std::int32_t t = 0; t < 4; ++t) EXPECT_FALSE(editable.quad({0, t}, 0)) << "a side of the domain";
  for (std::int32_t v = 0; v < 4; ++v) EXPECT_FALSE(editable.inside(v));
  ASSERT_TRUE(editable.inside(4));
  EXPECT_FALSE(editable.can_move({0, 4}, {1.1, 0.5})) << "out of the domain";
  const std::vector<std::int32_t> some{0, 1};
  const EditableMesh part(domain, mesh, xyz, some);
  EXPECT_EQ(part.fan(4).size(), 2U);
  EXPECT_TRUE(part.quad({0, 0}, 1));
  EXPECT_FALSE(part.quad({0, 1}, 1)) << "the triangle beyond is not met";
  EXPECT_FALSE(part.is_known(3));
}

TEST(EditableMesh, PartsOfASplitTriangleHaveTheGivenNumbers) {
  for (const auto keeps : {EditableMesh::Split::at_a, EditableMesh::Split::at_start}) {
    PlaneDomain domain;
    domain.vertices = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    PlaneMesh mesh{domain.vertices, {{0, 1, 2}, {0, 2, 3}}};
    std::vector<Vec3> xyz{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    EditableMesh editable(domain, mesh, xyz);
    const auto q = editable.quad({0, 0}, 2);  // from 2 to 0
    ASSERT_TRUE(q && editable.can_split(*q, {0.5, 0.5}));
    EXPECT_EQ(editable.split(*q, {0.5, 0.5}, {0.5, 0.5, 0}, keeps), (EditableMesh::Vertex{0, 4}));
    const bool at_a = keeps == EditableMesh::Split::at_a;
    EXPECT_EQ(mesh.triangles[0], (Triangle{2, 4, 1}));
    EXPECT_EQ(mesh.triangles[1], (at_a ? Triangle{4, 2, 3} : Triangle{0, 4, 3}));
    EXPECT_EQ(mesh.triangles[2], (Triangle{4, 0, 1}));
    EXPECT_EQ(mesh.triangles[3], (at_a ? Triangle{0, 4, 3} : Triangle{4, 2, 3}));
  }
}

}  // namespace
}  // namespace carreau
