// SPDX-License-Identifier: BSD-3-Clause
// Files between the steps of BL2D (RR-2818 sec. 6), as its runs wrote them: SMOOTH (.smo, supports of curves) and C (.mc,
// cut curves) have one layout, MS (.ms) has the triangles of domains.
#include <algorithm>
#include <array>
#include <map>

#include "io/bl2d_steps.h"
#include "io/plane/tokens.h"
#include "support/error.h"

namespace carreau {

namespace {

std::int32_t vertex_of(Tokens& in, std::size_t vertices) {
  const int line = in.line(), number = in.integer("the number of a vertex");
  if (number < 1 || static_cast<std::size_t>(number) > vertices)
    in.fail(line, "the vertex " + std::to_string(number) + " does not exist; there are " + std::to_string(vertices));
  return number - 1;
}

void read_vertices(Tokens& in, FlatMesh& mesh) {
  for (Vec3& p : mesh.vertices) p.x() = in.real("a coordinate"), p.y() = in.real("a coordinate");
}

FlatMesh start(Tokens& in) {
  if (!in.take("p1")) in.fail(in.line(), "the file does not start with p1");
  FlatMesh mesh;
  mesh.dimension = 2;
  mesh.vertices.resize(in.count("the number of vertices", 2));
  mesh.vertex_refs.resize(mesh.vertices.size());
  return mesh;
}

/// The sides of triangles that have another subdomain, or none, beyond them.
void add_borders(FlatMesh& mesh) {
  struct Side {
    std::array<std::int32_t, 2> along;
    std::int32_t ref;
    bool open;
  };
  std::map<std::array<std::int32_t, 2>, Side> sides;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3], ref = mesh.triangle_refs[t];
      const auto [side, is_first] = sides.try_emplace({std::min(a, b), std::max(a, b)}, Side{{a, b}, ref, true});
      if (!is_first) side->second.open = side->second.ref != ref;
    }
  for (const auto& [key, side] : sides)
    if (side.open) mesh.edges.push_back(side.along), mesh.edge_refs.push_back(0);
}

}  // namespace

FlatMesh read_mesh_smo(std::string_view text, const std::string& name) {
  Tokens in(text, name, {});
  FlatMesh mesh = start(in);
  const std::size_t vertices = mesh.vertices.size(), edges = in.count("the number of edges", 3);
  (void)in.count("the number of subdomains", 2);
  for (int i = 0; i < 4; ++i) (void)in.real("a coordinate of the box");
  read_vertices(in, mesh);
  for (std::size_t i = 0; i < edges; ++i) {
    mesh.edge_refs.push_back(in.integer("the number of a subdomain"));
    const std::int32_t a = vertex_of(in, vertices), b = vertex_of(in, vertices);
    mesh.edges.push_back({a, b});
  }
  while (!in.at_end() && !in.take("supplement")) (void)in.word("the word supplement");
  if (in.at_end()) return mesh;
  // The supplement has each curve in its own direction.
  for (int i = 0; i < 4; ++i) (void)in.count("a count of the supplement", 0);
  const std::size_t curves = in.count("the number of curves", 5);
  mesh.edges.clear(), mesh.edge_refs.clear();
  for (std::size_t c = 0; c < curves; ++c) {
    const std::size_t count = in.count("the number of vertices of a curve", 2);
    std::int32_t before = -1;
    for (std::size_t i = 0; i < count; ++i) {
      const std::int32_t v = vertex_of(in, vertices);
      (void)in.real("an arc length");
      if (i > 0) mesh.edges.push_back({before, v}), mesh.edge_refs.push_back(static_cast<std::int32_t>(c) + 1);
      before = v;
    }
  }
  return mesh;  // tangents at the ends follow
}

FlatMesh read_mesh_ms(std::string_view text, const std::string& name) {
  Tokens in(text, name, {});
  FlatMesh mesh = start(in);
  const std::size_t triangles = in.count("the number of triangles", 4);
  (void)in.count("the number of subdomains", 0);
  read_vertices(in, mesh);
  std::vector<char> inside(mesh.vertices.size(), 0);
  for (std::size_t i = 0; i < triangles; ++i) {
    std::array<std::int32_t, 3> t{};
    for (std::int32_t& v : t) v = vertex_of(in, mesh.vertices.size());
    const int subdomain = in.integer("the number of a subdomain");
    if (subdomain == 0) continue;  // between the domain and its frame
    mesh.triangles.push_back(t), mesh.triangle_refs.push_back(subdomain);
    for (const std::int32_t v : t) inside[static_cast<std::size_t>(v)] = 1;
  }
  // The corners of the frame come last; files of sizes do not have them.
  while (!mesh.vertices.empty() && inside[mesh.vertices.size() - 1] == 0) mesh.vertices.pop_back();
  mesh.vertex_refs.resize(mesh.vertices.size());
  add_borders(mesh);
  return mesh;
}

}  // namespace carreau
