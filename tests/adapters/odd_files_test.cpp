// What files of other programs hold: edges without curves in parameter planes, thin plates, edges of nearly no length.
#include <gtest/gtest.h>
#include <shape_file.h>
#include <shape_report.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include "measured_mesh.h"
#include "shapes.h"

namespace {

carreau_occ::ShapeFile file_of(const TopoDS_Shape& shape) { return {.shape = shape, .labels = {}, .unit = ""}; }

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

// A gap is what lies between two curves, not between points of equal parameters.
TEST(Gaps, AreNotThoseOfTheParameters) {
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
  const adapters::MeasuredMesh mesh = adapters::mesh_and_measure(host, host.diagonal() / 30);
  EXPECT_EQ(mesh.trouble(true), "");
  EXPECT_NEAR(mesh.volume, 30, 1e-3);
  EXPECT_LT(mesh.quality.triangles, 5000);  // not as many as edges of that length would make
}

}  // namespace
