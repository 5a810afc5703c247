// SPDX-License-Identifier: BSD-3-Clause
// Assemblies with placements, units, and faces that several solids share: read back from files and meshed.
#include <gtest/gtest.h>
#include <shape_file.h>

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepToIGES_BREntity.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESBasic_Group.hxx>
#include <IGESBasic_SingularSubfigure.hxx>
#include <IGESBasic_SubfigureDef.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_HArray1OfIGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>
#include <gp_Trsf.hxx>
#include <gp_XYZ.hxx>
#include <iterator>
#include <map>
#include <numbers>
#include <set>

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

double length_of_curve(const adapters::MeasuredMesh& mesh, std::int32_t ref) {
  double length = 0;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    if (mesh.edge_refs[e] != ref) continue;
    const auto &a = mesh.vertices[mesh.edges[e][0]], &b = mesh.vertices[mesh.edges[e][1]];
    length += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }
  return length;
}

TopoDS_Shape placed(const TopoDS_Shape& shape, const gp_Trsf& place) {
  return shape.Moved(TopLoc_Location(place), Standard_False /* mirrors are allowed */);
}

/// A quarter of a turn in a turned and moved assembly in another assembly; one part twice, once mirrored if requested:
/// STEP has no placements that mirror.
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

TEST(Placements, SeveralLevelsMatchStep) {
  const std::string path = path_of("rig.step");
  STEPControl_Writer writer;
  ASSERT_EQ(writer.Transfer(assembly(false), STEPControl_AsIs), IFSelect_RetDone);
  ASSERT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
  expect_assembly(path);
}

TEST(Placements, SeveralLevelsAndMirroredMatchBrep) {
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
  EXPECT_EQ(host.glue_tolerances().of_all, 0);
  EXPECT_TRUE(host.is_closed());
  const adapters::MeasuredMesh m = adapters::mesh_and_measure(host, 0.25);
  EXPECT_EQ(m.status, CARREAU_OK) << m.error;
  EXPECT_TRUE(m.failed.empty());
  EXPECT_EQ(m.open_edges, 0);
  EXPECT_EQ(m.crowded_edges, 4 * 13);  // the middle edge, and four from its ends each, to four edges' length each
  EXPECT_NEAR(m.quality.area, 20, 1e-9);
  std::filesystem::remove(path);
}

/// An IGES file of entities that the caller builds on a writer's model.
template <typename Build>
std::string iges_file(const std::string& name, Build&& build) {
  IGESControl_Controller::Init();
  const std::string path = path_of(name);
  IGESControl_Writer writer("MM", 0);
  BRepToIGES_BREntity tool;
  tool.SetModel(writer.Model());
  build(writer, tool);
  writer.ComputeModel();
  EXPECT_TRUE(writer.Write(path.c_str()));
  return path;
}

Handle(IGESData_HArray1OfIGESEntity) list_of(const std::vector<Handle(IGESData_IGESEntity)>& entities) {
  const Handle(IGESData_HArray1OfIGESEntity) list =
      new IGESData_HArray1OfIGESEntity(1, static_cast<int>(entities.size()));
  for (std::size_t i = 0; i < entities.size(); ++i) list->SetValue(static_cast<int>(i + 1), entities[i]);
  return list;
}

Handle(IGESBasic_SubfigureDef)
    subfigure(int depth, const char* name, const std::vector<Handle(IGESData_IGESEntity)>& entities) {
  const Handle(IGESBasic_SubfigureDef) definition = new IGESBasic_SubfigureDef;
  definition->Init(depth, new TCollection_HAsciiString(name), list_of(entities));
  return definition;
}

Handle(IGESBasic_SingularSubfigure) instance(const Handle(IGESBasic_SubfigureDef) & of, double x, double scale = 1) {
  const Handle(IGESBasic_SingularSubfigure) placed = new IGESBasic_SingularSubfigure;
  placed->Init(of, gp_XYZ(x, 0, 0), scale != 1, scale);
  return placed;
}

struct Read {
  carreau_occ::ShapeFile file;
  adapters::MeasuredMesh mesh;
};
Read read_and_mesh(const std::string& path, double size) {
  Read read{carreau_occ::read_shape(path), {}};
  carreau_occ::BrepHost host(read.file);
  read.mesh = adapters::mesh_and_measure(host, size, [&](carreau_session* session) {
    if (host.glue_tolerances().of_all > 0) {
      carreau_set_integer(session, "glue_open", 1);
      carreau_set_real(session, "eps_glue", host.glue_tolerances().of_all);
    }
  });
  std::filesystem::remove(path);
  return read;
}

// A pair of blocks, twice: entities 308 and 408 on two levels.
TEST(Placements, SubfiguresMatchIges) {
  const std::string path = iges_file("subfigures.igs", [](IGESControl_Writer& writer, BRepToIGES_BREntity& tool) {
    const auto block = subfigure(0, "BLOCK", {tool.TransferShape(BRepPrimAPI_MakeBox(1, 2, 3).Shape())});
    const auto pair = subfigure(1, "PAIR", {instance(block, 0), instance(block, 5)});
    for (const double x : {0., 20.}) writer.AddEntity(instance(pair, x));
  });
  const Read read = read_and_mesh(path, 0.5);
  EXPECT_TRUE(read.file.losses.empty()) << read.file.losses.front();
  EXPECT_EQ(read.mesh.trouble(true), "");
  EXPECT_NEAR(read.mesh.quality.area, 4 * 22, 1e-9);
  EXPECT_NEAR(read.mesh.volume, 4 * 6, 1e-9);
  double far = 0;
  for (const auto& p : read.mesh.vertices) far = std::max(far, p[0]);
  EXPECT_NEAR(far, 26, 1e-9);
}

TEST(Placements, SubfiguresThatScaleAreReported) {
  const std::string path = iges_file("scaled.igs", [](IGESControl_Writer& writer, BRepToIGES_BREntity& tool) {
    const auto block = subfigure(0, "BLOCK", {tool.TransferShape(BRepPrimAPI_MakeBox(1, 2, 3).Shape())});
    writer.AddEntity(instance(block, 0));
    writer.AddEntity(instance(block, 10, 2));
  });
  const Read read = read_and_mesh(path, 0.5);
  ASSERT_EQ(read.file.losses.size(), 1U);
  EXPECT_NE(read.file.losses.front().find("an instance with the scale 2 is not placed"), std::string::npos)
      << read.file.losses.front();
  EXPECT_EQ(read.mesh.trouble(true), "");
  EXPECT_NEAR(read.mesh.quality.area, 22, 1e-9);
}

TEST(Placements, GroupsOfIgesAreWhole) {
  const std::string path = iges_file("group.igs", [](IGESControl_Writer& writer, BRepToIGES_BREntity& tool) {
    const Handle(IGESBasic_Group) group = new IGESBasic_Group;
    group->Init(list_of({tool.TransferShape(BRepPrimAPI_MakeBox(1, 2, 3).Shape()),
                         tool.TransferShape(BRepPrimAPI_MakeBox(gp_Pnt(5, 0, 0), 1, 1, 1).Shape())}));
    writer.AddEntity(group);
  });
  const Read read = read_and_mesh(path, 0.5);
  EXPECT_TRUE(read.file.losses.empty()) << read.file.losses.front();
  EXPECT_EQ(read.mesh.trouble(true), "");
  EXPECT_NEAR(read.mesh.quality.area, 22 + 6, 1e-9);
}

TEST(Placements, ThatScaleMatchBrep) {
  gp_Trsf twice;
  twice.SetScale(gp_Pnt(1, 0, 0), 2);
  const TopoDS_Shape post = placed(BRepPrimAPI_MakeCylinder(1, 4).Shape(), twice);
  const std::string path = path_of("scaled.brep");
  ASSERT_TRUE(BRepTools::Write(post, path.c_str()));
  const Read read = read_and_mesh(path, 0.3);
  EXPECT_EQ(read.mesh.trouble(true), "");
  EXPECT_NEAR(read.mesh.volume / (8 * 4 * std::numbers::pi), 1, 0.01);
  double low = 0;
  for (const auto& p : read.mesh.vertices) low = std::min(low, p[0]);
  EXPECT_NEAR(low, -3, 0.02);
}

// OpenCASCADE's writer has no placement that scales: the test edits a placement that it wrote.
TEST(Placements, ThatScaleAreReportedInStep) {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  gp_Trsf move;
  move.SetTranslation(gp_Vec(10, 0, 0));
  const std::string path = path_of("scaled.step");
  STEPControl_Writer writer;
  ASSERT_EQ(writer.Transfer(together({block, placed(block, move)}), STEPControl_AsIs), IFSelect_RetDone);
  ASSERT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
  std::ifstream in(path);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  in.close();
  const std::string rigid = "ITEM_DEFINED_TRANSFORMATION(";
  const std::size_t from = text.rfind(rigid);
  ASSERT_NE(from, std::string::npos);
  const std::size_t to = text.find(';', from);
  text.replace(from, to - from,
               "CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',$,$,#900001,2.,$);\n"
               "#900001 = CARTESIAN_POINT('',(10.,0.,0.))");
  std::ofstream(path) << text;
  const Read read = read_and_mesh(path, 0.5);
  ASSERT_EQ(read.file.losses.size(), 1U);
  EXPECT_NE(read.file.losses.front().find("its scale of 2 is not applied"), std::string::npos)
      << read.file.losses.front();
  EXPECT_EQ(read.mesh.trouble(true), "");
}

// Free curves have edges, and shares of the diagonal do not count them.
TEST(Placements, EdgesOfNoFaceChangeNoFace) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  const TopoDS_Shape far = BRepBuilderAPI_MakeEdge(gp_Pnt(5, 5, 5), gp_Pnt(90, 90, 90)).Edge();
  const std::string path = path_of("loose.brep");
  ASSERT_TRUE(BRepTools::Write(together({box, far}), path.c_str()));
  const carreau_occ::ShapeFile file = carreau_occ::read_shape(path);
  EXPECT_NEAR(carreau_occ::BrepHost(file).diagonal(), std::sqrt(3.0), 1e-6);
  EXPECT_TRUE(carreau_occ::BrepHost(file).is_closed());
  const Read read = read_and_mesh(path, 0.25);
  EXPECT_EQ(read.mesh.trouble(true), "");
  EXPECT_NEAR(read.mesh.quality.area, 6, 1e-12);
  EXPECT_NEAR(length_of_curve(read.mesh, 13), 85 * std::sqrt(3.0), 1e-9);
}

/// A box and, beside it, a wire of a line, from the corner (1, 1, 1), and three quarters of a circle of radius 2.
TopoDS_Shape box_and_wire() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  const gp_Circ circle(gp_Ax2(gp_Pnt(4, 1, 1), gp_Dir(0, 0, 1), gp_Dir(-1, 0, 0)), 2);
  const TopoDS_Edge line = BRepBuilderAPI_MakeEdge(gp_Pnt(1, 1, 1), gp_Pnt(2, 1, 1)).Edge();
  const TopoDS_Edge arc =
      BRepBuilderAPI_MakeEdge(circle, TopExp::LastVertex(line), BRepBuilderAPI_MakeVertex(gp_Pnt(4, 3, 1)).Vertex())
          .Edge();
  BRepBuilderAPI_MakeWire wire(line);
  wire.Add(arc);
  return together({box, wire.Wire()});
}

std::string written_as_step(const TopoDS_Shape& shape, const std::string& name) {
  STEPControl_Writer writer;
  EXPECT_EQ(writer.Transfer(shape, STEPControl_AsIs), IFSelect_RetDone);
  EXPECT_EQ(writer.Write(path_of(name).c_str()), IFSelect_RetDone);
  return path_of(name);
}

// A STEP file with a wire beside a box: all edges of the wire are in the mesh, and meet where the file's edges meet.
TEST(Placements, AWireBesideABoxOfAStepFileIsMeshed) {
  const std::string path = written_as_step(box_and_wire(), "wire.step");
  const carreau_occ::ShapeFile file = carreau_occ::read_shape(path);
  EXPECT_EQ(carreau_occ::BrepHost(file).wire_count(), 2);
  const Read read = read_and_mesh(path, 0.1);
  EXPECT_EQ(read.mesh.trouble(true), "");
  EXPECT_EQ(read.mesh.faces, 6);
  EXPECT_NEAR(read.mesh.quality.area, 6, 1e-12);
  std::map<int, double> lengths;  // of the edges beyond the box
  std::map<std::int32_t, int> ends;
  for (std::size_t e = 0; e < read.mesh.edges.size(); ++e) {
    const auto &a = read.mesh.vertices[read.mesh.edges[e][0]], &b = read.mesh.vertices[read.mesh.edges[e][1]];
    if (std::max(a[0], b[0]) <= 1 + 1e-9) continue;
    lengths[read.mesh.edge_refs[e]] += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    for (const std::int32_t v : read.mesh.edges[e]) ++ends[v];
    for (const auto& p : {a, b})
      EXPECT_TRUE(std::abs(std::hypot(p[0] - 4, p[1] - 1) - 2) < 1e-9 || std::abs(p[1] - 1) < 1e-9);
  }
  ASSERT_EQ(lengths.size(), 2U);
  const auto [line, arc] = std::minmax(lengths.begin()->second, lengths.rbegin()->second);
  EXPECT_NEAR(line, 1, 1e-9);
  EXPECT_TRUE(std::abs(arc - std::numbers::pi) < 2e-3 || std::abs(arc - 3 * std::numbers::pi) < 6e-3) << arc;
  // One chain, although STEP gives each edge its own vertices: two ends, one of them a corner of the box.
  EXPECT_EQ(std::count_if(ends.begin(), ends.end(), [](const auto& end) { return end.second == 1; }), 2);
  std::set<std::int32_t> on_faces;
  for (const auto& t : read.mesh.triangles) on_faces.insert(t.begin(), t.end());
  EXPECT_EQ(std::count_if(ends.begin(), ends.end(), [&](const auto& end) { return on_faces.contains(end.first); }), 1);
}

// In a BREP file edges and faces may have vertices in common: the mesh has one vertex there.
TEST(Placements, AnEdgeFromACornerOfABoxStartsAtTheBoxsVertex) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  TopTools_IndexedMapOfShape corners;
  TopExp::MapShapes(box, TopAbs_VERTEX, corners);
  const TopoDS_Vertex far = BRepBuilderAPI_MakeVertex(gp_Pnt(7, 8, 9)).Vertex();
  const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(TopoDS::Vertex(corners(1)), far).Edge();
  const std::string path = path_of("corner.brep");
  ASSERT_TRUE(BRepTools::Write(together({box, edge}), path.c_str()));
  const Read read = read_and_mesh(path, 0.25);
  EXPECT_EQ(read.mesh.trouble(true), "");
  std::set<std::int32_t> on_faces, on_edge;
  for (const auto& t : read.mesh.triangles) on_faces.insert(t.begin(), t.end());
  for (std::size_t e = 0; e < read.mesh.edges.size(); ++e)
    if (read.mesh.edge_refs[e] == 13) on_edge.insert(read.mesh.edges[e].begin(), read.mesh.edges[e].end());
  EXPECT_EQ(std::count_if(on_edge.begin(), on_edge.end(), [&](std::int32_t v) { return on_faces.contains(v); }), 1);
  const double l = std::hypot(7, 8, 9);
  EXPECT_TRUE(std::abs(length_of_curve(read.mesh, 13) - l) < 2) << length_of_curve(read.mesh, 13);
}

}  // namespace
