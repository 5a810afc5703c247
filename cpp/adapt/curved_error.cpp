// SPDX-License-Identifier: BSD-3-Clause
// Interpolation errors of elements of second order.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "adapt/transfer.h"
#include "mesh/elements/jacobian.h"
#include "support/error.h"

namespace carreau {

namespace {

/// A point of the reference of an element.
struct Place {
  double s, t;
};

/// Middles of edges and centres of the triangles of a reference; each side of the reference is halved.
class Samples {
 public:
  explicit Samples(CellKind kind) {
    constexpr double h = 0.5;
    for (const double t : {0.0, h})
      for (const double s : {0.0, h}) {
        const bool last = corner_count(kind) == 3 && s + t >= 2 * h;
        if (last) continue;
        add({{{s, t}, {s + h, t}, {s, t + h}}});
        if (corner_count(kind) == 4 || s + t < h) add({{{s + h, t}, {s + h, t + h}, {s, t + h}}});
      }
  }
  [[nodiscard]] const std::vector<std::array<Place, 3>>& triangles() const noexcept { return triangles_; }
  /// Four places for each triangle: the centre is the last.
  [[nodiscard]] const std::vector<Place>& places() const noexcept { return places_; }

 private:
  void add(const std::array<Place, 3>& p) {
    triangles_.push_back(p);
    for (std::size_t k = 0; k < 3; ++k)
      places_.push_back({(p[k].s + p[(k + 1) % 3].s) / 2, (p[k].t + p[(k + 1) % 3].t) / 2});
    places_.push_back({(p[0].s + p[1].s + p[2].s) / 3, (p[0].t + p[1].t + p[2].t) / 3});
  }

  std::vector<std::array<Place, 3>> triangles_;
  std::vector<Place> places_;
};

/// An element with the values at its nodes.
struct Loaded {
  Cell cell;
  std::array<Vec3, 8> x, value;

  Loaded(const SurfaceMesh& mesh, std::span<const double> values, const Cell& of) : cell(of) {
    const std::size_t corners = mesh.vertices.size();
    for (std::size_t i = 0; i < size(); ++i) {
      const auto n = static_cast<std::size_t>(cell.nodes[i]);
      x[i] = n < corners ? mesh.vertices[n] : mesh.mid_vertices[n - corners];
      value[i] = {values[n], 0, 0};
    }
  }
  [[nodiscard]] std::size_t size() const noexcept { return static_cast<std::size_t>(node_count(cell.kind)); }
  [[nodiscard]] Vec3 at(const Place& p) const noexcept { return point_of_cell(cell.kind, {x.data(), size()}, p.s, p.t); }
  [[nodiscard]] double value_at(const Place& p) const noexcept {
    return point_of_cell(cell.kind, {value.data(), size()}, p.s, p.t).x();
  }
};

std::vector<Loaded> loaded_elements(const SurfaceMesh& mesh, std::span<const double> values) {
  if (values.size() != node_count(mesh))
    throw InvalidArgument("a field needs a value at each node; there are " + std::to_string(values.size()) + " values and " +
                          std::to_string(node_count(mesh)) + " nodes");
  for (std::size_t v = 0; v < values.size(); ++v) check_value(values[v], "at node " + std::to_string(v));
  std::vector<Loaded> elements;
  for (const FaceMesh& face : mesh.faces)
    for (const Cell& cell : cells_of(mesh, face)) {
      if (!is_quadratic(cell.kind)) throw InvalidArgument("a mesh has elements of first and second order");
      elements.emplace_back(mesh, values, cell);
    }
  if (elements.empty()) throw InvalidArgument("a field needs a mesh with one element at least");
  return elements;
}

}  // namespace

InterpolationError interpolation_error(const SurfaceMesh& mesh, std::span<const double> values, const FieldFunction& exact,
                                       double relative_floor) {
  const std::vector<Loaded> elements = loaded_elements(mesh, values);
  const Samples of_triangles(CellKind::triangle6), of_quads(CellKind::quad8);
  const auto samples = [&](const Loaded& e) -> const Samples& {
    return corner_count(e.cell.kind) == 3 ? of_triangles : of_quads;
  };
  std::vector<Vec3> points;
  for (const Loaded& e : elements)
    for (const Place& p : samples(e).places()) points.push_back(e.at(p));
  std::vector<double> known(points.size());
  exact(points, known);
  InterpolationError error;
  const double floor = relative_floor * largest_value(values);
  double area = 0, squares = 0;
  std::size_t next = 0;
  for (const Loaded& e : elements) {
    const Samples& all = samples(e);
    for (std::size_t i = 0; i < all.places().size(); ++i) {
      check_value(known[next], "at a point");
      const double value = known[next++], away = std::abs(value - e.value_at(all.places()[i]));
      error.largest = std::max(error.largest, away);
      if (away > 0) error.largest_share = std::max(error.largest_share, away / std::max(std::abs(value), floor));
      const auto& [a, b, c] = all.triangles()[i / 4];
      const double part = norm(cross(e.at(b) - e.at(a), e.at(c) - e.at(a))) / 6;  // a third of the area
      if (i % 4 < 3) area += part, squares += part * away * away;
    }
  }
  error.rms = area > 0 ? std::sqrt(squares / area) : 0;
  return error;
}

}  // namespace carreau
