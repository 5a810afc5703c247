// SPDX-License-Identifier: BSD-3-Clause
// Loops that files leave open: gaps at vertices, wrong images, seams that are missing, curves without length.
#include <gtest/gtest.h>
#include <shape_file.h>

#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>
#include <gp_Ax3.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>
#include <numbers>

#include "measured_mesh.h"
#include "shapes.h"

namespace {

constexpr double pi = std::numbers::pi, tolerance = 1e-7;

carreau_occ::ShapeFile file_of(const TopoDS_Shape& shape) { return {.shape = shape, .labels = {}, .unit = ""}; }

TopoDS_Vertex vertex_at(const gp_Pnt& p, double radius = tolerance) {
  TopoDS_Vertex vertex;
  BRep_Builder().MakeVertex(vertex, p, radius);
  return vertex;
}

TopoDS_Edge line_edge(const gp_Pnt& p, const gp_Pnt& q, const TopoDS_Vertex& from, const TopoDS_Vertex& to) {
  const BRep_Builder builder;
  TopoDS_Edge edge;
  builder.MakeEdge(edge, new Geom_Line(p, gp_Dir(gp_Vec(p, q))), tolerance);
  builder.Add(edge, from.Oriented(TopAbs_FORWARD));
  builder.Add(edge, to.Oriented(TopAbs_REVERSED));
  builder.Range(edge, 0, p.Distance(q));
  return edge;
}

TopoDS_Wire wire_of(const std::vector<TopoDS_Edge>& edges) {
  const BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (const TopoDS_Edge& edge : edges) builder.Add(wire, edge);
  return wire;
}

TopoDS_Face face_on(const Handle(Geom_Surface) & surface, const std::vector<TopoDS_Wire>& wires) {
  const BRep_Builder builder;
  TopoDS_Face face;
  builder.MakeFace(face, surface, tolerance);
  for (const TopoDS_Wire& wire : wires) builder.Add(face, wire);
  return face;
}

/// A closed edge on a circle, with its image on a surface.
TopoDS_Edge circle_edge(const gp_Circ& circle, const Handle(Geom2d_Curve) & image, const Handle(Geom_Surface) & surface,
                        const TopoDS_Vertex& vertex) {
  const BRep_Builder builder;
  TopoDS_Edge edge;
  builder.MakeEdge(edge, new Geom_Circle(circle), tolerance);
  builder.UpdateEdge(edge, image, surface, TopLoc_Location(), tolerance);
  builder.Add(edge, vertex.Oriented(TopAbs_FORWARD));
  builder.Add(edge, vertex.Oriented(TopAbs_REVERSED));
  builder.Range(edge, 0, 2 * pi);
  return edge;
}

TEST(LoopGaps, WrongImagesAreMadeAnew) {
  const TopoDS_Shape cylinder = BRepPrimAPI_MakeCylinder(1, 2).Shape();
  const BRep_Builder builder;
  for (TopExp_Explorer f(cylinder, TopAbs_FACE); f.More(); f.Next()) {
    const TopoDS_Face face = TopoDS::Face(f.Current());
    if (Handle(Geom_CylindricalSurface)::DownCast(BRep_Tool::Surface(face)).IsNull()) continue;
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      if (BRep_Tool::IsClosed(edge, face) || BRep_Tool::Pnt(TopExp::FirstVertex(edge)).Z() < 1) continue;
      builder.UpdateEdge(edge, new Geom2d_Line(gp_Pnt2d(0, 0.5), gp_Dir2d(1, 0)), face, tolerance);
    }
  }
  carreau_occ::BrepHost host(file_of(cylinder));
  ASSERT_EQ(host.notes().size(), 1U);
  EXPECT_NE(host.notes().front().find("made anew"), std::string::npos) << host.notes().front();
  const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.1);
  EXPECT_EQ(mesh.trouble(true), "");
  EXPECT_NEAR(mesh.volume, 2 * pi, 0.05);
}

// Two faces share three sides of a square and a vertex that stands for the fourth one.
TEST(LoopGaps, AVertexThatStandsForASideBecomesAnEdgeOfBothFaces) {
  const gp_Pnt a(0, 0, 0), b(4, 0, 0), c(4, 4, 0), d(0, 4, 0);
  const TopoDS_Vertex side = vertex_at(gp_Pnt(0, 2, 0), 2.5), vb = vertex_at(b), vc = vertex_at(c);
  const std::vector<TopoDS_Edge> edges = {line_edge(a, b, side, vb), line_edge(b, c, vb, vc),
                                          line_edge(c, d, vc, side)};
  const Handle(Geom_Plane) up = new Geom_Plane(gp_Pln(gp::XOY()));
  const BRep_Builder builder;
  TopoDS_Compound both;
  builder.MakeCompound(both);
  builder.Add(both, face_on(up, {wire_of(edges)}));
  builder.Add(both, face_on(up, {wire_of(edges)}).Reversed());
  carreau_occ::BrepHost host(file_of(both));
  ASSERT_EQ(host.notes().size(), 1U);
  EXPECT_NE(host.notes().front().find("1 gap was closed by an edge"), std::string::npos) << host.notes().front();
  EXPECT_EQ(host.edge_count(), 3);
  const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.5);
  EXPECT_TRUE(mesh.failed.empty()) << mesh.failed.front();
  EXPECT_EQ(mesh.open_edges, 0);
}

// The top of a box lies beyond the edges that it shares with the sides.
TEST(LoopGaps, FacesThatMissTheirEdgesAreMeshed) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  const BRep_Builder builder;
  for (TopExp_Explorer f(box, TopAbs_FACE); f.More(); f.Next()) {
    const TopoDS_Face face = TopoDS::Face(f.Current());
    const auto plane = Handle(Geom_Plane)::DownCast(BRep_Tool::Surface(face));
    if (plane->Location().Z() < 0.5 || std::abs(plane->Axis().Direction().Z()) < 0.5) continue;
    const auto raised = Handle(Geom_Plane)::DownCast(plane->Translated(gp_Vec(0, 0, 0.08)));
    builder.UpdateFace(face, raised, TopLoc_Location(), tolerance);
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      double first = 0, last = 0;
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      const Handle(Geom2d_Curve) image = BRep_Tool::CurveOnSurface(edge, face, first, last);
      ASSERT_FALSE(image.IsNull());
      builder.UpdateEdge(edge, image, raised, TopLoc_Location(), tolerance);
    }
  }
  carreau_occ::BrepHost host(file_of(box));
  EXPECT_NEAR(host.match_tolerance(), 0.06 * host.diagonal(), 1e-12);
  const adapters::MeasuredMesh narrow = adapters::mesh_and_measure(
      host, 0.2, [](carreau_session* session) { carreau_set_real(session, "eps_match", 0.05); });
  EXPECT_NE(narrow.error.find("its first end is 0.08"), std::string::npos) << narrow.error;
  const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.2);
  EXPECT_TRUE(mesh.failed.empty()) << mesh.failed.front();
  EXPECT_EQ(mesh.open_edges, 0);
}

TEST(MissingSeams, ABandBetweenTwoCirclesGetsOne) {
  const Handle(Geom_CylindricalSurface) cylinder = new Geom_CylindricalSurface(gp_Ax3(gp::XOY()), 1);
  for (const double turn : {0.0, 2.5}) {  // of the vertex of the upper circle
    const gp_Ax2 low(gp::XOY()), high(gp_Pnt(0, 0, 2), gp::DZ(), gp_Dir(std::cos(turn), std::sin(turn), 0));
    const TopoDS_Edge bottom = circle_edge(gp_Circ(low, 1), new Geom2d_Line(gp_Pnt2d(0, 0), gp_Dir2d(1, 0)), cylinder,
                                           vertex_at(gp_Pnt(1, 0, 0)));
    const TopoDS_Edge top = circle_edge(gp_Circ(high, 1), new Geom2d_Line(gp_Pnt2d(turn, 2), gp_Dir2d(1, 0)), cylinder,
                                        vertex_at(gp_Pnt(std::cos(turn), std::sin(turn), 2)));
    const TopoDS_Face face = face_on(cylinder, {wire_of({bottom}), wire_of({TopoDS::Edge(top.Reversed())})});
    carreau_occ::BrepHost host(file_of(face));
    const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.1);
    EXPECT_EQ(mesh.trouble(false), "") << turn;
    EXPECT_NEAR(mesh.quality.area, 4 * pi, 0.02) << turn;
  }
}

TEST(MissingSeams, ACapGetsItsPoleToo) {
  const Handle(Geom_SphericalSurface) sphere = new Geom_SphericalSurface(gp_Ax3(gp::XOY()), 1);
  const TopoDS_Edge equator = circle_edge(gp_Circ(gp::XOY(), 1), new Geom2d_Line(gp_Pnt2d(0, 0), gp_Dir2d(1, 0)),
                                          sphere, vertex_at(gp_Pnt(1, 0, 0)));
  for (const bool upper : {true, false}) {
    const TopoDS_Edge edge = upper ? equator : TopoDS::Edge(equator.Reversed());
    carreau_occ::BrepHost host(file_of(face_on(sphere, {wire_of({edge})})));
    const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.1);
    EXPECT_EQ(mesh.trouble(false), "") << upper;
    EXPECT_NEAR(mesh.quality.area, 2 * pi, 0.02) << upper;
    for (const auto& p : mesh.vertices) EXPECT_GE(upper ? p[2] : -p[2], -1e-12);
  }
}

TEST(MissingSeams, ABandOfATorusGetsOneInEitherDirection) {
  constexpr double R = 2, r = 0.5;
  const Handle(Geom_ToroidalSurface) torus = new Geom_ToroidalSurface(gp_Ax3(gp::XOY()), R, r);
  const auto circle_u = [&](double v) {
    const gp_Ax2 place(gp_Pnt(0, 0, r * std::sin(v)), gp::DZ(), gp::DX());
    return circle_edge(gp_Circ(place, R + r * std::cos(v)), new Geom2d_Line(gp_Pnt2d(0, v), gp_Dir2d(1, 0)), torus,
                       vertex_at(gp_Pnt(R + r * std::cos(v), 0, r * std::sin(v))));
  };
  const auto circle_v = [&](double u) {
    const gp_Dir out(std::cos(u), std::sin(u), 0);
    const gp_Pnt centre(R * std::cos(u), R * std::sin(u), 0);
    const gp_Ax2 place(centre, out.Crossed(gp::DZ()), out);
    return circle_edge(gp_Circ(place, r), new Geom2d_Line(gp_Pnt2d(u, 0), gp_Dir2d(0, 1)), torus,
                       vertex_at(centre.Translated(r * gp_Vec(out))));
  };
  // The outer half, past the seam of v; and a quarter that goes over the seam of u.
  const TopoDS_Face outer =
      face_on(torus, {wire_of({circle_u(1.5 * pi)}), wire_of({TopoDS::Edge(circle_u(pi / 2).Reversed())})});
  const TopoDS_Face quarter =
      face_on(torus, {wire_of({circle_v(pi / 4)}), wire_of({TopoDS::Edge(circle_v(1.75 * pi).Reversed())})});
  const double half = 2 * pi * r * (pi * R + 2 * r);
  for (const auto& [face, area] : {std::pair{outer, half}, {quarter, pi * pi * R * r}}) {
    carreau_occ::BrepHost host(file_of(face));
    const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.1);
    EXPECT_EQ(mesh.trouble(false), "");
    EXPECT_NEAR(mesh.quality.area, area, 0.02 * area);
  }
}

/// A unit square with more edges in its wire.
TopoDS_Face square_with(const std::vector<TopoDS_Edge>& more, double to = 1) {
  const gp_Pnt p[] = {{0, 0, 0}, {to, 0, 0}, {to, 1, 0}, {0, 1, 0}};
  TopoDS_Vertex v[4];
  for (int i = 0; i < 4; ++i) v[i] = vertex_at(p[i]);
  std::vector<TopoDS_Edge> edges = more;
  for (int i = 0; i < 4; ++i) edges.push_back(line_edge(p[i], p[(i + 1) % 4], v[i], v[(i + 1) % 4]));
  return face_on(new Geom_Plane(gp_Pln(gp::XOY())), {wire_of(edges)});
}

TEST(OddCurves, WithoutARangeAreLeftOut) {
  const TopoDS_Vertex at = vertex_at(gp_Pnt(0.5, 0.5, 0));
  TopoDS_Edge point = line_edge(gp_Pnt(0.5, 0.5, 0), gp_Pnt(1, 0.5, 0), at, at);
  BRep_Builder().Range(point, 0.25, 0.25);
  carreau_occ::BrepHost host(file_of(square_with({point})));
  const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.2);
  EXPECT_EQ(mesh.trouble(false), "");
  EXPECT_NEAR(mesh.quality.area, 1, 1e-12);
}

TEST(OddCurves, InsideTheFaceBoundItAndOutsideTheyDoNot) {
  for (const double x : {0.25, 2.0}) {
    const gp_Pnt p(x, 0.25, 0), q(x, 0.75, 0);
    const TopoDS_Edge line = line_edge(p, q, vertex_at(p), vertex_at(q));
    carreau_occ::BrepHost host(file_of(square_with({TopoDS::Edge(line.Oriented(TopAbs_INTERNAL))})));
    EXPECT_EQ(host.curve_count(1), x < 1 ? 5 : 4);
    const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.2);
    EXPECT_EQ(mesh.trouble(false), "") << x;
    EXPECT_NEAR(mesh.quality.area, 1, 1e-12);
  }
}

TEST(OddCurves, ThatEncloseNothingLeaveNoFace) {
  const gp_Pnt p(0, 0, 0), q(1, 1, 0);
  const TopoDS_Vertex from = vertex_at(p), to = vertex_at(q);
  const TopoDS_Face face =
      face_on(new Geom_Plane(gp_Pln(gp::XOY())), {wire_of({line_edge(p, q, from, to), line_edge(q, p, to, from)})});
  carreau_occ::BrepHost host(file_of(face));
  EXPECT_EQ(host.excluded(), (std::vector<std::pair<int, std::string>>{{1, "its curves enclose no area"}}));
}

// Two faces share a circle that names no vertex.
TEST(OddCurves, WithoutVerticesGetThem) {
  const gp_Circ circle(gp_Ax2(gp::XOY()), 1);
  const BRep_Builder builder;
  TopoDS_Edge edge;
  builder.MakeEdge(edge, new Geom_Circle(circle), tolerance);
  builder.Range(edge, 0, 2 * pi);
  const Handle(Geom_Plane) plane = new Geom_Plane(gp_Pln(gp::XOY()));
  TopoDS_Compound both;
  builder.MakeCompound(both);
  builder.Add(both, face_on(plane, {wire_of({edge})}));
  builder.Add(both, face_on(plane, {wire_of({edge})}).Reversed());
  carreau_occ::BrepHost host(file_of(both));
  EXPECT_TRUE(host.is_closed());
  const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.2);
  EXPECT_TRUE(mesh.failed.empty()) << mesh.failed.front();
  EXPECT_EQ(mesh.error, "");
  EXPECT_EQ(mesh.open_edges, 0);
  EXPECT_NEAR(mesh.quality.area, 2 * pi, 0.1);
}

TEST(OddCurves, ThatAreTurnedTheWrongWayBoundTheInside) {
  const TopoDS_Face face = square_with({});
  const BRep_Builder builder;
  TopoDS_Face turned;
  builder.MakeFace(turned, BRep_Tool::Surface(face), tolerance);
  for (TopExp_Explorer w(face, TopAbs_WIRE); w.More(); w.Next()) builder.Add(turned, w.Current().Reversed());
  carreau_occ::BrepHost host(file_of(turned));
  const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.2);
  EXPECT_EQ(mesh.trouble(false), "");
  EXPECT_NEAR(mesh.quality.area, 1, 1e-12);
}

TEST(LooseEdges, StayOutBesideFacesUnlessRequested) {
  const BRep_Builder builder;
  TopoDS_Compound both;
  builder.MakeCompound(both);
  const gp_Pnt p(2, 0, 0), q(3, 0, 0);
  const TopoDS_Edge line = line_edge(p, q, vertex_at(p), vertex_at(q));
  builder.Add(both, line);
  EXPECT_EQ(carreau_occ::BrepHost(file_of(both), false).wire_count(), 1);
  builder.Add(both, square_with({}));
  EXPECT_EQ(carreau_occ::BrepHost(file_of(both), true).wire_count(), 1);
  const carreau_occ::BrepHost host(file_of(both), false);
  EXPECT_EQ(host.wire_count(), 0);
  ASSERT_EQ(host.notes().size(), 1U);
  EXPECT_EQ(host.notes().front(), "1 edge of no face is not in the mesh (loose-edges adds them)");
}

}  // namespace
