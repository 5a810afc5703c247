// SPDX-License-Identifier: BSD-3-Clause
// make_cells FOLDER: periodic cells and cyclic sectors, made by OpenCASCADE.
//   cube.step        the unit cube
//   sector.step      60 degrees of a cylinder of radius 1 and height 1 about z; annulus.step: of a pipe; sector24.step: 15 degrees of a
//                    pipe with a hole in it
//   fcc.step         the unit cube without spheres of radius .3 around its corners and the middles of its faces
//   spheres.step     the unit cube without spheres of radius .2 around its corners and the middles of its edges and faces
//   inclusions.step  the unit cube without forty spheres, of which six faces cut some; mismatch.step: the cube without one at one face
//   block.step       a block of 2 x 1 x .8 about the origin with three bores, symmetric about all planes; half.step: where x > 0; quarter.step: where
//                    x and y > 0; open.step: half.step without its face at x = 0; uneven.step: the block with a fourth bore
//   wired.step       the block with free edges across x = 0, and half_wired.step: half.step with their halves
//   pipe.step        a whole pipe; lens.step: a ball of an upper and a lower half
//   ball.step, rod.step  a ball of radius 1 and a rod of length 2 along x, about (.3, .1, 0)
//   shifted.step     the cube without half a sphere at each of two faces: the circles on both begin at different places
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <STEPControl_Writer.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shell.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>
#include <gp_Pnt.hxx>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Centre = std::array<double, 3>;

void write(const TopoDS_Shape& shape, const std::string& path) {
  STEPControl_Writer writer;
  if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone || writer.Write(path.c_str()) != IFSelect_RetDone)
    throw std::runtime_error(path + " cannot be written");
}

TopoDS_Shape cut(const TopoDS_Shape& from, const TopTools_ListOfShape& tools) {
  TopTools_ListOfShape arguments;
  arguments.Append(from);
  BRepAlgoAPI_Cut operation;
  operation.SetArguments(arguments);
  operation.SetTools(tools);
  operation.Build();
  if (!operation.IsDone()) throw std::runtime_error("a cut has failed");
  return operation.Shape();
}

// Direction of the seams of a sphere and its images, into the cell from the faces that cut the sphere: OpenCASCADE 7.6 reads a sphere
// that is cut across its seam back from STEP as a part of its complement.
gp_Dir seam_of(const Centre& c, double radius) {
  const auto inwards = [radius](double x) { return x < radius ? 1. : x > 1 - radius ? -1. : 0.; };
  const double x = inwards(c[0]), y = inwards(c[1]);
  return x == 0 && y == 0 ? gp_Dir(1, 0, 0) : gp_Dir(x, y, 0);
}

// Spheres with their periodic images as far as these meet the unit cube.
TopoDS_Shape without_spheres(const std::vector<Centre>& centres, double radius, bool seams_inwards = false) {
  TopTools_ListOfShape spheres;
  for (const Centre& c : centres)
    for (int image = 0; image < 27; ++image) {
      const Centre p{c[0] + image % 3 - 1, c[1] + image / 3 % 3 - 1, c[2] + image / 9 - 1};
      double distance = 0;
      for (const double x : p) distance += std::pow(std::max({-x, x - 1, 0.}), 2);
      if (std::sqrt(distance) < radius) spheres.Append(BRepPrimAPI_MakeSphere(gp_Ax2(gp_Pnt(p[0], p[1], p[2]), gp_Dir(0, 0, 1), seams_inwards ? seam_of(c, radius) : gp_Dir(1, 0, 0)), radius).Shape());
    }
  return cut(BRepPrimAPI_MakeBox(1., 1., 1.).Shape(), spheres);
}

double apart(const Centre& a, const Centre& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += std::pow(std::remainder(a[k] - b[k], 1.), 2);
  return std::sqrt(sum);
}

// Random, apart from each other, and never nearly touching a face: slivers would show nothing.
std::vector<Centre> forty(double radius) {
  std::uint64_t state = 46;
  const auto next = [&] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state >> 11) / 9007199254740992.;
  };
  std::vector<Centre> centres;
  while (centres.size() < 40) {
    const Centre c{next(), next(), next()};
    bool good = true;
    for (const double x : c) {
      const double to_face = std::min(x, 1 - x);
      good = good && (to_face < 0.8 * radius || to_face > 1.2 * radius);
    }
    for (const Centre& other : centres) good = good && apart(c, other) > 2.2 * radius;
    if (good) centres.push_back(c);
  }
  return centres;
}

TopoDS_Shape pipe_sector(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  TopTools_ListOfShape bore;
  bore.Append(BRepPrimAPI_MakeCylinder(0.5, 1., angle).Shape());
  return cut(BRepPrimAPI_MakeCylinder(1., 1., angle).Shape(), bore);
}

// Both hemispheres are halves of one sphere, with seams at different places.
void make_shifted(const std::string& path) {
  TopTools_ListOfShape spheres;
  spheres.Append(BRepPrimAPI_MakeSphere(gp_Ax2(gp_Pnt(0, 0.5, 0.5), gp_Dir(1, 0, 0), gp_Dir(0, 0, 1)), 0.3).Shape());
  spheres.Append(BRepPrimAPI_MakeSphere(gp_Ax2(gp_Pnt(1, 0.5, 0.5), gp_Dir(1, 0, 0), gp_Dir(0, 0.6, 0.8)), 0.3).Shape());
  write(cut(BRepPrimAPI_MakeBox(1., 1., 1.).Shape(), spheres), path);
}

TopoDS_Shape bore(double x, const gp_Dir& axis, double radius) {
  const gp_Pnt begin(x - 3 * axis.X(), -3 * axis.Y(), -3 * axis.Z());
  return BRepPrimAPI_MakeCylinder(gp_Ax2(begin, axis), radius, 6.).Shape();
}

TopoDS_Shape block(bool uneven) {
  TopTools_ListOfShape bores;
  bores.Append(bore(0, gp_Dir(0, 0, 1), 0.2));
  for (const double x : {-0.6, 0.6}) bores.Append(bore(x, gp_Dir(0, 1, 0), 0.15));
  if (uneven) bores.Append(bore(0.85, gp_Dir(0, 0, 1), 0.05));
  return cut(BRepPrimAPI_MakeBox(gp_Pnt(-1, -0.5, -0.4), gp_Pnt(1, 0.5, 0.4)).Shape(), bores);
}

// A segment and an arc above the block, from x = `from` to 1.5.
TopoDS_Shape with_wires(const TopoDS_Shape& body, double from) {
  const BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  builder.Add(all, body);
  builder.Add(all, BRepBuilderAPI_MakeEdge(gp_Pnt(from, 0.2, 0.9), gp_Pnt(1.5, 0.2, 0.9)).Edge());
  const gp_Circ circle(gp_Ax2(gp_Pnt(0, 0, 0.3), gp_Dir(0, 1, 0), gp_Dir(1, 0, 0)), 1.5);
  const double half = std::numbers::pi / 2;
  builder.Add(all, BRepBuilderAPI_MakeEdge(circle, from < 0 ? -2 * half : -half, 0.).Edge());
  builder.Add(all, BRepBuilderAPI_MakeEdge(gp_Pnt(0, -0.3, 1), gp_Pnt(0, 0.3, 1.2)).Edge());
  return all;
}

// The shell of a solid without its faces at x = 0.
TopoDS_Shape opened(const TopoDS_Shape& solid) {
  const BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  for (TopExp_Explorer e(solid, TopAbs_FACE); e.More(); e.Next()) {
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(e.Current(), properties);
    if (std::abs(properties.CentreOfMass().X()) > 1e-9) builder.Add(shell, e.Current());
  }
  return shell;
}

void make_symmetric(const std::string& folder) {
  write(block(false), folder + "/block.step");
  write(block(true), folder + "/uneven.step");
  TopTools_ListOfShape left, low;
  left.Append(BRepPrimAPI_MakeBox(gp_Pnt(-2, -2, -2), gp_Pnt(0, 2, 2)).Shape());
  low.Append(BRepPrimAPI_MakeBox(gp_Pnt(-2, -2, -2), gp_Pnt(2, 0, 2)).Shape());
  const TopoDS_Shape half = cut(block(false), left);
  write(half, folder + "/half.step");
  write(cut(half, low), folder + "/quarter.step");
  write(opened(half), folder + "/open.step");
  write(with_wires(block(false), -1.5), folder + "/wired.step");
  write(with_wires(half, 0), folder + "/half_wired.step");
  write(BRepPrimAPI_MakeSphere(gp_Pnt(0.3, 0.1, 0), 1.).Shape(), folder + "/ball.step");
  write(BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-0.7, 0.1, 0), gp_Dir(1, 0, 0)), 0.4, 2.).Shape(), folder + "/rod.step");
}

void make(const std::string& folder) {
  make_symmetric(folder);
  write(BRepPrimAPI_MakeBox(1., 1., 1.).Shape(), folder + "/cube.step");
  write(BRepPrimAPI_MakeCylinder(1., 1., std::numbers::pi / 3).Shape(), folder + "/sector.step");
  write(pipe_sector(60), folder + "/annulus.step");
  TopTools_ListOfShape bore_of_pipe;
  bore_of_pipe.Append(BRepPrimAPI_MakeCylinder(0.5, 1.).Shape());
  write(cut(BRepPrimAPI_MakeCylinder(1., 1.).Shape(), bore_of_pipe), folder + "/pipe.step");
  write(BRepAlgoAPI_Fuse(BRepPrimAPI_MakeSphere(1., 0., std::numbers::pi / 2).Shape(), BRepPrimAPI_MakeSphere(1., -std::numbers::pi / 2, 0.).Shape()).Shape(), folder + "/lens.step");
  TopTools_ListOfShape hole;
  hole.Append(BRepPrimAPI_MakeSphere(gp_Pnt(0.75 * std::cos(0.13), 0.75 * std::sin(0.13), 0.5), 0.06).Shape());
  write(cut(pipe_sector(15), hole), folder + "/sector24.step");
  write(without_spheres({{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}}, 0.3), folder + "/fcc.step");
  write(without_spheres({{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}}, 0.2, true), folder + "/spheres.step");
  write(without_spheres(forty(0.12), 0.12, true), folder + "/inclusions.step");
  TopTools_ListOfShape one;
  one.Append(BRepPrimAPI_MakeSphere(gp_Pnt(0, 0.5, 0.5), 0.2).Shape());
  write(cut(BRepPrimAPI_MakeBox(1., 1., 1.).Shape(), one), folder + "/mismatch.step");
  make_shifted(folder + "/shifted.step");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::runtime_error("usage: make_cells FOLDER");
    make(argv[1]);
  } catch (const Standard_Failure& error) {
    std::fprintf(stderr, "%s\n", error.GetMessageString());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
