// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtk/vtk_cells.h"

#include <algorithm>
#include <array>

#include "io/curved_rows.h"
#include "io/polygons/polygon_cutter.h"

namespace carreau {

namespace {

constexpr std::int64_t vtk_vertex = 1, vtk_points = 2, vtk_line = 3, vtk_polyline = 4, vtk_strip = 6, vtk_polygon = 7,
                       vtk_pixel = 8, vtk_voxel = 11, vtk_quadratic_edge = 21, vtk_polyhedron = 42,
                       vtk_lagrange_curve = 68;

/// A type of cells that are elements: its first nodes are the nodes of the kind.
struct SurfaceType {
  std::int64_t type;
  std::size_t nodes;
  CellKind kind;
};
constexpr SurfaceType surface_types[] = {
    {5, 3, CellKind::triangle3},  {9, 4, CellKind::quad4},      {22, 6, CellKind::triangle6}, {23, 8, CellKind::quad8},
    {28, 9, CellKind::quad8},     {34, 7, CellKind::triangle6},  // a node at the centre comes last
    {69, 3, CellKind::triangle3}, {69, 6, CellKind::triangle6}, {70, 4, CellKind::quad4},     {70, 9, CellKind::quad8},
    {76, 3, CellKind::triangle3}, {77, 4, CellKind::quad4}};

/// A type of solids: corners first, then, in order 2, the nodes on edges. Lagrange's and Bezier's cells with other
/// numbers of nodes than `straight` or `curved` have different orders, so that only corners count.
struct SolidType {
  std::int64_t type;
  SolidShape shape;
  bool curved;
};
constexpr SolidType solid_types[] = {
    {10, SolidShape::tetrahedron, false}, {12, SolidShape::hexahedron, false}, {13, SolidShape::prism, false},
    {14, SolidShape::pyramid, false},     {24, SolidShape::tetrahedron, true}, {25, SolidShape::hexahedron, true},
    {26, SolidShape::prism, true},        {27, SolidShape::pyramid, true},     {29, SolidShape::hexahedron, true},
    {31, SolidShape::prism, false},       {32, SolidShape::prism, true},       {33, SolidShape::hexahedron, true},
    {71, SolidShape::tetrahedron, false}, {72, SolidShape::hexahedron, false}, {73, SolidShape::prism, false},
    {74, SolidShape::pyramid, false},     {78, SolidShape::tetrahedron, false}, {79, SolidShape::hexahedron, false},
    {80, SolidShape::prism, false},       {81, SolidShape::pyramid, false}};

}  // namespace

std::string VtkCells::add(std::int64_t type, std::span<const std::int32_t> corners, std::size_t cell,
                          const std::vector<Vec3>& vertices) {
  if (type == 0 || type == vtk_vertex || type == vtk_points || type == vtk_polyhedron) return "";
  if (add_curved_cell(type, corners, cell)) {
    if (wrong_.empty() && !elements_.empty()) wrong_ = "elements of different orders are mixed";
    return wrong_;
  }
  if (add_edges(type, corners, cell) || add_surface(type, corners, cell, vertices) || add_solid(type, corners, cell)) {
    const bool first_order = !is_quadratic(elements_.empty() ? CellKind::triangle3 : elements_.front().cell.kind);
    const bool mixes_curved = !elements_.empty() && !(cell_of_curved_[1].empty() && cell_of_curved_[2].empty());
    if (mixes_curved) return "elements of different orders are mixed";
    const bool mixed = !elements_.empty() && is_quadratic(elements_.back().cell.kind) == first_order;
    return mixed ? "elements of first and of second order are mixed" : "";
  }
  return "cell " + std::to_string(cell) + " (from 0) has type " + std::to_string(type) + " and " +
         std::to_string(corners.size()) +
         " points; triangles and quadrilaterals of order 1 and 2 (types 5, 9, 22, 23, 28, 34, 69, 70), pixels, polygons, "
         "strips and solids are read only";
}

bool VtkCells::add_curved_cell(std::int64_t type, std::span<const std::int32_t> nodes, std::size_t cell) {
  struct Curved {
    std::int64_t type;
    std::size_t nodes;
    int order, corners;
  };
  static constexpr Curved known[] = {{68, 4, 3, 2}, {68, 5, 4, 2}, {69, 10, 3, 3}, {69, 15, 4, 3}, {70, 16, 3, 4}, {70, 25, 4, 4}};
  if (curved_ == nullptr) return false;
  for (const Curved& each : known) {
    if (each.type != type || each.nodes != nodes.size()) continue;
    std::vector<std::int32_t> row(nodes.begin(), nodes.end());
    if (each.corners == 4) {
      const std::vector<std::size_t> rank = vtk_ranks_of_quad(each.order);
      for (std::size_t i = 0; i < rank.size(); ++i) row[rank[i]] = nodes[i];
    }
    if (!add_curved(*curved_, each.order, each.corners, row, 0)) wrong_ = "elements of orders 3 and 4 are mixed";
    cell_of_curved_[each.corners - 2].push_back(cell);
    return true;
  }
  return false;
}

bool VtkCells::add_edges(std::int64_t type, std::span<const std::int32_t> corners, std::size_t cell) {
  const std::size_t n = corners.size();
  if ((type == vtk_quadratic_edge || type == vtk_lagrange_curve) && n == 3) {
    edges_.push_back({corners[0], corners[1]}), cell_of_edge_.push_back(cell);
    edge_mids_.push_back(corners[2]);
    return true;
  }
  if (n < 2 || (type != vtk_line && type != vtk_polyline && !(type == vtk_lagrange_curve && n == 2))) return false;
  for (std::size_t k = 1; k < n; ++k)
    edges_.push_back({corners[k - 1], corners[k]}), cell_of_edge_.push_back(cell);
  return true;
}

void VtkCells::add_element(CellKind kind, std::span<const std::int32_t> nodes, std::size_t cell) {
  Element& element = elements_.emplace_back();
  element.cell.kind = kind, element.rank = cell;
  std::copy_n(nodes.begin(), node_count(kind), element.cell.nodes.begin());
}

bool VtkCells::add_polygon(std::span<const std::int32_t> corners, std::size_t cell, const std::vector<Vec3>& vertices) {
  FlatMesh polygon;
  std::vector<std::int32_t> own;
  for (const std::int32_t v : corners) {
    own.push_back(static_cast<std::int32_t>(own.size()));
    polygon.vertices.push_back(vertices[static_cast<std::size_t>(v)]);
  }
  if (!PolygonCutter(polygon).add(own, 0).empty()) return false;
  for (const auto& [a, b, c] : polygon.triangles) {
    const auto at = [&](std::int32_t k) { return corners[static_cast<std::size_t>(k)]; };
    add_element(CellKind::triangle3, std::array{at(a), at(b), at(c)}, cell);
  }
  return true;
}

bool VtkCells::add_surface(std::int64_t type, std::span<const std::int32_t> corners, std::size_t cell,
                           const std::vector<Vec3>& vertices) {
  for (const SurfaceType& known : surface_types)
    if (known.type == type && known.nodes == corners.size()) return add_element(known.kind, corners, cell), true;
  if (type == vtk_pixel && corners.size() == 4)
    return add_element(CellKind::quad4, std::array{corners[0], corners[1], corners[3], corners[2]}, cell), true;
  if (type == vtk_polygon) return add_polygon(corners, cell, vertices);
  if (type != vtk_strip || corners.size() < 3) return false;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const std::size_t odd = k % 2;  // every other triangle runs back
    add_element(CellKind::triangle3, std::array{corners[k - 2 + odd], corners[k - 1 - odd], corners[k]}, cell);
  }
  return true;
}

bool VtkCells::add_solid(std::int64_t type, std::span<const std::int32_t> corners, std::size_t cell) {
  const std::size_t n = corners.size();
  const auto take = [&](SolidShape shape, std::span<const std::int32_t> nodes) {
    skin_.add(shape, nodes, 0);
    cell_of_solid_.push_back(cell);
    if (nodes.size() == 4) tetrahedra_.push_back({nodes[0], nodes[1], nodes[2], nodes[3]});
    return true;
  };
  if (type == vtk_voxel && n == 8)
    return take(SolidShape::hexahedron, std::array{corners[0], corners[1], corners[3], corners[2], corners[4],
                                                   corners[5], corners[7], corners[6]});
  for (const SolidType& known : solid_types) {
    if (known.type != type) continue;
    const bool curved = known.curved || (type == 71 && n == quadratic_count(known.shape));
    const std::size_t wanted = curved ? quadratic_count(known.shape) : corner_count(known.shape);
    return n >= wanted && take(known.shape, corners.first(wanted));
  }
  return false;
}

void VtkCells::give_to(FlatMesh& mesh) {
  if (elements_.empty() && !skin_.empty())
    for (const SkinFace& face : skin_.faces(mesh.vertices)) elements_.push_back({face.cell, cell_of_solid_[face.solid]});
  // Straight triangles alone are a mesh without elements of other kinds.
  const bool plain = std::ranges::all_of(elements_, [](const Element& e) { return e.cell.kind == CellKind::triangle3; });
  for (const Element& element : elements_) {
    const auto& n = element.cell.nodes;
    if (plain)
      mesh.triangles.push_back({n[0], n[1], n[2]});
    else
      add_cell(mesh, element.cell, 0);
    cell_of_triangle_.resize(cell_of_triangle_.size() + (corner_count(element.cell.kind) == 4 ? 2 : 1), element.rank);
  }
  mesh.triangle_refs.clear();
  mesh.edges = std::move(edges_);
  // If straight and curved edges are mixed, only the ends are kept.
  if (edge_mids_.size() == mesh.edges.size()) mesh.edge_mids = std::move(edge_mids_);
  mesh.tetrahedra = std::move(tetrahedra_);
}

}  // namespace carreau
