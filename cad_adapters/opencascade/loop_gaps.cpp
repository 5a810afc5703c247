// SPDX-License-Identifier: BSD-3-Clause
#include "loop_gaps.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <ShapeConstruct_ProjectCurveOnSurface.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "faults.h"
#include "thresholds.h"

namespace carreau_occ {
namespace {

using Images = std::vector<Handle(Geom2d_Curve)>;
/// An end of an edge, the same in all faces: its number, and whether its parameter is the last one.
using EdgeEnd = std::pair<int, bool>;

/// An end of a curve of a face.
struct CurveEnd {
  std::size_t curve = 0;
  EdgeEnd end;
  gp_Pnt2d uv;
  gp_Pnt at;
};

/// The end of a curve and the start of the next one in its loop.
struct Joint {
  std::size_t face = 0;
  int vertex = 0;
  CurveEnd in, out;
  double gap = 0;
};

/// Sets of edge ends that are one point.
class EndSets {
 public:
  EdgeEnd top(EdgeEnd end) {
    for (auto next = above_.find(end); next != above_.end(); next = above_.find(end)) end = next->second;
    return end;
  }
  void merge(EdgeEnd a, EdgeEnd b) {
    a = top(a), b = top(b);
    if (a != b) above_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::map<EdgeEnd, EdgeEnd> above_;
};

constexpr int probes = 8;  // intervals of a curve in which it is compared

class GapCloser {
 public:
  explicit GapCloser(const LoopsOfFaces& loops)
      : loops_(loops), images_(loops.faces.size()), changed_(loops.faces.size(), 0) {}

  std::string run() {
    for (std::size_t f = 0; f < loops_.faces.size(); ++f) collect(f);
    if (!any_doubt_) return "";
    measure();
    for (const auto& [f, curves] : doubtful_curves()) make_images_anew(f, curves);
    divide_vertices();
    close();
    for (std::size_t f = 0; f < loops_.faces.size(); ++f)
      if (changed_[f] != 0) {
        guarded([&] { loops_.evaluators.set(f, forward(f), images_of(f)); });
      }
    return sentence();
  }

 private:
  [[nodiscard]] HostFace& face(std::size_t f) { return loops_.faces[f]; }
  Images& images_of(std::size_t f) {
    if (images_[f].empty()) images_[f] = loops_.evaluators.curves(f);
    return images_[f];
  }
  [[nodiscard]] const Handle(Geom2d_Curve) & image(std::size_t f, std::size_t c) {
    return (images_[f].empty() ? loops_.evaluators.curves(f) : images_[f])[c];
  }
  [[nodiscard]] TopoDS_Face forward(std::size_t f) const {
    return TopoDS::Face(loops_.shapes(static_cast<int>(f) + 1).Oriented(TopAbs_FORWARD));
  }
  // The evaluators of a thread keep the curves that a face had at the first call.
  const BRepAdaptor_Surface& surface_of(std::size_t f) {
    std::unique_ptr<BRepAdaptor_Surface>& known = surfaces_[f];
    if (!known) known = std::make_unique<BRepAdaptor_Surface>(forward(f), Standard_False);
    return *known;
  }
  [[nodiscard]] TopoDS_Edge edge(int number) const { return TopoDS::Edge(loops_.edges(number)); }
  [[nodiscard]] bool is_pole(const HostCurve& curve) const {
    return BRep_Tool::Degenerated(edge(curve.edge)) == Standard_True;
  }

  CurveEnd end_of(std::size_t f, std::size_t c, bool last) {
    const HostCurve& curve = face(f).curves[c];
    CurveEnd end{c, {curve.edge, last}, image(f, c)->Value(last ? curve.last : curve.first), {}};
    surface_of(f).D0(end.uv.X(), end.uv.Y(), end.at);
    return end;
  }

  gp_Pnt point(std::size_t f, std::size_t c, double share) {
    const HostCurve& curve = face(f).curves[c];
    const gp_Pnt2d uv = image(f, c)->Value(curve.first + share * (curve.last - curve.first));
    gp_Pnt at;
    surface_of(f).D0(uv.X(), uv.Y(), at);
    return at;
  }

  double length(std::size_t f, std::size_t c) {
    constexpr int parts = 6;
    double sum = 0;
    gp_Pnt before = point(f, c, 0);
    for (int i = 1; i <= parts; ++i) {
      const gp_Pnt at = point(f, c, static_cast<double>(i) / parts);
      sum += at.Distance(before);
      before = at;
    }
    return sum;
  }

  /// Joints of the loops of a face.
  void collect(std::size_t f) {
    std::erase_if(joints_, [&](const Joint& joint) { return joint.face == f; });
    if (!face(f).broken.empty() || !face(f).known) return;
    try {
      guarded([&] { collect_joints(f); });
    } catch (const Standard_Failure&) {  // meshing the face will report it
    }
  }

  void collect_joints(std::size_t f) {
    std::map<int, std::array<std::vector<CurveEnd>, 2>> at_vertex;  // ends that arrive, ends that leave
    for (std::size_t c = 0; c < face(f).curves.size(); ++c) {
      const HostCurve& curve = face(f).curves[c];
      if (curve.internal || curve.end1 == 0 || curve.end2 == 0) continue;
      at_vertex[curve.end1][curve.forward ? 1 : 0].push_back(end_of(f, c, false));
      at_vertex[curve.end2][curve.forward ? 0 : 1].push_back(end_of(f, c, true));
      if (is_pole(curve) && length(f, c) > doubt()) any_doubt_ = true;
    }
    for (auto& [vertex, ends] : at_vertex)
      if (ends[0].size() == ends[1].size()) join(f, vertex, ends[0], ends[1]);
  }

  /// Joins the nearest ends in space, and among equally near ends the nearest in the parameter plane. An edge goes on
  /// to itself if there is no other edge, as a circle does.
  void join(std::size_t f, int vertex, std::vector<CurveEnd>& in, std::vector<CurveEnd>& out) {
    std::vector<std::tuple<bool, double, double, std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < in.size(); ++i)
      for (std::size_t j = 0; j < out.size(); ++j) {
        const double apart = in[i].at.Distance(out[j].at);
        pairs.emplace_back(in[i].end.first == out[j].end.first, apart <= doubt() ? 0 : apart,
                           in[i].uv.Distance(out[j].uv), i, j);
      }
    std::sort(pairs.begin(), pairs.end());
    std::vector<char> taken_in(in.size(), 0), taken_out(out.size(), 0);
    for (const auto& [to_itself, apart, in_plane, i, j] : pairs) {
      if (taken_in[i] != 0 || taken_out[j] != 0) continue;
      taken_in[i] = taken_out[j] = 1;
      joints_.push_back({f, vertex, in[i], out[j], apart});
      any_doubt_ = any_doubt_ || apart > 0 || off_vertex(joints_.back()) > 0;
    }
  }

  /// Distance of the ends of curves beyond the tolerance of their vertex.
  [[nodiscard]] double off_vertex(const Joint& joint) const {
    const TopoDS_Vertex vertex = TopoDS::Vertex(loops_.vertices(joint.vertex));
    const gp_Pnt at = BRep_Tool::Pnt(vertex);
    const double off = std::max(at.Distance(joint.in.at), at.Distance(joint.out.at));
    return off > std::max(BRep_Tool::Tolerance(vertex), doubt()) ? off : 0;
  }

  static double doubt() { return 100 * Precision::Confusion(); }

  void measure() {
    Bnd_Box box;
    for (int v = 1; v <= loops_.vertices.Extent(); ++v) box.Add(BRep_Tool::Pnt(TopoDS::Vertex(loops_.vertices(v))));
    for (const Joint& joint : joints_) {
      box.Add(joint.in.at);
      box.Add(point(joint.face, joint.in.curve, 1.0 / 2));
    }
    if (!box.IsVoid()) diagonal_ = std::sqrt(box.SquareExtent());
  }

  [[nodiscard]] bool is_wide(double gap, double shorter) const {
    return gap > doubt() && (gap > thresholds::wide_gap * diagonal_ || (gap > thresholds::narrow_gap * diagonal_ &&
                                                                        gap > thresholds::gap_beside_curve * shorter));
  }
  bool is_open(const Joint& joint) {
    if (joint.gap <= doubt()) return false;
    return is_wide(joint.gap, std::min(length(joint.face, joint.in.curve), length(joint.face, joint.out.curve)));
  }
  /// Curves that miss each other or their vertex.
  [[nodiscard]] std::map<std::size_t, std::set<std::size_t>> doubtful_curves() {
    std::map<std::size_t, std::set<std::size_t>> curves;  // by face
    for (const Joint& joint : joints_)
      if (is_open(joint) || is_wide(off_vertex(joint), 0)) curves[joint.face].insert({joint.in.curve, joint.out.curve});
    return curves;
  }
  /// True for a side that the file calls a point although it has a length.
  bool is_false_pole(std::size_t f, std::size_t c) {
    const HostCurve& curve = face(f).curves[c];
    return is_pole(curve) && curve.end1 == curve.end2 && curve.end1 != 0 && !curve.internal && is_wide(length(f, c), 0);
  }

  void make_images_anew(std::size_t f, const std::set<std::size_t>& curves) {
    bool any = false;
    for (const std::size_t c : curves) {
      try {
        guarded([&] { any = make_image_anew(f, c) || any; });
      } catch (const Standard_Failure&) {  // the image stays
      }
    }
    if (any) collect(f);
  }

  bool make_image_anew(std::size_t f, std::size_t c) {
    HostCurve& curve = face(f).curves[c];
    double first = 0, last = 0;
    const Handle(Geom_Curve) in_space = BRep_Tool::Curve(edge(curve.edge), first, last);
    if (is_pole(curve) || in_space.IsNull() || !(first < last)) return false;
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(forward(f));
    ShapeAnalysis_Surface analysis(surface);
    double to_image = 0, to_surface = 0;
    gp_Pnt2d start;
    for (int i = 0; i <= probes; ++i) {
      const double share = static_cast<double>(i) / probes;
      const gp_Pnt p = in_space->Value(first + share * (last - first));
      const gp_Pnt2d uv = analysis.ValueOfUV(p, Precision::Confusion());
      if (i == 0) start = uv;
      to_surface = std::max(to_surface, p.Distance(analysis.Value(uv)));
      to_image = std::max(to_image, p.Distance(point(f, c, share)));
    }
    if (!is_wide(to_image, 0) || to_surface > thresholds::wrong_image * to_image) return false;
    Handle(Geom2d_Curve) made = moved_image(f, c, first, last, start);
    if (made.IsNull() || off(f, made, *in_space, first, last) > thresholds::wrong_image * to_image) {
      if (BRep_Tool::IsClosed(edge(curve.edge), forward(f))) return false;  // a seam has two images
      made = projected(surface, in_space, first, last, to_surface);
      if (made.IsNull()) return false;
      move_beside(*surface, image(f, c)->Value(curve.first), made, first);
    }
    images_of(f)[c] = made;
    curve.first = first, curve.last = last;
    changed_[f] = 1;
    ++remade_;
    tell(f, c, to_image);
    return true;
  }

  /// The image, moved to where the curve in space begins; null where the two run over different intervals.
  Handle(Geom2d_Curve) moved_image(std::size_t f, std::size_t c, double first, double last, gp_Pnt2d start) {
    const HostCurve& curve = face(f).curves[c];
    if (std::abs(curve.first - first) + std::abs(curve.last - last) > Precision::PConfusion()) return nullptr;
    const Handle(Geom2d_Curve) made = Handle(Geom2d_Curve)::DownCast(image(f, c)->Copy());
    const gp_Pnt2d before = made->Value(first);
    made->Translate(before, start);
    move_beside(*BRep_Tool::Surface(forward(f)), before, made, first);
    return made;
  }

  /// Distance of the image from the curve in space.
  double off(std::size_t f, const Handle(Geom2d_Curve) & made, const Geom_Curve& in_space, double first, double last) {
    double off = 0;
    for (int i = 0; i <= probes; ++i) {
      const double t = first + (last - first) * i / probes;
      const gp_Pnt2d uv = made->Value(t);
      gp_Pnt at;
      surface_of(f).D0(uv.X(), uv.Y(), at);
      off = std::max(off, at.Distance(in_space.Value(t)));
    }
    return off;
  }

  static Handle(Geom2d_Curve) projected(const Handle(Geom_Surface) & surface, const Handle(Geom_Curve) & in_space,
                                        double first, double last, double to_surface) {
    ShapeConstruct_ProjectCurveOnSurface project;
    project.Init(surface, std::max(to_surface, Precision::Confusion()));
    Handle(Geom_Curve) given = in_space;
    Handle(Geom2d_Curve) made;
    if (!project.Perform(given, first, last, made) || made.IsNull()) return nullptr;
    const double rounding = Precision::PConfusion();
    return made->FirstParameter() > first + rounding || made->LastParameter() < last - rounding ? nullptr : made;
  }

  /// The period of the surface in which the previous image was.
  static void move_beside(const Geom_Surface& surface, gp_Pnt2d near, const Handle(Geom2d_Curve) & made, double first) {
    const gp_Vec2d apart(made->Value(first), near);
    const auto turns = [](double distance, double period) { return period * std::round(distance / period); };
    made->Translate(gp_Vec2d(surface.IsUPeriodic() ? turns(apart.X(), surface.UPeriod()) : 0,
                             surface.IsVPeriodic() ? turns(apart.Y(), surface.VPeriod()) : 0));
  }

  void tell(std::size_t f, std::size_t c, double gap) {
    if (gap <= widest_) return;
    widest_ = gap;
    where_ = "edge " + std::to_string(face(f).curves[c].edge) + " of face " + std::to_string(f + 1);
  }

  /// Parts of a vertex that a gap, or a side that is no point, keeps apart get vertices of their own.
  void divide_vertices() {
    std::set<int> divided;
    for (const Joint& joint : joints_)
      if (is_open(joint)) divided.insert(joint.vertex);
    for (std::size_t f = 0; f < loops_.faces.size(); ++f)
      for (std::size_t c = 0; c < face(f).curves.size() && face(f).known && face(f).broken.empty(); ++c)
        if (is_false_pole(f, c)) divided.insert(face(f).curves[c].end1), false_poles_.emplace_back(f, c);
    if (divided.empty()) return;
    std::map<EdgeEnd, gp_Pnt> at;
    for (const Joint& joint : joints_) {
      if (divided.count(joint.vertex) == 0) continue;
      at.try_emplace(joint.in.end, joint.in.at);
      at.try_emplace(joint.out.end, joint.out.at);
      if (!is_open(joint)) sets_.merge(joint.in.end, joint.out.end);
    }
    std::map<int, std::set<EdgeEnd>> parts;  // of each vertex, by their smallest ends
    const auto keep_apart = [&](int vertex, EdgeEnd a, EdgeEnd b) {
      if (sets_.top(a) != sets_.top(b)) parts[vertex].insert({sets_.top(a), sets_.top(b)});
    };
    for (const Joint& joint : joints_)
      if (is_open(joint)) keep_apart(joint.vertex, joint.in.end, joint.out.end);
    for (const auto& [f, c] : false_poles_) {
      const HostCurve& curve = face(f).curves[c];
      keep_apart(curve.end1, {curve.edge, false}, {curve.edge, true});
    }
    for (const auto& [vertex, tops] : parts)
      for (auto top = std::next(tops.begin()); top != tops.end(); ++top) {
        TopoDS_Vertex part;
        BRep_Builder().MakeVertex(part, at[*top], BRep_Tool::Tolerance(TopoDS::Vertex(loops_.vertices(vertex))));
        vertex_of_[*top] = loops_.vertices.Add(part);
      }
    for (HostFace& each : loops_.faces)
      for (HostCurve& curve : each.curves) {
        curve.end1 = vertex_of({curve.edge, false}, curve.end1);
        curve.end2 = vertex_of({curve.edge, true}, curve.end2);
      }
  }

  int vertex_of(EdgeEnd end, int vertex) {
    const auto found = vertex_of_.find(sets_.top(end));
    return found != vertex_of_.end() ? found->second : vertex;
  }

  void close() {
    for (const auto& [f, c] : false_poles_) {
      const HostCurve& curve = face(f).curves[c];
      if (curve.end1 == curve.end2) continue;
      loops_.uses[static_cast<std::size_t>(curve.edge - 1)] = 1;
      ++closed_;
      tell(f, c, length(f, c));
    }
    std::map<std::pair<int, int>, int> known;  // edges that close gaps, by their ends
    const std::vector<Joint> joints = joints_;
    for (const Joint& joint : joints) {
      if (!is_open(joint) || joint.in.uv.Distance(joint.out.uv) <= Precision::PConfusion()) continue;
      const int from = vertex_of(joint.in.end, joint.vertex), to = vertex_of(joint.out.end, joint.vertex);
      if (from == to) continue;
      tell(joint.face, joint.in.curve, joint.gap);
      add_edge(joint, from, to, known);
    }
  }

  void add_edge(const Joint& joint, int from, int to, std::map<std::pair<int, int>, int>& known) {
    const std::pair<int, int> ends = std::minmax(from, to);
    const auto [found, fresh] = known.try_emplace(ends, 0);
    if (fresh) {
      const BRep_Builder builder;
      TopoDS_Edge made;
      builder.MakeEdge(made);
      builder.UpdateEdge(made, Precision::Confusion());  // gluing has to heed no gap
      found->second = loops_.edges.Add(made);
      loops_.uses.resize(static_cast<std::size_t>(loops_.edges.Extent()), 0);
      ++closed_;
    }
    ++loops_.uses[static_cast<std::size_t>(found->second - 1)];
    HostCurve curve;
    curve.edge = found->second;
    curve.end1 = ends.first, curve.end2 = ends.second;
    curve.forward = from == ends.first;
    const gp_Pnt2d start = curve.forward ? joint.in.uv : joint.out.uv, end = curve.forward ? joint.out.uv : joint.in.uv;
    curve.first = 0, curve.last = start.Distance(end);
    images_of(joint.face).push_back(new Geom2d_Line(start, gp_Dir2d(gp_Vec2d(start, end))));
    face(joint.face).curves.push_back(curve);
    changed_[joint.face] = 1;
  }

  [[nodiscard]] std::string sentence() const {
    if (remade_ + closed_ == 0) return "";
    const auto count = [](int n, const char* one, const char* many) {
      return std::to_string(n) + " " + (n == 1 ? one : many);
    };
    std::string done;
    if (remade_ > 0) done = count(remade_, "curve was", "curves were") + " made anew in the parameter plane";
    if (closed_ > 0) done += (done.empty() ? "" : ", ") + count(closed_, "gap was", "gaps were") + " closed by an edge";
    char width[32];
    std::snprintf(width, sizeof width, "%.3g", widest_);
    return "curves of loops end up to " + std::string(width) + " away from their neighbours (" + where_ + "): " + done;
  }

  const LoopsOfFaces& loops_;
  std::map<std::size_t, std::unique_ptr<BRepAdaptor_Surface>> surfaces_;
  std::vector<Images> images_;
  std::vector<char> changed_;
  std::vector<Joint> joints_;
  std::vector<std::pair<std::size_t, std::size_t>> false_poles_;  // faces and their curves
  EndSets sets_;
  std::map<EdgeEnd, int> vertex_of_;  // of sets that left their vertex
  bool any_doubt_ = false;
  double diagonal_ = 0, widest_ = 0;
  int remade_ = 0, closed_ = 0;
  std::string where_;
};

}  // namespace

std::string close_loop_gaps(const LoopsOfFaces& loops) { return GapCloser(loops).run(); }

}  // namespace carreau_occ
