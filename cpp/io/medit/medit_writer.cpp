// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <charconv>

#include "io/element_lists.h"
#include "io/mesh_writers.h"
#include "support/format.h"

namespace carreau {

namespace {

void append_integer(std::string& text, std::int64_t value) {
  std::array<char, 24> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  text.append(buffer.data(), end);
}

void append_header(std::string& text, const char* keyword, std::size_t count) {
  text += '\n';
  text += keyword;
  text += '\n';
  append_integer(text, static_cast<std::int64_t>(count));
  text += '\n';
}

template <std::size_t N>
void append_entities(std::string& text, const char* keyword, const std::vector<std::array<std::int32_t, N>>& entities,
                     const std::vector<std::int32_t>& refs) {
  if (entities.empty()) return;
  append_header(text, keyword, entities.size());
  for (std::size_t i = 0; i < entities.size(); ++i) {
    for (const std::int32_t vertex : entities[i]) {
      append_integer(text, std::int64_t{vertex} + 1);
      text += ' ';
    }
    append_integer(text, ref_of(refs, i));
    text += '\n';
  }
}

template <typename Record>
void append_record(std::string& text, const Record& record, const double* parameters, int count) {
  append_integer(text, std::int64_t{record.node} + 1);
  text += ' ';
  append_integer(text, record.ref);
  for (int i = 0; i < count; ++i) text += ' ', append_number(text, parameters[i]);
  text += count > 0 ? " 0\n" : "\n";  // the distance
}

void append_association(std::string& text, const MeshAssociation& association, const ElementList<2>& edges) {
  if (!association.points.empty()) append_header(text, "VerticesOnGeometricVertices", association.points.size());
  for (const MeshAssociation::OnPoint& on : association.points) append_record(text, on, nullptr, 0);
  if (!association.curves.empty()) append_header(text, "VerticesOnGeometricEdges", association.curves.size());
  for (const MeshAssociation::OnCurve& on : association.curves) append_record(text, on, &on.t, 1);
  if (!association.faces.empty()) append_header(text, "VerticesOnGeometricTriangles", association.faces.size());
  for (const MeshAssociation::OnFace& on : association.faces) append_record(text, on, on.uv.data(), 2);
  if (!edges.nodes.empty()) append_header(text, "EdgesOnGeometricEdges", edges.nodes.size());
  for (std::size_t e = 0; e < edges.nodes.size(); ++e)
    append_record(text, MeshAssociation::OnPoint{static_cast<std::int32_t>(e), edges.refs[e]}, nullptr, 0);
}

void append_vertex(std::string& text, int dimension, const Vec3& p, std::int32_t ref) {
  append_number(text, p.x());
  text += ' ';
  append_number(text, p.y());
  text += ' ';
  if (dimension == 3) {
    append_number(text, p.z());
    text += ' ';
  }
  append_integer(text, ref);
  text += '\n';
}

}  // namespace

// RT-0232 sec. 4, with version 2 (reals of 64 bits) instead of 0, which today's readers reject.
std::string medit_text(const FlatMesh& mesh, const MeshAssociation* association) {
  std::string text;
  text.reserve(200 + 56 * mesh.vertices.size() + 28 * mesh.triangles.size() + 20 * mesh.edges.size());
  // Gmsh requires the version on the line of its keyword; all programs read the dimension from a separate line.
  text += "MeshVersionFormatted 2\n\nDimension\n";
  append_integer(text, mesh.dimension);
  text += '\n';
  const MeditElements elements(mesh);
  append_header(text, "Vertices", mesh.vertices.size() + elements.centres.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    append_vertex(text, mesh.dimension, mesh.vertices[i], ref_of(mesh.vertex_refs, i));
  for (const Vec3& centre : elements.centres) append_vertex(text, mesh.dimension, centre, 0);
  const ElementLists& lists = elements.lists;
  append_entities(text, "Edges", lists.edges.nodes, lists.edges.refs);
  append_entities(text, "EdgesP2", lists.edges3.nodes, lists.edges3.refs);
  append_entities(text, "Triangles", elements.triangles, elements.triangle_refs);
  append_entities(text, "Quadrilaterals", lists.quads.nodes, lists.quads.refs);
  append_entities(text, "TrianglesP2", lists.triangles6.nodes, lists.triangles6.refs);
  append_entities(text, "QuadrilateralsQ2", elements.quads9.nodes, elements.quads9.refs);
  if (association != nullptr) append_association(text, *association, lists.edges);
  text += "\nEnd\n";
  return text;
}

}  // namespace carreau
