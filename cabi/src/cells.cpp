// SPDX-License-Identifier: BSD-3-Clause
// Elements of a mesh by kind.
#include "arguments.h"
#include "carreau.h"
#include "guard.h"
#include "high_order/curved_quality.h"
#include "mesh/elements/cell_quality.h"
#include "mesh_content.h"

using carreau::FaceMesh;
using carreau::FlatMesh;
using carreau::InvalidArgument;
using carreau::SurfaceMesh;
using namespace carreau::abi;

static_assert(int(carreau::CellKind::triangle3) == CARREAU_CELL_TRIANGLE3);
static_assert(int(carreau::CellKind::triangle6) == CARREAU_CELL_TRIANGLE6);
static_assert(int(carreau::CellKind::quad4) == CARREAU_CELL_QUAD4);
static_assert(int(carreau::CellKind::quad8) == CARREAU_CELL_QUAD8);

namespace {

/// body(cell, reference of its face) for each element of the kind; nodes are vertices of the mesh.
template <typename Body>
void for_each_cell(const carreau_mesh& mesh, carreau::CellKind kind, Body&& body) {
  if (mesh.session != nullptr) {
    for (const FaceMesh& face : surface_of(mesh).faces)
      for (const carreau::Cell& cell : carreau::cells_of(surface_of(mesh), face))
        if (cell.kind == kind) body(cell, face.shown_ref());
    return;
  }
  const FlatMesh& flat = mesh.flat;
  carreau::for_cells(flat, [&](std::size_t, const carreau::Cell& cell, const auto&, std::size_t triangle) {
    if (cell.kind == kind) body(cell, triangle < flat.triangle_refs.size() ? flat.triangle_refs[triangle] : 0);
  });
}

/// body(index of a face, local node) for each node of each element of the kind.
template <typename Body>
void for_each_node(const SurfaceMesh& mesh, carreau::CellKind kind, Body&& body) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const carreau::Cell& cell : carreau::local_cells(mesh.faces[f]))
      for (int i = 0; cell.kind == kind && i < carreau::node_count(kind); ++i) body(f, cell.nodes[std::size_t(i)]);
}

carreau::CellKind kind_of(std::int32_t kind) {
  if (kind < CARREAU_CELL_TRIANGLE3 || kind > CARREAU_CELL_QUAD8)
    throw InvalidArgument("there is no kind of elements " + std::to_string(kind));
  return carreau::CellKind(kind);
}

std::size_t count_cells(const carreau_mesh& mesh, carreau::CellKind kind) {
  std::size_t count = 0;
  for_each_cell(mesh, kind, [&](const carreau::Cell&, std::int32_t) { ++count; });
  return count;
}

}  // namespace

carreau_status carreau_mesh_cell_count(carreau_mesh* mesh, int32_t kind, int64_t* out_count) {
  return guarded(mesh, [&] {
    required(out_count, "out_count");
    require_content(*mesh);
    *out_count = std::int64_t(count_cells(*mesh, kind_of(kind)));
  });
}

carreau_status carreau_mesh_cells(carreau_mesh* mesh, int32_t kind, int64_t capacity, int32_t* out_nodes,
                                  int32_t* out_refs) {
  return guarded(mesh, [&] {
    required(out_nodes, "out_nodes");
    require_content(*mesh);
    const carreau::CellKind wanted = kind_of(kind);
    check_capacity(capacity, count_cells(*mesh, wanted), "elements");
    std::int32_t *node = out_nodes, *ref = out_refs;
    for_each_cell(*mesh, wanted, [&](const carreau::Cell& cell, std::int32_t of_face) {
      node = std::copy_n(cell.nodes.begin(), carreau::node_count(wanted), node);
      if (ref != nullptr) *ref++ = of_face;
    });
  });
}

carreau_status carreau_mesh_cell_uv(carreau_mesh* mesh, int32_t kind, int64_t capacity, double* out_uv) {
  return guarded(mesh, [&] {
    required(out_uv, "out_uv");
    require_content(*mesh);
    const carreau::CellKind wanted = kind_of(kind);
    check_capacity(capacity, count_cells(*mesh, wanted), "elements");
    double* out = out_uv;
    const SurfaceMesh& surface = session_only(*mesh, "(u, v)");
    for_each_node(surface, wanted, [&](std::size_t f, std::int32_t node) {
      const FaceMesh& face = surface.faces[f];
      const auto corners = std::int32_t(face.uv.size());
      const carreau::Vec2& uv = node < corners ? face.uv[node] : face.mid_uv[node - corners];
      *out++ = uv.x(), *out++ = uv.y();
    });
  });
}

carreau_status carreau_mesh_cell_faces(carreau_mesh* mesh, int32_t kind, int64_t capacity, int32_t* out_refs) {
  return guarded(mesh, [&] {
    required(out_refs, "out_refs");
    require_content(*mesh);
    const carreau::CellKind wanted = kind_of(kind);
    check_capacity(capacity, count_cells(*mesh, wanted), "elements");
    std::int32_t* out = out_refs;
    const SurfaceMesh& surface = session_only(*mesh, "(u, v)");
    for_each_node(surface, wanted, [&](std::size_t f, std::int32_t node) {
      *out++ = surface.faces[mesh->session->session.uv_face(f, node)].shown_ref();
    });
  });
}

carreau_status carreau_mesh_edge_mids(carreau_mesh* mesh, int64_t capacity, int32_t* out_vertices) {
  return guarded(mesh, [&] {
    required(out_vertices, "out_vertices");
    const std::size_t k = Counts(*mesh).edges;
    check_capacity(capacity, k, "edges");
    std::fill_n(out_vertices, k, -1);
    std::int32_t* out = out_vertices;
    if (mesh->session == nullptr) {
      std::copy(mesh->flat.edge_mids.begin(), mesh->flat.edge_mids.end(), out);
      return;
    }
    const SurfaceMesh& surface = surface_of(*mesh);
    for (const carreau::CurveMesh& curve : surface.curves) {
      for (std::size_t i = 0; i < curve.mid.size(); ++i) out[i] = std::int32_t(surface.vertices.size()) + curve.mid[i];
      if (!curve.vertices.empty()) out += curve.vertices.size() - 1;
    }
  });
}

carreau_status carreau_mesh_cell_quality(carreau_mesh* mesh, carreau_cell_quality* out_quality) {
  return guarded(mesh, [&] {
    require_content(*mesh);
    const carreau::CellSummary summary =
        mesh->session != nullptr ? carreau::summarise_cells(flat_of(*mesh)) : carreau::summarise_cells(mesh->flat);
    carreau_cell_quality result{};
    result.triangles3 = std::int64_t(summary.triangles3), result.triangles6 = std::int64_t(summary.triangles6);
    result.quads4 = std::int64_t(summary.quads4), result.quads8 = std::int64_t(summary.quads8);
    result.shape_mean = summary.shape.mean, result.shape_min = summary.shape.min;
    result.scaled_jacobian_mean = summary.scaled_jacobian.mean;
    result.scaled_jacobian_min = summary.scaled_jacobian.min;
    result.least_jacobian_mean = summary.least_jacobian.mean;
    result.least_jacobian_min = summary.least_jacobian.min;
    result.angle_min = summary.angle_min_deg, result.angle_max = summary.angle_max_deg;
    result.area = summary.area, result.triangle_share = summary.triangle_share;
    result.invalid = std::int64_t(summary.invalid);
    if (mesh->curved) {
      const carreau::CurvedQuality curved = carreau::measure_curved(*mesh->curved);
      result.invalid = curved.invalid, result.area = curved.area;
      result.least_jacobian_mean = curved.least_jacobian_mean, result.least_jacobian_min = curved.least_jacobian_min;
    }
    write_struct(result, out_quality, "out_quality");
  });
}
