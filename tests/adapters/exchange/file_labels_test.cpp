// SPDX-License-Identifier: BSD-3-Clause
// Names and colours of files with assemblies, and files that refer to others: known values, files by OpenCASCADE's
// writers.
#include <brep_host.h>
#include <gtest/gtest.h>
#include <shape_file.h>

#include <BRepBndLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <IGESCAFControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace {

constexpr int red = 0xff0000, green = 0x00ff00, blue = 0x0000ff, none = -1;

/// A document of OpenCASCADE, written into a folder of the test.
class FileLabels : public testing::Test {
 protected:
  FileLabels() {
    XCAFDoc_ShapeTool::SetAutoNaming(Standard_False);
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("carreau_labels_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    tool_ = XCAFDoc_DocumentTool::ShapeTool(document_->Main());
  }
  ~FileLabels() override { std::filesystem::remove_all(folder_); }

  TDF_Label add(const TopoDS_Shape& shape, const char* name) {
    const TDF_Label label = tool_->AddShape(shape, Standard_False);
    TDataStd_Name::Set(label, name);
    return label;
  }
  TDF_Label assembly(const char* name) {
    const TDF_Label label = tool_->NewShape();
    TDataStd_Name::Set(label, name);
    return label;
  }
  TDF_Label put(const TDF_Label& whole, const TDF_Label& part, double x, const char* name) {
    gp_Trsf move;
    move.SetTranslation(gp_Vec(x, 0, 0));
    const TDF_Label label = tool_->AddComponent(whole, part, TopLoc_Location(move));
    TDataStd_Name::Set(label, name);
    return label;
  }
  void colour(const TDF_Label& label, int rgb) {
    const Quantity_Color value((rgb >> 16) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0, Quantity_TOC_sRGB);
    XCAFDoc_DocumentTool::ColorTool(document_->Main())->SetColor(label, value, XCAFDoc_ColorSurf);
  }
  std::string written_step(bool into_several_files = false) {
    tool_->UpdateAssemblies();
    STEPCAFControl_Writer writer;
    Interface_Static::SetIVal("write.stepcaf.subshapes.name", 1);
    const std::string path = folder_ / "all.step", prefix = folder_ / "part_";
    if (into_several_files)
      EXPECT_TRUE(writer.Transfer(document_, STEPControl_AsIs, prefix.c_str()));
    else
      EXPECT_TRUE(writer.Transfer(document_));
    EXPECT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
    return path;
  }

  std::filesystem::path folder_;
  Handle(TDocStd_Document) document_ = new TDocStd_Document("XmlXCAF");
  Handle(XCAFDoc_ShapeTool) tool_;
};

struct Look {
  int faces = 0;
  std::set<std::string> names;
  std::set<int> colours;
};

/// Faces by the place of their middle in x, rounded down to tens.
std::map<int, Look> looks_of(const std::string& path) {
  const carreau_occ::ShapeFile file = carreau_occ::read_shape(path);
  EXPECT_TRUE(file.losses.empty());
  const carreau_occ::BrepHost host(file);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(file.shape, TopAbs_FACE, faces);
  std::map<int, Look> looks;
  for (int f = 1; f <= faces.Extent(); ++f) {
    Bnd_Box box;
    BRepBndLib::Add(faces(f), box);
    Look& look = looks[10 * static_cast<int>(std::floor((box.CornerMin().X() + box.CornerMax().X()) / 20))];
    ++look.faces;
    look.names.insert(host.face_name(f));
    look.colours.insert(host.face_colour(f));
  }
  return looks;
}

void expect(const std::map<int, Look>& looks, int x, int faces, const std::set<std::string>& names,
            const std::set<int>& colours) {
  ASSERT_TRUE(looks.contains(x)) << x;
  const Look& look = looks.at(x);
  EXPECT_EQ(look.faces, faces) << x;
  EXPECT_EQ(look.names, names) << x;
  EXPECT_EQ(look.colours, colours) << x;
}

TEST_F(FileLabels, AColourHoldsForAPartOrForOneUseOfIt) {
  const TDF_Label plain = add(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), "plain");
  const TDF_Label painted = add(BRepPrimAPI_MakeBox(2, 2, 3).Shape(), "painted");
  colour(painted, green);
  const TDF_Label rig = assembly("rig");
  put(rig, plain, 0, "left");
  colour(put(rig, plain, 20, "right"), red);
  put(rig, painted, 40, "far");
  const std::map<int, Look> looks = looks_of(written_step());
  ASSERT_EQ(looks.size(), 3u);
  expect(looks, 0, 6, {"plain"}, {none});
  expect(looks, 20, 6, {"plain"}, {red});
  expect(looks, 40, 6, {"painted"}, {green});
}

TEST_F(FileLabels, AssembliesOfAssembliesArePlacedInTurn) {
  const TDF_Label block = add(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), "block");
  const TDF_Label pair = assembly("pair"), all = assembly("all");
  put(pair, block, 0, "one");
  put(pair, block, 20, "two");
  put(all, pair, 100, "near");
  put(all, pair, 200, "far");
  const std::map<int, Look> looks = looks_of(written_step());
  ASSERT_EQ(looks.size(), 4u);
  for (const int x : {100, 120, 200, 220}) expect(looks, x, 6, {"block"}, {none});
}

TEST_F(FileLabels, AFaceHasItsOwnNameThoughItIsAllOfAShell) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  const TopoDS_Shape face = TopExp_Explorer(box, TopAbs_FACE).Current();
  TopoDS_Shell shell;
  const BRep_Builder builder;
  builder.MakeShell(shell);
  builder.Add(shell, face);
  const TDF_Label sheet = add(shell, "sheet");
  const TDF_Label inside = tool_->AddSubShape(sheet, face);
  TDataStd_Name::Set(inside, "lid");
  colour(inside, blue);
  const std::map<int, Look> looks = looks_of(written_step());
  ASSERT_EQ(looks.size(), 1u);
  expect(looks, 0, 1, {"lid"}, {blue});
}

TEST_F(FileLabels, SolidsOfOnePartHaveNames) {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  const TopoDS_Shape first = BRepPrimAPI_MakeBox(1, 2, 3).Shape(),
                     second = BRepPrimAPI_MakeBox(gp_Pnt(20, 0, 0), 1, 2, 3).Shape();
  builder.Add(both, first);
  builder.Add(both, second);
  const TDF_Label part = add(both, "part");
  TDataStd_Name::Set(tool_->AddSubShape(part, second), "second");
  colour(tool_->AddSubShape(part, first), blue);
  const std::map<int, Look> looks = looks_of(written_step());
  ASSERT_EQ(looks.size(), 2u);
  expect(looks, 0, 6, {"part"}, {blue});
  expect(looks, 20, 6, {"second"}, {none});
}

TEST_F(FileLabels, FilesThatAFileRefersToAreRead) {
  const TDF_Label block = add(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), "block");
  colour(block, red);
  const TDF_Label rig = assembly("rig");
  put(rig, block, 0, "one");
  put(rig, block, 20, "two");
  const std::string path = written_step(true);
  const auto files = std::distance(std::filesystem::directory_iterator(folder_), {});
  ASSERT_GT(files, 1) << "one file holds all";
  const std::map<int, Look> looks = looks_of(path);
  ASSERT_EQ(looks.size(), 2u);
  expect(looks, 0, 6, {"block"}, {red});
  expect(looks, 20, 6, {"block"}, {red});
}

TEST_F(FileLabels, IgesHasNumbersOfColoursAndColoursOfItsOwn) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  const TDF_Label label = add(box, "box");
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(box, TopAbs_FACE, faces);
  const int colours[] = {red, green, blue, 0xffff00, 0x00ffff, 0x40a030};  // all but the last have numbers
  for (int f = 1; f <= 6; ++f) colour(tool_->AddSubShape(label, faces(f)), colours[f - 1]);
  IGESCAFControl_Writer writer;
  const std::string path = folder_ / "box.igs";
  ASSERT_TRUE(writer.Transfer(document_));
  ASSERT_TRUE(writer.Write(path.c_str()));
  const carreau_occ::BrepHost host(carreau_occ::read_shape(path));
  ASSERT_EQ(host.face_count(), 6);
  std::multiset<int> found;
  for (int f = 1; f <= 6; ++f) found.insert(host.face_colour(f));
  EXPECT_EQ(found, (std::multiset<int>(std::begin(colours), std::end(colours))));
}

}  // namespace
