// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/curved_elements.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "adapt/thresholds.h"
#include "mesh/elements/jacobian.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "support/shares.h"

namespace carreau {

namespace {

using namespace thresholds::adapt;

std::span<const Vec3> nodes_of(const Cell& cell, const std::array<Vec3, 8>& x) {
  return {x.data(), static_cast<std::size_t>(node_count(cell.kind))};
}

double min_coordinate(CellKind kind, double s, double t) {
  return corner_count(kind) == 3 ? std::min({s, t, 1 - s - t}) : std::min({s, t, 1 - s, 1 - t});
}

}  // namespace

CurvedElements::CurvedElements(const SurfaceMesh& mesh, const FaceMesh& face) {
  if (face.mid.empty()) return;
  add(mesh, face);
  const auto corners = static_cast<std::int32_t>(face.uv.size());
  for (const Cell& cell : local_cells(face)) {
    std::array<Vec3, 8>& x = uv_.emplace_back();
    for (std::size_t i = 0; i < static_cast<std::size_t>(node_count(cell.kind)); ++i) {
      const std::int32_t node = cell.nodes[i];
      const Vec2& p = node < corners ? face.uv[node] : face.mid_uv[node - corners];
      x[i] = {p.x(), p.y(), 0};
    }
  }
  number_corners();
}

CurvedElements::CurvedElements(const SurfaceMesh& mesh) {
  for (const FaceMesh& face : mesh.faces)
    if (!face.triangles.empty() && face.mid.empty()) return;
  for (const FaceMesh& face : mesh.faces) add(mesh, face);
  number_corners();
}

void CurvedElements::add(const SurfaceMesh& mesh, const FaceMesh& face) {
  const auto all = static_cast<std::int32_t>(mesh.vertices.size());
  for (const Cell& cell : cells_of(mesh, face)) {
    of_triangle_.insert(of_triangle_.end(), corner_count(cell.kind) == 4 ? 2 : 1, static_cast<std::int32_t>(cells_.size()));
    cells_.push_back(cell);
    std::array<Vec3, 8>& x = xyz_.emplace_back();
    for (std::size_t i = 0; i < static_cast<std::size_t>(node_count(cell.kind)); ++i)
      x[i] = cell.nodes[i] < all ? mesh.vertices[cell.nodes[i]] : mesh.mid_vertices[cell.nodes[i] - all];
  }
}

void CurvedElements::number_corners() {
  std::int32_t most = -1;
  const auto for_corners = [&](const auto& use) {
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (int i = 0; i < corner_count(cells_[c].kind); ++i) use(c, cells_[c].nodes[i]);
  };
  for_corners([&](std::size_t, std::int32_t row) { most = std::max(most, row); });
  first_.assign(static_cast<std::size_t>(most) + 2, 0);
  for_corners([&](std::size_t, std::int32_t row) { ++first_[row + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  at_corner_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<std::int32_t> next = first_;
  for_corners([&](std::size_t c, std::int32_t row) { at_corner_[next[row]++] = static_cast<std::int32_t>(c); });
}

// Gauss and Newton's method for the point of the element nearest to p. In the plane the residual is 0 and convergence
// is quadratic; on a surface the residual is the distance of p. Coordinates are of degree 2 each, so that central
// differences are exact.
CurvedElements::Place CurvedElements::place_in(std::int32_t c, const Vec3& p, bool in_space) const {
  const Cell& cell = cells_[c];
  const std::span<const Vec3> x = nodes_of(cell, in_space || uv_.empty() ? xyz_[c] : uv_[c]);
  const double third = 1.0 / 3, start = corner_count(cell.kind) == 3 ? third : 0.5;
  Place place{c, start, start, 0};
  double step = infinity;
  for (int k = 0; k < rounding_of::max_steps; ++k) {
    const double s = place.s, t = place.t;
    const auto at = [&](double ds, double dt) { return point_of_cell(cell.kind, x, s + ds, t + dt); };
    const Vec3 by_s = at(0.5, 0) - at(-0.5, 0), by_t = at(0, 0.5) - at(0, -0.5), d = p - at(0, 0);
    const double a = dot(by_s, by_s), b = dot(by_s, by_t), e = dot(by_t, by_t), det = a * e - b * b;
    step = infinity;
    if (!(det > 0)) break;
    const double f = dot(by_s, d), g = dot(by_t, d), ds = (e * f - b * g) / det, dt = (a * g - b * f) / det;
    place.s = std::clamp(s + ds, -1.0, 2.0), place.t = std::clamp(t + dt, -1.0, 2.0);
    step = std::max(std::abs(place.s - s), std::abs(place.t - t));
    if (step < rounding_of::digits) break;
  }
  // Far from p the element may fold on the way; then Newton's method stops at a point that is not p.
  place.inside = step < shares::negligible ? min_coordinate(cell.kind, place.s, place.t) : -infinity;
  return place;
}

void CurvedElements::interpolate(std::int32_t triangle, const Vec3& p, bool in_space, std::span<const double> values,
                                 std::size_t components, double* out) const {
  const std::int32_t start = of_triangle_[triangle];
  Place best = place_in(start, p, in_space);
  for (int i = 0; i < corner_count(cells_[start].kind) && best.inside < 0; ++i) {
    const std::int32_t row = cells_[start].nodes[i];
    for (std::int32_t k = first_[row]; k < first_[row + 1]; ++k)
      if (const Place other = place_in(at_corner_[k], p, in_space); other.inside > best.inside) best = other;
  }
  const Cell& cell = cells_[best.cell];
  // Beside the mesh the polynomial holds slightly beyond a curved border; farther away the nearest value is used.
  double s = std::clamp(best.s, -max_beside, 1 + max_beside), t = std::clamp(best.t, -max_beside, 1 + max_beside);
  if (const double beyond = s + t - 1 - max_beside; corner_count(cell.kind) == 3 && beyond > 0)
    s -= beyond / 2, t -= beyond / 2;
  std::array<Vec3, 8> unit;
  const auto n = static_cast<std::size_t>(node_count(cell.kind));
  for (std::size_t k = 0; k < components; ++k) {
    for (std::size_t i = 0; i < n; ++i)
      unit[i] = {values[static_cast<std::size_t>(cell.nodes[i]) * components + k], 0, 0};
    out[k] = point_of_cell(cell.kind, {unit.data(), n}, s, t).x();
  }
}

}  // namespace carreau
