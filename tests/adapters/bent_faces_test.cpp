// SPDX-License-Identifier: BSD-3-Clause
// Faces that bend inside are meshed as if they ended there, and stay single faces in all results.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <BRepAdaptor_Curve.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Tool.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <Geom2d_Line.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "bent_shapes.h"
#include "domain_cut.h"
#include "evaluators.h"
#include "line_crossings.h"
#include "measured_mesh.h"
#include "shapes.h"

namespace {

using adapters::MeasuredMesh;

carreau_occ::ShapeFile file_of(const TopoDS_Shape& shape) { return {.shape = shape, .labels = {}, .unit = ""}; }

const shapes::BentShape& shape_of(const std::string& name) {
  for (const shapes::BentShape& shape : shapes::bent_shapes())
    if (shape.name == name) return shape;
  throw std::runtime_error(name);
}

double length(const MeasuredMesh& m, std::size_t edge) {
  const auto& a = m.vertices[static_cast<std::size_t>(m.edges[edge][0])];
  const auto& b = m.vertices[static_cast<std::size_t>(m.edges[edge][1])];
  return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

class Bent : public testing::TestWithParam<std::string> {};

// Edges that cut across a bend leave an error of the first order; flat sides have none at all.
TEST_P(Bent, AreaAndVolumeConvergeAtSecondOrder) {
  const shapes::BentShape& shape = shape_of(GetParam());
  carreau_occ::BrepHost host(file_of(shape.make()));
  EXPECT_TRUE(host.bent_faces().empty());
  const bool solid = shape.volume > 0;
  ASSERT_EQ(host.is_closed(), solid);
  double area[2], volume[2];
  for (int i = 0; i < 2; ++i) {
    const MeasuredMesh m = adapters::mesh_and_measure(host, host.diagonal() / (i == 0 ? 25 : 100));
    ASSERT_EQ(m.trouble(solid), "");
    EXPECT_EQ(m.faces, shape.faces);
    EXPECT_EQ(*std::max_element(m.refs.begin(), m.refs.end()), shape.faces);
    EXPECT_GT(m.free_q2_min, 0.3);
    area[i] = std::abs(m.quality.area / shape.area - 1);
    volume[i] = solid ? std::abs(m.volume / shape.volume - 1) : 0;
  }
  if (shape.flat) {
    EXPECT_LT(area[0], 1e-12);
    EXPECT_LT(volume[0], 1e-12);
    return;
  }
  // Areas of walls and of the faces around their holes err against each other: only volumes show the error.
  const double* error = solid ? volume : area;
  EXPECT_GT(std::log(error[0] / error[1]) / std::log(4), 1.8);
}

// Curvatures do not show a bend: 17 % of the roof's area were lost.
TEST_P(Bent, SizesByAngleAndChordKeepTheBends) {
  const shapes::BentShape& shape = shape_of(GetParam());
  for (const bool by_direction : {false, true}) {
    SCOPED_TRACE(by_direction);
    carreau_occ::BrepHost host(file_of(shape.make()));
    const double diagonal = host.diagonal();
    const MeasuredMesh m = adapters::mesh_and_measure(host, diagonal / 5, [&](carreau_session* s) {
      carreau_set_integer(s, "hphy_flag", 0);
      carreau_set_integer(s, "hgeo_flag", 1);
      carreau_set_real(s, "angle_mesh", 8);
      carreau_set_real(s, "hgeomin", diagonal / 500);
      if (by_direction) carreau_set_integer(s, "geo_metric", 1), carreau_set_real(s, "gradation", 1.3);
    });
    EXPECT_EQ(m.trouble(shape.volume > 0), "");
    EXPECT_GT(m.free_q2_min, 0.02);
    // Inscribed polygons whose sides turn by up to 16 degrees: 1 - sin(x) / x, and as much again for the other
    // direction.
    EXPECT_NEAR(m.quality.area / shape.area, 1, shape.flat ? 1e-12 : 0.02);
    if (shape.volume > 0) {
      EXPECT_NEAR(m.volume / shape.volume, 1, shape.flat ? 1e-12 : 0.03);
    }
  }
}

// All edges of an edge of the shape have its number; those on bends have numbers behind.
TEST_P(Bent, EdgesOfTheShapeKeepTheirNumbers) {
  const TopoDS_Shape shape = shape_of(GetParam()).make();
  carreau_occ::BrepHost host(file_of(shape));
  const double size = host.diagonal() / 200;
  const MeasuredMesh m = adapters::mesh_and_measure(host, size);
  std::map<int, double> lengths;
  for (std::size_t i = 0; i < m.edges.size(); ++i) lengths[m.edge_refs[i]] += length(m, i);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  for (int e = 1; e <= edges.Extent(); ++e) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(e));
    const double exact = BRep_Tool::Degenerated(edge) ? 0 : GCPnts_AbscissaPoint::Length(BRepAdaptor_Curve(edge), 1e-9);
    EXPECT_NEAR(lengths[e], exact, 2e-4 * host.diagonal()) << e;
  }
  EXPECT_GT(lengths.rbegin()->first, edges.Extent());
}

INSTANTIATE_TEST_SUITE_P(Shapes, Bent,
                         testing::Values("roof", "cubic_roof", "vault", "pyramid", "square_pipe", "prism",
                                         "mirrored_prism", "drilled_prism", "square_ring", "two_cones"),
                         [](const auto& info) { return info.param; });

TEST(BentFaces, ThreadsDoNotChangeTheMesh) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  for (const char* name : {"drilled_prism", "two_cones"}) {
    SCOPED_TRACE(name);
    MeasuredMesh one;
    for (const int threads : {1, 2, 8}) {
      carreau_occ::BrepHost host(file_of(shape_of(name).make()));
      const MeasuredMesh m = adapters::mesh_and_measure(host, host.diagonal() / 60, [threads](carreau_session* s) {
        carreau_set_integer(s, "threads", threads);
        carreau_set_integer(s, "hgeo_flag", 1);
      });
      ASSERT_EQ(m.trouble(true), "");
      if (threads == 1) one = m;
      EXPECT_EQ(m.vertices, one.vertices);
      EXPECT_EQ(m.triangles, one.triangles);
    }
  }
}

TEST(BentFaces, SizesHoldInAllParts) {
  carreau_occ::BrepHost host(file_of(shape_of("prism").make()));
  ASSERT_TRUE(host.set_face_size("1", 0.05));
  EXPECT_FALSE(host.set_face_size("4", 0.05));  // a part is no face
  const MeasuredMesh m =
      adapters::mesh_and_measure(host, 0.5, [](carreau_session* s) { carreau_set_integer(s, "hphy_flag", 2); });
  EXPECT_EQ(m.trouble(true), "");
  const auto fine = static_cast<double>(std::count(m.refs.begin(), m.refs.end(), 1));
  EXPECT_NEAR(fine, 24 / (std::sqrt(3.0) / 4 * 0.05 * 0.05), 0.02 * fine);
}

TEST(BentFaces, PartsBelongToTheirFace) {
  const carreau_occ::BrepHost host(file_of(shape_of("pyramid").make()));
  EXPECT_EQ(host.face_count(), 1);
  EXPECT_EQ(host.parts(1), (std::vector<int>{1, 2, 3, 4}));
  for (const int part : host.parts(1)) EXPECT_EQ(host.whole_face(part), 1);
  EXPECT_EQ(host.whole_face(5), 5);
  std::set<int> wholes;
  for (const int part : host.parts(1))
    for (const int curve : host.curves(part)) wholes.insert(host.whole_edge(curve));
  EXPECT_EQ(wholes.size(), 4U + 4U);  // its own and the bends
}

// A curve of the file's on a piece of a bend bounds the parts on both sides.
TEST(BentFaces, CurvesInsideMayLieOnABend) {
  carreau_occ::BrepHost host(file_of(shapes::marked_roof()));
  EXPECT_TRUE(host.bent_faces().empty());
  EXPECT_EQ(host.parts(1).size(), 2U);
  const MeasuredMesh m = adapters::mesh_and_measure(host, 0.1);
  EXPECT_EQ(m.trouble(false), "");
  EXPECT_NEAR(m.quality.area, shape_of("roof").area, 1e-12);
  double marked = 0;
  for (std::size_t i = 0; i < m.edges.size(); ++i) marked += m.edge_refs[i] == host.edge_count() ? length(m, i) : 0;
  EXPECT_NEAR(marked, 0.4, 1e-9);
}

// The sides of an offset do not meet on the bend of its base surface.
TEST(BentFaces, OffsetsOfBentSurfacesAreNotCut) {
  const carreau_occ::BrepHost host(file_of(shapes::torn_roof()));
  EXPECT_EQ(host.bent_faces(), std::vector<int>{1});
  EXPECT_EQ(host.parts(1).size(), 1U);
}

// On the ridge itself each side has its own derivatives.
TEST(BentFaces, DerivativesOnABendMatchTheirSide) {
  const double slope = std::tan(std::acos(-1.0) / 6);
  carreau_occ::Evaluators evaluators;
  evaluators.resize(2);
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(shapes::roof(), 1e-7).Face();
  for (const bool right : {false, true}) {
    carreau_occ::PartBox box;
    (right ? box.low_u : box.high_u) = 0.25;
    box.step_u = box.step_v = 1e-7;
    evaluators.set(right ? 1 : 0, face, {}, box);
    const carreau_occ::Evaluators::Surface side = evaluators.surface(right ? 1 : 0);
    for (const double beyond : {0.0, 1e-12, -1e-12}) {
      gp_Pnt p;
      gp_Vec su, sv, suu, svv, suv;
      side.d1(0.25 + beyond, 0.5, p, su, sv);
      EXPECT_NEAR(su.Z() / su.X(), right ? -slope : slope, 1e-12);
      EXPECT_NEAR(p.Z(), 0, 1e-11);
      side.d2(0.25 + beyond, 0.5, p, su, sv, suu, svv, suv);
      EXPECT_NEAR(su.Z() / su.X(), right ? -slope : slope, 1e-12);
      EXPECT_NEAR(suu.Magnitude(), 0, 1e-9);
    }
  }
}

TEST(LineCrossings, AreFoundOnceAndOnlyInside) {
  const auto count = [](gp_Pnt2d from, gp_Pnt2d to, double at) {
    const Handle(Geom2d_Line) line = new Geom2d_Line(from, gp_Dir2d(gp_Vec2d(from, to)));
    return carreau_occ::crossings(line, 0, from.Distance(to), true, at, 1e-9, 1e-8);
  };
  ASSERT_EQ(count({0, 0}, {3, 4}, 1).size(), 1U);
  EXPECT_NEAR(count({0, 0}, {3, 4}, 1)[0], 5.0 / 3, 1e-15);
  EXPECT_EQ(count({0, 0}, {2, 0}, 1).size(), 1U);     // at a sample
  EXPECT_TRUE(count({0, 0}, {3, 4}, 0).empty());      // begins there
  EXPECT_TRUE(count({0, 0}, {3, 4}, 3).empty());      // ends there
  EXPECT_TRUE(count({1, 0}, {1, 4}, 1).empty());      // runs along
  EXPECT_TRUE(count({0, 0}, {3, 4}, 3.001).empty());  // beside
}

carreau_occ::DomainArc arc(int end1, int end2, std::vector<gp_Pnt2d> points, bool forward = true) {
  return {.end1 = end1, .end2 = end2, .forward = forward, .internal = false, .samples = std::move(points)};
}

// A square with a square hole: two parts where a line crosses both, one with its hole where it misses them.
TEST(DomainCut, HolesAreCutOrKept) {
  const auto square = [](int first, double low, double high, bool hole) {
    const gp_Pnt2d p[4] = {{low, low}, {high, low}, {high, high}, {low, high}};
    std::vector<carreau_occ::DomainArc> sides;
    for (int i = 0; i < 4; ++i) {
      // Sides across u = 1/2 come in halves.
      const int j = (i + 1) % 4;
      const gp_Pnt2d middle((p[i].X() + p[j].X()) / 2, (p[i].Y() + p[j].Y()) / 2);
      if (i % 2 == 0) {
        sides.push_back(arc(first + i, first + 4 + i, {p[i], middle}, !hole));
        sides.push_back(arc(first + 4 + i, first + j, {middle, p[j]}, !hole));
      } else {
        sides.push_back(arc(first + i, first + j, {p[i], p[j]}, !hole));
      }
    }
    return sides;
  };
  std::vector<carreau_occ::DomainArc> arcs = square(1, 0, 1, false);
  const auto inner = square(11, 0.25, 0.75, true);
  arcs.insert(arcs.end(), inner.begin(), inner.end());
  const gp_XY near(1e-9, 1e-9);
  const auto cut = carreau_occ::cut_domain(arcs, {.u = {0.5}, .v = {}}, near, 100);
  ASSERT_TRUE(cut.has_value());
  EXPECT_EQ(cut->edges.size(), 2U);
  ASSERT_EQ(cut->parts.size(), 2U);
  for (const carreau_occ::CutPart& part : cut->parts) EXPECT_EQ(part.uses.size(), 8U);
  EXPECT_EQ(cut->parts[0].high.X(), 0.5);
  EXPECT_EQ(cut->parts[1].low.X(), 0.5);
  // Beside it: one part, with its hole.
  const auto whole = carreau_occ::cut_domain(arcs, {.u = {-1}, .v = {}}, near, 100);
  ASSERT_TRUE(whole.has_value());
  EXPECT_TRUE(whole->edges.empty());
  ASSERT_EQ(whole->parts.size(), 1U);
  EXPECT_EQ(whole->parts[0].uses.size(), 12U);
  // Along sides of the square: nothing to cut.
  const auto along = carreau_occ::cut_domain(arcs, {.u = {0, 1}, .v = {}}, near, 100);
  ASSERT_TRUE(along.has_value());
  EXPECT_TRUE(along->edges.empty());
  EXPECT_EQ(along->parts.size(), 1U);
  // Through sides that were not divided there.
  EXPECT_FALSE(carreau_occ::cut_domain(arcs, {.u = {0.4}, .v = {}}, near, 100).has_value());
  // Not closed.
  arcs.pop_back();
  EXPECT_FALSE(carreau_occ::cut_domain(arcs, {.u = {0.5}, .v = {}}, near, 100).has_value());
}

}  // namespace
