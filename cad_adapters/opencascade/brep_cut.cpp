// SPDX-License-Identifier: BSD-3-Clause
// Faces of a BrepHost that bend inside, cut along their kinks.
#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Line.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Curve.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "brep_state.h"
#include "domain_cut.h"
#include "faults.h"
#include "kinks.h"
#include "line_crossings.h"

namespace carreau_occ {
namespace {

using Images = std::vector<Handle(Geom2d_Curve)>;

/// A face to be cut.
struct Bent {
  int face = 0;  // number
  CutLines lines;
  ClosingKink closing;
  gp_XY near;    // (u, v) closer than that is one
  gp_XY extent;  // of its box of parameters
};

/// The place of a cut of an edge: its parameter on one of its curves, and the place.
struct EdgeCut {
  int face = 0, curve = 0;  // number of the face, index of its curve
  double t = 0;
  gp_Pnt at;
  int vertex = 0;
};

/// The cutter of the faces of one file. Numbers and indices as in the host's state.
class KinkCutter {
 public:
  struct Result {
    std::vector<HostFace> faces;  // faces of the shape, then parts
    std::vector<Images> images;
    std::vector<PartBox> boxes;
    std::vector<char> changed;  // by face
    std::vector<int> bent, uses;
    int vertex_total = 0;
    std::map<int, int> whole_edge;
    double shortest_free_piece = std::numeric_limits<double>::infinity();
    double free_gap = 0;
  };

  KinkCutter(const TopTools_IndexedMapOfShape& faces, const TopTools_IndexedMapOfShape& edges,
             const TopTools_IndexedMapOfShape& vertices, Result start)
      : faces_(faces), edges_(edges), vertices_(vertices), result_(std::move(start)) {}

  /// Nothing to cut: no value.
  std::optional<Result> run() {
    std::vector<Bent> wanted = find();
    if (wanted.empty() && result_.bent.empty()) return std::nullopt;
    cut_edges(wanted);
    for (const Bent& bent : wanted)
      if (!cut_face(bent)) result_.bent.push_back(bent.face);
    std::sort(result_.bent.begin(), result_.bent.end());
    return std::move(result_);
  }

 private:
  [[nodiscard]] HostFace& host(int face) { return result_.faces[static_cast<std::size_t>(face - 1)]; }
  [[nodiscard]] Images& images(int face) { return result_.images[static_cast<std::size_t>(face - 1)]; }
  [[nodiscard]] TopoDS_Face shape(int face) const { return TopoDS::Face(faces_(face).Oriented(TopAbs_FORWARD)); }

  std::vector<Bent> find() {
    std::vector<Bent> found;
    for (int f = 1; f <= faces_.Extent(); ++f) {
      if (!host(f).broken.empty() || !host(f).known) continue;
      try {
        guarded([&] {
          Bent bent{.face = f, .lines = {}, .closing = closing_kink_of(shape(f)), .near = {}, .extent = {}};
          bool torn = false;
          for (const Kink& kink : kinks_of(shape(f))) {
            torn = torn || kink.torn;
            (kink.of_u ? bent.lines.u : bent.lines.v).push_back(kink.at);
          }
          if (torn) return result_.bent.push_back(f);
          const bool any = !bent.lines.u.empty() || !bent.lines.v.empty() || bent.closing.of_u || bent.closing.of_v;
          if (!any) return;
          measure(bent);
          found.push_back(bent);
        });
      } catch (const Standard_Failure&) {  // meshing reports it
      }
    }
    return found;
  }

  void measure(Bent& bent) {
    constexpr double rounding = 1e-9, most = 1e-4;  // of the extent
    const BRepAdaptor_Surface surface(shape(bent.face));
    bent.extent = {surface.LastUParameter() - surface.FirstUParameter(),
                   surface.LastVParameter() - surface.FirstVParameter()};
    double tolerance = 0;
    for (const HostCurve& curve : host(bent.face).curves)
      for (const int end : {curve.end1, curve.end2})
        if (end >= 1 && end <= vertices_.Extent())
          tolerance = std::max(tolerance, BRep_Tool::Tolerance(TopoDS::Vertex(vertices_(end))));
    bent.near.SetX(std::clamp(surface.UResolution(2 * tolerance), rounding * bent.extent.X(), most * bent.extent.X()));
    bent.near.SetY(std::clamp(surface.VResolution(2 * tolerance), rounding * bent.extent.Y(), most * bent.extent.Y()));
  }

  [[nodiscard]] gp_Pnt place(int face, int curve, double t) {
    const gp_Pnt2d uv = images(face)[static_cast<std::size_t>(curve)]->Value(t);
    gp_Pnt p;
    BRepAdaptor_Surface(shape(face), Standard_False).D0(uv.X(), uv.Y(), p);
    return p;
  }

  /// All edges that the faces' lines cross, in all faces that have them.
  void cut_edges(std::vector<Bent>& wanted) {
    std::map<int, std::vector<EdgeCut>> cuts;  // by edge
    for (int f = 1; f <= faces_.Extent(); ++f)
      for (std::size_t c = 0; c < host(f).curves.size(); ++c)
        uses_of_[host(f).curves[c].edge].emplace_back(f, static_cast<int>(c));
    for (const Bent& bent : wanted)
      for (std::size_t c = 0; c < host(bent.face).curves.size(); ++c) collect_cuts(bent, static_cast<int>(c), cuts);
    // Two curves of one edge must agree on the order of its cuts. Otherwise the edge stays whole, and so do the faces
    // that need it cut.
    std::erase_if(cuts, [](const auto& each) { return each.second.empty(); });
    for (auto& [edge, list] : cuts)
      std::sort(list.begin(), list.end(), [](const EdgeCut& a, const EdgeCut& b) { return a.t < b.t; });
    const int whole_edges = static_cast<int>(result_.uses.size());
    std::map<int, int> first_piece;  // number of the second piece of an edge
    for (auto it = cuts.begin(); it != cuts.end();) {
      if (!on_all_curves(it->first, it->second)) {
        it = cuts.erase(it);
        continue;
      }
      const bool point = BRep_Tool::Degenerated(TopoDS::Edge(edges_(it->first)));
      for (EdgeCut& cut : it->second)
        cut.vertex = point ? host(cut.face).curves[static_cast<std::size_t>(cut.curve)].end1 : ++result_.vertex_total;
      first_piece[it->first] = static_cast<int>(result_.uses.size()) + 1;
      result_.uses.resize(result_.uses.size() + it->second.size(),
                          result_.uses[static_cast<std::size_t>(it->first - 1)]);
      ++it;
    }
    if (static_cast<int>(result_.uses.size()) == whole_edges) return;
    std::vector<Divided> divided;
    for (int f = 1; f <= faces_.Extent(); ++f)
      if (std::optional<Divided> now = divide_curves(f, cuts, first_piece)) divided.push_back(std::move(*now));
    for (Divided& now : divided) {
      host(now.face).curves = std::move(now.curves);
      images(now.face) = std::move(now.images);
      result_.changed[static_cast<std::size_t>(now.face - 1)] = 1;
    }
  }

  void collect_cuts(const Bent& bent, int index, std::map<int, std::vector<EdgeCut>>& cuts) {
    constexpr double brief = 16;
    const HostCurve& curve = host(bent.face).curves[static_cast<std::size_t>(index)];
    const Handle(Geom2d_Curve)& image = images(bent.face)[static_cast<std::size_t>(index)];
    for (const bool of_u : {true, false})
      for (const double at : of_u ? bent.lines.u : bent.lines.v)
        for (const double t : crossings(image, curve.first, curve.last, of_u, at, of_u ? bent.near.X() : bent.near.Y(),
                                        brief * (of_u ? bent.near.Y() : bent.near.X()))) {
          std::vector<EdgeCut>& list = cuts[curve.edge];
          const EdgeCut cut{.face = bent.face, .curve = index, .t = t, .at = place(bent.face, index, t), .vertex = 0};
          const bool known =
              at_an_end(cut, bent, of_u, at) ||
              std::any_of(list.begin(), list.end(), [&](const EdgeCut& other) { return same(cut, other, curve); });
          if (!known) list.push_back(cut);
        }
  }

  /// True if an end on the line is as near as its vertex lets curves miss it: then the line passes through this end.
  [[nodiscard]] bool at_an_end(const EdgeCut& cut, const Bent& bent, bool of_u, double at) {
    const HostCurve& curve = host(cut.face).curves[static_cast<std::size_t>(cut.curve)];
    if (BRep_Tool::Degenerated(TopoDS::Edge(edges_(curve.edge)))) return false;
    for (const bool last : {false, true}) {
      const int end = last ? curve.end2 : curve.end1;
      if (end < 1 || end > vertices_.Extent()) continue;
      const TopoDS_Vertex vertex = TopoDS::Vertex(vertices_(end));
      if (cut.at.Distance(BRep_Tool::Pnt(vertex)) > 2 * BRep_Tool::Tolerance(vertex)) continue;
      const gp_Pnt2d uv = images(cut.face)[static_cast<std::size_t>(cut.curve)]->Value(last ? curve.last : curve.first);
      if (std::abs((of_u ? uv.X() : uv.Y()) - at) <= (of_u ? bent.near.X() : bent.near.Y())) return true;
    }
    return false;
  }

  /// The other curve of a seam, the face on the other side of the edge, or two lines that cross there.
  [[nodiscard]] bool same(const EdgeCut& a, const EdgeCut& b, const HostCurve& curve) const {
    constexpr double rounding = 1e-7, close = 0.01;  // of the curve
    const TopoDS_Edge edge = TopoDS::Edge(edges_(curve.edge));
    const double apart = std::abs(a.t - b.t) / (curve.last - curve.first);
    if (apart <= rounding) return true;
    return apart <= close && !BRep_Tool::Degenerated(edge) && a.at.Distance(b.at) <= 2 * BRep_Tool::Tolerance(edge);
  }

  /// The parameter of a cut on any curve of its edge.
  double parameter(const EdgeCut& cut, int face, int index) {
    const HostCurve& curve = host(face).curves[static_cast<std::size_t>(index)];
    const HostCurve& own = host(cut.face).curves[static_cast<std::size_t>(cut.curve)];
    if (face == cut.face) return cut.t;
    const double share = (cut.t - own.first) / (own.last - own.first);
    const double guess = curve.first + share * (curve.last - curve.first);
    const TopoDS_Edge edge = TopoDS::Edge(edges_(curve.edge));
    const double tolerance = std::max(BRep_Tool::Tolerance(edge), 1e-7);
    if (BRep_Tool::Degenerated(edge) || place(face, index, guess).Distance(cut.at) <= tolerance) return guess;
    // Curves that run along each other at different paces: the nearest of some places, then of those around.
    constexpr int places = 200, rounds = 100;
    double best = guess, distance = HUGE_VAL;
    for (int i = 1; i < places; ++i) {
      const double t = curve.first + i * (curve.last - curve.first) / places;
      if (const double d = place(face, index, t).Distance(cut.at); d < distance) best = t, distance = d;
    }
    double step = (curve.last - curve.first) / places;
    for (int i = 0; i < rounds; ++i, step *= 0.7)
      for (const double t : {best - step, best + step}) {
        if (t <= curve.first || t >= curve.last) continue;
        if (const double d = place(face, index, t).Distance(cut.at); d < distance) best = t, distance = d;
      }
    return best;
  }

  bool on_all_curves(int edge, const std::vector<EdgeCut>& cuts) {
    for (const auto& [f, c] : uses_of_[edge]) {
      const HostCurve& curve = host(f).curves[static_cast<std::size_t>(c)];
      double before = curve.first;
      for (const EdgeCut& cut : cuts) {
        const double t = parameter(cut, f, c);
        if (!(t > before)) return false;
        before = t;
      }
      if (!(before < curve.last)) return false;
    }
    return true;
  }

  struct Divided {
    int face = 0;
    std::vector<HostCurve> curves;
    Images images;
  };
  std::optional<Divided> divide_curves(int face, const std::map<int, std::vector<EdgeCut>>& cuts,
                                       const std::map<int, int>& first_piece) {
    const HostFace& old = host(face);
    std::vector<HostCurve> curves;
    Images all;
    for (std::size_t c = 0; c < old.curves.size(); ++c) {
      HostCurve rest = old.curves[c];
      const int piece_of = rest.edge;
      const auto found = cuts.find(rest.edge);
      int next = found != cuts.end() ? first_piece.at(rest.edge) : 0;
      if (found != cuts.end())
        for (const EdgeCut& cut : found->second) {
          HostCurve piece = rest;
          piece.last = rest.first = parameter(cut, face, static_cast<int>(c));
          piece.end2 = rest.end1 = cut.vertex;
          curves.push_back(piece);
          all.push_back(images(face)[c]);
          if (result_.uses[static_cast<std::size_t>(piece.edge - 1)] == 1)
            note_free(TopoDS::Edge(edges_(piece_of)), place(face, static_cast<int>(c), piece.first),
                      place(face, static_cast<int>(c), piece.last));
          rest.edge = next++;
          result_.whole_edge[rest.edge] = piece_of;
        }
      curves.push_back(rest);
      all.push_back(images(face)[c]);
    }
    if (curves.size() == old.curves.size()) return std::nullopt;
    return Divided{face, std::move(curves), std::move(all)};
  }

  /// Records the length of a piece for gluing, and the distance of its new end from the edge. An edge that OpenCASCADE
  /// has computed across a bend is farthest from its faces there.
  void note_free(const TopoDS_Edge& edge, const gp_Pnt& from, const gp_Pnt& to) {
    result_.shortest_free_piece = std::min(result_.shortest_free_piece, from.Distance(to));
    gp_Pnt nearest;
    double at = 0;
    const double gap = ShapeAnalysis_Curve().Project(BRepAdaptor_Curve(edge), to, Precision::Confusion(), nearest, at);
    result_.free_gap = std::max(result_.free_gap, gap);
  }

  /// False: it stays as it is.
  bool cut_face(const Bent& bent) {
    const HostFace whole = host(bent.face);
    const Images own = images(bent.face);
    std::vector<DomainArc> arcs;
    for (std::size_t c = 0; c < whole.curves.size(); ++c) {
      const HostCurve& curve = whole.curves[c];
      arcs.push_back({.end1 = curve.end1,
                      .end2 = curve.end2,
                      .forward = curve.forward,
                      .internal = curve.internal,
                      .samples = sampled(own[c], curve.first, curve.last)});
    }
    const std::optional<DomainCut> cut = cut_domain(arcs, bent.lines, bent.near, result_.vertex_total + 1);
    if (!cut) return false;
    result_.vertex_total += static_cast<int>(cut->vertices.size());
    const auto first_edge = static_cast<int>(result_.uses.size()) + 1;
    result_.uses.resize(result_.uses.size() + cut->edges.size(), 2);
    for (std::size_t i = 0; i < cut->parts.size(); ++i) {
      const CutPart& cut_part = cut->parts[i];
      HostFace part = whole;
      part.curves.clear();
      Images curves;
      for (const CutPart::Use& use : cut_part.uses) {
        const auto index = static_cast<std::size_t>(use.curve);
        if (index < arcs.size()) {
          part.curves.push_back(whole.curves[index]);
          part.curves.back().forward = use.forward, part.curves.back().internal = use.internal;
          curves.push_back(own[index]);
          continue;
        }
        const CutEdge& edge = cut->edges[index - arcs.size()];
        const gp_Vec2d way(edge.from, edge.to);
        curves.push_back(new Geom2d_Line(edge.from, gp_Dir2d(way)));
        part.curves.push_back({.first = 0,
                               .last = way.Magnitude(),
                               .edge = first_edge + use.curve - static_cast<int>(arcs.size()),
                               .end1 = edge.end1,
                               .end2 = edge.end2,
                               .forward = use.forward,
                               .internal = false});
      }
      std::size_t index = static_cast<std::size_t>(bent.face - 1);
      if (i > 0) {
        index = result_.faces.size();
        result_.faces.emplace_back(), result_.images.emplace_back(), result_.boxes.emplace_back();
        result_.changed.push_back(1);
      }
      result_.faces[index] = std::move(part);
      result_.images[index] = std::move(curves);
      result_.boxes[index] = box_of(bent, cut_part);
      result_.changed[index] = 1;
    }
    return true;
  }

  static PartBox box_of(const Bent& bent, const CutPart& part) {
    constexpr double beside = 1e-7;  // of the part; the samples of a domain lie much farther apart
    PartBox box{.low_u = part.low.X(), .high_u = part.high.X(), .low_v = part.low.Y(), .high_v = part.high.Y()};
    const ClosingKink& closing = bent.closing;
    if (closing.of_u) box.low_u = std::max(box.low_u, closing.low_u), box.high_u = std::min(box.high_u, closing.high_u);
    if (closing.of_v) box.low_v = std::max(box.low_v, closing.low_v), box.high_v = std::min(box.high_v, closing.high_v);
    box.step_u = beside * std::min(bent.extent.X(), box.high_u - box.low_u);
    box.step_v = beside * std::min(bent.extent.Y(), box.high_v - box.low_v);
    return box;
  }

  const TopTools_IndexedMapOfShape &faces_, &edges_, &vertices_;
  Result result_;
  std::map<int, std::vector<std::pair<int, int>>> uses_of_;  // of an edge: faces and indices of their curves
};

}  // namespace

void BrepHost::State::cut_kinks() {
  KinkCutter::Result start{.faces = host_faces,
                           .images = {},
                           .boxes = std::vector<PartBox>(host_faces.size()),
                           .changed = std::vector<char>(host_faces.size(), 0),
                           .bent = {},
                           .uses = uses,
                           .vertex_total = vertex_total,
                           .whole_edge = {}};
  for (std::size_t f = 0; f < host_faces.size(); ++f) start.images.push_back(evaluators.curves(f));
  std::optional<KinkCutter::Result> cut;
  try {
    guarded([&] { cut = KinkCutter(faces, edges, vertices, std::move(start)).run(); });
  } catch (const Standard_Failure&) {
    return;  // as it was
  }
  if (!cut) return;
  host_faces = std::move(cut->faces);
  bent = std::move(cut->bent);
  uses = std::move(cut->uses);
  vertex_total = cut->vertex_total;
  whole_edge = std::move(cut->whole_edge);
  shortest_free_piece = cut->shortest_free_piece;
  free_gap = cut->free_gap;
  evaluators.resize(host_faces.size());
  for (std::size_t f = 0; f < host_faces.size(); ++f)
    if (cut->changed[f] != 0)
      evaluators.set(f, TopoDS::Face(faces(host_faces[f].whole).Oriented(TopAbs_FORWARD)), cut->images[f],
                     cut->boxes[f]);
}

}  // namespace carreau_occ
