#include "size/background.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "metric/metric3_algebra.h"
#include "size/thresholds.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

using namespace thresholds::size;

std::string vertex_name(std::size_t v) { return "the background mesh: vertex " + std::to_string(v) + " (from 0) "; }

void check_geometry(const BackgroundMesh& mesh) {
  if (mesh.dimension != 2 && mesh.dimension != 3)
    throw InvalidArgument("the background mesh has dimension " + std::to_string(mesh.dimension) + " instead of 2 or 3");
  if (mesh.triangles.empty()) throw InvalidArgument("the background mesh has no triangle");
  if (!mesh.faces.empty() && mesh.faces.size() != mesh.triangles.size())
    throw InvalidArgument("the background mesh has " + std::to_string(mesh.triangles.size()) + " triangles, but " +
                          std::to_string(mesh.faces.size()) + " references of faces");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!is_finite(mesh.vertices[v])) throw InvalidArgument(vertex_name(v) + "has a coordinate that is not finite");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::int32_t v : mesh.triangles[i])
      if (v < 0 || static_cast<std::size_t>(v) >= mesh.vertices.size())
        throw InvalidArgument("the background mesh: triangle " + std::to_string(i) + " (from 0) names vertex " +
                              std::to_string(v) + ", but there are " + std::to_string(mesh.vertices.size()));
}

double blend(double p, double q, double t, MetricLaw law) noexcept { return p * size_between(q / p, t, law); }
template <typename M>
M blend(const M& p, const M& q, double t, MetricLaw law) noexcept {
  return p == q ? p : interpolate(p, q, t, law);
}

/// The value inside a triangle; exact at corners.
template <typename Value>
Value interpolated(const std::vector<Value>& list, const std::array<std::int32_t, 3>& corner,
                   const std::array<double, 3>& w, MetricLaw law) {
  const auto at = [&](std::size_t k) -> const Value& { return list[static_cast<std::size_t>(corner[k])]; };
  const double side = w[0] + w[1];
  if (!(side > 0)) return at(2);
  const Value first = w[1] > 0 ? (w[0] > 0 ? blend(at(0), at(1), w[1] / side, law) : at(1)) : at(0);
  return w[2] > 0 ? blend(first, at(2), w[2] / (side + w[2]), law) : first;
}

}  // namespace

void BackgroundField::check_values(std::size_t vertices) const {
  if (values_.size() != vertices)
    throw InvalidArgument("the background mesh has " + std::to_string(vertices) + " vertices, but " +
                          std::to_string(values_.size()) + " sizes or metrics are given");
  const int lists =
      (values_.sizes.empty() ? 0 : 1) + (values_.space.empty() ? 0 : 1) + (values_.parameter.empty() ? 0 : 1);
  if (lists != 1) throw InvalidArgument("the background mesh wants either sizes or metrics at its vertices");
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

void BackgroundField::add_piece(int face, Piece piece) {
  if (piece.triangles.empty()) return;
  piece.tree = TriangleSearch(piece.vertices, piece.triangles);
  piece.steep = steep_vertices(piece);
  planes_.emplace(face, std::move(piece));
}

BackgroundField::BackgroundField(const BackgroundMesh& mesh)
    : values_(mesh.values), needs_position_(mesh.dimension == 3) {
  check_geometry(mesh);
  if (mesh.dimension == 3 && !values_.parameter.empty())
    throw InvalidArgument("the background mesh is a surface in space, but its metrics are those of a plane");
  check_values(mesh.vertices.size());
  std::vector<std::int32_t> same(mesh.vertices.size());
  for (std::size_t v = 0; v < same.size(); ++v) same[v] = static_cast<std::int32_t>(v);
  if (mesh.dimension == 3) {
    space_ = Piece{TriangleSearch(mesh.vertices, mesh.triangles), mesh.vertices, mesh.triangles, std::move(same)};
    find_steep_in_space();
    return;
  }
  std::map<int, std::vector<std::array<std::int32_t, 3>>> groups;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    groups[mesh.faces.empty() ? 0 : mesh.faces[i]].push_back(mesh.triangles[i]);
  for (auto& [face, triangles] : groups) add_piece(face, {{}, mesh.vertices, std::move(triangles), same});
}

BackgroundField::BackgroundField(const SurfaceMesh& mesh, VertexValues values)
    : values_(std::move(values)), needs_position_(false) {
  if (!values_.parameter.empty())
    throw InvalidArgument("a metric at a vertex of a surface mesh is one of space, not of a parameter plane");
  check_values(mesh.vertices.size());
  Piece whole;
  whole.vertices = mesh.vertices;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) whole.value.push_back(static_cast<std::int32_t>(v));
  for (const FaceMesh& face : mesh.faces) {
    Piece piece;
    for (const Vec2& p : face.uv) piece.vertices.push_back({p.x(), p.y(), 0});
    piece.value = face.vertex;
    piece.triangles = face.triangles;
    piece.triangles.insert(piece.triangles.end(), face.flattened.begin(), face.flattened.end());
    add_piece(face.ref, std::move(piece));
    for (const auto& t : face.triangles) {
      const auto global = [&](std::size_t k) { return face.vertex[static_cast<std::size_t>(t[k])]; };
      whole.triangles.push_back({global(0), global(1), global(2)});
    }
  }
  // A face without triangles is looked up in space.
  needs_position_ = planes_.size() < mesh.faces.size();
  if (whole.triangles.empty()) throw InvalidArgument("the background mesh has no triangle");
  whole.tree = TriangleSearch(whole.vertices, whole.triangles);
  space_ = std::move(whole);
}

BackgroundField::Piece* BackgroundField::piece_of(int face) noexcept {
  auto found = planes_.find(face);
  if (found == planes_.end()) found = planes_.find(0);
  return found == planes_.end() ? nullptr : &found->second;
}

Prescription BackgroundField::value_at(const Piece& piece, const NearestOnMesh& where) const {
  const auto& t = piece.triangles[static_cast<std::size_t>(where.triangle)];
  std::array<std::int32_t, 3> corner{};
  for (std::size_t k = 0; k < 3; ++k) corner[k] = piece.value[static_cast<std::size_t>(t[k])];
  if (!values_.sizes.empty()) return Prescription::of_size(interpolated(values_.sizes, corner, where.weight, law_));
  if (!values_.space.empty()) return Prescription::of_space(interpolated(values_.space, corner, where.weight, law_));
  return Prescription::of_parameter(interpolated(values_.parameter, corner, where.weight, law_));
}

Prescription BackgroundField::look_up(Piece& piece, Vec3 p) {
  const NearestOnMesh where = piece.tree.nearest(p, piece.last);
  piece.last = where.triangle;
  ++report_.asked;
  if (where.distance > outside_share * piece.tree.longest_edge(where.triangle)) {
    ++report_.outside;
    report_.farthest = std::max(report_.farthest, where.distance);
  }
  return value_at(piece, where);
}

Prescription BackgroundField::on_surface(int face, Vec2 uv, Vec3 xyz) {
  if (Piece* const piece = piece_of(face)) return look_up(*piece, {uv.x(), uv.y(), 0});
  return space_ ? look_up(*space_, xyz) : Prescription{};
}

Prescription BackgroundField::on_curve(int face, int /*ic*/, double /*t*/, Vec2 uv, Vec3 xyz) {
  return on_surface(face, uv, xyz);
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

// Values at vertices come from estimates, and their interpolation has a kink on every edge: what is finer than this
// would be sampled for nothing.
double BackgroundField::accuracy() const noexcept { return 0.05; }

void BackgroundField::begin_run(MetricLaw law) {
  law_ = law;
  report_ = {};
}

std::vector<std::string> BackgroundField::remarks() const {
  if (report_.asked == 0) return {"the background mesh was not asked: none of its triangles is for these faces"};
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

// Where edges are shorter than sizes, what counts is the change within a unit edge.
void BackgroundField::find_steep_in_space() {
  const auto length_at = [&](std::size_t v, Vec3 e) {
    return values_.sizes.empty() ? length(values_.space[v], e) : norm(e) / values_.sizes[v];
  };
  std::vector<char> steep(space_->vertices.size(), 0);
  std::vector<double> longest(steep.size(), 0);
  for (const auto& t : space_->triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
      const Vec3 e = space_->vertices[b] - space_->vertices[a];
      for (const std::size_t v : {a, b}) longest[v] = std::max(longest[v], norm(e));
      const double units = std::min({length_at(a, e), length_at(b, e), 1.});
      const double ratio = change(t[k], t[(k + 1) % 3]);
      if (units > 0 && std::log(ratio) > units * std::log(steep_ratio)) steep[a] = steep[b] = 1;
    }
  for (std::size_t v = 0; v < steep.size(); ++v)
    if (steep[v] != 0) steep_in_space_.push_back({space_->vertices[v], longest[v]});
}

std::vector<Vec2> BackgroundField::steep_vertices(const Piece& piece) const {
  std::vector<char> steep(piece.vertices.size(), 0);
  for (const auto& t : piece.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
      if (change(piece.value[a], piece.value[b]) > steep_ratio) steep[a] = steep[b] = 1;
    }
  std::vector<Vec2> places;
  for (std::size_t v = 0; v < steep.size(); ++v)
    if (steep[v] != 0) places.push_back({piece.vertices[v].x(), piece.vertices[v].y()});
  return places;
}

}  // namespace carreau
