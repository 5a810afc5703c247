// SPDX-License-Identifier: BSD-3-Clause
// Meshes from arrays of the caller.
#include <limits>

#include "arguments.h"
#include "carreau.h"
#include "guard.h"
#include "support/vec.h"

using carreau::FlatMesh;
using carreau::InvalidArgument;
using namespace carreau::abi;

namespace {

void check_counts(const carreau_mesh_arrays& given) {
  if (given.dimension != 2 && given.dimension != 3)
    throw InvalidArgument("the dimension of a mesh is " + std::to_string(given.dimension) + "; it must be 2 or 3");
  const auto check = [](std::int64_t count, std::int64_t least, const char* what) {
    if (count < least || count > std::numeric_limits<std::int32_t>::max())
      throw InvalidArgument("the number of " + std::string(what) + " is " + std::to_string(count));
  };
  check(given.vertex_count, 1, "vertices");
  check(given.triangle_count, 1, "triangles");
  check(given.edge_count, 0, "edges");
  required(given.vertices, "arrays->vertices"), required(given.triangles, "arrays->triangles");
  if (given.edge_count > 0) required(given.edges, "arrays->edges");
}

/// Rows of N vertices; rejects indices out of range.
template <std::size_t N>
std::vector<std::array<std::int32_t, N>> rows_of(const std::int32_t* indices, std::int64_t count, std::int64_t vertices,
                                                 const char* what) {
  std::vector<std::array<std::int32_t, N>> rows(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < N; ++k) {
      const std::int32_t v = rows[i][k] = indices[N * i + k];
      if (v < 0 || v >= vertices)
        throw InvalidArgument(std::string(what) + " " + std::to_string(i) + " has the vertex " + std::to_string(v) +
                              "; there are " + std::to_string(vertices) + ", counted from 0");
    }
  return rows;
}

std::vector<carreau::Vec3> vertices_of(const carreau_mesh_arrays& given) {
  std::vector<carreau::Vec3> vertices;
  vertices.reserve(static_cast<std::size_t>(given.vertex_count));
  for (std::int64_t i = 0; i < given.vertex_count; ++i) {
    const double* const p = given.vertices + given.dimension * i;
    vertices.emplace_back(p[0], p[1], given.dimension == 3 ? p[2] : 0);
    if (!carreau::is_finite(vertices.back()))
      throw InvalidArgument("a coordinate of vertex " + std::to_string(i) + " is not finite");
  }
  return vertices;
}

std::vector<std::int32_t> refs_of(const std::int32_t* refs, std::int64_t count, std::int32_t otherwise) {
  if (refs == nullptr) return std::vector<std::int32_t>(static_cast<std::size_t>(count), otherwise);
  return {refs, refs + count};
}

FlatMesh flat_of(const carreau_mesh_arrays& given) {
  FlatMesh flat;
  flat.dimension = given.dimension;
  flat.vertices = vertices_of(given);
  flat.triangles = rows_of<3>(given.triangles, given.triangle_count, given.vertex_count, "triangle");
  flat.edges = rows_of<2>(given.edges, given.edge_count, given.vertex_count, "edge");
  flat.vertex_refs = refs_of(given.vertex_refs, given.vertex_count, 0);
  flat.triangle_refs = refs_of(given.triangle_refs, given.triangle_count, 1);
  flat.edge_refs = refs_of(given.edge_refs, given.edge_count, 0);
  return flat;
}

}  // namespace

carreau_status carreau_mesh_from_arrays(carreau_mesh* mesh, const carreau_mesh_arrays* arrays) {
  return guarded(mesh, [&] {
    const carreau_mesh_arrays known = read_struct(arrays, "carreau_mesh_arrays");
    if (mesh->session != nullptr)
      throw InvalidArgument("the mesh of a session cannot be replaced: use carreau_mesh_create");
    check_counts(known);
    FlatMesh flat = flat_of(known);
    std::vector<double> uv;
    if (known.corner_uv != nullptr) uv.assign(known.corner_uv, known.corner_uv + 6 * known.triangle_count);
    mesh->flat_faces = faces_of(flat);
    mesh->flat = std::move(flat);
    mesh->corner_uv = std::move(uv);
    mesh->filled = true;
    mesh->part.reset();
    mesh->curved.reset();
    mesh->remeshed.reset();
  });
}
