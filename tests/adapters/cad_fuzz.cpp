// SPDX-License-Identifier: BSD-3-Clause
// Meshes random shapes of OpenCASCADE: trees of booleans, fillets, chamfers, offsets and lofts of primitives.
#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_MakeOffsetShape.hxx>
#include <BRepOffsetAPI_MakeThickSolid.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepPrimAPI_MakeWedge.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>
#include <gp_Trsf.hxx>
#include <numbers>
#include <stdexcept>
#include <string>

#include "geometry_fuzz.h"
#include "measured_mesh.h"
#include "session_handle.h"

namespace {

using namespace geometry_fuzz;

// Lattice lengths make faces touch and edges coincide.
double length(Random& random) { return random.chance(0.6) ? 1 + random.below(4) : random.uniform(0.2, 4); }

double place(Random& random) { return random.chance(0.6) ? random.below(5) - 2 : random.uniform(-2, 2); }

TopoDS_Shape moved(Random& random, const TopoDS_Shape& shape) {
  gp_Trsf shift, turn;
  const double x = place(random), y = place(random), z = place(random);
  shift.SetTranslation(gp_Vec(x, y, z));
  if (random.chance(0.4)) {
    const double u = random.uniform(-1, 1), v = random.uniform(-1, 1), w = random.uniform(0.1, 1);
    const double angle = random.chance(0.5) ? std::numbers::pi / 2 : random.uniform(0, std::numbers::pi);
    turn.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), random.chance(0.5) ? gp_Dir(1, 0, 0) : gp_Dir(u, v, w)), angle);
  }
  return BRepBuilderAPI_Transform(shape, shift * turn, true).Shape();
}

TopoDS_Wire wire(Random& random, double z) {
  const double radius = length(random);
  if (random.chance(0.3)) {
    const gp_Circ circle(gp_Ax2(gp_Pnt(0, 0, z), gp_Dir(0, 0, 1)), radius);
    return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire();
  }
  BRepBuilderAPI_MakePolygon polygon;
  const int n = 3 + random.below(4);
  const double turned = random.chance(0.5) ? 0 : random.uniform(0, 1);
  for (int i = 0; i < n; ++i) {
    const double a = turned + 2 * std::numbers::pi * i / n, r = radius * random.uniform(0.5, 1);
    polygon.Add(gp_Pnt(r * std::cos(a), r * std::sin(a), z));
  }
  polygon.Close();
  return polygon.Wire();
}

TopoDS_Shape loft(Random& random) {
  BRepOffsetAPI_ThruSections sections(true, random.chance(0.5));
  double z = 0;
  for (int n = 2 + random.below(3); n > 0; --n, z += length(random)) sections.AddWire(wire(random, z));
  return sections.Shape();
}

TopoDS_Shape primitive(Random& random) {
  const double a = length(random), b = length(random), c = length(random);
  const bool part = random.chance(0.2);
  const double angle = part ? random.uniform(0.3, 6) : 2 * std::numbers::pi;
  switch (random.below(6)) {
    case 0: return BRepPrimAPI_MakeCylinder(0.5 * a, b, angle).Shape();
    case 1: return part ? BRepPrimAPI_MakeSphere(0.5 * a, angle).Shape() : BRepPrimAPI_MakeSphere(0.5 * a).Shape();
    case 2: return BRepPrimAPI_MakeCone(0.5 * a, random.chance(0.5) ? 0 : 0.5 * (a + b), c, angle).Shape();
    case 3: return BRepPrimAPI_MakeTorus(a, a * random.uniform(0.1, 0.9)).Shape();
    case 4: return BRepPrimAPI_MakeWedge(a, b, c, a * random.uniform(0, 1)).Shape();
    default: return BRepPrimAPI_MakeBox(a, b, c).Shape();
  }
}

TopoDS_Shape tree(Random& random, int depth) {
  if (depth == 0) return moved(random, primitive(random));
  const TopoDS_Shape a = tree(random, depth - 1), b = tree(random, random.below(depth));
  switch (random.below(4)) {
    case 0: return BRepAlgoAPI_Common(a, b).Shape();
    case 1: return BRepAlgoAPI_Fuse(a, b).Shape();
    default: return BRepAlgoAPI_Cut(a, b).Shape();
  }
}

TopoDS_Shape blend(Random& random) {
  const TopoDS_Shape solid = tree(random, random.below(2));
  TopTools_IndexedMapOfShape edges, faces;
  TopExp::MapShapes(solid, TopAbs_EDGE, edges);
  TopExp::MapShapes(solid, TopAbs_FACE, faces);
  if (edges.IsEmpty()) return {};
  const double size = random.power(-2, 0);
  const auto edge = [&] { return TopoDS::Edge(edges(1 + random.below(edges.Extent()))); };
  const int count = random.chance(0.3) ? 1 : 1 + random.below(4);
  switch (random.below(4)) {
    case 0: {
      BRepFilletAPI_MakeChamfer chamfer(solid);
      for (int n = 0; n < count; ++n) chamfer.Add(size, edge());
      return chamfer.Shape();
    }
    case 1: {
      TopTools_ListOfShape open;
      open.Append(faces(1 + random.below(faces.Extent())));
      BRepOffsetAPI_MakeThickSolid thick;
      thick.MakeThickSolidByJoin(solid, open, random.chance(0.5) ? size : -0.2 * size, 1e-6);
      return thick.Shape();
    }
    case 2: {
      BRepOffsetAPI_MakeOffsetShape offset;
      offset.PerformByJoin(solid, size, 1e-6);
      return offset.Shape();
    }
    default: {
      BRepFilletAPI_MakeFillet fillet(solid);
      for (int n = 0; n < count; ++n) fillet.Add(size, edge());
      return fillet.Shape();
    }
  }
}

/// Null where OpenCASCADE makes none, or none that is valid.
TopoDS_Shape shape_of(const std::function<TopoDS_Shape(Random&)>& make, Random& random) {
  const Foreign foreign;
  try {
    const TopoDS_Shape shape = make(random);
    return !shape.IsNull() && BRepCheck_Analyzer(shape).IsValid() ? shape : TopoDS_Shape();
  } catch (const Standard_Failure&) {
    return {};
  }
}

Outcome run_shape(std::uint64_t seed, const std::function<TopoDS_Shape(Random&)>& make) {
  Random random(seed);
  const TopoDS_Shape shape = shape_of(make, random);
  if (shape.IsNull()) return {};
  const SessionHandle session;
  try {
    carreau_occ::BrepHost host({.shape = shape, .labels = {}, .unit = ""});
    const carreau_status status = host.give_to(session);
    if (status != CARREAU_OK) return {Result::rejected, fault_of(session, status, "BrepHost::give_to")};
    const double diagonal = host.diagonal();
    adapters::use_command_parameters(session, diagonal * random.power(-1.6, 0), diagonal);
    return mesh_and_check(session, host.is_closed(), random);
  } catch (const std::runtime_error& error) {
    return {Result::rejected, *error.what() == '\0' ? "a failure without a sentence" : ""};
  }
}

}  // namespace

int main(int argc, char** argv) {
  const auto booleans = [](Random& random) { return tree(random, 1 + random.below(3)); };
  const auto of = [](const std::function<TopoDS_Shape(Random&)>& make) {
    return [make](std::uint64_t seed) { return run_shape(seed, make); };
  };
  return main_of({{"booleans", of(booleans)}, {"blends", of(blend)}, {"lofts", of(loft)}}, argc, argv);
}
