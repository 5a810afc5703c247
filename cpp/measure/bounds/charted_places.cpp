// SPDX-License-Identifier: BSD-3-Clause
#include "measure/bounds/charted_places.h"

#include <algorithm>
#include <cmath>

#include "cad/batches.h"
#include "cad/fundamental_forms.h"

namespace carreau {

namespace {

// Ranks in the lattice: corners, places on side i from corner i on, and inside.
constexpr std::array<std::size_t, 3> corner_ranks{0, 4, 14};
constexpr std::array<std::array<std::size_t, 3>, 3> side_ranks{{{1, 2, 3}, {8, 11, 13}, {12, 9, 5}}};
constexpr std::array<std::size_t, 3> inner_ranks{6, 7, 10};

}  // namespace

ChartedPlaces::ChartedPlaces(const SurfaceMesh& mesh, std::int32_t face, std::size_t first, const MeshEdges& edges,
                             std::vector<SharedEdge>& shared, Cad& cad, Monitor& monitor)
    : mesh_(mesh),
      face_(mesh.faces[static_cast<std::size_t>(face)]),
      first_(first),
      edges_(edges),
      cad_(cad),
      monitor_(monitor),
      degenerate_(face_, face),
      vertex_(face_.uv.size()),
      edge_(shared) {
  link();
}

ChartedPlaces::~ChartedPlaces() {
  for (std::size_t t = first_; t < first_ + face_.triangles.size(); ++t)
    for (const std::int32_t e : edges_.of_triangle[t]) edge_[e] = {};
}

// Both triangles have the edge with the same local vertices, and it is on no curve.
void ChartedPlaces::link() {
  for (std::size_t t = 2 * static_cast<std::size_t>(face_.quads); t < face_.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3 && !face_.is_spread(t); ++i) {
      const std::int32_t e = edges_.of_triangle[first_ + t][i], a = face_.triangles[t][i], b = face_.triangles[t][(i + 1) % 3];
      if (edges_.segment[e] >= 0) continue;
      SharedEdge& edge = edge_[e];
      if (edge.beside[0] < 0)
        edge.beside[0] = static_cast<std::int32_t>(t), edge.from = a, edge.to = b;
      else if (edge.from == b && edge.to == a)
        edge.beside[1] = static_cast<std::int32_t>(t);
    }
}

template <typename Use>
void ChartedPlaces::evaluate(std::span<const Vec2> uv, const Use& use) {
  for_batches(cad_, face_.ref, want_position | want_first, uv, monitor_,
              [&](std::size_t first, std::span<const Vec2>, std::span<const SurfaceJet> jets) {
                for (std::size_t k = 0; k < jets.size(); ++k) use(first + k, jets[k]);
              });
}

Vec2 ChartedPlaces::arrival(std::int32_t pole, std::int32_t from) const {
  const AtVertex& at = vertex_[from];
  const Vec3 chord = mesh_.vertices[face_.vertex[pole]] - mesh_.vertices[face_.vertex[from]];
  return degenerate_.arrival(pole, {vertex_[pole].su, vertex_[pole].sv}, face_.uv[from], {at.su, at.sv}, chord).value_or(face_.uv[pole]);
}

ChartMap ChartedPlaces::map_of(std::int32_t triangle) const {
  const auto& c = face_.triangles[static_cast<std::size_t>(triangle)];
  ChartMap map{{face_.uv[c[0]], face_.uv[c[1]], face_.uv[c[2]]}, {bulge_of(triangle, 0), bulge_of(triangle, 1), bulge_of(triangle, 2)}, -1, {}};
  for (int i = 0; i < 3; ++i) {
    const std::int32_t a = c[(i + 1) % 3], b = c[(i + 2) % 3];
    if (vertex_[c[i]].regular || !vertex_[a].regular || !vertex_[b].regular) continue;
    map.pole = i, map.arrival = {arrival(c[i], a), arrival(c[i], b)};
  }
  return map;
}

Vec2 ChartedPlaces::bulge_of(std::int32_t triangle, int side) const {
  const SharedEdge& edge = edge_[edges_.of_triangle[first_ + static_cast<std::size_t>(triangle)][side]];
  if (edge.beside[1] < 0 || (edge.beside[0] != triangle && edge.beside[1] != triangle)) return {0, 0};
  for (const std::int32_t t : edge.beside)
    for (const std::int32_t v : face_.triangles[static_cast<std::size_t>(t)])
      if (!vertex_[v].regular) return {0, 0};
  const AtVertex &p = vertex_[edge.from], &q = vertex_[edge.to];
  const Vec2 bulge = bulge_over_chord(face_.uv[edge.to] - face_.uv[edge.from], {p.su, p.sv}, {q.su, q.sv});
  if (!is_finite(bulge)) return {0, 0};
  double part = 1;
  for (const std::int32_t t : edge.beside) {
    const auto& c = face_.triangles[static_cast<std::size_t>(t)];
    part = std::min(part, part_inside(bulge, face_.uv[c[1]] - face_.uv[c[0]], face_.uv[c[2]] - face_.uv[c[0]]));
  }
  return std::isfinite(part) ? Vec2(part * bulge) : Vec2(0, 0);
}

std::int32_t ChartedPlaces::add(const Vec2& uv) {
  uv_.push_back(uv);
  return static_cast<std::int32_t>(uv_.size()) - 1;
}

void ChartedPlaces::see_vertex(std::int32_t v) {
  if (vertex_[v].place < 0) vertex_[v].place = add(face_.uv[v]), seen_.push_back(v);
}

void ChartedPlaces::see_vertices(std::span<const std::int32_t> triangles) {
  for (const std::int32_t t : triangles) {
    for (const std::int32_t v : face_.triangles[static_cast<std::size_t>(t)]) see_vertex(v);
    for (const std::int32_t e : edges_.of_triangle[first_ + static_cast<std::size_t>(t)])
      for (const std::int32_t beside : edge_[e].beside)
        if (beside >= 0)
          for (const std::int32_t v : face_.triangles[static_cast<std::size_t>(beside)]) see_vertex(v);
  }
  place_.resize(uv_.size());
  evaluate(uv_, [&](std::size_t k, const SurfaceJet& jet) {
    place_[k] = {jet.s, cross(jet.su, jet.sv)};
    AtVertex& at = vertex_[seen_[k]];
    at.su = jet.su, at.sv = jet.sv, at.regular = unit_normal(jet).has_value();
  });
}

void ChartedPlaces::forget() {
  for (const std::int32_t v : seen_) vertex_[v].place = -1;
  for (const std::int32_t e : used_) edge_[e].place = -1;
  seen_.clear(), used_.clear(), uv_.clear(), place_.clear(), ranks_.clear();
}

// Shared with the triangle that has the same edge of (u, v).
void ChartedPlaces::add_side(std::int32_t triangle, int side, const ChartMap& map, Ranks& ranks) {
  const auto& c = face_.triangles[static_cast<std::size_t>(triangle)];
  const std::int32_t from = c[side], to = c[(side + 1) % 3];
  const std::int32_t edge = edges_.of_triangle[first_ + static_cast<std::size_t>(triangle)][side];
  SharedEdge& known = edge_[edge];
  const std::array<std::size_t, 3>& rank = side_ranks[side];
  const bool shared = map.pole < 0 && known.beside[1] >= 0 && (known.beside[0] == triangle || known.beside[1] == triangle);
  if (shared && known.place >= 0) {
    const bool same_way = known.from == from && known.to == to;
    for (std::int32_t k = 0; k < 3; ++k) ranks[rank[k]] = known.place + (same_way ? k : 2 - k);
    return;
  }
  std::array<std::size_t, 3> order = rank;  // as the edge runs
  if (shared && known.from != from) std::ranges::reverse(order);
  for (const std::size_t k : order) ranks[k] = add(map.at(TriangleBound::lattice()[k]));
  if (!shared) return;
  known.place = ranks[order[0]];
  used_.push_back(edge);
}

void ChartedPlaces::see(std::span<const std::int32_t> triangles) {
  forget();
  see_vertices(triangles);
  const std::size_t known = uv_.size();
  ranks_.reserve(triangles.size());
  for (const std::int32_t t : triangles) {
    const ChartMap map = map_of(t);
    Ranks& ranks = ranks_.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      ranks[corner_ranks[i]] = vertex_[face_.triangles[static_cast<std::size_t>(t)][i]].place;
      add_side(t, static_cast<int>(i), map, ranks);
    }
    for (const std::size_t k : inner_ranks) ranks[k] = add(map.at(TriangleBound::lattice()[k]));
  }
  place_.resize(uv_.size());
  evaluate(std::span(uv_).subspan(known),
           [&](std::size_t k, const SurfaceJet& jet) { place_[known + k] = {jet.s, cross(jet.su, jet.sv)}; });
}

std::array<BoundPlace, TriangleBound::lattice_size> ChartedPlaces::lattice(std::size_t k) const {
  std::array<BoundPlace, TriangleBound::lattice_size> places;
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = place_[static_cast<std::size_t>(ranks_[k][i])];
  return places;
}

std::vector<BoundPlace> ChartedPlaces::see(std::span<const ChartedPlace> places) {
  std::vector<Vec2> uv;
  uv.reserve(places.size());
  for (const ChartedPlace& p : places) uv.push_back(map_of(p.triangle).at(p.at));
  std::vector<BoundPlace> seen(uv.size());
  evaluate(uv, [&](std::size_t k, const SurfaceJet& jet) { seen[k] = {jet.s, cross(jet.su, jet.sv)}; });
  return seen;
}

}  // namespace carreau
