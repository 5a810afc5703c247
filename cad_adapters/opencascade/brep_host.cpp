// SPDX-License-Identifier: BSD-3-Clause
#include "brep_host.h"

#include <BRepBndLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

#include "brep_state.h"
#include "extent.h"
#include "faults.h"
#include "thresholds.h"

namespace carreau_occ {

BrepHost::BrepHost(const ShapeFile& file, bool loose_edges) : state_(std::make_shared<State>()) {
  state_->shape = file.shape;
  try {
    guarded([&] { state_->collect(), state_->collect_names(file), state_->collect_doubts(file); });
    guarded([&] { state_->solids = solids_of(file); });
    state_->cut_kinks();
    guarded([&] { state_->collect_wires(loose_edges); });
    state_->let_evaluate();
  } catch (const Standard_Failure& failure) {
    throw std::runtime_error(std::string("OpenCASCADE cannot read the topology: ") + failure.GetMessageString());
  }
}

BrepHost::~BrepHost() = default;

// The curve that gives the orientation; the engine keeps it however small it is. It is the first one that is not tiny
// beside the others in the parameter plane. 0: none.
int BrepHost::seed_curve(int number) const {
  constexpr double tiny = 1e-3;  // of the longest
  const HostFace& face = state_->host_faces[static_cast<std::size_t>(number - 1)];
  std::vector<double> extent(face.curves.size(), 0);
  double longest = 0;
  for (std::size_t c = 0; c < face.curves.size(); ++c) {
    double a[2], middle[2], b[2];
    const int ic = static_cast<int>(c + 1);
    if (face.curves[c].internal || !on_curve(number, ic, 0, a) || !on_curve(number, ic, 0.5, middle) ||
        !on_curve(number, ic, 1, b))
      continue;
    extent[c] = std::max(std::hypot(b[0] - a[0], b[1] - a[1]), std::hypot(middle[0] - a[0], middle[1] - a[1]));
    longest = std::max(longest, extent[c]);
  }
  int first = 0;
  for (std::size_t c = 0; c < face.curves.size(); ++c) {
    if (face.curves[c].internal) continue;
    if (first == 0) first = static_cast<int>(c + 1);
    if (extent[c] >= tiny * longest) return static_cast<int>(c + 1);
  }
  return first;
}

carreau_status BrepHost::give_to(carreau_session* session) {
  const carreau_status status = carreau_model_clear(session);
  return status == CARREAU_OK ? add_to(session) : status;
}

carreau_status BrepHost::add_to(carreau_session* session) {
  carreau_cad cad{};
  cad.struct_size = sizeof cad;
  cad.surface_order = cad.curve_order = 2;
  cad.reentrant = 1;
  cad.surface_batch = State::surface_batch;
  cad.curve_interval = State::interval;
  cad.curve = State::curve;
  state_->collect_sizes();
  cad.surface_size = State::surface_size;
  cad.curve_size = State::curve_size;
  cad.point_size = State::point_size;
  cad.failure = State::failure;
  cad.release = State::release;
  cad.user = state_->hold();
  carreau_status status = carreau_geometry_begin(session, &cad);
  if (status != CARREAU_OK) {
    State::release(cad.user);
    return status;
  }
  status = add_faces(session);
  if (status != CARREAU_OK) {
    carreau_geometry_cancel(session);
    return status;
  }
  status = carreau_geometry_end(session);
  return status == CARREAU_OK ? move_reasons(session) : status;
}

carreau_status BrepHost::add_faces(carreau_session* session) const {
  // Parts behind the face that they belong to.
  std::vector<std::size_t> order(state_->host_faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return state_->host_faces[a].whole < state_->host_faces[b].whole;
  });
  carreau_status status = CARREAU_OK;
  for (const std::size_t f : order)
    if (status == CARREAU_OK) status = add_face(session, f);
  for (std::size_t w = 0; w < state_->wires.size(); ++w)
    if (status == CARREAU_OK) status = add_wire(session, w);
  const std::vector<std::string>& names = state_->solids.names;
  for (std::size_t s = 0; s < names.size(); ++s)
    if (const auto solid = static_cast<int32_t>(s + 1); status == CARREAU_OK && !names[s].empty() && state_->solids.has_face(solid))
      status = carreau_model_name_entities(session, 3, 1, &solid, names[s].c_str());
  for (const auto& [piece, whole] : state_->whole_edge)
    if (status == CARREAU_OK) status = carreau_model_part_of_curve(session, piece, whole);
  return status == CARREAU_OK ? name_edges_and_vertices(session) : status;
}

/// Names go to the curves and points that the session has.
carreau_status BrepHost::name_edges_and_vertices(carreau_session* session) const {
  std::set<int> edges, vertices;
  const auto use = [&](int edge, int end1, int end2) { edges.insert(edge), vertices.insert(end1), vertices.insert(end2); };
  if (state_->edge_names.empty() && state_->vertex_names.empty()) return CARREAU_OK;
  for (const HostFace& face : state_->host_faces)
    for (const HostCurve& curve : face.curves)
      if (face.broken.empty()) use(curve.edge, curve.end1, curve.end2);
  for (const LooseEdge& wire : state_->wires) use(wire.number, wire.end1, wire.end2);
  std::map<std::pair<int, std::string>, std::vector<int32_t>> groups;
  for (const int edge : edges)
    if (const auto name = state_->edge_names.find(whole_edge(edge)); name != state_->edge_names.end()) groups[{1, name->second}].push_back(edge);
  for (const auto& [vertex, name] : state_->vertex_names)
    if (vertices.contains(vertex)) groups[{0, name}].push_back(vertex);
  carreau_status status = CARREAU_OK;
  for (const auto& [group, refs] : groups)
    if (status == CARREAU_OK)
      status = carreau_model_name_entities(session, group.first, static_cast<int64_t>(refs.size()), refs.data(), group.second.c_str());
  return status;
}

carreau_status BrepHost::add_wire(carreau_session* session, std::size_t index) const {
  const LooseEdge& wire = state_->wires[index];
  const auto ref = static_cast<int32_t>(state_->host_faces.size() + index + 1);
  const carreau_status status = carreau_model_add_face(session, ref, 0);
  if (status != CARREAU_OK) return status;
  return carreau_model_add_curve(session, ref, CARREAU_INTERNAL, wire.number, wire.end1, wire.end2);
}

carreau_status BrepHost::add_face(carreau_session* session, std::size_t index) const {
  const HostFace& face = state_->host_faces[index];
  int32_t orientation = 1;  // 0 would make it a wire
  const auto ref = static_cast<int32_t>(index + 1);
  if (const int seed = face.broken.empty() ? seed_curve(ref) : 0; seed != 0) {
    const HostCurve& curve = face.curves[static_cast<std::size_t>(seed - 1)];
    orientation = seed * (curve.forward != face.swapped ? 1 : -1);
  }
  carreau_status status = carreau_model_add_face(session, ref, orientation);
  if (status == CARREAU_OK) status = carreau_model_name_face(session, ref, face.name.c_str());
  if (status == CARREAU_OK && ref == face.whole) {
    const std::array<int, 2>& sides = state_->solids.of_face[index];
    status = carreau_model_set_face_sides(session, ref, sides[0], sides[1]);
  }
  if (status == CARREAU_OK) status = carreau_model_color_face(session, ref, face.rgb);
  if (status == CARREAU_OK && ref != face.whole) status = carreau_model_part_of_face(session, ref, face.whole);
  if (status == CARREAU_OK && !face.broken.empty())
    return carreau_model_leave_out_face(session, ref, ("face " + std::to_string(ref) + ": " + face.broken).c_str());
  for (const HostCurve& curve : face.curves)
    if (status == CARREAU_OK)
      status = carreau_model_add_curve(session, ref, curve.internal ? CARREAU_INTERNAL : CARREAU_BOUNDARY, curve.edge,
                                       curve.end1, curve.end2);
  return status;
}

/// Reasons to leave faces out name the references of the session.
carreau_status BrepHost::move_reasons(carreau_session* session) const {
  carreau_geometry geometry{};
  geometry.struct_size = sizeof geometry;
  int64_t count = 0;
  carreau_status status = carreau_geometry_count(session, &count);
  if (status == CARREAU_OK) status = carreau_geometry_info(session, count - 1, &geometry);
  if (geometry.first_face == 1) return status;
  for (const auto& [number, why] : excluded()) {
    if (status != CARREAU_OK) break;
    const int32_t ref = geometry.first_face + number - 1;
    status = carreau_model_leave_out_face(session, ref, ("face " + std::to_string(ref) + ": " + why).c_str());
  }
  return status;
}

void BrepHost::keep(std::shared_ptr<void> companion) { state_->companion = std::move(companion); }

void BrepHost::State::collect_sizes() {
  edge_size.assign(uses.size(), 0);
  vertex_size.assign(static_cast<std::size_t>(vertex_total), 0);
  const auto lower = [](double& size, double other) { size = size > 0 ? std::min(size, other) : other; };
  for (const HostFace& face : host_faces)
    for (const HostCurve& curve : face.curves) {
      const auto own = own_edge_sizes.find(curve.edge);
      for (const double size : {face.size, own != own_edge_sizes.end() ? own->second : 0.0}) {
        if (!(size > 0)) continue;
        lower(edge_size[static_cast<std::size_t>(curve.edge - 1)], size);
        for (const int end : {curve.end1, curve.end2}) lower(vertex_size[static_cast<std::size_t>(end - 1)], size);
      }
    }
  for (const auto& [vertex, size] : own_vertex_sizes) lower(vertex_size[static_cast<std::size_t>(vertex - 1)], size);
}

bool BrepHost::set_size(int dimension, int number, double size) {
  State& state = *state_;
  if (dimension == 2) return set_face_size(std::to_string(number), size);
  if (dimension == 3) {
    bool found = false;
    for (HostFace& face : state.host_faces) {
      const std::array<int, 2>& sides = state.solids.of_face[static_cast<std::size_t>(face.whole - 1)];
      if (sides[0] == number || sides[1] == number) face.size = size, found = true;
    }
    return found;
  }
  if (number < 1 || number > (dimension == 0 ? state.file_vertices : state.file_edges)) return false;
  (dimension == 0 ? state.own_vertex_sizes : state.own_edge_sizes)[number] = size;
  if (dimension == 1)
    for (const auto& [piece, whole] : state.whole_edge)
      if (whole == number) state.own_edge_sizes[piece] = size;
  return true;
}

bool BrepHost::set_face_size(const std::string& face, double size) {
  bool found = false;
  for (std::size_t f = 0; f < state_->host_faces.size(); ++f) {
    if (face != state_->host_faces[f].name && face != std::to_string(state_->host_faces[f].whole)) continue;
    state_->host_faces[f].size = size;
    found = true;
  }
  return found;
}

std::vector<std::pair<int, std::string>> BrepHost::excluded() const {
  std::vector<std::pair<int, std::string>> list;
  for (std::size_t f = 0; f < state_->host_faces.size(); ++f)
    if (!state_->host_faces[f].broken.empty()) list.emplace_back(static_cast<int>(f + 1), state_->host_faces[f].broken);
  return list;
}

const std::string& BrepHost::face_name(int number) const {
  return state_->host_faces[static_cast<std::size_t>(number - 1)].name;
}

int BrepHost::face_colour(int number) const { return state_->host_faces[static_cast<std::size_t>(number - 1)].rgb; }
const std::string& BrepHost::face_layer(int number) const { return state_->host_faces[static_cast<std::size_t>(number - 1)].layer; }
const std::map<int, std::string>& BrepHost::names(int dimension) const { return dimension == 0 ? state_->vertex_names : state_->edge_names; }
int BrepHost::face_count() const noexcept { return state_->faces.Extent(); }
int BrepHost::wire_count() const noexcept { return static_cast<int>(state_->wires.size()); }
int BrepHost::reference_count() const noexcept { return static_cast<int>(state_->host_faces.size()); }
int BrepHost::curve_count(int reference) const noexcept {
  return static_cast<int>(state_->host_faces[static_cast<std::size_t>(reference - 1)].curves.size());
}
int BrepHost::whole_face(int reference) const noexcept {
  const bool known = reference >= 1 && static_cast<std::size_t>(reference) <= state_->host_faces.size();
  return known ? state_->host_faces[static_cast<std::size_t>(reference - 1)].whole : reference;
}
std::vector<int> BrepHost::parts(int face) const {
  std::vector<int> parts;
  for (std::size_t f = 0; f < state_->host_faces.size(); ++f)
    if (state_->host_faces[f].whole == face) parts.push_back(static_cast<int>(f + 1));
  return parts;
}
int BrepHost::whole_edge(int reference) const noexcept {
  const auto found = state_->whole_edge.find(reference);
  return found != state_->whole_edge.end() ? found->second : reference;
}
const std::vector<int>& BrepHost::bent_faces() const noexcept { return state_->bent; }
int BrepHost::edge_count() const noexcept { return state_->file_edges; }
int BrepHost::vertex_count() const noexcept { return state_->file_vertices; }
const std::vector<std::string>& BrepHost::notes() const noexcept { return state_->notes; }

bool BrepHost::locate(int face, double u, double v, double* xyz, double* uv) const noexcept {
  const double given[2] = {u, v};
  const bool swapped =
      state_->wire(face) == nullptr && state_->host_faces[static_cast<std::size_t>(face - 1)].swapped;
  uv[0] = swapped ? v : u, uv[1] = swapped ? u : v;
  return State::surface_batch(face, 1, given, 0, xyz, nullptr, nullptr, nullptr, nullptr, nullptr, state_.get()) == 0;
}

std::vector<std::int32_t> BrepHost::curves(int face) const {
  std::vector<std::int32_t> edges;
  if (face < 1 || static_cast<std::size_t>(face) > state_->host_faces.size()) return edges;
  for (const HostCurve& curve : state_->host_faces[static_cast<std::size_t>(face - 1)].curves)
    edges.push_back(curve.edge);
  return edges;
}

bool BrepHost::on_curve(int face, int ic, double share, double* uv) const noexcept {
  double a = 0, b = 0;
  if (State::interval(face, ic, &a, &b, state_.get()) != 0) return false;
  const double t = share < 1 ? a + share * (b - a) : b;
  return State::curve(face, ic, t, 0, uv, nullptr, nullptr, state_.get()) == 0;
}

double BrepHost::diagonal() const {
  if (state_->diagonal) return *state_->diagonal;
  // Faces that are broken, and edges of no face, may reach anywhere.
  TopoDS_Compound good;
  const BRep_Builder builder;
  builder.MakeCompound(good);
  for (int f = 1; f <= state_->faces.Extent(); ++f)
    if (state_->host_faces[static_cast<std::size_t>(f - 1)].broken.empty()) builder.Add(good, state_->faces(f));
  if (state_->faces.IsEmpty())
    for (const LooseEdge& wire : state_->wires) builder.Add(good, wire.edge);
  state_->diagonal = diagonal_of(good);
  return *state_->diagonal;
}

double BrepHost::match_tolerance() const { return thresholds::match_share * diagonal(); }

BrepHost::GlueTolerances BrepHost::glue_tolerances() const try {
  GlueTolerances tolerances;
  guarded([&] { tolerances = state_->glue_tolerances(); });
  return tolerances;
} catch (const Standard_Failure&) {
  return {};
}

BrepHost::GlueTolerances BrepHost::State::glue_tolerances() const {
  double tolerance = 0, shortest = std::numeric_limits<double>::infinity();
  int free = 0;
  for (int e = 1; e <= edges.Extent(); ++e) {
    if (uses[static_cast<std::size_t>(e - 1)] != 1) continue;
    const TopoDS_Edge edge = TopoDS::Edge(edges(e));
    ++free;
    tolerance = std::max(tolerance, BRep_Tool::Tolerance(edge));
    for (TopExp_Explorer v(edge, TopAbs_VERTEX); v.More(); v.Next())
      tolerance = std::max(tolerance, BRep_Tool::Tolerance(TopoDS::Vertex(v.Current())));
    Bnd_Box box;
    BRepBndLib::Add(edge, box, Standard_False);
    if (!box.IsVoid()) shortest = std::min(shortest, std::sqrt(box.SquareExtent()));
  }
  if (free < 2) return {};
  shortest = std::min(shortest, shortest_free_piece);
  tolerance += free_gap;
  // Each of two edges may be off by its own tolerance.
  return {.of_all = std::min(2 * tolerance, shortest / 10), .of_each = 2 * tolerance};
}

bool BrepHost::is_closed() const noexcept {
  return std::find(state_->uses.begin(), state_->uses.end(), 1) == state_->uses.end();
}

std::string BrepHost::failure(int face) const {
  const std::scoped_lock lock(state_->mutex);
  const auto found = state_->failures.find(face);
  return found == state_->failures.end() ? std::string() : found->second;
}

}  // namespace carreau_occ
