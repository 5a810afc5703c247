// SPDX-License-Identifier: BSD-3-Clause
// Odd content of files of other programs: edges without curves in parameter planes, thin plates, edges of nearly no length.
#include <gtest/gtest.h>
#include <shape_file.h>
#include <shape_report.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GCE2d_MakeSegment.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_Surface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <array>
#include <cmath>
#include <gp_Ax3.hxx>
#include <gp_Pln.hxx>
#include <gp_Trsf.hxx>
#include <numbers>

#include "measured_mesh.h"
#include "shapes.h"

namespace {

carreau_occ::ShapeFile file_of(const TopoDS_Shape& shape) { return {.shape = shape, .labels = {}, .unit = ""}; }

void keep_narrow_faces(carreau_session* session) { carreau_set_text(session, "narrow_faces", "keep"); }

template <typename Visit>
void for_each_edge_of_faces(const TopoDS_Shape& shape, Visit visit) {
  for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next())
    for (TopExp_Explorer e(f.Current(), TopAbs_EDGE); e.More(); e.Next())
      visit(TopoDS::Edge(e.Current()), TopoDS::Face(f.Current()));
}

TEST(MissingCurves, AreMadeOfTheEdgesInSpace) {
  const TopoDS_Shape shape = BRepBuilderAPI_NurbsConvert(shapes::make("box_with_hole"), Standard_True).Shape();
  carreau_occ::BrepHost whole(file_of(shape));
  const double size = whole.diagonal() / 30;
  const adapters::MeasuredMesh expected = adapters::mesh_and_measure(whole, size);
  ASSERT_EQ(expected.trouble(true), "");

  const BRep_Builder builder;
  for_each_edge_of_faces(shape, [&](const TopoDS_Edge& edge, const TopoDS_Face& face) {
    if (!BRep_Tool::IsClosed(edge, face)) builder.UpdateEdge(edge, Handle(Geom2d_Curve)(), face, 1e-7);
  });
  carreau_occ::BrepHost host(file_of(shape));
  EXPECT_TRUE(host.is_closed());
  const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, size);
  EXPECT_EQ(mesh.trouble(true), "");
  EXPECT_NEAR(mesh.volume, expected.volume, 1e-3 * expected.volume);
}

/// A square of 4 whose one wire goes along an edge to (1, 1) and back, round a square hole in between or not.
TopoDS_Face square_with_return(bool round_a_hole) {
  const gp_Pnt places[] = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  TopoDS_Vertex corner[8];
  for (int i = 0; i < 8; ++i) corner[i] = BRepBuilderAPI_MakeVertex(places[i]);
  const BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  const auto add = [&](int a, int b) { builder.Add(wire, BRepBuilderAPI_MakeEdge(corner[a], corner[b]).Edge()); };
  const TopoDS_Edge there = BRepBuilderAPI_MakeEdge(corner[0], corner[4]);
  add(0, 1), add(1, 2), add(2, 3), add(3, 0);
  builder.Add(wire, there);
  if (round_a_hole) add(4, 7), add(7, 6), add(6, 5), add(5, 4);
  builder.Add(wire, there.Reversed());
  wire.Closed(Standard_True);
  TopoDS_Face face;
  builder.MakeFace(face, new Geom_Plane(gp_Pln()), 1e-7);
  builder.Add(face, wire);
  return face;
}

// Such an edge was two sides of a boundary that met itself.
TEST(Returns, AreCurvesInside) {
  for (const bool round_a_hole : {true, false}) {
    const TopoDS_Face face = square_with_return(round_a_hole);
    ASSERT_TRUE(BRepCheck_Analyzer(face).IsValid());
    carreau_occ::BrepHost host(file_of(face));
    const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.5);
    ASSERT_EQ(mesh.trouble(false), "");
    EXPECT_NEAR(mesh.quality.area, round_a_hole ? 15 : 16, 1e-12);
    // The way to (1, 1) is edges of the mesh: nothing crosses u = v before it.
    const auto on_way = [](const std::array<double, 3>& p) {
      return std::abs(p[0] - p[1]) < 1e-12 && p[0] < 1 + 1e-12;
    };
    double on_the_way = 0;
    for (const auto& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto &p = mesh.vertices[static_cast<std::size_t>(t[i])],
                   &q = mesh.vertices[static_cast<std::size_t>(t[(i + 1) % 3])];
        if (on_way(p) && on_way(q)) on_the_way += std::abs(q[0] - p[0]);
      }
    EXPECT_NEAR(on_the_way, 2, 1e-12);  // from both sides
    EXPECT_EQ(mesh.open_edges, round_a_hole ? 40 : 32);
  }
}

// A gap is the distance between two curves, not between points of equal parameters.
TEST(Gaps, DoNotDependOnTheParameters) {
  const TopoDS_Shape shape = BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), Standard_True).Shape();
  const BRep_Builder builder;
  for_each_edge_of_faces(shape, [&](const TopoDS_Edge& edge, const TopoDS_Face& face) {
    double a = 0, b = 0;
    const Handle(Geom2d_Curve) image = BRep_Tool::CurveOnSurface(edge, face, a, b);
    TColgp_Array1OfPnt2d points(1, 2);
    points(1) = image->Value(a), points(2) = image->Value(b);
    TColgp_Array1OfPnt2d poles(1, 3);  // the same line, slow at first
    poles(1) = points(1), poles(3) = points(2);
    poles(2) = points(1).Translated(0.2 * gp_Vec2d(points(1), points(2)));
    TColStd_Array1OfReal knots(1, 2);
    knots(1) = a, knots(2) = b;
    TColStd_Array1OfInteger multiplicities(1, 2);
    multiplicities.Init(3);
    builder.UpdateEdge(edge, new Geom2d_BSplineCurve(poles, knots, multiplicities, 2), face, 1e-7);
  });
  EXPECT_LT(carreau_occ::measure_gaps(file_of(shape)).largest, 1e-6);
}

// Triangles on the borders are 0.1 long, the plate is 100 wide and the size 25.
TEST(ThinPlates, AreFilledFromTheirFineBorders) {
  carreau_occ::BrepHost host(file_of(BRepPrimAPI_MakeBox(100, 80, 0.03).Shape()));
  const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(
      host, host.diagonal() / 5, [](carreau_session* session) { carreau_set_real(session, "CoefRectangle", 0.1); });
  EXPECT_EQ(mesh.trouble(true), "");
  EXPECT_NEAR(mesh.volume, 240, 1e-9 * 240);
  EXPECT_GT(mesh.quality.q2_min, 0.2);
}

// An edge of 1.4e-5 makes a face as narrow; its ends are one point for the curves beside, not for the face.
TEST(TinyEdges, LeaveNarrowFacesMeshed) {
  BRepBuilderAPI_MakePolygon polygon;
  for (const auto& [x, y] : {std::pair{0., 0.}, {5., 0.}, {5.00001, 1e-5}, {2., 4.}}) polygon.Add(gp_Pnt(x, y, 0));
  polygon.Close();
  carreau_occ::BrepHost host(
      file_of(BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire()).Face(), gp_Vec(0, 0, 3)).Shape()));
  const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, host.diagonal() / 30, keep_narrow_faces);
  EXPECT_EQ(mesh.trouble(true), "");
  EXPECT_NEAR(mesh.volume, 30, 1e-3);
  EXPECT_LT(mesh.quality.triangles, 5000);  // not as many as edges of that length would make
}

// Chamfers that no triangle of the prescribed size can resolve vanish; their neighbours meet in one curve.
TEST(NarrowFaces, NarrowerThanAnyCutVanish) {
  for (const double width : {1e-7, 1e-5, 1e-4}) {
    SCOPED_TRACE(width);
    BRepBuilderAPI_MakePolygon polygon;
    for (const auto& [x, y] : {std::pair{0., 0.}, {5., 0.}, {5. - width, width}, {2., 4.}})
      polygon.Add(gp_Pnt(x, y, 0));
    polygon.Close();
    carreau_occ::BrepHost host(
        file_of(BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire()).Face(), gp_Vec(0, 0, 3)).Shape()));
    const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, host.diagonal() / 15);
    EXPECT_EQ(mesh.trouble(true), "");
    EXPECT_NEAR(mesh.volume, 30, 20 * width);
    EXPECT_GT(mesh.quality.q2_min, 0.5);
  }
}

// Two tiny edges one after the other, first in the wires of two faces: one of them must not determine how the loop is
// turned.
TEST(TinyEdges, FirstInTheirWiresTearNoLoop) {
  for (const double tiny : {1e-4, 1e-5, 1e-6}) {
    SCOPED_TRACE(tiny);
    BRepBuilderAPI_MakePolygon polygon;
    for (const auto& [x, y] : {std::pair{0., 0.}, {tiny, 0.}, {2 * tiny, tiny}, {5., 0.}, {2., 4.}})
      polygon.Add(gp_Pnt(x, y, 0));
    polygon.Close();
    carreau_occ::BrepHost host(
        file_of(BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire()).Face(), gp_Vec(0, 0, 3)).Shape()));
    const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, host.diagonal() / 30, keep_narrow_faces);
    EXPECT_EQ(mesh.trouble(true), "");
    EXPECT_NEAR(mesh.volume, 30, 20 * tiny);
  }
}

/// z = x^2 + y^2 over the unit square, as a Bezier surface that goes on beyond it.
Handle(Geom_Surface) bowl() {
  TColgp_Array2OfPnt poles(1, 3, 1, 3);
  const double square[] = {0, 0, 1};  // Bezier coefficients of t^2
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) poles(i + 1, j + 1) = gp_Pnt(i / 2.0, j / 2.0, square[i] + square[j]);
  return new Geom_BezierSurface(poles);
}

/// A wire along a square of the parameter plane.
TopoDS_Wire square_on(const Handle(Geom_Surface) & surface, double low, double high, bool clockwise) {
  const std::array<gp_Pnt2d, 4> corners{gp_Pnt2d(low, low), {high, low}, {high, high}, {low, high}};
  std::array<TopoDS_Vertex, 4> vertices;
  for (std::size_t i = 0; i < 4; ++i)
    vertices[i] = BRepBuilderAPI_MakeVertex(surface->Value(corners[i].X(), corners[i].Y()));
  const BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    const Handle(Geom2d_TrimmedCurve) side = GCE2d_MakeSegment(corners[i], corners[j]).Value();
    TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(side, surface, vertices[i], vertices[j]);
    BRepLib::BuildCurve3d(edge);
    builder.Add(wire, clockwise ? edge.Reversed() : edge);
  }
  return wire;
}

// A loop that runs clockwise is the border of all that lies outside: no face, and OpenCASCADE calls the whole plane
// inside.
TEST(WrongTurns, OuterLoopsAreTurnedRound) {
  const Handle(Geom_Surface) surface = bowl();
  const BRep_Builder builder;
  const auto face_with = [&](bool outer_clockwise, bool inner_clockwise) {
    TopoDS_Face face;
    builder.MakeFace(face, surface, 1e-7);
    builder.Add(face, square_on(surface, 0.1, 0.9, outer_clockwise));
    builder.Add(face, square_on(surface, 0.3, 0.6, inner_clockwise));
    return face;
  };
  carreau_occ::BrepHost sound(file_of(face_with(false, true)));
  EXPECT_NEAR(sound.diagonal(), std::sqrt(2 * 0.8 * 0.8 + 1.6 * 1.6), 1e-9);
  const adapters::MeasuredMesh expected = adapters::mesh_and_measure(sound, 0.1);
  ASSERT_EQ(expected.trouble(false), "");
  for (const bool inner_clockwise : {false, true})
    for (const bool reversed : {false, true}) {
      SCOPED_TRACE(::testing::Message() << "inner clockwise " << inner_clockwise << ", reversed " << reversed);
      const TopoDS_Face face = face_with(true, inner_clockwise);
      carreau_occ::BrepHost host(file_of(reversed ? face.Reversed() : TopoDS_Shape(face)));
      EXPECT_NEAR(host.diagonal(), sound.diagonal(), 1e-9);
      const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.1);
      EXPECT_EQ(mesh.trouble(false), "");
      EXPECT_NEAR(mesh.quality.area, expected.quality.area, 1e-3 * expected.quality.area);
      EXPECT_EQ(mesh.quality.vertices - mesh.quality.edges + mesh.quality.triangles, 0);  // a ring
    }
}

// The outside of a loop on a sphere has a seam and poles. A face without them is the inside.
TEST(WrongTurns, LoopsOnASphereWithoutASeamBoundTheirInside) {
  const Handle(Geom_Surface) sphere = new Geom_SphericalSurface(gp_Ax3(), 1);
  const BRep_Builder builder;
  TopoDS_Face face;
  builder.MakeFace(face, sphere, 1e-7);
  builder.Add(face, square_on(sphere, 0.3, 0.9, true));
  carreau_occ::BrepHost host(file_of(face));
  const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.1);
  EXPECT_EQ(mesh.trouble(false), "");
  const double inside = 0.6 * (std::sin(0.9) - std::sin(0.3));
  EXPECT_NEAR(mesh.quality.area, inside, 2e-3 * inside);
  EXPECT_EQ(mesh.quality.vertices - mesh.quality.edges + mesh.quality.triangles, 1);  // a disc
}

/// The round face of a cylinder of radius 1 and height 2, whose upper circle and one of whose seams lie a period before
/// the others in (u, v), as OpenCASCADE's reader leaves faces of revolution. With `bridges` it has closed the loop by
/// edges that it marks as degenerate.
TopoDS_Face torn_cylinder(bool bridges) {
  const double turn = 2 * std::numbers::pi;
  const TopoDS_Face whole = TopoDS::Face(
      TopExp_Explorer(BRepPrimAPI_MakeCylinder(1, 2).Shape(), TopAbs_FACE).Current().Oriented(TopAbs_FORWARD));
  const BRep_Builder builder;
  TopoDS_Face face;
  builder.MakeFace(face, Handle(Geom_Surface)::DownCast(BRep_Tool::Surface(whole)->Copy()), 1e-7);
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  const auto bridge = [&](const TopoDS_Vertex& at, gp_Pnt2d from, double by) {
    TopoDS_Edge edge;
    builder.MakeEdge(edge);
    builder.UpdateEdge(edge, new Geom2d_Line(from, gp_Dir2d(by, 0)), face, 1e-7);
    builder.Range(edge, face, 0, turn);
    builder.Degenerated(edge, Standard_True);
    builder.Add(edge, at.Oriented(TopAbs_FORWARD));
    builder.Add(edge, at.Oriented(TopAbs_REVERSED));
    builder.Add(wire, edge);
  };
  for (TopExp_Explorer e(whole, TopAbs_EDGE); e.More(); e.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(e.Current());
    double a = 0, b = 0;
    const Handle(Geom2d_Curve) image = BRep_Tool::CurveOnSurface(edge, whole, a, b);
    const gp_Vec2d back(-turn, 0);
    const bool is_upper = image->Value(a).Y() > 1 && image->Value(b).Y() > 1;
    const auto moved = [](const Handle(Geom2d_Curve) & curve, gp_Vec2d by) {
      return Handle(Geom2d_Curve)::DownCast(curve->Translated(by));
    };
    if (BRep_Tool::IsClosed(edge, whole)) {
      const TopoDS_Edge up = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
      const auto one = BRep_Tool::CurveOnSurface(up, whole, a, b);
      const auto other = BRep_Tool::CurveOnSurface(TopoDS::Edge(up.Reversed()), whole, a, b);
      const bool first = one->Value(a).X() < 1;  // the seam at u = 0 goes to -2 pi
      builder.UpdateEdge(up, moved(one, first ? back : gp_Vec2d()), moved(other, first ? gp_Vec2d() : back), face,
                         1e-7);
    } else {
      builder.UpdateEdge(edge, moved(image, is_upper ? back : gp_Vec2d()), face, 1e-7);
    }
    if (bridges && is_upper) bridge(TopExp::FirstVertex(edge), {turn, 2}, -1);
    builder.Add(wire, edge);
    if (bridges && image->Value(a).X() < 1 && image->Value(b).X() < 1) bridge(TopExp::FirstVertex(edge), {-turn, 0}, 1);
  }
  builder.Add(face, wire);
  return face;
}

TEST(PeriodicSurfaces, LoopsThatLieAPeriodApartClose) {
  for (const bool bridges : {false, true}) {
    SCOPED_TRACE(bridges);
    carreau_occ::BrepHost host(file_of(torn_cylinder(bridges)));
    const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.1);
    EXPECT_EQ(mesh.trouble(false), "");
    EXPECT_NEAR(mesh.quality.area, 4 * std::numbers::pi, 0.01);
    EXPECT_EQ(mesh.quality.vertices - mesh.quality.edges + mesh.quality.triangles, 0);  // a ring
  }
}

// Two edges of each torn loop end at different vertices at one place: a lid's, and the vertices of its hole.
TEST(TornLoops, CloseWhereTheirEndsAreOnePlace) {
  const BRep_Builder builder;
  TopoDS_Compound shape;
  builder.MakeCompound(shape);
  TopoDS_Face lid;
  builder.MakeFace(lid, new Geom_Plane(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 1e-7);
  const auto add_torn_loop = [&](const std::vector<gp_Pnt>& corners) {
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    const TopoDS_Vertex first = BRepBuilderAPI_MakeVertex(corners.front());
    TopoDS_Vertex from = first;
    for (std::size_t i = 1; i <= corners.size(); ++i) {
      const TopoDS_Vertex to = BRepBuilderAPI_MakeVertex(corners[i % corners.size()]);  // the last one is not `first`
      builder.Add(wire, BRepBuilderAPI_MakeEdge(from, to).Edge());
      from = to;
    }
    builder.Add(lid, wire);
  };
  add_torn_loop({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  add_torn_loop({{0.3, 0.3, 0}, {0.3, 0.7, 0}, {0.7, 0.7, 0}, {0.7, 0.3, 0}});
  builder.Add(shape, lid);
  carreau_occ::BrepHost host(file_of(shape));
  const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.1);
  EXPECT_EQ(mesh.trouble(false), "");
  EXPECT_NEAR(mesh.quality.area, 1 - 0.16, 1e-12);
  EXPECT_EQ(mesh.quality.vertices - mesh.quality.edges + mesh.quality.triangles, 0);  // a ring
}

// BREP files may describe a whole sphere or torus by its surface alone, placed and turned or not.
TEST(NaturalBounds, BoundClosedSurfaces) {
  const double pi = std::numbers::pi;
  const BRep_Builder builder;
  TopoDS_Compound shape;
  builder.MakeCompound(shape);
  gp_Trsf away;
  away.SetTranslation(gp_Vec(10, 0, 0));
  TopoDS_Face sphere, torus, plane;
  builder.MakeFace(sphere, new Geom_SphericalSurface(gp_Ax3(), 1), 1e-7);
  builder.MakeFace(torus, new Geom_ToroidalSurface(gp_Ax3(), 2, 0.5), 1e-7);
  builder.MakeFace(plane, new Geom_Plane(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 1e-7);
  builder.Add(shape, sphere.Reversed());
  builder.Add(shape, torus.Moved(away));
  const std::string path = ::testing::TempDir() + "natural_bounds.brep";
  ASSERT_TRUE(BRepTools::Write(shape, path.c_str()));
  carreau_occ::BrepHost host(carreau_occ::read_shape(path));
  const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, 0.1);
  EXPECT_EQ(mesh.trouble(true), "");
  EXPECT_NEAR(mesh.quality.area, 4 * pi + 4 * pi * pi, 0.01 * 4 * pi * pi);
  // The sphere's normals point inwards.
  EXPECT_NEAR(mesh.volume, 2 * pi * pi * 2 * 0.25 - 4 * pi / 3, 0.05);
  builder.Add(shape, plane);  // has no end
  ASSERT_TRUE(BRepTools::Write(shape, path.c_str()));
  carreau_occ::BrepHost endless(carreau_occ::read_shape(path));
  EXPECT_EQ(endless.excluded(), (std::vector<std::pair<int, std::string>>{{3, "no edge bounds it, and its surface has no end"}}));
}

}  // namespace
