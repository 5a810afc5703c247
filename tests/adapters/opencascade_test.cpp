// SPDX-License-Identifier: BSD-3-Clause
// CAD shapes through the adapter and the C interface, against OpenCASCADE's measures.
#include <extent.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <Standard_NumericError.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <cmath>
#include <gp_Ax1.hxx>
#include <gp_Trsf.hxx>

#include "measured_mesh.h"
#include "odd_cylinder.h"
#include "shape_report.h"
#include "shapes.h"

namespace {

carreau_occ::ShapeFile file_of(const TopoDS_Shape& shape) { return {.shape = shape, .labels = {}, .unit = ""}; }

double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties, 1e-10);
  return properties.Mass();
}

class Torture : public testing::TestWithParam<std::string> {};

// A curved surface that is meshed with edges of length h lies within O(h^2) of its mesh.
TEST_P(Torture, VolumeConvergesAtSecondOrder) {
  const TopoDS_Shape shape = shapes::make(GetParam());
  carreau_occ::BrepHost host(file_of(shape));
  const double exact = volume_of(shape), diagonal = host.diagonal();
  ASSERT_TRUE(host.is_closed());
  double error[2];
  for (int i = 0; i < 2; ++i) {
    const adapters::MeasuredMesh m = adapters::mesh_and_measure(host, diagonal / (i == 0 ? 30 : 120));
    ASSERT_EQ(m.trouble(true), "");
    error[i] = std::abs(m.volume / exact - 1);
  }
  const double order = std::log(error[0] / error[1]) / std::log(4);
  EXPECT_GT(order, 1.85);
  EXPECT_LT(order, 2.15);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Torture,
                         testing::Values("sphere", "torus", "cone", "cylinder", "box_with_hole", "nurbs_sphere",
                                         "nurbs_torus", "across_a_seam", "through_a_pole", "two_cylinders"),
                         [](const auto& info) { return info.param; });

TEST(BrepHost, EvaluatesTheSurfaceAboutOnceAVertexBesideTheSampling) {
  for (const char* name : {"sphere", "nurbs_torus"}) {
    SCOPED_TRACE(name);
    carreau_occ::BrepHost host(file_of(shapes::make(name)));
    const adapters::MeasuredMesh m = adapters::mesh_and_measure(host, host.diagonal() / 200);
    EXPECT_LT(static_cast<double>(m.surface_calls) / static_cast<double>(m.vertices.size()), 2);
  }
}

// Every shape whose surfaces are of several polynomials or of one; the results are identical.
TEST(BrepHost, ThreadsDoNotChangeTheMesh) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  for (const char* name : {"nurbs_torus", "across_a_seam", "two_cylinders"}) {
    SCOPED_TRACE(name);
    const carreau_occ::ShapeFile file = file_of(shapes::make(name));
    adapters::MeasuredMesh one;
    for (const int threads : {1, 2, 8}) {
      carreau_occ::BrepHost host(file);
      const adapters::MeasuredMesh m =
          adapters::mesh_and_measure(host, host.diagonal() / 60, [threads](carreau_session* s) {
            carreau_set_integer(s, "threads", threads);
            carreau_set_integer(s, "hgeo_flag", 1);
          });
      ASSERT_EQ(m.trouble(true), "");
      if (threads == 1) one = m;
      EXPECT_EQ(m.vertices, one.vertices);
      EXPECT_EQ(m.triangles, one.triangles);
      EXPECT_EQ(m.surface_calls, one.surface_calls);
    }
  }
}

TEST(BrepHost, ExceptionsOfOpenCascadeNameTheFace) {
  for (const int threads : {1, 2}) {
    const TopoDS_Shape solid = adapters::odd_cylinder([](double u, double v) {
      if (adapters::is_inside(u, v)) throw Standard_NumericError("on purpose");
    });
    carreau_occ::BrepHost host(file_of(solid));
    const auto run = [&](const char* failing_faces) {
      return adapters::mesh_and_measure(host, 0.2, [&](carreau_session* s) {
        carreau_set_integer(s, "threads", threads);
        carreau_set_text(s, "failing_faces", failing_faces);
      });
    };
    const adapters::MeasuredMesh failed = run("stop");
    EXPECT_EQ(failed.status, CARREAU_ERR_CALLBACK);
    EXPECT_NE(failed.error.find("face 1"), std::string::npos) << failed.error;
    EXPECT_NE(host.failure(1).find("Standard_NumericError: on purpose"), std::string::npos) << host.failure(1);
    EXPECT_EQ(host.failure(2), "");
    EXPECT_NE(failed.error.find("Standard_NumericError: on purpose"), std::string::npos) << failed.error;
    const adapters::MeasuredMesh others = run("leave_out");
    EXPECT_EQ(others.status, CARREAU_ERR_PARTIAL);
    ASSERT_EQ(others.failed.size(), 1U);
    EXPECT_NE(others.failed.front().find("Standard_NumericError: on purpose"), std::string::npos);
    EXPECT_NEAR(others.quality.area, 2 * std::acos(-1.0), 0.05);  // the two lids
  }
}

TEST(BrepHost, SizesOfFacesHoldOnTheirEdges) {
  carreau_occ::BrepHost host(file_of(BRepPrimAPI_MakeBox(1, 1, 1).Shape()));
  ASSERT_TRUE(host.set_face_size("1", 0.05));
  EXPECT_FALSE(host.set_face_size("7", 0.05));
  const adapters::MeasuredMesh m =
      adapters::mesh_and_measure(host, 0.25, [](carreau_session* s) { carreau_set_integer(s, "hphy_flag", 2); });
  EXPECT_EQ(m.trouble(true), "");
  EXPECT_NEAR(m.volume, 1, 1e-12);
  const auto fine = std::count(m.refs.begin(), m.refs.end(), 1);
  EXPECT_NEAR(static_cast<double>(fine), 1 / (std::sqrt(3.0) / 4 * 0.05 * 0.05), 100);
}

TEST(ShapeReport, FindsPotentialMeshingProblems) {
  const carreau_occ::ShapeReport sliver = carreau_occ::inspect(file_of(shapes::make("sliver")));
  int narrow = 0, tiny = 0;
  for (const carreau_occ::Danger& danger : sliver.dangers) {
    narrow += danger.kind == "sliver face" ? 1 : 0;
    tiny += danger.kind == "tiny edge" ? 1 : 0;
    if (danger.kind == "tiny edge") {
      EXPECT_NEAR(danger.value, 1e-4 * std::sqrt(3.0), 1e-9);
    }
  }
  EXPECT_EQ(narrow, 1);
  EXPECT_EQ(tiny, 2);
  EXPECT_NEAR(sliver.volume, 1, 1e-7);
  const carreau_occ::ShapeReport sphere = carreau_occ::inspect(file_of(BRepPrimAPI_MakeSphere(1).Shape()));
  EXPECT_EQ(sphere.poles, 2);
  EXPECT_EQ(sphere.seams, 1);
  EXPECT_TRUE(sphere.dangers.empty());
  EXPECT_NEAR(sphere.area, 4 * std::acos(-1.0), 1e-6);
}

// A roof of one B-spline face of degree 1, whose sides fall by 30 degrees; circles as rational splines have knots of
// full multiplicity as well, but bend nowhere.
TEST(ShapeReport, FindsKinksInsideFaces) {
  const Handle(Geom_BSplineSurface) roof = shapes::roof();
  const carreau_occ::ShapeFile whole = file_of(BRepBuilderAPI_MakeFace(roof, 1e-7).Face());
  const auto kinks = carreau_occ::find_kinks(whole);
  ASSERT_EQ(kinks.size(), 1U);
  EXPECT_NEAR(kinks[0].value, 60, 1e-4);
  EXPECT_EQ(kinks[0].face, 1);
  EXPECT_NE(kinks[0].text.find("u = 0.25"), std::string::npos) << kinks[0].text;
  const carreau_occ::ShapeReport report = carreau_occ::inspect(whole);
  EXPECT_EQ(std::count_if(report.dangers.begin(), report.dangers.end(), [](const auto& d) { return d.kind == "kink"; }),
            1);
  // Half of it: the knot is no longer inside.
  EXPECT_TRUE(carreau_occ::find_kinks(file_of(BRepBuilderAPI_MakeFace(roof, 0.25, 1, 0, 1, 1e-7).Face())).empty());
  const TopoDS_Shape torus = BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeTorus(2, 0.5).Shape(), Standard_True).Shape();
  EXPECT_TRUE(carreau_occ::find_kinks(file_of(torus)).empty());
}

TEST(ShapeReport, FindsWideTolerances) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  const TopExp_Explorer edge(box, TopAbs_EDGE);
  BRep_Builder().UpdateEdge(TopoDS::Edge(edge.Current()), 0.01);
  const carreau_occ::ShapeReport report = carreau_occ::inspect(file_of(box));
  ASSERT_EQ(report.dangers.size(), 1U);
  EXPECT_EQ(report.dangers[0].kind, "wide tolerance");
  EXPECT_EQ(report.dangers[0].value, 0.01);
}

TEST(ShapeReport, FindsFreeEdges) {
  TopExp_Explorer faces(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), TopAbs_FACE);
  const carreau_occ::ShapeReport report = carreau_occ::inspect(file_of(faces.Current()));
  EXPECT_EQ(report.dangers.size(), 4u);
  for (const carreau_occ::Danger& danger : report.dangers) EXPECT_EQ(danger.kind, "free edge");
}

// Splines are no quadrics: their boxes are found on the surface.
TEST(Diagonal, IsExactForFreeFormFaces) {
  const auto diagonal = [](const TopoDS_Shape& shape) {
    return carreau_occ::diagonal_of(BRepBuilderAPI_NurbsConvert(shape, Standard_True).Shape());
  };
  EXPECT_NEAR(diagonal(BRepPrimAPI_MakeSphere(1).Shape()), 2 * std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(diagonal(BRepPrimAPI_MakeTorus(2, 0.5).Shape()), std::sqrt(51.0), 1e-6);
  gp_Trsf turned;  // no extreme is at a seam, a knot or a pole
  turned.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(1, 2, 3)), 1);
  EXPECT_NEAR(diagonal(BRepPrimAPI_MakeSphere(1).Shape().Moved(TopLoc_Location(turned))), 2 * std::sqrt(3.0), 1e-6);
}

}  // namespace
