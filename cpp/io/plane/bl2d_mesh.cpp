// SPDX-License-Identifier: BSD-3-Clause
// BL2D's .bl2d, the input of its solvers: `p1`, three counts, vertices, edges, triangles, each with its reference.
#include <array>

#include "io/mesh_files.h"
#include "io/mesh_writers.h"
#include "io/plane/tokens.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

template <std::size_t N>
void append_entities(std::string& text, const std::vector<std::array<std::int32_t, N>>& entities,
                     const std::vector<std::int32_t>& refs) {
  for (std::size_t i = 0; i < entities.size(); ++i) {
    for (const std::int32_t vertex : entities[i]) text += std::to_string(vertex + 1) + " ";
    text += std::to_string(ref_of(refs, i)) + "\n";
  }
}

template <std::size_t N>
void read_entities(Tokens& in, std::size_t vertices, std::vector<std::array<std::int32_t, N>>& entities,
                   std::vector<std::int32_t>& refs) {
  for (std::size_t i = 0; i < entities.size(); ++i) {
    for (std::int32_t& vertex : entities[i]) {
      const int line = in.line(), number = in.integer("the number of a vertex");
      if (number < 1 || static_cast<std::size_t>(number) > vertices)
        in.fail(line,
                "the vertex " + std::to_string(number) + " does not exist; there are " + std::to_string(vertices));
      vertex = number - 1;
    }
    refs[i] = in.integer("a reference");
  }
}

}  // namespace

std::string bl2d_text(const FlatMesh& mesh) {
  if (!mesh.cells.empty())
    throw InvalidArgument("a mesh cannot be written as .bl2d: it has elements that are not straight triangles (p1)");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (mesh.vertices[i].z() != 0)
      throw InvalidArgument("a mesh cannot be written as .bl2d: vertex " + std::to_string(i) +
                            " (from 0) is not in the plane z = 0");
  std::string text = "p1\n" + std::to_string(mesh.vertices.size()) + " " + std::to_string(mesh.edges.size()) + " " +
                     std::to_string(mesh.triangles.size()) + "\n";
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    append_number(text, mesh.vertices[i].x());
    text += ' ';
    append_number(text, mesh.vertices[i].y());
    text += " " + std::to_string(ref_of(mesh.vertex_refs, i)) + "\n";
  }
  append_entities(text, mesh.edges, mesh.edge_refs);
  append_entities(text, mesh.triangles, mesh.triangle_refs);
  return text;
}

FlatMesh read_mesh_bl2d(std::string_view text, const std::string& name) {
  Tokens in(text, name, {});
  if (!in.take("p1")) in.fail(in.line(), "the file does not start with p1");
  FlatMesh mesh;
  mesh.dimension = 2;
  const std::size_t vertices = in.count("the number of vertices", 3), edges = in.count("the number of edges", 3),
                    triangles = in.count("the number of triangles", 4);
  mesh.vertices.resize(vertices), mesh.vertex_refs.resize(vertices);
  mesh.edges.resize(edges), mesh.edge_refs.resize(edges);
  mesh.triangles.resize(triangles), mesh.triangle_refs.resize(triangles);
  for (std::size_t i = 0; i < vertices; ++i) {
    mesh.vertices[i].x() = in.real("a coordinate"), mesh.vertices[i].y() = in.real("a coordinate");
    mesh.vertex_refs[i] = in.integer("the reference of a vertex");
  }
  read_entities(in, vertices, mesh.edges, mesh.edge_refs);
  read_entities(in, vertices, mesh.triangles, mesh.triangle_refs);
  in.end();
  return mesh;
}

}  // namespace carreau
