// SPDX-License-Identifier: BSD-3-Clause
// The data that a BrepHost takes from a shape: topology, names, doubts.
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Precision.hxx>
#include <TopAbs.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "brep_state.h"
#include "face_check.h"
#include "faults.h"
#include "loop_gaps.h"
#include "missing_curves.h"
#include "missing_seams.h"
#include "torn_loops.h"
#include "wire_order.h"
#include "wire_periods.h"
#include "wrong_turns.h"

namespace carreau_occ {

namespace {

/// True if two curves of the parameter plane are one, but for rounding. The curves of a seam are a period apart.
bool coincide(const EdgeImage& a, const EdgeImage& b) {
  constexpr double rounding = 1e-9;  // of coordinates
  constexpr int pieces = 8;
  for (int i = 0; i <= pieces; ++i) {
    const auto at = [&](const EdgeImage& image) {
      return image.curve->Value(image.first + (image.last - image.first) * i / pieces);
    };
    const gp_Pnt2d p = at(a), q = at(b);
    if (p.Distance(q) > rounding * (std::abs(p.X()) + std::abs(p.Y()) + 1)) return false;
  }
  return true;
}

/// Makes edges internal along which a wire goes to and fro, as from an outer border to the border of a hole: they have
/// the face on both sides.
void make_returns_internal(std::vector<EdgeImage>& images) {
  std::unordered_map<const TopoDS_TShape*, std::size_t> ways;  // the last use of each edge
  std::vector<bool> back(images.size(), false);
  for (std::size_t j = 0; j < images.size(); ++j) {
    const TopoDS_Edge& edge = images[j].edge;
    const bool side = edge.Orientation() == TopAbs_FORWARD || edge.Orientation() == TopAbs_REVERSED;
    if (!side || BRep_Tool::Degenerated(edge)) continue;
    const auto [there, first] = ways.try_emplace(edge.TShape().get(), j);
    if (first) continue;
    EdgeImage& other = images[there->second];
    if (other.edge.Orientation() == TopAbs::Reverse(edge.Orientation()) && other.edge.IsSame(edge) &&
        coincide(other, images[j])) {
      other.edge.Orientation(TopAbs_INTERNAL);
      back[j] = true;
    }
    there->second = j;
  }
  std::size_t kept = 0;
  for (std::size_t j = 0; j < images.size(); ++j)
    if (!back[j]) std::swap(images[kept++], images[j]);
  images.resize(kept);
}

bool has_no_range(const EdgeImage& image) {
  constexpr double rounding = 1e-12;
  return std::abs(image.last - image.first) <= rounding * std::max(1.0, std::abs(image.first));
}

/// Images of all edges of each wire, null if missing, without edges of no length. OpenCASCADE computes images on planes
/// at each call, which takes long: so they are kept.
std::vector<std::vector<EdgeImage>> wires_of(const TopoDS_Face& face) {
  std::vector<std::vector<EdgeImage>> wires;
  for (TopExp_Explorer w(face, TopAbs_WIRE); w.More(); w.Next()) {
    std::vector<EdgeImage>& images = wires.emplace_back();
    for (TopExp_Explorer e(w.Current(), TopAbs_EDGE); e.More(); e.Next()) {
      EdgeImage image;
      image.edge = TopoDS::Edge(e.Current());
      BRep_Tool::Range(image.edge, image.first, image.last);
      if (BRep_Tool::IsGeometric(image.edge) && has_no_range(image)) continue;
      image.curve = BRep_Tool::CurveOnSurface(image.edge, face, image.first, image.last);
      images.push_back(std::move(image));
    }
  }
  return wires;
}

std::vector<std::vector<EdgeImage>> complete_wires_of(const TopoDS_Face& face) {
  std::vector<std::vector<EdgeImage>> wires = wires_of(face);
  for (const std::vector<EdgeImage>& wire : wires)
    for (const EdgeImage& image : wire)
      if (image.curve.IsNull()) {
        add_missing_curves(face);
        return wires_of(face);
      }
  return wires;
}

/// Internal edges that lie outside of the face mean nothing to it.
bool is_outside(const EdgeImage& image, const TopoDS_Face& face) {
  constexpr int places = 4;
  BRepTopAdaptor_FClass2d inside(face, Precision::PConfusion());
  for (int i = 1; i < places; ++i)
    if (inside.Perform(image.curve->Value(image.first + (image.last - image.first) * i / places)) != TopAbs_OUT)
      return false;
  return true;
}

/// The area that all loops of a face enclose in the parameter plane, as shares of the boxes of the loops.
struct Enclosed {
  double largest = 0;  ///< of one loop
  double sum = 0;      ///< of all; outer loops are counterclockwise
};

/// No value if a loop is not in order or does not close, or without loops.
std::optional<Enclosed> enclosed_by(const std::vector<std::vector<EdgeImage>>& loops) {
  constexpr double rounding = 1e-9, closing = 1e-2;  // of the box of the loop
  constexpr double coordinate_rounding = 1e-12;      // of coordinates
  double areas = 0, largest_box = 0;
  Enclosed enclosed;
  for (const std::vector<EdgeImage>& wire : loops) {
    std::vector<EdgeImage> loop;
    std::copy_if(wire.begin(), wire.end(), std::back_inserter(loop), bounds);
    if (loop.empty()) continue;
    loop = in_order(loop);
    if (loop.empty()) return std::nullopt;
    const LoopArea area = area_of(loop);
    if (start_of(loop.front()).Distance(end_of(loop.back())) > closing * (area.width + area.height))
      return std::nullopt;
    const gp_Pnt2d at = start_of(loop.front());
    const bool flat =
        area.width <= coordinate_rounding * std::abs(at.X()) || area.height <= coordinate_rounding * std::abs(at.Y());
    const double box = flat ? 0 : area.width * area.height;
    areas += area.area;
    largest_box = std::max(largest_box, box);
    if (!flat && std::abs(area.area) > rounding * box)
      enclosed.largest = std::max(enclosed.largest, std::abs(area.area) / box);
  }
  if (largest_box > 0) enclosed.sum = areas / largest_box;
  return std::any_of(loops.begin(), loops.end(), [](const auto& loop) { return !loop.empty(); })
             ? std::optional(enclosed)
             : std::nullopt;
}

/// Loops that enclose nothing are an error. Loops that are turned the wrong way as a whole would enclose the outside.
void check_enclosed(std::vector<std::vector<EdgeImage>>& loops) {
  constexpr double surely = 0.05;  // of the box: chords stand for the curves
  const std::optional<Enclosed> enclosed = enclosed_by(loops);
  if (!enclosed) return;
  if (enclosed->largest == 0) throw std::runtime_error("its curves enclose no area");
  if (enclosed->sum > -surely) return;
  for (std::vector<EdgeImage>& loop : loops)
    for (EdgeImage& image : loop)
      if (bounds(image)) image.edge.Reverse();
}

/// The images that bound the face or lie inside it, loop by loop.
std::vector<EdgeImage> images_of(std::vector<std::vector<EdgeImage>> loops, const TopoDS_Face& face) {
  for (std::vector<EdgeImage>& images : loops) {
    std::erase_if(images, [](const EdgeImage& image) { return image.edge.Orientation() == TopAbs_EXTERNAL; });
    for (const EdgeImage& image : images)
      if (image.curve.IsNull()) throw std::runtime_error("an edge has no curve in its parameter plane");
    std::erase_if(images, [&](const EdgeImage& image) {
      return has_no_range(image) || (image.edge.Orientation() == TopAbs_INTERNAL && is_outside(image, face));
    });
    close_over_periods(images, face);
  }
  add_missing_seams(loops, face);
  check_enclosed(loops);
  std::vector<EdgeImage> all;
  for (std::vector<EdgeImage>& images : loops) make_returns_internal(images);
  turn_wrong_loops(loops, face);
  for (const std::vector<EdgeImage>& images : loops) all.insert(all.end(), images.begin(), images.end());
  return all;
}

}  // namespace

/// Further problems of a face without edges.
std::string BrepHost::State::endless(int number) const {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(TopoDS::Face(faces(number)));
  if (surface.IsNull()) return ", and it has no surface";
  double u1 = 0, u2 = 0, v1 = 0, v2 = 0;
  surface->Bounds(u1, u2, v1, v2);
  const auto is_infinite = [](double x) { return Precision::IsInfinite(x) == Standard_True; };
  const bool any = is_infinite(u1) || is_infinite(u2) || is_infinite(v1) || is_infinite(v2);
  return any ? ", and its surface has no end" : "";
}

void BrepHost::State::collect() {
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  TopExp::MapShapes(shape, TopAbs_VERTEX, vertices);
  file_edges = edges.Extent(), file_vertices = vertices.Extent();
  uses.assign(static_cast<std::size_t>(edges.Extent()), 0);
  host_faces.resize(static_cast<std::size_t>(faces.Extent()));
  evaluators.resize(host_faces.size());
  for (int f = 1; f <= faces.Extent(); ++f) {
    HostFace& face = host_faces[static_cast<std::size_t>(f - 1)];
    face.whole = f;
    try {
      guarded([&] { collect_face(f); });
      if (face.curves.empty() && face.broken.empty()) face.broken = "no edge bounds it" + endless(f);
    } catch (const Standard_Failure& error) {
      face.broken = sentence_of(error);
    } catch (const std::runtime_error& error) {
      face.broken = error.what();
    }
  }
  close_torn_loops(host_faces, vertices);
  if (std::string note = close_loop_gaps({host_faces, evaluators, faces, edges, vertices, uses}); !note.empty())
    notes.push_back(std::move(note));
  vertex_total = vertices.Extent();
}

void BrepHost::State::collect_wires(bool beside_faces) {
  wires = find_loose_edges(shape, edges, vertices);
  if (!beside_faces && !faces.IsEmpty() && !wires.empty()) {
    notes.push_back(std::to_string(wires.size()) +
                    (wires.size() == 1 ? " edge of no face is" : " edges of no face are") +
                    " not in the mesh (loose-edges adds them)");
    wires.clear();
  }
  wire_curves.set(wires);
  if (faces.IsEmpty() && wires.empty()) throw std::runtime_error("the shape has neither a face nor an edge");
}

const LooseEdge* BrepHost::State::wire(int reference) const noexcept {
  const auto index = static_cast<std::size_t>(reference) - 1;
  return index >= host_faces.size() && index - host_faces.size() < wires.size() ? &wires[index - host_faces.size()]
                                                                                : nullptr;
}

void BrepHost::State::let_evaluate() {
  for (auto* failed : {&surface_failed, &curves_failed}) {
    *failed = std::make_unique<std::atomic<bool>[]>(host_faces.size() + wires.size());
    for (std::size_t f = 0; f < host_faces.size(); ++f) (*failed)[f] = !host_faces[f].known;
  }
}

void BrepHost::State::collect_face(int number) {
  const TopoDS_Face face = TopoDS::Face(faces(number));
  HostFace& host = host_faces[static_cast<std::size_t>(number - 1)];
  // A placement that mirrors turns the surface inside out and leaves the orientation of the face.
  host.swapped =
      (face.Orientation() == TopAbs_REVERSED) != (face.Location().Transformation().IsNegative() == Standard_True);
  // Wires are turned for the face taken forward.
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const std::vector<std::vector<EdgeImage>> loops = complete_wires_of(forward);
  std::vector<Handle(Geom2d_Curve)> images;
  for (const EdgeImage& image : images_of(loops, forward)) {
    HostCurve curve;
    curve.first = image.first, curve.last = image.last;
    curve.edge = edges.Add(image.edge);  // a seam that was missing is new
    uses.resize(static_cast<std::size_t>(edges.Extent()), 0);
    curve.end1 = end_of(image, false);
    curve.end2 = end_of(image, true);
    curve.forward = image.edge.Orientation() == TopAbs_FORWARD;
    curve.internal = image.edge.Orientation() == TopAbs_INTERNAL;
    if (!curve.internal) ++uses[static_cast<std::size_t>(curve.edge - 1)];
    if (BRep_Tool::Degenerated(image.edge)) uses[static_cast<std::size_t>(curve.edge - 1)] = 2;
    host.curves.push_back(curve);
    images.push_back(image.curve);
  }
  evaluators.set(static_cast<std::size_t>(number - 1), forward, std::move(images));
  host.known = true;
  refuse_unusable(forward, loops);
}

// If an edge does not name one of its ends, returns its vertex that lies there, or a new one.
int BrepHost::State::end_of(const EdgeImage& image, bool last) {
  const TopoDS_Vertex named =
      last ? TopExp::LastVertex(image.edge, Standard_False) : TopExp::FirstVertex(image.edge, Standard_False);
  if (!named.IsNull()) return vertices.Add(named);
  double from = 0, to = 0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(image.edge, from, to);
  if (curve.IsNull() || Precision::IsInfinite(last ? to : from)) return 0;
  const gp_Pnt at = curve->Value(last ? to : from);
  const double tolerance = std::max(BRep_Tool::Tolerance(image.edge), Precision::Confusion());
  int& vertex = missing_ends[{edges.FindIndex(image.edge), last}];
  if (vertex != 0) return vertex;
  for (TopoDS_Iterator own(image.edge, Standard_False); own.More() && vertex == 0; own.Next())
    if (const TopoDS_Vertex other = TopoDS::Vertex(own.Value().Located(image.edge.Location() * own.Value().Location()));
        at.Distance(BRep_Tool::Pnt(other)) <= tolerance + BRep_Tool::Tolerance(other))
      vertex = vertices.Add(other);
  if (const auto other = missing_ends.find({edges.FindIndex(image.edge), !last});
      vertex == 0 && other != missing_ends.end() && other->second != 0 &&
      at.Distance(BRep_Tool::Pnt(TopoDS::Vertex(vertices(other->second)))) <= 2 * tolerance)
    vertex = other->second;
  if (vertex != 0) return vertex;
  TopoDS_Vertex made;
  BRep_Builder().MakeVertex(made, at, tolerance);
  return vertex = vertices.Add(made);
}

// Wide parts first, so that the name of the narrowest part stays: a shell before its only face.
void BrepHost::State::collect_names(const ShapeFile& file) {
  std::vector<std::pair<const ShapeFile::Label*, std::vector<int>>> parts;  // with their faces
  for (const ShapeFile::Label& label : file.labels) {
    std::vector<int> held;
    for (TopExp_Explorer e(label.part, TopAbs_FACE); e.More(); e.Next())
      if (const int number = faces.FindIndex(e.Current()); number > 0) held.push_back(number);
    parts.emplace_back(&label, std::move(held));
  }
  std::stable_sort(parts.begin(), parts.end(), [](const auto& p, const auto& q) {
    return std::pair(q.second.size(), p.first->part.ShapeType()) <
           std::pair(p.second.size(), q.first->part.ShapeType());
  });
  for (const auto& [label, held] : parts)
    for (const int number : held) {
      HostFace& face = host_faces[static_cast<std::size_t>(number - 1)];
      if (!label->name.empty()) face.name = label->name;
      if (!label->layer.empty()) face.layer = label->layer;
      if (label->has_colour) face.rgb = label->rgb();
    }
  for (const ShapeFile::Label& label : file.labels) {
    if (label.name.empty()) continue;
    if (label.part.ShapeType() == TopAbs_EDGE)
      if (const int number = edges.FindIndex(label.part); number > 0) edge_names[number] = label.name;
    if (label.part.ShapeType() == TopAbs_VERTEX)
      if (const int number = vertices.FindIndex(label.part); number > 0) vertex_names[number] = label.name;
  }
}

void BrepHost::State::collect_doubts(const ShapeFile& file) {
  for (const auto& [doubtful, why] : file.doubtful)
    for (TopExp_Explorer e(doubtful, TopAbs_FACE); e.More(); e.Next())
      for (int f = 1; f <= faces.Extent(); ++f)  // wherever an assembly puts it
        if (HostFace& face = host_faces[static_cast<std::size_t>(f - 1)];
            faces(f).IsPartner(e.Current()) && face.broken.empty())
          face.broken = why;
}

}  // namespace carreau_occ
