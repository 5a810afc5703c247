// SPDX-License-Identifier: BSD-3-Clause
#include "size/background.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "metric/metric3_algebra.h"
#include "size/thresholds.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

using namespace thresholds::size;

std::string vertex_name(std::size_t v) { return "the background mesh: vertex " + std::to_string(v) + " (from 0) "; }

template <std::size_t N>
void check_indices(const char* what, const std::vector<std::array<std::int32_t, N>>& elements, std::size_t vertices) {
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (const std::int32_t v : elements[i])
      if (v < 0 || static_cast<std::size_t>(v) >= vertices)
        throw InvalidArgument("the background mesh: " + std::string(what) + " " + std::to_string(i) +
                              " (from 0) names vertex " + std::to_string(v) + ", but there are " +
                              std::to_string(vertices));
}

void check_geometry(const BackgroundMesh& mesh) {
  if (mesh.dimension != 2 && mesh.dimension != 3)
    throw InvalidArgument("the background mesh has dimension " + std::to_string(mesh.dimension) + " instead of 2 or 3");
  if (mesh.triangles.empty() && mesh.tetrahedra.empty() && mesh.edges.empty())
    throw InvalidArgument("the background mesh has no triangle, no tetrahedron and no edge");
  if (mesh.dimension == 2 && !mesh.tetrahedra.empty())
    throw InvalidArgument("the background mesh lies in parameter planes, which hold no tetrahedra");
  if (!mesh.faces.empty() && mesh.faces.size() != mesh.triangles.size())
    throw InvalidArgument("the background mesh has " + std::to_string(mesh.triangles.size()) + " triangles, but " +
                          std::to_string(mesh.faces.size()) + " references of faces");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!is_finite(mesh.vertices[v])) throw InvalidArgument(vertex_name(v) + "has a coordinate that is not finite");
  check_indices("triangle", mesh.triangles, mesh.vertices.size());
  check_indices("tetrahedron", mesh.tetrahedra, mesh.vertices.size());
  check_indices("edge", mesh.edges, mesh.vertices.size());
}

double blend(double p, double q, double t, MetricLaw law) noexcept { return p * size_between(q / p, t, law); }
template <typename M>
M blend(const M& p, const M& q, double t, MetricLaw law) noexcept {
  return p == q ? p : interpolate(p, q, t, law);
}

/// The value inside an element of `corners` vertices: along a segment from each corner towards the next; exact at
/// corners.
template <typename Value>
Value interpolated(const std::vector<Value>& list, const std::array<std::int32_t, 4>& corner, int corners,
                   const std::array<double, 4>& w, MetricLaw law) {
  std::optional<Value> value;
  double sum = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(corners); ++k) {
    const Value& next = list[static_cast<std::size_t>(corner[k])];
    if (!(w[k] > 0)) continue;
    sum += w[k];
    value = value ? blend(*value, next, w[k] / sum, law) : next;
  }
  return *value;
}

/// use(a, b) for each edge of an element, in the order of its corners.
template <typename Use>
void for_edges(const Simplex& s, const Use& use) {
  const auto corner = [&](int k) { return static_cast<std::size_t>(s.vertex[static_cast<std::size_t>(k)]); };
  for (int i = 0; i < s.corners; ++i)
    for (int j = i + 1; j < s.corners; ++j) use(corner(i), corner(j));
}

}  // namespace

void BackgroundField::check_values(std::size_t vertices) const {
  if (values_.size() != vertices)
    throw InvalidArgument("the background mesh has " + std::to_string(vertices) + " vertices, but " +
                          std::to_string(values_.size()) + " sizes or metrics are given");
  const int lists =
      (values_.sizes.empty() ? 0 : 1) + (values_.space.empty() ? 0 : 1) + (values_.parameter.empty() ? 0 : 1);
  if (lists != 1) throw InvalidArgument("the background mesh requires either sizes or metrics at its vertices");
  for (std::size_t v = 0; v < values_.sizes.size(); ++v)
    if (!(values_.sizes[v] > 0) || !std::isfinite(values_.sizes[v]))
      throw InvalidArgument(vertex_name(v) + "has the size " + format_number(values_.sizes[v]) +
                            "; sizes are positive and finite");
  for (std::size_t v = 0; v < values_.space.size(); ++v)
    if (!is_positive_definite(values_.space[v]))
      throw InvalidArgument(vertex_name(v) + "has a metric that is not positive definite");
  for (std::size_t v = 0; v < values_.parameter.size(); ++v)
    if (!is_positive_definite(values_.parameter[v]))
      throw InvalidArgument(vertex_name(v) + "has a metric that is not positive definite");
}

void BackgroundField::Piece::prepare() {
  tree = SimplexSearch(vertices, simplices);
  edges_only = simplices.front().corners == 2;  // larger ones come first
}

void BackgroundField::add_piece(int face, Piece piece) {
  if (piece.simplices.empty()) return;
  piece.prepare();
  piece.steep = steep_vertices(piece);
  planes_.emplace(face, std::move(piece));
}

BackgroundField::BackgroundField(const BackgroundMesh& mesh)
    : values_(mesh.values), needs_position_(mesh.dimension == 3) {
  check_geometry(mesh);
  if (mesh.dimension == 3 && !values_.parameter.empty())
    throw InvalidArgument("the background mesh is a surface in space, but its metrics belong to a plane");
  check_values(mesh.vertices.size());
  std::vector<std::int32_t> same(mesh.vertices.size());
  for (std::size_t v = 0; v < same.size(); ++v) same[v] = static_cast<std::int32_t>(v);
  if (mesh.dimension == 3) {
    space_ = Piece{mesh.vertices, simplices_of(mesh.tetrahedra, mesh.triangles, mesh.edges), std::move(same)};
    space_->prepare();
    find_steep_in_space();
    return;
  }
  add_planes(mesh, same);
}

void BackgroundField::add_planes(const BackgroundMesh& mesh, const std::vector<std::int32_t>& same) {
  std::map<int, std::vector<Simplex>> groups;
  std::size_t i = 0;
  for (const Simplex& s : simplices_of({}, mesh.triangles, mesh.edges)) {
    const bool named = s.corners == 3 && !mesh.faces.empty();  // triangles come first, all of them
    groups[named ? mesh.faces[i] : 0].push_back(s);
    ++i;
  }
  for (auto& [face, simplices] : groups) add_piece(face, {mesh.vertices, std::move(simplices), same});
}

BackgroundField::BackgroundField(const SurfaceMesh& mesh, VertexValues values)
    : values_(std::move(values)), needs_position_(false) {
  if (!values_.parameter.empty())
    throw InvalidArgument("a metric at a vertex of a surface mesh is a metric of space, not of a parameter plane");
  check_values(mesh.vertices.size());
  Piece whole;
  whole.vertices = mesh.vertices;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) whole.value.push_back(static_cast<std::int32_t>(v));
  for (const FaceMesh& face : mesh.faces) {
    Piece piece;
    for (const Vec2& p : face.uv) piece.vertices.push_back({p.x(), p.y(), 0});
    piece.value = face.vertex;
    for (const auto* list : {&face.triangles, &face.flattened})
      for (const Simplex& s : simplices_of({}, *list, {})) piece.simplices.push_back(s);
    add_piece(face.ref, std::move(piece));
    for (const auto& t : face.triangles) {
      const auto global = [&](std::size_t k) { return face.vertex[static_cast<std::size_t>(t[k])]; };
      whole.simplices.push_back({{global(0), global(1), global(2), -1}, 3});
    }
  }
  // A face without triangles is looked up in space.
  needs_position_ = planes_.size() < mesh.faces.size();
  if (whole.simplices.empty()) throw InvalidArgument("the background mesh has no triangle");
  whole.prepare();
  space_ = std::move(whole);
}

BackgroundField::Piece* BackgroundField::piece_of(int face) noexcept {
  auto found = planes_.find(face);
  if (found == planes_.end()) found = planes_.find(0);
  return found == planes_.end() ? nullptr : &found->second;
}

Prescription BackgroundField::value_at(const Piece& piece, const NearestOnSimplices& where) const {
  const Simplex& s = piece.simplices[static_cast<std::size_t>(where.simplex)];
  std::array<std::int32_t, 4> corner{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(s.corners); ++k)
    corner[k] = piece.value[static_cast<std::size_t>(s.vertex[k])];
  const auto value = [&](const auto& list) { return interpolated(list, corner, s.corners, where.weight, law_); };
  if (!values_.sizes.empty()) return Prescription::of_size(value(values_.sizes));
  if (!values_.space.empty()) return Prescription::of_space(value(values_.space));
  return Prescription::of_parameter(value(values_.parameter));
}

Prescription BackgroundField::look_up(Piece& piece, Vec3 p) {
  const NearestOnSimplices where = piece.tree.nearest(p, piece.last);
  piece.last = where.simplex;
  ++report_.asked;
  if (where.distance > outside_share * piece.tree.longest_edge(where.simplex)) {
    ++report_.outside;
    report_.farthest = std::max(report_.farthest, where.distance);
  }
  return value_at(piece, where);
}

Prescription BackgroundField::on_surface(int face, Vec2 uv, Vec3 xyz) {
  Piece* const piece = piece_of(face);
  if (piece != nullptr ? piece->edges_only : space_ && space_->edges_only) return {};
  return on_curve(face, 0, 0, uv, xyz);
}

Prescription BackgroundField::on_curve(int face, int /*ic*/, double /*t*/, Vec2 uv, Vec3 xyz) {
  if (Piece* const piece = piece_of(face)) return look_up(*piece, {uv.x(), uv.y(), 0});
  return space_ ? look_up(*space_, xyz) : Prescription{};
}

bool BackgroundField::curves_only() const noexcept {
  if (space_) return space_->edges_only;
  return std::all_of(planes_.begin(), planes_.end(), [](const auto& each) { return each.second.edges_only; });
}

Prescription BackgroundField::at_point(int /*point*/, Vec3 xyz) {
  return space_ ? look_up(*space_, xyz) : Prescription{};
}

double BackgroundField::change(std::int32_t a, std::int32_t b) const {
  const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
  if (!values_.sizes.empty()) return std::max(values_.sizes[i] / values_.sizes[j], values_.sizes[j] / values_.sizes[i]);
  const LengthRatios r = values_.space.empty() ? length_ratios(values_.parameter[i], values_.parameter[j])
                                               : length_ratios(values_.space[i], values_.space[j]);
  return std::max(r.largest, 1 / r.smallest);
}

// Values at vertices come from estimates, and their interpolation has a kink on every edge: finer samples would be
// wasted.
double BackgroundField::accuracy() const noexcept { return 0.05; }

void BackgroundField::begin_run(MetricLaw law) {
  law_ = law;
  report_.asked = report_.outside = 0;
  report_.farthest = 0;
}

std::vector<std::string> BackgroundField::remarks() const {
  if (report_.asked == 0) return {"the background mesh was not used: it has no elements for these faces"};
  if (report_.outside == 0) return {};
  return {std::to_string(report_.outside) + " of " + std::to_string(report_.asked) +
          " points lie outside of the background mesh and have the nearest value; the farthest is " +
          format_number(report_.farthest) + " away"};
}

std::vector<Vec2> BackgroundField::steep_places(int face) const {
  auto found = planes_.find(face);
  if (found == planes_.end()) found = planes_.find(0);
  return found == planes_.end() ? std::vector<Vec2>{} : found->second.steep;
}

// If edges are shorter than sizes, the change within a unit edge counts.
void BackgroundField::find_steep_in_space() {
  const auto length_at = [&](std::size_t v, Vec3 e) {
    return values_.sizes.empty() ? length(values_.space[v], e) : norm(e) / values_.sizes[v];
  };
  std::vector<char> steep(space_->vertices.size(), 0);
  std::vector<double> longest(steep.size(), 0);
  for (const Simplex& s : space_->simplices)
    for_edges(s, [&](std::size_t a, std::size_t b) {
      const Vec3 e = space_->vertices[b] - space_->vertices[a];
      for (const std::size_t v : {a, b}) longest[v] = std::max(longest[v], norm(e));
      const double units = std::min({length_at(a, e), length_at(b, e), 1.});
      const double ratio = change(space_->value[a], space_->value[b]);
      if (units > 0 && std::log(ratio) > units * std::log(steep_ratio)) steep[a] = steep[b] = 1;
    });
  for (std::size_t v = 0; v < steep.size(); ++v)
    if (steep[v] != 0) steep_in_space_.push_back({space_->vertices[v], longest[v]});
}

std::vector<Vec2> BackgroundField::steep_vertices(const Piece& piece) const {
  std::vector<char> steep(piece.vertices.size(), 0);
  for (const Simplex& s : piece.simplices)
    for_edges(s, [&](std::size_t a, std::size_t b) {
      if (change(piece.value[a], piece.value[b]) > steep_ratio) steep[a] = steep[b] = 1;
    });
  std::vector<Vec2> places;
  for (std::size_t v = 0; v < steep.size(); ++v)
    if (steep[v] != 0) places.push_back({piece.vertices[v].x(), piece.vertices[v].y()});
  return places;
}

}  // namespace carreau
