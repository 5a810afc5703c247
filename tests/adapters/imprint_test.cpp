// SPDX-License-Identifier: BSD-3-Clause
// Parts that touch share faces and edges; lengths get a unit or a scale; files come from memory.
#include <gtest/gtest.h>
#include <changes/imprint.h>
#include <shape_file.h>
#include <solids.h>
#include <changes/units.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <GProp_GProps.hxx>
#include <STEPControl_Writer.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>
#include <gp_Vec.hxx>
#include <iterator>
#include <numbers>
#include <set>
#include <sstream>

#include "measured_mesh.h"

namespace imprint_tests {

using carreau_occ::ShapeFile;
using std::numbers::pi;

ShapeFile file_of_parts(const std::vector<TopoDS_Shape>& parts) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& part : parts) builder.Add(all, part);
  ShapeFile file;
  file.shape = all;
  return file;
}

TopoDS_Shape box(double x, double y, double z, double dx, double dy, double dz) {
  return BRepPrimAPI_MakeBox(gp_Pnt(x, y, z), dx, dy, dz).Shape();
}

TopoDS_Shape upright_cylinder(double x, double y, double z, double radius, double height) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, z), gp_Dir(0, 0, 1)), radius, height).Shape();
}

double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

/// The volume that the triangles around a solid enclose, and the number of edges that two of them do not run along in opposite ways.
struct Enclosed {
  double volume = 0;
  int open_edges = 0;
};

std::vector<Enclosed> enclosed_by_solids(const adapters::MeasuredMesh& m, const carreau_occ::Solids& solids) {
  std::vector<Enclosed> all(solids.names.size());
  std::vector<std::map<std::array<std::int32_t, 2>, int>> ways(all.size());
  for (std::size_t t = 0; t < m.triangles.size(); ++t) {
    const std::array<int, 2>& sides = solids.of_face[static_cast<std::size_t>(m.refs[t] - 1)];
    for (std::size_t side = 0; side < 2; ++side) {
      if (sides[side] == 0) continue;
      const auto s = static_cast<std::size_t>(sides[side] - 1);
      std::array<std::int32_t, 3> v = m.triangles[t];
      if (side == 1) std::swap(v[1], v[2]);
      const auto &a = m.vertices[v[0]], &b = m.vertices[v[1]], &c = m.vertices[v[2]];
      all[s].volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t p = v[k], q = v[(k + 1) % 3];
        ways[s][{std::min(p, q), std::max(p, q)}] += p < q ? 1 : -1;
      }
    }
  }
  for (std::size_t s = 0; s < all.size(); ++s)
    for (const auto& [edge, sum] : ways[s]) all[s].open_edges += sum != 0 ? 1 : 0;
  return all;
}

int faces_between(const carreau_occ::Solids& solids) {
  return static_cast<int>(std::count_if(solids.of_face.begin(), solids.of_face.end(), [](const auto& sides) { return sides[1] > 0; }));
}

adapters::MeasuredMesh meshed(const ShapeFile& file, double size) {
  carreau_occ::BrepHost host(file);
  adapters::MeasuredMesh m = adapters::mesh_and_measure(host, size);
  EXPECT_EQ(m.status, CARREAU_OK) << m.error;
  EXPECT_TRUE(m.failed.empty());
  EXPECT_EQ(m.open_edges, 0);
  return m;
}

// A small box on a large one, off its middle: the contact is one face of both, and a ring of the large one is left.
TEST(Imprint, BoxesShareTheFaceOfTheirContact) {
  ShapeFile file = file_of_parts({box(0, 0, 0, 4, 4, 1), box(1, 0.5, 1, 2, 1.5, 1)});
  carreau_occ::imprint_parts(file, 0);
  EXPECT_TRUE(file.losses.empty());
  const carreau_occ::Solids solids = carreau_occ::solids_of(file);
  EXPECT_EQ(solids.names.size(), 2U);
  EXPECT_EQ(solids.of_face.size(), 12U);  // 6 + 6: the contact is one face of both, and the rest of the large face is
                                          // another
  EXPECT_EQ(faces_between(solids), 1);
  const adapters::MeasuredMesh m = meshed(file, 0.3);
  EXPECT_NEAR(m.quality.area, 2 * 16 + 16 + 2 * 3.5 + 3, 1e-9);  // the contact is counted once, as a piece of the 16 below
  const std::vector<Enclosed> enclosed = enclosed_by_solids(m, solids);
  EXPECT_NEAR(enclosed[0].volume, 16, 1e-9);
  EXPECT_NEAR(enclosed[1].volume, 3, 1e-9);
  for (const Enclosed& each : enclosed) EXPECT_EQ(each.open_edges, 0);
}

// A pin pressed into a plate: the contact is a cylinder, and the pin ends above and below.
TEST(Imprint, VolumesStay) {
  const TopoDS_Shape plate = BRepAlgoAPI_Cut(box(-3, -3, 0, 6, 6, 1), upright_cylinder(0, 0, -1, 1, 3)).Shape();
  ShapeFile file = file_of_parts({plate, upright_cylinder(0, 0, -0.5, 1, 2)});
  const std::array<double, 2> exact{36 - pi, 2 * pi};
  carreau_occ::imprint_parts(file, 0);
  ASSERT_TRUE(file.losses.empty()) << file.losses.front();
  TopTools_IndexedMapOfShape shapes;
  TopExp::MapShapes(file.shape, TopAbs_SOLID, shapes);
  ASSERT_EQ(shapes.Extent(), 2);
  for (int s = 1; s <= 2; ++s) EXPECT_NEAR(volume_of(shapes(s)), exact[s - 1], 1e-6 * exact[s - 1]);
  const carreau_occ::Solids solids = carreau_occ::solids_of(file);
  EXPECT_EQ(faces_between(solids), 1);
  const double h = 0.1;
  const std::vector<Enclosed> enclosed = enclosed_by_solids(meshed(file, h), solids);
  // Chords of length h on a circle of radius 1 enclose less by h^2 / 6 of its area.
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_NEAR(enclosed[s].volume, exact[s], 2 * pi * h * h / 6 * 1.5);
    EXPECT_EQ(enclosed[s].open_edges, 0);
  }
  EXPECT_NEAR(enclosed[0].volume + enclosed[1].volume, 36 + pi, pi * h * h / 6 * 1.5);
}

// n x n x n boxes: 3 n^2 (n + 1) faces, of which 3 n^2 (n - 1) have two solids.
TEST(Imprint, APileOfBoxesSharesAllInnerFaces) {
  const int n = 4;
  std::vector<TopoDS_Shape> parts;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) parts.push_back(box(i, j, k, 1, 1, 1));
  ShapeFile file = file_of_parts(parts);
  carreau_occ::imprint_parts(file, 0);
  const carreau_occ::Solids solids = carreau_occ::solids_of(file);
  EXPECT_EQ(static_cast<int>(solids.of_face.size()), 3 * n * n * (n + 1));
  EXPECT_EQ(faces_between(solids), 3 * n * n * (n - 1));
  for (const Enclosed& each : enclosed_by_solids(meshed(file, 0.5), solids)) {
    EXPECT_NEAR(each.volume, 1, 1e-12);
    EXPECT_EQ(each.open_edges, 0);
  }
}

TEST(Imprint, TheToleranceClosesGaps) {
  const double gap = 1e-3;
  for (const double tolerance : {0.0, 2 * gap}) {
    ShapeFile file = file_of_parts({box(0, 0, 0, 1, 1, 1), box(0, 0, 1 + gap, 1, 1, 1)});
    carreau_occ::imprint_parts(file, tolerance);
    EXPECT_TRUE(file.losses.empty());
    EXPECT_EQ(faces_between(carreau_occ::solids_of(file)), tolerance > 0 ? 1 : 0);
  }
}

// Two spheres that overlap by a lens, which belongs to both.
TEST(Imprint, OverlapsBecomeSolidsOfTheirOwn) {
  gp_Trsf move;
  move.SetTranslation(gp_Vec(1, 0, 0));
  const TopoDS_Shape sphere = BRepPrimAPI_MakeSphere(1).Shape();
  ShapeFile file = file_of_parts({sphere, sphere.Moved(TopLoc_Location(move))});
  carreau_occ::imprint_parts(file, 0);
  EXPECT_TRUE(file.losses.empty());
  TopTools_IndexedMapOfShape shapes;
  TopExp::MapShapes(file.shape, TopAbs_SOLID, shapes);
  ASSERT_EQ(shapes.Extent(), 3);
  const double lens = 5 * pi / 12;  // 2 pi h^2 (3 - h) / 3 with h = 1/2
  std::vector<double> volumes;
  for (int s = 1; s <= 3; ++s) volumes.push_back(volume_of(shapes(s)));
  std::sort(volumes.begin(), volumes.end());
  EXPECT_NEAR(volumes[0], lens, 1e-5);
  EXPECT_NEAR(volumes[1], 4 * pi / 3 - lens, 1e-5);
  EXPECT_NEAR(volumes[2], 4 * pi / 3 - lens, 1e-5);
}

TEST(Imprint, NamesAndColoursFollow) {
  ShapeFile file = file_of_parts({box(0, 0, 0, 4, 4, 1), box(1, 1, 1, 1, 1, 1)});
  TopTools_IndexedMapOfShape before;
  TopExp::MapShapes(file.shape, TopAbs_SOLID, before);
  file.labels.push_back({.part = file.shape, .name = "press"});
  file.labels.push_back({.part = before(1), .name = "plate", .has_colour = true, .red = 1});
  file.labels.push_back({.part = before(2), .name = "stamp"});
  carreau_occ::imprint_parts(file, 0);
  const carreau_occ::Solids solids = carreau_occ::solids_of(file);
  EXPECT_EQ(std::set<std::string>(solids.names.begin(), solids.names.end()), (std::set<std::string>{"plate", "stamp"}));
  const carreau_occ::BrepHost host(file);
  int red = 0;
  for (int f = 1; f <= host.face_count(); ++f) {
    red += host.face_colour(f) == 0xFF0000 ? 1 : 0;
    EXPECT_TRUE(host.face_name(f) == "plate" || host.face_name(f) == "stamp") << host.face_name(f);
  }
  EXPECT_GE(red, 6);
}

TEST(Imprint, StopsOnRequest) {
  ShapeFile file = file_of_parts({box(0, 0, 0, 1, 1, 1), box(0, 0, 1, 1, 1, 1), box(0, 0, 2, 1, 1, 1)});
  EXPECT_THROW(carreau_occ::imprint_parts(file, 0, [](double) { return false; }), std::runtime_error);
  EXPECT_EQ(faces_between(carreau_occ::solids_of(file)), 0);
}

// An assembly of one part at three places, one of them turned: volumes grow by the cube, and places with them.
TEST(Units, ScaledAssembliesKeepTheirPlaces) {
  const TopoDS_Shape part = BRepAlgoAPI_Cut(box(0, 0, 0, 3, 2, 1), upright_cylinder(1, 1, -1, 0.5, 3)).Shape();
  gp_Trsf move, turn;
  move.SetTranslation(gp_Vec(10, 0, 0));
  turn.SetRotation(gp_Ax1(gp_Pnt(0, 5, 0), gp_Dir(0, 0, 1)), pi / 3);
  ShapeFile file = file_of_parts({part, part.Moved(TopLoc_Location(move)), part.Moved(TopLoc_Location(turn))});
  file.unit = "mm";
  TopTools_IndexedMapOfShape solids;
  TopExp::MapShapes(file.shape, TopAbs_SOLID, solids);
  file.labels.push_back({.part = solids(3), .name = "turned"});
  const auto centre_of = [](const TopoDS_Shape& shape) {
    GProp_GProps properties;
    BRepGProp::VolumeProperties(shape, properties);
    return properties.CentreOfMass();
  };
  std::vector<gp_Pnt> centres;
  for (int s = 1; s <= 3; ++s) centres.push_back(centre_of(solids(s)));
  carreau_occ::change_lengths(file, "in", 2);
  EXPECT_EQ(file.unit, "");
  const double factor = 2 / 25.4;
  TopTools_IndexedMapOfShape scaled;
  TopExp::MapShapes(file.shape, TopAbs_SOLID, scaled);
  ASSERT_EQ(scaled.Extent(), 3);
  for (int s = 1; s <= 3; ++s) {
    EXPECT_NEAR(volume_of(scaled(s)), (6 - pi / 4) * std::pow(factor, 3), 1e-9);
    EXPECT_LT(centre_of(scaled(s)).Distance(gp_Pnt(centres[s - 1].XYZ() * factor)), 1e-9);
  }
  EXPECT_EQ(carreau_occ::solids_of(file).names, (std::vector<std::string>{"", "", "turned"}));
}

TEST(Units, AFileWithoutOneRejectsUnits) {
  ShapeFile file = file_of_parts({box(0, 0, 0, 1, 1, 1)});
  EXPECT_THROW(carreau_occ::change_lengths(file, "m", 1), carreau_occ::UnknownUnit);
  file.unit = "mm";
  EXPECT_THROW(carreau_occ::change_lengths(file, "parsec", 1), carreau_occ::UnknownUnit);
  carreau_occ::change_lengths(file, "m", 1);
  EXPECT_EQ(file.unit, "m");
  EXPECT_NEAR(volume_of(file.shape), 1e-9, 1e-18);
}

std::string bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Bytes, AllFormatsAreReadFromMemory) {
  const TopoDS_Shape shape = box(0, 0, 0, 1, 2, 3);
  std::ostringstream text, binary;
  BRepTools::Write(shape, text);
  BinTools::Write(shape, binary);
  const std::string path = (std::filesystem::temp_directory_path() / "carreau_bytes.step").string();
  STEPControl_Writer writer;
  writer.Transfer(shape, STEPControl_AsIs);
  ASSERT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
  const std::string step = bytes_of(path);
  std::filesystem::remove(path);
  for (const auto& [bytes, format] : {std::pair{text.str(), "brep"}, {binary.str(), "brep"}, {step, "step"}})
    for (const std::string& given : {std::string(), std::string(format)}) {
      const ShapeFile file = carreau_occ::read_shape(std::string_view(bytes), given, "memory");
      EXPECT_NEAR(volume_of(file.shape), 6, 1e-9) << format;
      EXPECT_EQ(file.unit, std::string(format) == "step" ? "mm" : "");
      EXPECT_EQ(file.file_unit, std::string(format) == "step" ? "mm" : "");
    }
}

TEST(Bytes, WrongOnesAreRejected) {
  const TopoDS_Shape shape = box(0, 0, 0, 1, 2, 3);
  std::ostringstream text, binary;
  BRepTools::Write(shape, text);
  BinTools::Write(shape, binary);
  const auto sentence = [](const std::string& bytes, const std::string& format) -> std::string {
    try {
      (void)carreau_occ::read_shape(std::string_view(bytes), format, "memory");
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(sentence("", ""), "memory: the bytes are not a STEP, IGES or BREP file");
  EXPECT_EQ(sentence("solid", "brep"), "memory: the bytes are not a STEP, IGES or BREP file");
  EXPECT_EQ(sentence(text.str(), "step"), "memory: the bytes do not begin like a STEP file");
  EXPECT_EQ(sentence(text.str(), "stl"), "memory: the format is 'stl', which is not step, iges or brep");
  EXPECT_NE(sentence("ISO-10303-21;\nHEADER;\n", "").find("memory: "), std::string::npos);
  for (const std::string& whole : {text.str(), binary.str()})
    for (std::size_t n = whole.size() / 10; n < whole.size() - 10; n += whole.size() / 10)
      EXPECT_NE(sentence(whole.substr(0, n), ""), "") << n;
}

}  // namespace imprint_tests
