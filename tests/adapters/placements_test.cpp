// Assemblies with placements, units, and faces that several solids share: read back from files and meshed.
#include <gtest/gtest.h>
#include <shape_file.h>

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <array>
#include <cmath>
#include <filesystem>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>
#include <numbers>

#include "measured_mesh.h"

namespace {

std::string path_of(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("carreau_placements_" + name)).string();
}

TopoDS_Compound together(const std::vector<TopoDS_Shape>& parts) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& part : parts) builder.Add(all, part);
  return all;
}

TopoDS_Shape placed(const TopoDS_Shape& shape, const gp_Trsf& place) {
  return shape.Moved(TopLoc_Location(place), Standard_False /* mirrors are allowed */);
}

/// A quarter of a turn in a turned and moved assembly in another one; one part twice, once mirrored if asked: STEP has
/// no placements that mirror.
TopoDS_Shape assembly(bool mirrored) {
  gp_Trsf turn, move, mirror;
  turn.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), std::numbers::pi / 2);
  move.SetTranslation(gp_Vec(10, 0, 0));
  if (mirrored)
    mirror.SetMirror(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 1, 0)));
  else
    mirror.SetTranslation(gp_Vec(0, -6, 0));
  const TopoDS_Shape post = BRepPrimAPI_MakeCylinder(1, 4).Shape(),
                     block = BRepPrimAPI_MakeBox(gp_Pnt(3, 2, 0), 1, 2, 3).Shape();
  const TopoDS_Shape inner = together({placed(post, turn), block, placed(block, mirror)});
  return together({inner, placed(together({placed(inner, turn)}), move)});
}

void expect_assembly(const std::string& path) {
  SCOPED_TRACE(path);
  const carreau_occ::ShapeFile file = carreau_occ::read_shape(path);
  EXPECT_TRUE(file.losses.empty());
  carreau_occ::BrepHost host(file);
  EXPECT_EQ(host.face_count(), 2 * (3 + 6 + 6));
  const adapters::MeasuredMesh m = adapters::mesh_and_measure(host, 0.4);
  EXPECT_EQ(m.trouble(true), "");
  EXPECT_NEAR(m.volume / (2 * (4 * std::numbers::pi + 12)), 1, 0.02);
  std::array<double, 3> low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  for (const auto& p : m.vertices)
    for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  // The turned half has the blocks at x in 10 + [-4, 4], y in [3, 4].
  const std::array<double, 3> from{-1, -4, 0}, to{14, 4, 4};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(low[i], from[i], 0.03);
    EXPECT_NEAR(high[i], to[i], 0.03);
  }
  std::filesystem::remove(path);
}

TEST(Placements, OfSeveralLevelsAreThoseOfStep) {
  const std::string path = path_of("rig.step");
  STEPControl_Writer writer;
  ASSERT_EQ(writer.Transfer(assembly(false), STEPControl_AsIs), IFSelect_RetDone);
  ASSERT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
  expect_assembly(path);
}

TEST(Placements, OfSeveralLevelsAndMirroredAreThoseOfBrep) {
  const std::string path = path_of("rig.brep");
  ASSERT_TRUE(BRepTools::Write(assembly(true), path.c_str()));
  expect_assembly(path);
}

TEST(Placements, UnitsOfFilesAreMillimetresAfterwards) {
  for (const auto& [unit, millimetres] : {std::pair{"MM", 1.}, {"INCH", 25.4}, {"M", 1000.}}) {
    for (const std::string suffix : {".step", ".igs"}) {
      SCOPED_TRACE(unit + suffix);
      const std::string path = path_of("unit" + suffix);
      const TopoDS_Shape box = BRepPrimAPI_MakeBox(2 * millimetres, millimetres, millimetres).Shape();
      if (suffix == ".step") {
        STEPControl_Controller::Init();
        Interface_Static::SetCVal("write.step.unit", unit);
        STEPControl_Writer writer;
        ASSERT_EQ(writer.Transfer(box, STEPControl_AsIs), IFSelect_RetDone);
        ASSERT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
        Interface_Static::SetCVal("write.step.unit", "MM");
      } else {
        IGESControl_Writer writer(unit, 1);
        writer.AddShape(box);
        ASSERT_TRUE(writer.Write(path.c_str()));
      }
      carreau_occ::BrepHost host(carreau_occ::read_shape(path));
      const adapters::MeasuredMesh m = adapters::mesh_and_measure(host, millimetres / 4);
      EXPECT_EQ(m.trouble(true), "");
      EXPECT_NEAR(m.volume / (2 * std::pow(millimetres, 3)), 1, 1e-6);
      std::filesystem::remove(path);
    }
  }
}

// Four boxes around one edge: it belongs to four faces, which belong to two boxes each.
TEST(Placements, FacesThatSolidsShareAreMeshedOnce) {
  TopTools_ListOfShape boxes;
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
    boxes.Append(BRepPrimAPI_MakeBox(gp_Pnt(x, y, 0), 1, 1, 1).Shape());
  BRepAlgoAPI_BuilderAlgo fuse;
  fuse.SetArguments(boxes);
  fuse.Build();
  const std::string path = path_of("cells.brep");
  ASSERT_TRUE(BRepTools::Write(fuse.Shape(), path.c_str()));
  carreau_occ::BrepHost host(carreau_occ::read_shape(path));
  EXPECT_EQ(host.face_count(), 20);  // 24 less the 4 that are shared
  EXPECT_EQ(host.glue_tolerance(), 0);
  EXPECT_FALSE(host.is_closed());
  const adapters::MeasuredMesh m = adapters::mesh_and_measure(host, 0.25);
  EXPECT_EQ(m.status, CARREAU_OK) << m.error;
  EXPECT_TRUE(m.failed.empty());
  EXPECT_EQ(m.open_edges, 0);
  EXPECT_EQ(m.crowded_edges, 4 * 13);  // the middle edge, and four from its ends each, to four edges' length each
  EXPECT_NEAR(m.quality.area, 20, 1e-9);
  std::filesystem::remove(path);
}

}  // namespace
