// SPDX-License-Identifier: BSD-3-Clause
#include "files/mesh_file.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/text_file.h"
#include "files/med_file.h"
#include "files/readable_mesh.h"

namespace command {

MeshHandle read_mesh(const std::string& path) {
  carreau_mesh* raw = nullptr;
  if (carreau_mesh_create(&raw) != CARREAU_OK) throw Failure("Out of memory.");
  MeshHandle mesh(raw);
  const ReadableMesh file(path);
  if (carreau_mesh_read(raw, file.path().c_str()) != CARREAU_OK)
    throw Failure(file.in_terms_of_file(carreau_mesh_last_error(raw)));
  return mesh;
}

void write_mesh(carreau_mesh* mesh, const std::string& path) {
  if (suffix_of(path) == ".med") return write_med(mesh, path);
  require(mesh, carreau_mesh_write(mesh, path.c_str()));
}

std::string group_table(carreau_mesh* mesh) {
  std::int64_t vertices = 0, edges = 0;
  require(mesh, carreau_mesh_count(mesh, &vertices, nullptr, &edges, nullptr));
  std::vector<std::int32_t> points(static_cast<std::size_t>(vertices)), curves(static_cast<std::size_t>(edges));
  if (vertices > 0) require(mesh, carreau_mesh_vertex_refs(mesh, vertices, points.data()));
  if (edges > 0) require(mesh, carreau_mesh_edge_refs(mesh, edges, curves.data()));
  std::map<std::pair<int, std::int32_t>, std::string> groups;
  const auto add = [&](int dimension, std::int32_t ref) {
    if (ref == 0 || groups.contains({dimension, ref})) return;
    groups[{dimension, ref}] = carreau_mesh_entity_name(mesh, dimension, ref);
  };
  for (const std::int32_t ref : points) add(0, ref);
  for (const std::int32_t ref : curves) add(1, ref);
  for (const FaceResult& face : faces_of(mesh)) {
    groups[{2, face.ref}] = face.name;
    std::int32_t solids[2] = {};
    require(mesh, carreau_mesh_face_sides(mesh, face.ref, solids));
    add(3, solids[0]), add(3, solids[1]);
  }
  std::string table = "dimension reference group\n";
  for (const auto& [entity, name] : groups)
    if (!name.empty()) table += std::to_string(entity.first) + " " + std::to_string(entity.second) + " " + name + "\n";
  return table;
}

void require_writers(const std::vector<std::string>& paths) {
  for (const std::string& path : paths)
    if (suffix_of(path) == ".med") require_med();
}

void require(carreau_mesh* mesh, carreau_status status) {
  if (status == CARREAU_OK) return;
  const std::string sentence = carreau_mesh_last_error(mesh);
  throw Failure(sentence.empty() ? carreau_status_meaning(status) : sentence);
}

const char* status_word(std::int32_t status) {
  switch (status) {
    case CARREAU_FACE_MESHED:
      return "meshed";
    case CARREAU_FACE_MENDED:
      return "mended";
    case CARREAU_FACE_COLLAPSED:
      return "collapsed";
    default:
      return "failed";
  }
}

std::string reason_of(const FaceResult& face) {
  if (face.why.empty()) return "";
  const std::string name = "face " + std::to_string(face.ref);
  for (const char* after : {", ", ": "})
    if (face.why.starts_with(name + after)) return ": " + face.why.substr(name.size() + 2);
  return ": " + face.why;
}

std::vector<FaceResult> faces_of(carreau_mesh* mesh) {
  std::vector<FaceResult> faces;
  std::int64_t n = 0;
  require(mesh, carreau_mesh_count(mesh, nullptr, nullptr, nullptr, &n));
  for (std::int64_t i = 0; i < n; ++i) {
    carreau_face face{};
    face.struct_size = sizeof face;
    require(mesh, carreau_mesh_face(mesh, i, &face));
    faces.push_back({face.ref, face.status, face.triangles, face.name, face.why, face.rgb});
  }
  return faces;
}

namespace {

std::vector<Element> elements_of(carreau_mesh* mesh) {
  std::vector<Element> elements;
  for (const std::int32_t kind :
       {CARREAU_CELL_QUAD8, CARREAU_CELL_QUAD4, CARREAU_CELL_TRIANGLE6, CARREAU_CELL_TRIANGLE3}) {
    std::int64_t n = 0;
    require(mesh, carreau_mesh_cell_count(mesh, kind, &n));
    if (n == 0 || (kind == CARREAU_CELL_TRIANGLE3 && elements.empty())) continue;
    Element element{.kind = kind, .ref = 0, .nodes = {}};
    const auto nodes = static_cast<std::size_t>(element.corners() * (element.is_curved() ? 2 : 1));
    std::vector<std::int32_t> all(static_cast<std::size_t>(n) * nodes), refs(static_cast<std::size_t>(n));
    require(mesh, carreau_mesh_cells(mesh, kind, n, all.data(), refs.data()));
    for (std::size_t i = 0; i < refs.size(); ++i) {
      std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(i * nodes), nodes, element.nodes.begin());
      element.ref = refs[i];
      elements.push_back(element);
    }
  }
  return elements;
}

}  // namespace

MeshArrays arrays_of(carreau_mesh* mesh) {
  MeshArrays arrays;
  std::int64_t n = 0, m = 0, k = 0;
  std::int32_t dimension = 3;
  require(mesh, carreau_mesh_count(mesh, &n, &m, &k, nullptr));
  require(mesh, carreau_mesh_dimension(mesh, &dimension));
  arrays.dimension = dimension;
  arrays.vertices.resize(static_cast<std::size_t>(n));
  arrays.triangles.resize(static_cast<std::size_t>(m));
  arrays.triangle_refs.resize(static_cast<std::size_t>(m));
  arrays.edges.resize(static_cast<std::size_t>(k));
  if (n > 0) require(mesh, carreau_mesh_vertices(mesh, n, arrays.vertices.front().data()));
  if (m > 0) require(mesh, carreau_mesh_triangles(mesh, m, arrays.triangles.front().data()));
  if (m > 0) require(mesh, carreau_mesh_triangle_refs(mesh, m, arrays.triangle_refs.data()));
  if (k > 0) require(mesh, carreau_mesh_edges(mesh, k, arrays.edges.front().data()));
  arrays.elements = elements_of(mesh);
  arrays.faces = faces_of(mesh);
  return arrays;
}

}  // namespace command
