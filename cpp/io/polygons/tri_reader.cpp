// SPDX-License-Identifier: BSD-3-Clause
// Cart3D's triangulations (.tri), ASCII: "vertices triangles", coordinates, triangles from 1, a component of each triangle.
// A third number on the first line counts values at vertices behind them (.triq), which are not read.
#include "io/mesh_files.h"
#include "io/mesh_writers.h"
#include "io/text.h"
#include "io/words.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

FlatMesh read_mesh_tri(std::string_view content, const std::string& name) {
  const std::string_view text = without_byte_order_mark(content);
  Words in(text, name, '#');
  FlatMesh mesh;
  const std::size_t n = in.count("vertices", 3);
  const std::size_t m = in.count("triangles", 3);
  in.rest_of_line();
  mesh.vertices.resize(in.checked_count(static_cast<std::int64_t>(n), in.position(), "vertices", 3));
  for (Vec3& p : mesh.vertices)
    for (int k = 0; k < 3; ++k) p[k] = in.real("a coordinate of a vertex");
  mesh.vertex_refs.assign(n, 0);
  for (std::size_t t = 0; t < m; ++t) {
    auto& triangle = mesh.triangles.emplace_back();
    for (std::int32_t& v : triangle) {
      const std::int32_t vertex = in.integer("a vertex of a triangle");
      if (vertex < 1 || static_cast<std::size_t>(vertex) > n)
        in.fail(in.position(), "triangle " + std::to_string(t + 1) + " names vertex " + std::to_string(vertex) + " of " +
                                   std::to_string(n));
      v = vertex - 1;
    }
  }
  mesh.triangle_refs.assign(m, 0);
  const char* const before = in.position();
  if (in.word().empty()) return mesh;  // without components
  in.go_back(before);
  for (std::int32_t& ref : mesh.triangle_refs) ref = in.integer("the component of a triangle");
  return mesh;
}

std::string tri_text(const FlatMesh& mesh) {
  if (mesh.is_quadratic()) throw InvalidArgument("Cart3D's .tri holds no elements of order 2");
  std::string text = std::to_string(mesh.vertices.size()) + " " + std::to_string(mesh.triangles.size()) + "\n";
  for (const Vec3& p : mesh.vertices)
    text += format_number(p.x()) + " " + format_number(p.y()) + " " + format_number(mesh.dimension == 3 ? p.z() : 0.0) + "\n";
  for (const auto& [a, b, c] : mesh.triangles)
    text += std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) text += std::to_string(ref_of(mesh.triangle_refs, t)) + "\n";
  return text;
}

}  // namespace carreau
