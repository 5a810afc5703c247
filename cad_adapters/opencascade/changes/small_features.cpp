// SPDX-License-Identifier: BSD-3-Clause
#include "changes/small_features.h"

#include <BOPAlgo_RemoveFeatures.hxx>
#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRepTools_History.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_Curve.hxx>
#include <Message_ProgressScope.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>
#include <numbers>
#include <set>

#include "changes/shape_images.h"

namespace carreau_occ {
namespace {

using std::numbers::pi;

/// Angles between normals, degrees: faces that meet smoothly, and the range of chamfers, whose edges are blunt.
constexpr double smooth = 2, blunt_least = 10, blunt_most = 80;
/// A strip is so many times longer than wide.
constexpr double strip_length = 3;
/// Share of a full turn that a face around an axis may lack.
constexpr double turn_rounding = 1e-3;

/// How a face meets the face behind an edge.
struct Meeting {
  int face = 0;      // behind the edge; 0: none, or the face itself
  double angle = 0;  // between the normals outwards of the solid, degrees
  bool convex = false;
  double length = 0;
};

struct Look {
  GeomAbs_SurfaceType type = GeomAbs_OtherSurface;
  double radius = 0;  // the largest around an axis; the minor one of a torus
  bool concave = false;
  double turn = 0;    // angle around the axis
  double area = 0, perimeter = 0, extent = 0;
  gp_Pnt middle;
  gp_Ax1 axis;
  std::vector<Meeting> meetings;

  [[nodiscard]] double width() const { return perimeter > 0 ? 2 * area / perimeter : 0; }
  [[nodiscard]] bool turns_fully() const { return turn >= 2 * pi * (1 - turn_rounding); }
};

gp_Vec normal_outwards(const TopoDS_Face& face, double u, double v) {
  const BRepAdaptor_Surface surface(face, Standard_False);
  gp_Pnt p;
  gp_Vec su, sv;
  surface.D1(u, v, p, su, sv);
  gp_Vec n = su.Crossed(sv);
  if (n.Magnitude() > 0) n.Normalize();
  return face.Orientation() == TopAbs_REVERSED ? n.Reversed() : n;
}

class Finder {
 public:
  Finder(const ShapeFile& file, double size) : size_(size) {
    TopExp::MapShapes(file.shape, TopAbs_FACE, faces_);
    TopTools_IndexedMapOfShape solids;
    TopExp::MapShapes(file.shape, TopAbs_SOLID, solids);
    looks_.resize(static_cast<std::size_t>(faces_.Extent()));
    owner_.assign(looks_.size(), 0);
    taken_.assign(looks_.size(), false);
    for (int s = 1; s <= solids.Extent(); ++s) look_at_solid(solids(s), s);
  }

  std::vector<SmallFeature> run() {
    find_round("hole", true);
    find_round("boss", false);
    find_fillets();
    find_strips("chamfer", [](const Look& look) { return has_two(look, [](const Meeting& a, const Meeting& b) {
      const auto blunt = [](const Meeting& m) { return m.angle > blunt_least && m.angle < blunt_most; };
      return blunt(a) && blunt(b) && a.convex == b.convex;
    }); });
    find_strips("step", [](const Look& look) { return has_two(look, [](const Meeting& a, const Meeting& b) {
      return a.angle > smooth && b.angle > smooth && a.convex != b.convex;
    }); });
    find_small_faces();
    return std::move(found_);
  }

 private:
  [[nodiscard]] const TopoDS_Face& face(int f) const { return TopoDS::Face(faces_(f)); }
  [[nodiscard]] Look& look(int f) { return looks_[static_cast<std::size_t>(f - 1)]; }

  void look_at_solid(const TopoDS_Shape& solid, int number) {
    TopTools_IndexedDataMapOfShapeListOfShape around;
    TopExp::MapShapesAndAncestors(solid, TopAbs_EDGE, TopAbs_FACE, around);
    for (TopExp_Explorer e(solid, TopAbs_FACE); e.More(); e.Next()) {
      const int f = faces_.FindIndex(e.Current());
      if (f == 0 || owner_[static_cast<std::size_t>(f - 1)] != 0) continue;
      owner_[static_cast<std::size_t>(f - 1)] = number;
      try {
        measure(f);
        for (TopExp_Explorer edge(face(f), TopAbs_EDGE); edge.More(); edge.Next()) meet(f, TopoDS::Edge(edge.Current()), around);
      } catch (const Standard_Failure&) {
        look(f) = Look{};  // a face on which OpenCASCADE fails is no feature
      }
    }
  }

  void measure(int f) {
    Look& known = look(f);
    GProp_GProps of_surface, of_edges;
    BRepGProp::SurfaceProperties(face(f), of_surface);
    BRepGProp::LinearProperties(face(f), of_edges);
    known.area = of_surface.Mass(), known.perimeter = of_edges.Mass();
    Bnd_Box box;
    BRepBndLib::AddOptimal(face(f), box, Standard_False, Standard_False);
    if (!box.IsVoid()) known.extent = std::sqrt(box.SquareExtent());
    const BRepAdaptor_Surface surface(face(f), Standard_True);
    known.type = surface.GetType();
    double u1 = 0, u2 = 0, v1 = 0, v2 = 0;
    BRepTools::UVBounds(face(f), u1, u2, v1, v2);
    const double u = (u1 + u2) / 2, v = (v1 + v2) / 2;
    known.middle = surface.Value(u, v);
    gp_Pnt centre = known.middle;
    switch (known.type) {
      case GeomAbs_Cylinder:
        known.axis = surface.Cylinder().Axis(), known.radius = surface.Cylinder().Radius(), known.turn = u2 - u1;
        centre = foot_on(known.axis, known.middle);
        break;
      case GeomAbs_Cone: {
        const gp_Cone cone = surface.Cone();
        known.axis = cone.Axis(), known.turn = u2 - u1;
        for (const double end : {v1, v2}) known.radius = std::max(known.radius, std::abs(cone.RefRadius() + end * std::sin(cone.SemiAngle())));
        centre = foot_on(known.axis, known.middle);
        break;
      }
      case GeomAbs_Torus:
        known.radius = surface.Torus().MinorRadius();
        centre = foot_on(surface.Torus().Axis(), known.middle);
        centre = surface.Torus().Location().Translated(direction_to(surface.Torus(), known.middle) * surface.Torus().MajorRadius());
        break;
      case GeomAbs_Sphere:
        known.radius = surface.Sphere().Radius(), centre = surface.Sphere().Location();
        break;
      default:
        break;
    }
    known.concave = normal_outwards(face(f), u, v).Dot(gp_Vec(centre, known.middle)) < 0;
  }

  static gp_Pnt foot_on(const gp_Ax1& axis, const gp_Pnt& p) {
    const gp_Vec along(axis.Direction());
    return axis.Location().Translated(along * gp_Vec(axis.Location(), p).Dot(along));
  }
  /// Across the axis of a torus.
  static gp_Vec direction_to(const gp_Torus& torus, const gp_Pnt& p) {
    const gp_Vec along(torus.Axis().Direction());
    gp_Vec to(torus.Location(), p);
    to -= along * to.Dot(along);
    return to.Magnitude() > 0 ? to.Normalized() : to;
  }

  void meet(int f, const TopoDS_Edge& edge, const TopTools_IndexedDataMapOfShapeListOfShape& around) {
    if (BRep_Tool::Degenerated(edge) || !around.Contains(edge)) return;
    Meeting meeting;
    for (const TopoDS_Shape& other : around.FindFromKey(edge))
      if (!other.IsSame(face(f))) meeting.face = faces_.FindIndex(other);
    GProp_GProps properties;
    BRepGProp::LinearProperties(edge, properties);
    meeting.length = properties.Mass();
    if (meeting.face != 0) turn_over(f, edge, meeting);
    look(f).meetings.push_back(meeting);
  }

  /// The angle between both normals in the middle of the edge, and whether the solid bulges there.
  void turn_over(int f, const TopoDS_Edge& edge, Meeting& meeting) const {
    double first = 0, last = 0;
    const auto normal_at = [&](const TopoDS_Face& of) -> gp_Vec {
      const Handle(Geom2d_Curve) image = BRep_Tool::CurveOnSurface(edge, of, first, last);
      if (image.IsNull()) return {};
      const gp_Pnt2d uv = image->Value((first + last) / 2);
      return normal_outwards(of, uv.X(), uv.Y());
    };
    const gp_Vec own = normal_at(face(f)), other = normal_at(face(meeting.face));
    if (own.Magnitude() == 0 || other.Magnitude() == 0) return;
    meeting.angle = own.Angle(other) * 180 / pi;
    const BRepAdaptor_Curve curve(edge);
    gp_Pnt p;
    gp_Vec along;
    curve.D1((curve.FirstParameter() + curve.LastParameter()) / 2, p, along);
    if (edge.Orientation() == TopAbs_REVERSED) along.Reverse();
    // The face lies on the left of its edges: own x other points along a convex one.
    meeting.convex = own.Crossed(other).Dot(along) > 0;
  }

  [[nodiscard]] bool is_free(int f) const { return f > 0 && !taken_[static_cast<std::size_t>(f - 1)] && owner_[static_cast<std::size_t>(f - 1)] != 0; }

  /// All free faces that `holds` and that meet one another, from a face on.
  template <typename Holds>
  std::vector<int> connected(int from, Holds&& holds) {
    std::vector<int> group{from};
    std::set<int> seen{from};
    for (std::size_t i = 0; i < group.size(); ++i)
      for (const Meeting& meeting : look(group[i]).meetings)
        if (is_free(meeting.face) && holds(meeting.face) && seen.insert(meeting.face).second) group.push_back(meeting.face);
    return group;
  }

  /// Adds faces whose neighbours are all in the group: bottoms and caps. Returns their number.
  int close(std::vector<int>& group) {
    std::set<int> inside(group.begin(), group.end());
    int added = 0;
    for (std::size_t i = 0; i < group.size(); ++i)
      for (const Meeting& meeting : look(group[i]).meetings) {
        if (!is_free(meeting.face) || inside.contains(meeting.face)) continue;
        const auto& meetings = look(meeting.face).meetings;
        if (!std::all_of(meetings.begin(), meetings.end(), [&](const Meeting& m) { return m.face == 0 || inside.contains(m.face); })) continue;
        inside.insert(meeting.face), group.push_back(meeting.face), ++added;
      }
    return added;
  }

  [[nodiscard]] bool is_whole_solid(const std::vector<int>& group) const {
    const int solid = owner_[static_cast<std::size_t>(group.front() - 1)];
    return std::ssize(group) == std::count(owner_.begin(), owner_.end(), solid);
  }

  void take(const char* kind, double size, std::vector<int> group) {
    std::sort(group.begin(), group.end());
    for (const int f : group) taken_[static_cast<std::size_t>(f - 1)] = true;
    const gp_Pnt& p = look(group.front()).middle;
    found_.push_back({.kind = kind, .size = size, .faces = std::move(group), .place = {p.X(), p.Y(), p.Z()}});
  }

  /// Finds cylinders and cones that go round an axis, in one face or several, with their caps.
  void find_round(const char* kind, bool concave) {
    for (int f = 1; f <= faces_.Extent(); ++f) {
      const auto is_round = [&](int g) {
        const Look& l = look(g);
        return (l.type == GeomAbs_Cylinder || l.type == GeomAbs_Cone) && l.concave == concave && 2 * l.radius < size_ && l.turn > 0;
      };
      if (!is_free(f) || !is_round(f)) continue;
      const gp_Ax1 axis = look(f).axis;
      const auto is_around = [&](int g) { return is_round(g) && look(g).axis.IsCoaxial(axis, 1e-3, 1e-4 * size_); };
      const auto is_ring = [&](int g) {  // between two diameters of a counterbore
        return look(g).type == GeomAbs_Plane && look(g).meetings.size() >= 2 && std::all_of(look(g).meetings.begin(), look(g).meetings.end(), [&](const Meeting& m) {
                 return is_free(m.face) && is_around(m.face);
               });
      };
      std::vector<int> group = connected(f, [&](int g) { return is_around(g) || is_ring(g); });
      double turn = 0, radius = 0;
      for (const int g : group) turn = std::max(turn, turn_of(group, g)), radius = std::max(radius, look(g).radius);
      const int caps = close(group);
      if (turn < 2 * pi * (1 - turn_rounding) || (!concave && caps == 0) || is_whole_solid(group)) continue;
      take(kind, 2 * radius, std::move(group));
    }
  }
  /// Around the axis, of all faces of one radius.
  double turn_of(const std::vector<int>& group, int like) {
    double turn = 0;
    for (const int g : group)
      if (look(g).type == look(like).type && std::abs(look(g).radius - look(like).radius) < 1e-6 * size_) turn += look(g).turn;
    return turn;
  }

  /// Finds round faces that go over smoothly into at least two faces, with adjacent round faces.
  void find_fillets() {
    const auto is_fillet = [&](int f) {
      const Look& l = look(f);
      const bool round = l.type == GeomAbs_Cylinder || l.type == GeomAbs_Torus || l.type == GeomAbs_Sphere;
      const auto smooth_edges = std::count_if(l.meetings.begin(), l.meetings.end(),
                                              [](const Meeting& m) { return m.face != 0 && m.angle < smooth; });
      return round && l.radius > 0 && l.radius < size_ && smooth_edges >= 2 && (l.type != GeomAbs_Cylinder || !l.turns_fully());
    };
    for (int f = 1; f <= faces_.Extent(); ++f) {
      if (!is_free(f) || !is_fillet(f)) continue;
      std::vector<int> group = connected(f, is_fillet);
      double radius = 0;
      for (const int g : group) radius = std::max(radius, look(g).radius);
      if (!is_whole_solid(group)) take("fillet", radius, std::move(group));
    }
  }

  /// True if `holds` for the two longest edges to other faces, and these are two faces.
  template <typename Holds>
  static bool has_two(const Look& look, Holds&& holds) {
    std::vector<Meeting> meetings;
    std::copy_if(look.meetings.begin(), look.meetings.end(), std::back_inserter(meetings), [](const Meeting& m) { return m.face != 0; });
    if (meetings.size() < 2) return false;
    std::stable_sort(meetings.begin(), meetings.end(), [](const Meeting& a, const Meeting& b) { return a.length > b.length; });
    return meetings[0].face != meetings[1].face && holds(meetings[0], meetings[1]);
  }

  template <typename Holds>
  void find_strips(const char* kind, Holds&& holds) {
    for (int f = 1; f <= faces_.Extent(); ++f) {
      const Look& l = look(f);
      const bool strip = l.type == GeomAbs_Plane || l.type == GeomAbs_Cone || l.type == GeomAbs_Cylinder;
      if (!is_free(f) || !strip || !(l.width() > 0) || l.width() >= size_ || l.perimeter / 2 < strip_length * l.width() || !holds(l)) continue;
      if (!is_whole_solid({f})) take(kind, l.width(), {f});
    }
  }

  void find_small_faces() {
    for (int f = 1; f <= faces_.Extent(); ++f)
      if (is_free(f) && look(f).extent > 0 && look(f).extent < size_ && !is_whole_solid({f})) take("small face", look(f).extent, {f});
  }

  double size_;
  TopTools_IndexedMapOfShape faces_;
  std::vector<Look> looks_;  // by number - 1
  std::vector<int> owner_;   // solid of each face; 0: none
  std::vector<bool> taken_;
  std::vector<SmallFeature> found_;
};

/// The remaining faces of a file, from one operation to the next.
class Remains {
 public:
  explicit Remains(const ShapeFile& file) {
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(file.shape, TopAbs_FACE, faces);
    for (int f = 1; f <= faces.Extent(); ++f) left_.emplace_back().Append(faces(f));
  }
  [[nodiscard]] const TopTools_ListOfShape& of(int face) const { return left_[static_cast<std::size_t>(face - 1)]; }
  void follow(const ImagesOf& images_of) {
    for (TopTools_ListOfShape& each : left_) {
      TopTools_ListOfShape images;
      for (const TopoDS_Shape& face : each) {
        TopTools_ListOfShape own = images_of(face);
        images.Append(own);
      }
      each = images;
    }
  }

 private:
  std::vector<TopTools_ListOfShape> left_;
};

bool is_closed(const TopoDS_Shape& shape) {
  TopTools_IndexedDataMapOfShapeListOfShape around;
  TopExp::MapShapesAndUniqueAncestors(shape, TopAbs_EDGE, TopAbs_FACE, around);
  for (int e = 1; e <= around.Extent(); ++e) {
    const TopoDS_Edge edge = TopoDS::Edge(around.FindKey(e));
    if (!BRep_Tool::Degenerated(edge) && around(e).Size() < 2 && !BRep_Tool::IsClosed(edge, TopoDS::Face(around(e).First()))) return false;
  }
  return true;
}

/// The features of one kind at once: each that OpenCASCADE can remove is gone.
void remove_kind(ShapeFile& file, double size, std::vector<SmallFeature*>& features, Remains& remains,
                 const Message_ProgressRange& progress) {
  BOPAlgo_RemoveFeatures builder;
  TopTools_ListOfShape solids;
  add_parts(file.shape, TopAbs_SOLID, TopAbs_SHAPE, solids);
  builder.SetShape(compound_of(solids));
  double area = 0;
  for (const SmallFeature* feature : features)
    for (const int f : feature->faces)
      for (const TopoDS_Shape& face : remains.of(f)) builder.AddFaceToRemove(face), area += area_of(face);
  builder.Perform(progress);
  if (builder.HasErrors() || builder.Shape().IsNull()) return;
  const Handle(BRepTools_History) history = builder.History();
  const ImagesOf images_of = [&](const TopoDS_Shape& shape) {
    TopTools_ListOfShape images;
    if (!BRepTools_History::IsSupportedType(shape)) return images;
    images = history->Modified(shape);
    if (images.IsEmpty() && !history->IsRemoved(shape)) images.Append(shape);
    return images;
  };
  double before = 0, after = 0;
  for (const TopoDS_Shape& solid : solids) before += volume_of(solid);
  TopTools_ListOfShape results;
  add_parts(builder.Shape(), TopAbs_SOLID, TopAbs_SHAPE, results);
  for (const TopoDS_Shape& solid : results) after += volume_of(solid);
  if (results.Size() != solids.Size() || std::abs(after - before) > size * area || !is_closed(builder.Shape())) return;
  for (SmallFeature* feature : features)
    feature->removed = std::all_of(feature->faces.begin(), feature->faces.end(), [&](int f) {
      return std::all_of(remains.of(f).begin(), remains.of(f).end(), [&](const TopoDS_Shape& face) { return images_of(face).IsEmpty(); });
    });
  remains.follow(images_of);
  add_parts(file.shape, TopAbs_SHELL, TopAbs_SOLID, results);
  add_parts(file.shape, TopAbs_FACE, TopAbs_SHELL, results);
  file = with_images(file, compound_of(results), images_of);
}

}  // namespace

std::vector<SmallFeature> find_small_features(const ShapeFile& file, double size) { return Finder(file, size).run(); }

std::vector<SmallFeature> remove_small_features(ShapeFile& file, double size, const Message_ProgressRange& progress) {
  std::vector<SmallFeature> features = find_small_features(file, size);
  Remains remains(file);
  constexpr std::array<const char*, 6> kinds{"hole", "boss", "fillet", "chamfer", "step", "small face"};
  Message_ProgressScope scope(progress, nullptr, static_cast<double>(kinds.size()));
  for (const char* kind : kinds) {
    std::vector<SmallFeature*> of_kind;
    for (SmallFeature& feature : features)
      if (feature.kind == kind) of_kind.push_back(&feature);
    const Message_ProgressRange range = scope.Next();
    if (!of_kind.empty() && scope.More()) remove_kind(file, size, of_kind, remains, range);
  }
  return features;
}

}  // namespace carreau_occ
