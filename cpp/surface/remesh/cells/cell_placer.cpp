// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/cells/cell_placer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>
#include <utility>

#include "mesh/elements/jacobian.h"
#include "predicates/predicates.h"
#include "support/infinity.h"
#include "surface/remesh/base/thresholds.h"

namespace carreau {

using namespace thresholds::remesh;

PlacedCell CellPlacer::operator()(const SpaceCell& cell, const SpaceCell& nodes) {
  vertex_ = cell;
  n_ = cell[3] < 0 ? 3 : 4;
  side_ = -1;
  for (int i = 0; i < n_ && side_ < 0; ++i)
    if (vertices_.is_free(cell[i])) side_ = charts_.triangles()[vertices_.place(cell[i]).foot.triangle].side;
  const auto at = [&](int k) -> Vec3 { return vertices_.position(cell[k]); };
  const Vec3 a = at(0);
  normal_ = n_ == 3 ? Vec3(cross(at(1) - a, at(2) - a)) : Vec3(cross(at(2) - a, at(3) - at(1)));
  const auto placed = [&]() -> PlacedCell {
    if (const auto face = only_one_each()) {
      if (*face >= 0 && fits({})) return this->placed(*face, {}, is_turned(place(0, {})), false);
      return over_several();
    }
    for (const std::int32_t face : common_faces())
      if (auto in_face = in_one_chart(face)) return *in_face;
    return over_several();
  };
  PlacedCell result = placed();
  if (nodes[0] >= 0) place_nodes(nodes, result);
  return result;
}

// Returns the face that common_faces() finds if corners have one place each, as inside, or -1 if no face is common.
std::optional<std::int32_t> CellPlacer::only_one_each() const {
  std::int32_t face = -1;
  bool common = true;
  for (int i = 0; i < n_; ++i) {
    const auto places = vertices_.places(vertex_[i]);
    if (places.size() != 1) return {};
    const SurfacePlace& p = places.front();
    if (i == 0) face = face_of(p);
    common = common && face_of(p) == face && (!p.regular || dot(p.normal, normal_) > 0);
  }
  return common ? face : -1;
}

// Returns the faces in which each corner has a place, on the side of the cell; ascending.
std::vector<std::int32_t> CellPlacer::common_faces() const {
  std::vector<std::int32_t> common;
  for (int i = 0; i < n_; ++i) {
    std::vector<std::int32_t> faces;
    for (const SurfacePlace& p : vertices_.places(vertex_[i]))
      if (is_allowed(p) && (!p.regular || dot(p.normal, normal_) > 0)) faces.push_back(face_of(p));
    std::ranges::sort(faces);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    if (i == 0) {
      common = std::move(faces);
    } else {
      std::erase_if(common, [&](std::int32_t f) { return !std::ranges::binary_search(faces, f); });
    }
  }
  return common;
}

// Selects, among the places of the corners in a face, places that are as far apart in (u, v) as in space.
std::optional<PlacedCell> CellPlacer::in_one_chart(std::int32_t face) const {
  std::array<std::vector<std::int32_t>, 4> choice;
  for (int i = 0; i < n_; ++i) {
    const auto places = vertices_.places(vertex_[i]);
    for (std::size_t k = 0; k < places.size(); ++k)
      if (face_of(places[k]) == face && is_allowed(places[k])) choice[i].push_back(static_cast<std::int32_t>(k));
  }
  if (n_ == 3) choice[3].push_back(-1);
  for (const std::int32_t a : choice[0])
    for (const std::int32_t b : choice[1])
      for (const std::int32_t c : choice[2])
        for (const std::int32_t d : choice[3]) {
          const Choice k{a, b, c, d};
          if (fits(k)) return placed(face, k, is_turned(place(0, k)), false);
        }
  return {};
}

bool CellPlacer::fits(const Choice& k) const {
  std::array<const SurfacePlace*, 4> p{};
  for (int i = 0; i < n_; ++i) p[i] = &place(i, k);
  const double sign = is_turned(*p[0]) ? -1 : 1;
  for (int i = 0; i < (n_ == 3 ? 1 : 4); ++i)
    if (!(sign * orientation(p[i]->foot.uv, p[(i + 1) % n_]->foot.uv, p[(i + 2) % n_]->foot.uv) > 0)) return false;
  for (int i = 0; i < n_; ++i) {
    if (!p[i]->regular) continue;
    for (int step = 1; step < n_; ++step) {
      const SurfacePlace& other = *p[(i + step) % n_];
      const Vec2 way = other.foot.uv - p[i]->foot.uv;
      const Vec3 chord = other.xyz - p[i]->xyz;
      if (!(norm(way.x() * p[i]->su + way.y() * p[i]->sv - chord) <= max_distortion * norm(chord))) return false;
    }
  }
  return true;
}

PlacedCell CellPlacer::placed(std::int32_t face, const Choice& k, bool turned, bool spread) const {
  PlacedCell cell{face, n_, {}, {}, spread};
  for (int i = 0; i < n_; ++i) cell.corners[i] = {vertex_[i], k[i]};
  if (turned) std::swap(cell.corners[1], cell.corners[n_ - 1]);
  return cell;
}

std::int32_t CellPlacer::nearest_place(std::int32_t v, std::int32_t face) const {
  const auto places = vertices_.places(v);
  std::int32_t best = 0;
  std::tuple<bool, bool, double> most{false, false, -infinity};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::tuple here{is_allowed(places[k]), face_of(places[k]) == face && dot(places[k].normal, normal_) > 0,
                          dot(places[k].normal, normal_)};
    if (here > most) most = here, best = static_cast<std::int32_t>(k);
  }
  return best;
}

/// The surface over a place of the cell, from the nearest corner that has a normal.
std::optional<SurfacePlace> CellPlacer::below(const std::array<double, 4>& weight, const Choice& k) const {
  Vec3 target = weight[0] * vertices_.position(vertex_[0]) + weight[1] * vertices_.position(vertex_[1]) +
                weight[2] * vertices_.position(vertex_[2]);
  if (n_ == 4) target += weight[3] * vertices_.position(vertex_[3]);
  std::array<int, 4> order{0, 1, 2, 3};
  std::stable_sort(order.begin(), order.begin() + n_, [&](int i, int j) { return weight[i] > weight[j]; });
  for (int i = 0; i < n_; ++i) {
    const SurfacePlace& from = place(order[i], k);
    if (!from.regular) continue;
    if (auto found = charts_.towards(cad_, from, target)) return found;
  }
  return {};
}

// The face that holds most of some places, if the corners lie in three faces; otherwise the face of the centroid.
std::optional<SurfacePlace> CellPlacer::most_of(const Choice& k) const {
  constexpr double most = 2. / 3;
  const double rest = n_ == 3 ? 1. / 6 : 1. / 9;
  std::array<double, 4> equal{}, weight{};
  for (int i = 0; i < n_; ++i) equal[i] = 1. / n_;
  auto found = below(equal, k);
  std::vector<std::int32_t> faces;
  for (int i = 0; i < n_; ++i) faces.push_back(face_of(place(i, k)));
  std::ranges::sort(faces);
  if (std::unique(faces.begin(), faces.end()) - faces.begin() < 3) return found;
  std::map<std::int32_t, int> votes;
  std::vector<SurfacePlace> places;
  if (found) places.push_back(*found);
  for (int i = 0; i < n_; ++i) {
    for (int j = 0; j < n_; ++j) weight[j] = i == j ? most : rest;
    if (auto at = below(weight, k)) places.push_back(*at);
  }
  for (int i = 0; i < n_; ++i) {
    weight = {};
    weight[i] = weight[(i + 1) % n_] = 0.5;
    if (auto at = below(weight, k)) places.push_back(*at);
  }
  for (const SurfacePlace& p : places) ++votes[face_of(p)];
  for (const SurfacePlace& p : places)
    if (!found || votes[face_of(p)] > votes[face_of(*found)]) found = p;
  return found;
}

// Returns the face if all places of the corners are in one face.
std::optional<std::int32_t> CellPlacer::only_face() const {
  const std::int32_t face = face_of(vertices_.places(vertex_[0]).front());
  for (int i = 0; i < n_; ++i)
    for (const SurfacePlace& p : vertices_.places(vertex_[i]))
      if (face_of(p) != face) return {};
  return face;
}

PlacedCell CellPlacer::over_several() const {
  Choice k{};
  if (const auto face = only_face()) {
    for (int i = 0; i < n_; ++i) k[i] = nearest_place(vertex_[i], *face);
    return placed(*face, k, is_turned(place(0, k)), true);
  }
  for (int i = 0; i < n_; ++i) k[i] = nearest_place(vertex_[i], -1);
  const std::optional<SurfacePlace> foot = most_of(k);
  const SurfacePlace middle = foot ? *foot : place(0, k);
  const std::int32_t face = face_of(middle);
  for (int i = 0; i < n_; ++i) k[i] = nearest_place(vertex_[i], face);
  return placed(face, k, is_turned(middle), true);
}

// Returns the place of a node nearest to `middle` in the face of a cell, otherwise the place on the side of the cell.
std::int32_t CellPlacer::place_of_node(std::int32_t node, const PlacedCell& cell, const Vec2& middle) const {
  const auto places = vertices_.places(node);
  std::int32_t best = -1;
  double nearest = infinity;
  for (std::size_t k = 0; k < places.size() && !cell.spread; ++k)
    if (const double apart = norm(places[k].foot.uv - middle); face_of(places[k]) == cell.face && apart < nearest)
      nearest = apart, best = static_cast<std::int32_t>(k);
  return best >= 0 ? best : nearest_place(node, cell.face);
}

void CellPlacer::place_nodes(const SpaceCell& nodes, PlacedCell& cell) const {
  const bool reversed = cell.corners[1].vertex != vertex_[1];
  const auto uv = [&](const PlacedCorner& c) -> Vec2 { return vertices_.places(c.vertex)[c.place].foot.uv; };
  for (int i = 0; i < n_; ++i) {
    const std::int32_t node = nodes[reversed ? n_ - 1 - i : i];
    const Vec2 middle = 0.5 * (uv(cell.corners[i]) + uv(cell.corners[(i + 1) % n_]));
    cell.nodes[i] = {node, place_of_node(node, cell, middle)};
  }
  cell.spread = cell.spread || !is_valid_in_chart(cell);
}

bool CellPlacer::is_valid_in_chart(const PlacedCell& cell) const {
  std::array<Vec3, 8> plane;
  const auto put = [&](int i, const PlacedCorner& c) {
    const SurfacePlace& p = vertices_.places(c.vertex)[c.place];
    plane[i] = {p.foot.uv.x(), p.foot.uv.y(), 0};
    return face_of(p) == cell.face;
  };
  for (int i = 0; i < n_; ++i)
    if (!put(i, cell.corners[i]) || !put(n_ + i, cell.nodes[i])) return false;
  const CellKind kind = n_ == 3 ? CellKind::triangle6 : CellKind::quad8;
  return jacobian(kind, {plane.data(), static_cast<std::size_t>(2 * n_)}).min_along({0, 0, 1}) > 0;
}

}  // namespace carreau
