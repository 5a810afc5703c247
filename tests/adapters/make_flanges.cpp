// SPDX-License-Identifier: BSD-3-Clause
// make_flanges FILE.brep [FLANGES HOLES RINGS LENGTH]: a pipeline, as an assembly of many detailed faces: a long tube,
// pairs of flanges on it, and bolts with threads of rings through their holes; 4 12 6 400: 1187 faces. For
//   carreau mesh FILE.brep --angle 15 --anisotropic --max 5% --json
// beside the same with --size 5% ("seconds", "processor").
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <gp_Vec.hxx>
#include <numbers>

namespace {

using std::numbers::pi;

const gp_Dir up(0, 0, 1);

TopoDS_Shape face_of(BRepBuilderAPI_MakePolygon& polygon) {
  polygon.Close();
  return BRepBuilderAPI_MakeFace(polygon.Wire()).Face();
}

/// A hexagonal head at z, and below it a shank of radius 1 whose thread is made of rings.
TopoDS_Shape bolt(double x, double y, double z, int rings) {
  BRepBuilderAPI_MakePolygon hexagon, profile;
  for (int k = 0; k < 6; ++k) hexagon.Add(gp_Pnt(x + 1.8 * std::cos(k * pi / 3), y + 1.8 * std::sin(k * pi / 3), z));
  const TopoDS_Shape head = BRepPrimAPI_MakePrism(face_of(hexagon), gp_Vec(0, 0, 1.2));
  double below = 2;
  profile.Add(gp_Pnt(x, y, z));
  profile.Add(gp_Pnt(x + 1, y, z));
  profile.Add(gp_Pnt(x + 1, y, z - below));
  for (int k = 0; k < rings; ++k, below += 0.2) {
    profile.Add(gp_Pnt(x + 0.85, y, z - below - 0.1));
    profile.Add(gp_Pnt(x + 1, y, z - below - 0.2));
  }
  profile.Add(gp_Pnt(x, y, z - below));
  const TopoDS_Shape shank = BRepPrimAPI_MakeRevol(face_of(profile), gp_Ax1(gp_Pnt(x, y, z), up));
  return BRepAlgoAPI_Fuse(head, shank).Shape();
}

TopoDS_Shape cylinder(double x, double y, double z, double radius, double height) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, z), up), radius, height).Shape();
}

/// A disc of radius 25 with a bore for the tube and holes for the bolts.
TopoDS_Shape flange(double z, int holes) {
  TopTools_ListOfShape discs, drills;
  discs.Append(cylinder(0, 0, z, 25, 3));
  drills.Append(cylinder(0, 0, z - 1, 10.05, 6));
  for (int k = 0; k < holes; ++k)
    drills.Append(cylinder(20 * std::cos(2 * pi * k / holes), 20 * std::sin(2 * pi * k / holes), z - 1, 1.2, 6));
  BRepAlgoAPI_Cut cut;
  cut.SetArguments(discs);
  cut.SetTools(drills);
  cut.Build();
  return cut.Shape();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 6) {
    std::fprintf(stderr, "usage: make_flanges FILE.brep [FLANGES HOLES RINGS LENGTH]\n");
    return 2;
  }
  const auto number = [&](int i, int usual) { return argc == 6 ? std::atoi(argv[i]) : usual; };
  const int flanges = number(2, 4), holes = number(3, 12), rings = number(4, 6), length = number(5, 400);
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  builder.Add(all, cylinder(0, 0, 0, 10, length));
  for (int f = 0; f < flanges; ++f) {
    const double z = 50 + 100. * f;
    builder.Add(all, flange(z, holes));
    builder.Add(all, flange(z + 3.5, holes));
    for (int k = 0; k < holes; ++k)
      builder.Add(all, bolt(20 * std::cos(2 * pi * k / holes), 20 * std::sin(2 * pi * k / holes), z + 7, rings));
  }
  int faces = 0;
  for (TopExp_Explorer e(all, TopAbs_FACE); e.More(); e.Next()) ++faces;
  std::printf("%d faces\n", faces);
  return BRepTools::Write(all, argv[1]) ? 0 : 1;
}
