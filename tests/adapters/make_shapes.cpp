// SPDX-License-Identifier: BSD-3-Clause
// make_shapes FOLDER: files for the tests of the command, made by OpenCASCADE itself.
//   NAME.step, NAME.brep   each shape of the torture set
//   assembly.step          two boxes of one part "block", placed apart, and a "ball", in an assembly "rig"
//   named_faces.step       a box whose six faces are called bottom, top and side; the box is green, its top orange
//   press.step             an assembly "press" of the part "plate" (4 x 4 x 1, on layer "walls") and two parts "stamp" (cubes
//                          of side 1, on layer "tools") on it; the plate has a top named "contact", a side named "#197",
//                          an edge "rim" and a vertex "corner"
//   bracket.step           a part whose faces have names: bracket.h
//   inch.step              a cube of one inch
//   open.igs               five faces of a box, each on its own
//   plate.step, .brep, .igs   a plate with a hole, all of NURBS
//   quarter_plate.step     a unit square without the quarter of a disc (HDR fig. 3.6): a face
//   free.brep              a face with an edge inside, and a box whose orientation is reversed
//   touching.brep          a plate of 4 x 4 x 1 and a cube of side 2 on it
//   wires.brep             three sides of a unit square and no face; loose.brep: the same beside a unit cube;
//                          scribed.brep: a unit cube, a wire on two of its faces, and an edge that leaves it
//   outside.step           the same assembly; its parts are in outside_block.stp and outside_ball.stp
//   NAME.brep              faces that bend inside: bent_shapes()
//   torn_roof.brep         one that is not cut there, since its sides do not meet
//   bent.step              the prism of bent_shapes(), whose side is named "side" and red
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Writer.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <cstdio>
#include <exception>
#include <gp.hxx>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>
#include <gp_Trsf.hxx>
#include <stdexcept>
#include <string>

#include "bent_shapes.h"
#include "bracket.h"
#include "shapes.h"

namespace {

void require(bool good, const std::string& path) {
  if (!good) throw std::runtime_error(path + " cannot be written");
}

void write_step(const TopoDS_Shape& shape, const std::string& path) {
  STEPControl_Writer writer;
  require(
      writer.Transfer(shape, STEPControl_AsIs) == IFSelect_RetDone && writer.Write(path.c_str()) == IFSelect_RetDone,
      path);
}

void name(const TDF_Label& label, const char* text) { TDataStd_Name::Set(label, text); }

TopLoc_Location at(double x, double y, double z) {
  gp_Trsf move;
  move.SetTranslation(gp_Vec(x, y, z));
  return TopLoc_Location(move);
}

void write_document(const Handle(TDocStd_Document) & document, const std::string& path) {
  STEPCAFControl_Writer writer;
  Interface_Static::SetIVal("write.stepcaf.subshapes.name", 1);
  require(writer.Transfer(document) && writer.Write(path.c_str()) == IFSelect_RetDone, path);
}

/// In one file, and in one of each part.
void write_assembly(const std::string& path) {
  Handle(TDocStd_Document) document = new TDocStd_Document("XmlXCAF");
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const TDF_Label block = shapes->AddShape(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), Standard_False);
  const TDF_Label ball = shapes->AddShape(BRepPrimAPI_MakeSphere(1).Shape(), Standard_False);
  const TDF_Label rig = shapes->NewShape();
  name(block, "block"), name(ball, "ball"), name(rig, "rig");
  shapes->AddComponent(rig, block, at(10, 0, 0));
  shapes->AddComponent(rig, block, at(20, 0, 0));
  shapes->AddComponent(rig, ball, at(0, 0, 10));
  shapes->UpdateAssemblies();
  write_document(document, path + "assembly.step");
  STEPCAFControl_Writer outside;
  require(outside.Transfer(document, STEPControl_AsIs, "outside_") &&
              outside.Write((path + "outside.step").c_str()) == IFSelect_RetDone,
          "outside.step");
}

void write_named_faces(const std::string& path) {
  Handle(TDocStd_Document) document = new TDocStd_Document("XmlXCAF");
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  BRepPrimAPI_MakeBox box(1, 1, 1);
  const TopoDS_Face bottom = box.BottomFace(), top = box.TopFace();
  const TDF_Label whole = shapes->AddShape(box.Shape(), Standard_False);
  name(whole, "box");
  const auto colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const auto colour = [](int red, int green, int blue) {
    return Quantity_Color(red / 255.0, green / 255.0, blue / 255.0, Quantity_TOC_sRGB);
  };
  colours->SetColor(whole, colour(64, 160, 48), XCAFDoc_ColorGen);
  for (TopExp_Explorer e(box.Shape(), TopAbs_FACE); e.More(); e.Next()) {
    const TDF_Label face = shapes->AddSubShape(whole, e.Current());
    name(face, e.Current().IsSame(bottom) ? "bottom" : e.Current().IsSame(top) ? "top" : "side");
    if (e.Current().IsSame(top)) colours->SetColor(face, colour(255, 128, 0), XCAFDoc_ColorSurf);
  }
  write_document(document, path);
}

void write_press(const std::string& path) {
  Handle(TDocStd_Document) document = new TDocStd_Document("XmlXCAF");
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto layers = XCAFDoc_DocumentTool::LayerTool(document->Main());
  BRepPrimAPI_MakeBox box(4, 4, 1);
  const TDF_Label plate = shapes->AddShape(box.Shape(), Standard_False);
  const TDF_Label stamp = shapes->AddShape(BRepPrimAPI_MakeBox(1, 1, 1).Shape(), Standard_False);
  name(plate, "plate"), name(stamp, "stamp");
  layers->SetLayer(plate, "walls"), layers->SetLayer(stamp, "tools");
  name(shapes->AddSubShape(plate, box.TopFace()), "contact");
  name(shapes->AddSubShape(plate, box.FrontFace()), "#197");
  const TopoDS_Shape rim = TopExp_Explorer(box.TopFace(), TopAbs_EDGE).Current();
  name(shapes->AddSubShape(plate, rim), "rim");
  name(shapes->AddSubShape(plate, TopExp_Explorer(rim, TopAbs_VERTEX).Current()), "corner");
  const TDF_Label press = shapes->NewShape();
  name(press, "press");
  shapes->AddComponent(press, plate, at(10, 0, 0));
  shapes->AddComponent(press, stamp, at(10.5, 1, 1));
  shapes->AddComponent(press, stamp, at(12.5, 1, 1));
  shapes->UpdateAssemblies();
  write_document(document, path);
}

void write_bracket(const std::string& path) {
  Handle(TDocStd_Document) document = new TDocStd_Document("XmlXCAF");
  const auto tool = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const TopoDS_Shape bracket = shapes::bracket();
  const TDF_Label whole = tool->AddShape(bracket, Standard_False);
  name(whole, "bracket");
  for (TopExp_Explorer e(bracket, TopAbs_FACE); e.More(); e.Next())
    name(tool->AddSubShape(whole, e.Current()), shapes::name_in_bracket(TopoDS::Face(e.Current())).c_str());
  write_document(document, path);
}

void write_step_of_bent(const std::string& path) {
  Handle(TDocStd_Document) document = new TDocStd_Document("XmlXCAF");
  const auto tool = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  TopoDS_Shape prism;
  for (const shapes::BentShape& bent : shapes::bent_shapes())
    if (bent.name == "prism") prism = bent.make();
  const TDF_Label whole = tool->AddShape(prism, Standard_False);
  const TDF_Label side = tool->AddSubShape(whole, TopExp_Explorer(prism, TopAbs_FACE).Current());
  name(whole, "prism"), name(side, "side");
  XCAFDoc_DocumentTool::ColorTool(document->Main())
      ->SetColor(side, Quantity_Color(1, 0, 0, Quantity_TOC_sRGB), XCAFDoc_ColorSurf);
  write_document(document, path);
}

void write_open_iges(const std::string& path) {
  IGESControl_Writer writer("MM", 0);
  int left = 5;
  for (TopExp_Explorer e(BRepPrimAPI_MakeBox(2, 2, 2).Shape(), TopAbs_FACE); e.More() && left > 0; e.Next(), --left)
    writer.AddShape(e.Current());
  require(writer.Write(path.c_str()), path);
}

void write_plate(const std::string& path) {
  const TopoDS_Shape plate = BRepBuilderAPI_NurbsConvert(shapes::make("box_with_hole"), Standard_True).Shape();
  write_step(plate, path + ".step");
  require(BRepTools::Write(plate, (path + ".brep").c_str()), path);
  IGESControl_Writer writer("MM", 1);  // 1: faces of solids
  writer.AddShape(plate);
  require(writer.Write((path + ".igs").c_str()), path);
}

void write_quarter_plate(const std::string& path) {
  const gp_Circ circle(gp_Ax2(gp_Pnt(1, 1, 0), gp::DZ()), 0.5);
  const gp_Pnt corners[] = {gp_Pnt(0.5, 1, 0), gp_Pnt(0, 1, 0), gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0), gp_Pnt(1, 0.5, 0)};
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(circle, corners[0], corners[4]).Edge());
  for (int k = 4; k > 0; --k) wire.Add(BRepBuilderAPI_MakeEdge(corners[k], corners[k - 1]).Edge());
  write_step(BRepBuilderAPI_MakeFace(gp_Pln(), wire.Wire()).Face(), path);
}

void write_free_edges(const std::string& path) {
  const TopoDS_Face plain = BRepBuilderAPI_MakeFace(gp_Pln(), 0, 4, 0, 4).Face();
  BRep_Builder builder;
  TopoDS_Face face = TopoDS::Face(plain.EmptyCopied());
  for (TopExp_Explorer e(plain, TopAbs_WIRE); e.More(); e.Next()) builder.Add(face, e.Current());
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  builder.Add(wire, BRepBuilderAPI_MakeEdge(gp_Pnt(1, 1, 0), gp_Pnt(3, 2, 0)).Edge().Oriented(TopAbs_INTERNAL));
  builder.Add(face, wire.Oriented(TopAbs_INTERNAL));
  TopoDS_Compound all;
  builder.MakeCompound(all);
  builder.Add(all, face);
  builder.Add(all, BRepPrimAPI_MakeBox(gp_Pnt(10, 0, 0), 1, 1, 1).Shape().Reversed());
  require(BRepTools::Write(all, path.c_str()), path);
}

/// Four boxes: two touch, two overlap, one is apart.
void write_boxes(const std::string& path) {
  BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  builder.Add(all, BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 10, 10, 10).Shape());
  builder.Add(all, BRepPrimAPI_MakeBox(gp_Pnt(10, 2, 2), 10, 6, 6).Shape());
  builder.Add(all, BRepPrimAPI_MakeBox(gp_Pnt(-5, 4, 4), 10, 2, 2).Shape());
  builder.Add(all, BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 20), 10, 10, 10).Shape());
  require(BRepTools::Write(all, path.c_str()), path);
}

void write_wires(const std::string& folder) {
  BRep_Builder builder;
  TopoDS_Compound wires, both;
  builder.MakeCompound(wires);
  builder.MakeCompound(both);
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(gp_Pnt(3, 0, 0), gp_Pnt(4, 0, 0)).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(4, 0, 0), gp_Pnt(4, 1, 0)).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(4, 1, 0), gp_Pnt(3, 1, 0)).Edge());
  builder.Add(wires, wire.Wire());
  builder.Add(both, wire.Wire());
  builder.Add(both, BRepPrimAPI_MakeBox(1, 1, 1).Shape());
  require(BRepTools::Write(wires, (folder + "wires.brep").c_str()), "wires.brep");
  require(BRepTools::Write(both, (folder + "loose.brep").c_str()), "loose.brep");
  TopoDS_Compound scribed;
  builder.MakeCompound(scribed);
  builder.Add(scribed, BRepPrimAPI_MakeBox(1, 1, 1).Shape());
  BRepBuilderAPI_MakeWire line(BRepBuilderAPI_MakeEdge(gp_Pnt(0.2, 0.3, 1), gp_Pnt(1, 0.5, 1)).Edge());
  line.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(1, 0.5, 1), gp_Pnt(1, 0.6, 0.2)).Edge());
  builder.Add(scribed, line.Wire());
  builder.Add(scribed, BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 1), gp_Pnt(0, 0, 2)).Edge());
  require(BRepTools::Write(scribed, (folder + "scribed.brep").c_str()), "scribed.brep");
}

/// A plate of 4 x 4 x 1 and a cube of side 2 that stands on it.
void write_touching(const std::string& path) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  builder.Add(all, BRepPrimAPI_MakeBox(4, 4, 1).Shape());
  builder.Add(all, BRepPrimAPI_MakeBox(gp_Pnt(0.5, 1, 1), 2, 2, 2).Shape());
  require(BRepTools::Write(all, path.c_str()), path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string folder = std::string(argv[1]) + "/";
  Message::DefaultMessenger()->ChangePrinters().Clear();
  try {
    for (const shapes::NamedShape& shape : shapes::torture_set()) {
      const TopoDS_Shape made = shape.make();
      write_step(made, folder + shape.name + ".step");
      require(BRepTools::Write(made, (folder + shape.name + ".brep").c_str()), shape.name);
    }
    write_assembly(folder);
    write_named_faces(folder + "named_faces.step");
    write_press(folder + "press.step");
    write_bracket(folder + "bracket.step");
    write_plate(folder + "plate");
    write_quarter_plate(folder + "quarter_plate.step");
    Interface_Static::SetCVal("write.step.unit", "INCH");
    write_step(BRepPrimAPI_MakeBox(25.4, 25.4, 25.4).Shape(), folder + "inch.step");
    write_open_iges(folder + "open.igs");
    write_free_edges(folder + "free.brep");
    write_boxes(folder + "boxes.brep");
    write_wires(folder);
    write_touching(folder + "touching.brep");
    for (const shapes::BentShape& bent : shapes::bent_shapes())
      require(BRepTools::Write(bent.make(), (folder + bent.name + ".brep").c_str()), bent.name);
    require(BRepTools::Write(shapes::torn_roof(), (folder + "torn_roof.brep").c_str()), "torn_roof.brep");
    write_step_of_bent(folder + "bent.step");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
