// SPDX-License-Identifier: BSD-3-Clause
// OFF and Wavefront OBJ as text, PLY as bytes: triangles and straight quadrilaterals. OBJ has a group a face and lines along curves;
// the others have neither. A property of faces would hold references in PLY, but not every reader of its bytes skips one.
#include <bit>
#include <cstring>

#include "io/mesh_writers.h"
#include "io/solver/element_sets.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr std::size_t longest_name = 255;

void add_point(const FlatMesh& mesh, std::size_t v, std::string& text) {
  const Vec3& p = mesh.vertices[v];
  append_number(text, p.x()), text += ' ';
  append_number(text, p.y()), text += ' ';
  append_number(text, mesh.dimension == 3 ? p.z() : 0.0), text += '\n';
}

/// use(nodes, count) for each element, in the order of the mesh.
template <typename Use>
void for_each_polygon(const FlatMesh& mesh, Use&& use) {
  for (const Cell& cell : mesh.cells) use(cell.nodes.data(), corner_count(cell.kind));
  if (mesh.cells.empty())
    for (const auto& triangle : mesh.triangles) use(triangle.data(), 3);
}

std::size_t count_polygons(const FlatMesh& mesh) {
  return mesh.cells.empty() ? mesh.triangles.size() : mesh.cells.size();
}

template <typename Number>
void add_bytes(Number value, std::string& bytes) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

}  // namespace

std::string off_text(const FlatMesh& mesh) {
  refuse_second_order(mesh, ".off");
  std::string text =
      "OFF\n" + std::to_string(mesh.vertices.size()) + " " + std::to_string(count_polygons(mesh)) + " 0\n";
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) add_point(mesh, v, text);
  for_each_polygon(mesh, [&](const std::int32_t* nodes, int count) {
    text += std::to_string(count);
    for (int k = 0; k < count; ++k) text.append(" ").append(std::to_string(nodes[k]));
    text += '\n';
  });
  return text;
}

std::string obj_text(const FlatMesh& mesh) {
  refuse_second_order(mesh, ".obj");
  const ElementSets sets = sets_of(mesh, longest_name);
  std::vector<std::string> names;
  for (const FaceSet& face : sets.faces) names.push_back(face.name);
  for (const NamedSets& each : sets.names)
    for (const std::size_t i : each.sets) names[i] = each.name;
  std::string text = "# mesh by Carreau\n";
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) text += "v ", add_point(mesh, v, text);
  const auto add = [&](char key, const std::int32_t* nodes, std::size_t count) {
    text += key;
    for (std::size_t k = 0; k < count; ++k) text.append(" ").append(std::to_string(nodes[k] + 1));
    text += '\n';
  };
  for (std::size_t i = 0; i < sets.faces.size(); ++i) {
    text += "g " + names[i] + "\n";
    for (const Cell& cell : sets.faces[i].cells) add('f', cell.nodes.data(), std::size_t(corner_count(cell.kind)));
  }
  for (const CurveSet& curve : sets.curves) {
    text += "g " + curve.name + "\n";
    for (const auto& edge : curve.edges) add('l', edge.data(), 2);
  }
  return text;
}

std::string ply_bytes(const FlatMesh& mesh) {
  refuse_second_order(mesh, ".ply");
  std::string bytes = "ply\nformat binary_" + std::string(std::endian::native == std::endian::little ? "little" : "big") +
                      "_endian 1.0\ncomment mesh by Carreau\nelement vertex " + std::to_string(mesh.vertices.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(count_polygons(mesh)) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : mesh.vertices)
    for (const double x : {p.x(), p.y(), mesh.dimension == 3 ? p.z() : 0.0}) add_bytes(x, bytes);
  for_each_polygon(mesh, [&](const std::int32_t* nodes, int count) {
    add_bytes(static_cast<std::uint8_t>(count), bytes);
    for (int k = 0; k < count; ++k) add_bytes(nodes[k], bytes);
  });
  return bytes;
}

}  // namespace carreau
