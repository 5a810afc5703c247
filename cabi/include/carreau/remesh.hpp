// SPDX-License-Identifier: BSD-3-Clause
/// Pieces that deform, break and touch tools: carreau_remesh.h, see carreau.hpp.
#ifndef CARREAU_REMESH_HPP
#define CARREAU_REMESH_HPP

#include "../carreau_remesh.h"
#include "mesh.hpp"

namespace carreau {

/// Meshes a piece anew after an increment. The struct of the C interface is the input, whose struct_size need not be set: it holds
/// pointers to arrays of the caller.
inline carreau_remesh_summary remesh(Mesh& mesh, const carreau_remesh_input& input) {
  const carreau_remesh_input in = detail::sized(input);
  auto out = detail::sized<carreau_remesh_summary>();
  mesh.done(carreau_remesh(mesh.get(), &in, &out));
  return out;
}
/// The fields on the new mesh: vertices x components, triangles x components, triangles.
inline std::vector<double> remesh_nodal_values(const Mesh& mesh, int components) {
  std::vector<double> out(static_cast<std::size_t>(mesh.vertex_count() * components));
  mesh.done(carreau_remesh_nodal_values(mesh.get(), mesh.vertex_count(), out.data()));
  return out;
}
inline std::vector<double> remesh_element_values(const Mesh& mesh, int components) {
  std::vector<double> out(static_cast<std::size_t>(mesh.triangle_count() * components));
  mesh.done(carreau_remesh_element_values(mesh.get(), mesh.triangle_count(), out.data()));
  return out;
}
inline std::vector<double> remesh_damage(const Mesh& mesh) {
  return mesh.values<double>(mesh.triangle_count(), carreau_remesh_damage);
}
/// Adds a field to a mesh outside of sessions, for .vtu files: `components` numbers for each vertex, or each triangle.
inline void add_field(Mesh& mesh, const std::string& name, bool on_vertices, int components, std::span<const double> values) {
  const std::int64_t rows = on_vertices ? mesh.vertex_count() : mesh.triangle_count();
  if (detail::count_of(values.size()) != rows * components)
    detail::fail(CARREAU_ERR_ARGUMENT, "The values of a field do not fit the mesh.");
  mesh.done(carreau_mesh_add_field(mesh.get(), name.c_str(), on_vertices ? 1 : 0, components, values.data()));
}

} // namespace carreau

#endif
