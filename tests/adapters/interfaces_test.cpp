// SPDX-License-Identifier: BSD-3-Clause
// Edges that faces do not share in the file, or share with images that disagree.
#include <gtest/gtest.h>
#include <shape_file.h>

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <IGESControl_Writer.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gp_Trsf.hxx>

#include "measured_mesh.h"
#include "shapes.h"

namespace {

carreau_occ::ShapeFile file_of(const TopoDS_Shape& shape) { return {.shape = shape, .labels = {}, .unit = ""}; }

/// Vertices - edges + triangles.
std::int64_t euler(const adapters::MeasuredMesh& m) {
  return m.quality.vertices - m.quality.edges + m.quality.triangles;
}

std::int64_t count(const adapters::MeasuredMesh& m, bool (*what)(const carreau_interface&)) {
  return std::count_if(m.interfaces.begin(), m.interfaces.end(), what);
}
bool is_glued(const carreau_interface& i) { return i.glued != 0; }
bool is_open(const carreau_interface& i) { return i.uses == 1 && i.boundary != 0 && i.degenerate == 0; }
double widest_gap(const adapters::MeasuredMesh& m) {
  double gap = 0;
  for (const carreau_interface& i : m.interfaces) gap = std::max(gap, i.gap);
  return gap;
}

/// The faces of a shape, without shared edges; the first is moved by `gap` along x, and every edge has the
/// tolerance `tolerance`.
TopoDS_Shape taken_apart(const TopoDS_Shape& shape, double gap, double tolerance) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  bool first = true;
  for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next(), first = false) {
    TopoDS_Shape face = BRepBuilderAPI_Copy(f.Current()).Shape();
    gp_Trsf move;
    move.SetTranslation(gp_Vec(first ? gap : 0, 0, 0));
    face = BRepBuilderAPI_Transform(face, move, Standard_True).Shape();
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      builder.UpdateEdge(TopoDS::Edge(e.Current()), tolerance);
      for (TopExp_Explorer v(e.Current(), TopAbs_VERTEX); v.More(); v.Next())
        builder.UpdateVertex(TopoDS::Vertex(v.Current()), tolerance);
    }
    builder.Add(all, face);
  }
  return all;
}

class Unsewn : public testing::TestWithParam<std::string> {};

TEST_P(Unsewn, FacesMeetAsInTheSolid) {
  const TopoDS_Shape solid = shapes::make(GetParam());
  carreau_occ::BrepHost whole(file_of(solid));
  const double size = whole.diagonal() / 30;
  EXPECT_EQ(whole.glue_tolerances().of_all, 0);
  const adapters::MeasuredMesh expected = adapters::mesh_and_measure(whole, size);
  ASSERT_EQ(expected.trouble(true), "");
  EXPECT_EQ(count(expected, is_glued), 0);

  carreau_occ::BrepHost apart(file_of(taken_apart(solid, 0, 1e-6)));
  EXPECT_NEAR(apart.glue_tolerances().of_all, 2e-6, 1e-12);
  EXPECT_FALSE(apart.is_closed());
  const adapters::MeasuredMesh m = adapters::mesh_and_measure(apart, size);
  EXPECT_EQ(m.trouble(true), "");
  EXPECT_EQ(euler(m), euler(expected));
  EXPECT_EQ(count(m, is_open), 0);
  EXPECT_GT(count(m, is_glued), 0);
  EXPECT_LT(widest_gap(m), 2e-6);
  EXPECT_NEAR(m.volume / expected.volume, 1, 1e-3);
  // The same curves: the same edges, since the size is one.
  EXPECT_EQ(m.interfaces.size(), expected.interfaces.size());
}

INSTANTIATE_TEST_SUITE_P(Shapes, Unsewn,
                         testing::Values("cylinder", "box_with_hole", "cone", "across_a_seam", "two_cylinders"),
                         [](const auto& info) { return info.param; });

TEST(Unsewn, GapsWithinTheFilesOwnTolerancesAreBridgedAndReported) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  for (const double gap : {1e-3, 1e-5}) {
    carreau_occ::BrepHost host(file_of(taken_apart(box, gap, gap)));
    const adapters::MeasuredMesh m = adapters::mesh_and_measure(host, 0.25);
    EXPECT_EQ(m.trouble(true), "");
    EXPECT_EQ(euler(m), 2);
    EXPECT_EQ(count(m, is_glued), 12);
    EXPECT_NEAR(widest_gap(m), gap, 1e-9);
    EXPECT_NEAR(m.volume, 6, 10 * gap);
  }
}

// A short edge elsewhere in the file does not change the tolerance that its coarse edges need.
TEST(Unsewn, ShortEdgesElsewhereLeaveNoGapOpen) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  const double gap = 1e-3;
  builder.Add(all, taken_apart(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), gap, gap));
  builder.Add(all, taken_apart(BRepPrimAPI_MakeBox(gp_Pnt(2, 0, 0), gap, 1, 1).Shape(), 0, 1e-7));
  carreau_occ::BrepHost host(file_of(all));
  EXPECT_LT(host.glue_tolerances().of_all, gap);
  EXPECT_NEAR(host.glue_tolerances().of_each, 2 * gap, 1e-12);
  const adapters::MeasuredMesh m = adapters::mesh_and_measure(host, 0.25);
  EXPECT_EQ(m.trouble(true), "");
  EXPECT_EQ(euler(m), 4);
  EXPECT_EQ(count(m, is_open), 0);
  // The edges of both boxes; the pieces that the face moved inwards cuts off its neighbours' edges are points.
  const auto is_glued_curve = [](const carreau_interface& i) { return i.glued != 0 && i.degenerate == 0; };
  EXPECT_EQ(count(m, is_glued_curve), 24);
  EXPECT_NEAR(widest_gap(m), gap, 1e-9);
}

TEST(Unsewn, WiderGapsStayOpenAndAreReported) {
  carreau_occ::BrepHost host(file_of(taken_apart(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), -0.01, 1e-4)));
  const adapters::MeasuredMesh m = adapters::mesh_and_measure(host, 0.25);
  EXPECT_EQ(m.trouble(false), "");
  EXPECT_EQ(count(m, is_glued), 8);
  EXPECT_EQ(count(m, is_open), 8);  // four of the face that is away, four of those around it
  for (const carreau_interface& i : m.interfaces)
    if (is_open(i)) {
      EXPECT_EQ(i.gap, 0);
    }
}

// Edges that the file shares are not compared again: two boxes that touch stay two.
TEST(Unsewn, ShapesThatAreSewnAreLeftAlone) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  builder.Add(all, BRepPrimAPI_MakeBox(1, 1, 1).Shape());
  builder.Add(all, BRepPrimAPI_MakeBox(gp_Pnt(1, 0, 0), 1, 1, 1).Shape());
  builder.Add(all, taken_apart(BRepPrimAPI_MakeBox(gp_Pnt(2, 0, 0), 1, 1, 1).Shape(), 0, 1e-6));
  carreau_occ::BrepHost host(file_of(all));
  const adapters::MeasuredMesh m = adapters::mesh_and_measure(host, 0.25);
  EXPECT_EQ(m.trouble(true), "");
  EXPECT_EQ(euler(m), 6);
  EXPECT_EQ(m.interfaces.size(), 36U);
  EXPECT_EQ(count(m, is_glued), 12);
}

TEST(Unsewn, IgesOfSeparateFacesComesOutConforming) {
  const std::string path = (std::filesystem::temp_directory_path() / "carreau_unsewn_test.igs").string();
  // In micrometres OpenCASCADE's writer claims a resolution far above the size of the part.
  const std::pair<const char*, const char*> cases[] = {{"box_with_hole", "MM"}, {"cylinder", "MM"},
                                                       {"torus", "MM"},         {"two_cylinders", "MM"},
                                                       {"box_with_hole", "UM"}, {"across_a_seam", "UM"}};
  for (const auto& [name, unit] : cases) {
    SCOPED_TRACE(std::string(name) + " " + unit);
    const TopoDS_Shape solid = shapes::make(name);
    IGESControl_Writer writer(unit, 0);
    for (TopExp_Explorer f(solid, TopAbs_FACE); f.More(); f.Next()) writer.AddShape(f.Current());
    ASSERT_TRUE(writer.Write(path.c_str()));
    carreau_occ::BrepHost whole(file_of(solid)), host(carreau_occ::read_shape(path));
    const double size = whole.diagonal() / 30;
    const adapters::MeasuredMesh expected = adapters::mesh_and_measure(whole, size),
                                 m = adapters::mesh_and_measure(host, size);
    EXPECT_EQ(m.trouble(true), "");
    EXPECT_EQ(euler(m), euler(expected));
    EXPECT_NEAR(std::abs(m.volume) / expected.volume, 1, 2e-3);
  }
  std::filesystem::remove(path);
}

/// A box one edge of which has, on its first face, an image with another parameter: (1 + c) / 2 of the way in the
/// middle, and `off` away from the edge.
TopoDS_Shape box_with_odd_image(double off, double bend) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  TopExp_Explorer faces(box, TopAbs_FACE);
  const TopoDS_Face face = TopoDS::Face(faces.Current());
  const TopoDS_Edge edge = TopoDS::Edge(TopExp_Explorer(face, TopAbs_EDGE).Current());
  double a = 0, b = 0;
  const Handle(Geom2d_Curve) image = BRep_Tool::CurveOnSurface(edge, face, a, b);
  const gp_Pnt2d p = image->Value(a), q = image->Value(b);
  const gp_Vec2d along(p, q), across(-along.Y(), along.X());
  TColgp_Array1OfPnt2d poles(1, 3);
  poles(1) = p;
  poles(2) = p.Translated((0.5 + bend) * along + 2 * off * across.Normalized());
  poles(3) = q;
  TColStd_Array1OfReal knots(1, 2);
  knots(1) = a, knots(2) = b;
  TColStd_Array1OfInteger multiplicities(1, 2);
  multiplicities(1) = multiplicities(2) = 3;
  const BRep_Builder builder;
  builder.UpdateEdge(edge, new Geom2d_BSplineCurve(poles, knots, multiplicities, 2), face, std::max(1e-7, 2 * off));
  builder.SameParameter(edge, Standard_False);
  builder.SameRange(edge, Standard_False);
  return box;
}

// The middle pole at (1/2 + bend) of the chord moves t = 1/2 by bend / 2 along it.
TEST(Interfaces, ImagesOfAnEdgeMayHaveOtherParameters) {
  carreau_occ::BrepHost host(file_of(box_with_odd_image(0, 0.2)));
  const adapters::MeasuredMesh m = adapters::mesh_and_measure(host, 0.1);
  EXPECT_EQ(m.trouble(true), "");
  EXPECT_NEAR(m.volume, 1, 1e-12);
  EXPECT_LT(widest_gap(m), 1e-6);
}

TEST(Interfaces, GapsBetweenImagesOfAnEdgeAreMeasured) {
  const double off = 1e-3;
  carreau_occ::BrepHost host(file_of(box_with_odd_image(off, 0.1)));
  const adapters::MeasuredMesh m = adapters::mesh_and_measure(host, 0.1);
  EXPECT_EQ(m.trouble(true), "");
  // The image is off the edge by `off` at t = 1/2, the largest of its parabola.
  EXPECT_NEAR(widest_gap(m), off, 0.02 * off);
  const auto wide = std::max_element(m.interfaces.begin(), m.interfaces.end(),
                                     [](const auto& i, const auto& j) { return i.gap < j.gap; });
  EXPECT_EQ(wide->uses, 2);
  EXPECT_TRUE(wide->face == 1 || wide->other_face == 1);
  EXPECT_NE(wide->face, wide->other_face);
  for (const carreau_interface& i : m.interfaces)
    if (&i != &*wide) {
      EXPECT_LT(i.gap, 1e-9);
    }
  EXPECT_NEAR(m.volume, 1, off);
}

}  // namespace
