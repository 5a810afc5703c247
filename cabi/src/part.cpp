// SPDX-License-Identifier: BSD-3-Clause
// Meshes that the processes of a team keep in parts.
#include <algorithm>
#include <utility>

#include "arguments.h"
#include "carreau.h"
#include "guard.h"
#include "mesh_content.h"

using namespace carreau::abi;

namespace {

const carreau::PartMesh& part_of(const carreau_mesh& mesh) {
  if (!mesh.part) throw StatusError(CARREAU_ERR_SEQUENCE, "the mesh is not a part: carreau_mesh_generate_part makes parts");
  return *mesh.part;
}

template <typename T>
void copy(const std::vector<T>& rows, T* out) {
  if (out != nullptr) std::copy(rows.begin(), rows.end(), out);
}

}  // namespace

void carreau::abi::keep_part(PartMesh part, carreau_mesh& mesh) {
  std::vector<carreau_mesh::FaceOfFile> faces;
  for (const WholeFace& whole : part.faces) faces.push_back({whole.face, std::int64_t(whole.triangles)});
  mesh.flat = std::exchange(part.mesh, {});
  mesh.flat_faces = std::move(faces);
  mesh.part = std::move(part);
  mesh.filled = true;
  mesh.corner_uv.clear();
  mesh.curved.reset();
  mesh.remeshed.reset();
}

carreau_status carreau_mesh_part_count(carreau_mesh* part, carreau_part_counts* out_counts) {
  return guarded(part, [&] {
    const carreau::PartMesh& of = part_of(*part);
    carreau_part_counts counts{};
    counts.rank = of.rank, counts.size = of.processes;
    counts.own_vertices = of.own_vertices, counts.own_triangles = of.own_triangles;
    counts.all_vertices = of.vertices, counts.all_triangles = of.triangles, counts.all_edges = of.curve_edges;
    counts.crossings = of.crossings;
    write_struct(counts, out_counts, "out_counts");
  });
}

carreau_status carreau_mesh_part_vertices(carreau_mesh* part, int64_t capacity, int64_t* out_numbers, int32_t* out_owners,
                                          int64_t* out_rows) {
  return guarded(part, [&] {
    const carreau::PartMesh& of = part_of(*part);
    check_capacity(capacity, of.vertex_number.size(), "vertices");
    copy(of.vertex_number, out_numbers);
    copy(of.vertex_owner, out_owners);
    copy(of.vertex_row, out_rows);
  });
}

carreau_status carreau_mesh_part_triangles(carreau_mesh* part, int64_t capacity, int64_t* out_numbers, int32_t* out_owners) {
  return guarded(part, [&] {
    const carreau::PartMesh& of = part_of(*part);
    check_capacity(capacity, of.triangle_number.size(), "triangles");
    copy(of.triangle_number, out_numbers);
    copy(of.triangle_owner, out_owners);
  });
}

carreau_status carreau_mesh_part_quality(carreau_mesh* part, carreau_quality* out_quality) {
  return guarded(part, [&] { write_struct(quality_of(part_of(*part).quality), out_quality, "out_quality"); });
}
