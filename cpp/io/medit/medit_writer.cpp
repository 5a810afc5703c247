#include <array>
#include <charconv>

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

}  // namespace

// RT-0232 sec. 4, with version 2 (reals of 64 bits) instead of 0, which today's readers refuse.
std::string medit_text(const FlatMesh& mesh) {
  std::string text;
  text.reserve(200 + 56 * mesh.vertices.size() + 28 * mesh.triangles.size() + 20 * mesh.edges.size());
  // Gmsh wants the version on the line of its keyword; the dimension is taken by all on a line of its own.
  text += "MeshVersionFormatted 2\n\nDimension\n";
  append_integer(text, mesh.dimension);
  text += '\n';
  append_header(text, "Vertices", mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& p = mesh.vertices[i];
    append_number(text, p.x());
    text += ' ';
    append_number(text, p.y());
    text += ' ';
    if (mesh.dimension == 3) {
      append_number(text, p.z());
      text += ' ';
    }
    append_integer(text, ref_of(mesh.vertex_refs, i));
    text += '\n';
  }
  append_entities(text, "Edges", mesh.edges, mesh.edge_refs);
  append_entities(text, "Triangles", mesh.triangles, mesh.triangle_refs);
  text += "\nEnd\n";
  return text;
}

}  // namespace carreau
