// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "io/mesh_files.h"
#include "io/polygons/polygon_cutter.h"
#include "io/text.h"
#include "io/words.h"
#include "support/error.h"

namespace carreau {

namespace {

constexpr std::array known_headers{"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF"};

void read_header(Words& in) {
  const std::string_view word = in.word();
  if (word.empty()) in.fail(in.end(), "the file is empty");
  for (const char* known : known_headers)
    if (word == known) return;
  in.fail(word.data(), "OFF was expected, not " + shown(word));
}

}  // namespace

FlatMesh read_mesh_off(std::string_view content, const std::string& name) {
  Words in(without_byte_order_mark(content), name, '#');
  read_header(in);
  const char* const after = in.position();
  if (in.word() == "BINARY") in.fail(after, "the binary form of OFF is not read: convert the file to text");
  in.go_back(after);
  const std::int32_t vertices = in.integer("the number of vertices"), faces = in.integer("the number of faces");
  in.integer("the number of edges");
  FlatMesh mesh;
  mesh.vertices.resize(in.checked_count(vertices, in.position(), "vertices", 3));
  const std::size_t n = in.checked_count(faces, in.position(), "faces", 1);
  for (Vec3& p : mesh.vertices) {
    for (int k = 0; k < 3; ++k) p[k] = in.real("a coordinate of a vertex");
    in.rest_of_line();  // colours, normals
  }
  PolygonCutter cutter(mesh);
  std::vector<std::int32_t> corners;
  for (std::size_t i = 0; i < n; ++i) {
    corners.resize(in.count("corners of a face", 1));
    const char* const at = in.position();
    for (std::int32_t& v : corners) v = in.integer("a corner of a face");
    if (const std::string wrong = cutter.add(corners, 0); !wrong.empty()) in.fail(at, wrong);
    in.rest_of_line();
  }
  mesh.vertex_refs.assign(mesh.vertices.size(), 0);
  return mesh;
}

}  // namespace carreau
