// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/face_contacts.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <ElSLib.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <GProp_GProps.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>
#include <map>
#include <memory>
#include <numbers>
#include <optional>

#include "assembly/common_area.h"
#include "assembly/domain_cells.h"
#include "extent.h"
#include "faults.h"

namespace carreau_occ {
namespace {

/// Share of the diagonal within which surfaces are at one place.
constexpr double same_place = 1e-6;
/// Radians within which axes and normals are parallel.
constexpr double same_direction = 1e-6;
/// Points in each direction of a curved face, first and when a part of them lies on the other face.
constexpr int few_points = 8, many_points = 40;
/// Points of curved faces in all, about a second; then few points are enough.
constexpr int max_points = 200'000;
/// Projections onto free-form surfaces in all, about a second; more faces are not compared.
constexpr int max_projections = 20'000;
/// Pieces of a circle in a plane: its polygon lacks 1e-4 of its area.
constexpr double pieces_of_circle = 256;

class ContactAreas {
 public:
  ContactAreas(const ShapeFile& file, const Solids& solids) : solids_(solids), tolerance_(std::max(same_place * diagonal_of(file.shape), Precision::Confusion())) {
    TopExp::MapShapes(file.shape, TopAbs_FACE, faces_);
    for (int f = 1; f <= faces_.Extent(); ++f) {
      Looked& face = looked_.emplace_back();
      const std::array<int, 2>& sides = solids.of_face[static_cast<std::size_t>(f - 1)];
      if (sides[0] == 0 || sides[1] != 0) continue;
      face.solid = sides[0];
      guard([&] { BRepBndLib::Add(faces_(f), face.box, Standard_False); });
      if (!face.box.IsVoid()) face.box.Enlarge(tolerance_);
    }
  }

  std::vector<FaceContact> run() {
    compare_boxes();
    std::vector<FaceContact> contacts;
    for (const auto& [solids, contact] : found_) contacts.push_back(contact);
    return contacts;
  }

 private:
  /// Points of a face in the middle of cells, and the sum of their areas.
  struct Points {
    struct At {
      gp_Pnt p;
      gp_Vec outside;
    };
    std::vector<At> list;
    double all = 0;
  };
  struct Looked {
    int solid = 0;
    Bnd_Box box;
    std::unique_ptr<BRepAdaptor_Surface> surface;
    std::unique_ptr<DomainCells> inside;
    Handle(ShapeAnalysis_Surface) projection;
    std::optional<double> area;
    std::optional<std::vector<Segment>> borders;  // in its own plane
    std::map<int, Points> points;                 // by the number in each direction
  };
  Looked& at(int f) { return looked_[static_cast<std::size_t>(f - 1)]; }
  [[nodiscard]] TopoDS_Face face(int f) const { return TopoDS::Face(faces_(f)); }

  template <typename Body>
  void guard(Body&& body) {
    try {
      guarded(body);
    } catch (const Standard_Failure&) {
      return;  // this face, or pair, has no contact
    }
  }

  /// Sorted along the longest side of all: only boxes that meet there are compared.
  void compare_boxes() {
    std::vector<int> order;
    Bnd_Box all;
    for (int f = 1; f <= faces_.Extent(); ++f)
      if (at(f).solid > 0 && !at(f).box.IsVoid()) order.push_back(f), all.Add(at(f).box);
    if (order.size() < 2) return;
    const gp_Pnt low = all.CornerMin(), high = all.CornerMax();
    int axis = 1;
    for (const int other : {2, 3})
      if (high.Coord(other) - low.Coord(other) > high.Coord(axis) - low.Coord(axis)) axis = other;
    const auto begin = [&](int f) { return at(f).box.CornerMin().Coord(axis); };
    std::stable_sort(order.begin(), order.end(), [&](int f, int g) { return begin(f) < begin(g); });
    for (std::size_t i = 0; i < order.size(); ++i) {
      const int f = order[i];
      const double end = at(f).box.CornerMax().Coord(axis);
      for (std::size_t k = i + 1; k < order.size() && begin(order[k]) <= end; ++k)
        if (const int g = order[k]; at(f).solid != at(g).solid && !at(f).box.IsOut(at(g).box))
          guard([&] { compare(std::min(f, g), std::max(f, g)); });
    }
  }

  const BRepAdaptor_Surface& surface(int f) {
    Looked& looked = at(f);
    if (!looked.surface) looked.surface = std::make_unique<BRepAdaptor_Surface>(face(f));
    return *looked.surface;
  }
  double area(int f) {
    Looked& looked = at(f);
    if (!looked.area) {
      GProp_GProps properties;
      BRepGProp::SurfaceProperties(face(f), properties);
      looked.area = std::abs(properties.Mass());
    }
    return *looked.area;
  }

  [[nodiscard]] bool are_parallel(const gp_Dir& p, const gp_Dir& q) const { return p.IsParallel(q, same_direction); }
  [[nodiscard]] bool are_one(const gp_Ax1& p, const gp_Ax1& q) const {
    return are_parallel(p.Direction(), q.Direction()) && gp_Vec(p.Location(), q.Location()).Crossed(gp_Vec(p.Direction())).Magnitude() <= tolerance_;
  }
  [[nodiscard]] bool are_near(double a, double b) const { return std::abs(a - b) <= tolerance_; }

  /// True if the surfaces may coincide: surfaces of different kinds may.
  bool may_coincide(int f, int g) {
    const BRepAdaptor_Surface &p = surface(f), &q = surface(g);
    const GeomAbs_SurfaceType kind = p.GetType();
    if (kind != q.GetType()) return kind > GeomAbs_Torus || q.GetType() > GeomAbs_Torus;
    switch (kind) {
      case GeomAbs_Plane:
        return are_parallel(p.Plane().Axis().Direction(), q.Plane().Axis().Direction()) && p.Plane().Distance(q.Plane().Location()) <= tolerance_;
      case GeomAbs_Cylinder:
        return are_one(p.Cylinder().Axis(), q.Cylinder().Axis()) && are_near(p.Cylinder().Radius(), q.Cylinder().Radius());
      case GeomAbs_Cone:
        return are_one(p.Cone().Axis(), q.Cone().Axis()) && p.Cone().Apex().Distance(q.Cone().Apex()) <= tolerance_;
      case GeomAbs_Sphere:
        return p.Sphere().Location().Distance(q.Sphere().Location()) <= tolerance_ && are_near(p.Sphere().Radius(), q.Sphere().Radius());
      case GeomAbs_Torus:
        return are_one(p.Torus().Axis(), q.Torus().Axis()) && p.Torus().Location().Distance(q.Torus().Location()) <= tolerance_ &&
               are_near(p.Torus().MajorRadius(), q.Torus().MajorRadius()) && are_near(p.Torus().MinorRadius(), q.Torus().MinorRadius());
      default:
        return true;
    }
  }

  void compare(int f, int g) {
    if (!may_coincide(f, g)) return;
    gp_Pnt place;
    const bool planes = surface(f).GetType() == GeomAbs_Plane && surface(g).GetType() == GeomAbs_Plane;
    const double common = planes ? common_area_of_planes(f, g, place) : common_area_of_points(f, g, place);
    if (!(common > tolerance_ * tolerance_)) return;
    const bool ascending = at(f).solid < at(g).solid;
    const std::array<int, 2> solids{std::min(at(f).solid, at(g).solid), std::max(at(f).solid, at(g).solid)};
    FaceContact& contact = found_[solids];
    if (common > largest_[solids]) {
      largest_[solids] = common;
      contact.faces = ascending ? std::array{f, g} : std::array{g, f};
      contact.place = {place.X(), place.Y(), place.Z()};
    }
    contact.solids = solids;
    contact.area += common;
    ++contact.pairs;
  }

  // ---- planes ----

  gp_Dir outside_of_plane(int f) {
    const gp_Dir normal = surface(f).Plane().Axis().Direction();
    const bool direct = surface(f).Plane().Direct(), reversed = faces_(f).Orientation() == TopAbs_REVERSED;
    return direct != reversed ? normal : normal.Reversed();
  }

  /// The borders of a face in a plane, as segments.
  std::vector<Segment> segments(int f, const gp_Pln& plane) const {
    std::vector<Segment> all;
    for (TopExp_Explorer e(faces_(f), TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      if (BRep_Tool::Degenerated(edge) || edge.Orientation() == TopAbs_INTERNAL || edge.Orientation() == TopAbs_EXTERNAL) continue;
      const BRepAdaptor_Curve curve(edge);
      const double a = curve.FirstParameter(), b = curve.LastParameter();
      int pieces = static_cast<int>(pieces_of_circle) / 4;
      if (curve.GetType() == GeomAbs_Line) pieces = 1;
      if (curve.GetType() == GeomAbs_Circle) pieces = std::max(2, static_cast<int>(std::ceil(pieces_of_circle * (b - a) / (2 * std::numbers::pi))));
      std::array<double, 2> last{};
      for (int i = 0; i <= pieces; ++i) {
        std::array<double, 2> p;
        ElSLib::Parameters(plane, curve.Value(a + (b - a) * i / pieces), p[0], p[1]);
        if (i > 0) all.push_back({last, p});
        last = p;
      }
    }
    return all;
  }

  const std::vector<Segment>& borders(int f) {
    Looked& looked = at(f);
    if (!looked.borders) looked.borders = segments(f, surface(f).Plane());
    return *looked.borders;
  }

  double common_area_of_planes(int f, int g, gp_Pnt& place) {
    if (outside_of_plane(f) * outside_of_plane(g) > 0) return 0;
    // A face with many borders, which may touch many others, is divided once.
    if (borders(f).size() < borders(g).size()) std::swap(f, g);
    const gp_Pln plane = surface(f).Plane();
    std::array<double, 2> inside{};
    const double common = common_area(borders(f), segments(g, plane), inside);
    place = ElSLib::Value(inside[0], inside[1], plane);
    return common;
  }

  // ---- other surfaces ----

  DomainCells& domain(int f) {
    Looked& looked = at(f);
    if (!looked.inside) looked.inside = std::make_unique<DomainCells>(face(f));
    return *looked.inside;
  }

  /// The outside of a face at (u, v); null where it is degenerate.
  gp_Vec outside(int f, double u, double v, gp_Pnt& p) {
    gp_Vec du, dv;
    surface(f).D1(u, v, p, du, dv);
    const gp_Vec normal = du.Crossed(dv);
    return faces_(f).Orientation() == TopAbs_REVERSED ? normal.Reversed() : normal;
  }

  /// The place of a point on a face, and the outside there.
  bool lies_on(const gp_Pnt& p, int f, gp_Vec& normal) {
    Looked& looked = at(f);
    if (looked.projection.IsNull()) looked.projection = new ShapeAnalysis_Surface(BRep_Tool::Surface(face(f)));
    if (surface(f).GetType() > GeomAbs_Torus) ++projections_;
    const gp_Pnt2d uv = looked.projection->ValueOfUV(p, Precision::Confusion());
    gp_Pnt foot;
    normal = outside(f, uv.X(), uv.Y(), foot);
    if (foot.Distance(p) > tolerance_) return false;
    const TopAbs_State state = domain(f).state(uv);
    return state == TopAbs_IN || state == TopAbs_ON;
  }

  /// A face has equal points for all other faces.
  const Points& points(int f, int n) {
    std::map<int, Points>& known = at(f).points;
    if (const auto found = known.find(n); found != known.end()) return found->second;
    Points made;
    double u0, u1, v0, v1;
    BRepTools::UVBounds(face(f), u0, u1, v0, v1);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const gp_Pnt2d uv(u0 + (u1 - u0) * (i + 0.5) / n, v0 + (v1 - v0) * (j + 0.5) / n);
        if (domain(f).state(uv) != TopAbs_IN) continue;
        gp_Pnt p;
        const gp_Vec normal = outside(f, uv.X(), uv.Y(), p);
        made.all += normal.Magnitude();
        made.list.push_back({p, normal});
      }
    return known.emplace(n, std::move(made)).first->second;
  }

  /// Shares of the area of face f that lies on face g, by points in the middle of cells.
  double share_on(int f, int g, int n, gp_Pnt& place) {
    double common = 0;
    const Points& mine = points(f, n);
    for (const auto& [p, normal] : mine.list) {
      if (at(g).box.IsOut(p)) continue;
      gp_Vec other;
      if (!lies_on(p, g, other) || normal * other > 0) continue;
      if (common == 0) place = p;
      common += normal.Magnitude();
    }
    points_ += static_cast<int>(mine.list.size());
    return mine.all > 0 ? common / mine.all : 0;
  }

  double common_area_of_points(int f, int g, gp_Pnt& place) {
    if (projections_ >= max_projections && (surface(f).GetType() > GeomAbs_Torus || surface(g).GetType() > GeomAbs_Torus)) return 0;
    if (area(g) < area(f)) std::swap(f, g);
    double share = share_on(f, g, few_points, place);
    if (share > 0 && share < 1 && points_ < max_points && projections_ < max_projections) share = share_on(f, g, many_points, place);
    return share * area(f);
  }

  const Solids& solids_;
  double tolerance_;
  TopTools_IndexedMapOfShape faces_;
  std::vector<Looked> looked_;
  std::map<std::array<int, 2>, FaceContact> found_;
  std::map<std::array<int, 2>, double> largest_;
  int points_ = 0, projections_ = 0;
};

}  // namespace

std::vector<FaceContact> find_face_contacts(const ShapeFile& file, const Solids& solids) {
  if (solids.names.size() < 2) return {};
  return ContactAreas(file, solids).run();
}

}  // namespace carreau_occ
