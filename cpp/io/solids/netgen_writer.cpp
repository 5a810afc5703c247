// SPDX-License-Identifier: BSD-3-Clause
// Netgen's .vol (netgen/libsrc/meshing/meshclass.cpp, Mesh::Save): triangles with the numbers of their faces and of the solids
// on both sides, names of solids and faces.
#include <algorithm>
#include <map>

#include "io/mesh_writers.h"
#include "io/solids/corner_numbers.h"
#include "mesh/regions.h"
#include "support/format.h"

namespace carreau {

std::string netgen_text(const FlatMesh& mesh) {
  const MeshRegions regions = find_regions(mesh);
  const CornerNumbers corners(mesh);
  // Faces and solids are numbered from 1 without gaps.
  std::map<std::array<int, 3>, int> faces;  // by reference and sides
  std::map<int, int> solids;
  for (const auto& [solid, volume] : regions.volumes) solids.emplace(solid, static_cast<int>(solids.size()) + 1);
  solids[0] = 0;
  std::vector<std::array<int, 3>> keys;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [out_of, into] = regions.sides[t];
    keys.push_back({ref_of(mesh.triangle_refs, t), out_of, into});
    faces.emplace(keys.back(), 0);
  }
  int last = 0;
  for (auto& [key, number] : faces) number = ++last;
  std::string text = "mesh3d\ndimension\n3\ngeomtype\n0\n\nsurfaceelements\n" + std::to_string(mesh.triangles.size()) + '\n';
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::string number = std::to_string(faces.at(keys[t]));
    const bool turned = keys[t][1] == 0;  // triangles look out of the first domain, which must be a solid
    text += number + ' ' + number;
    for (const int solid : {keys[t][turned ? 2U : 1U], keys[t][turned ? 1U : 2U]}) text += ' ' + std::to_string(solids.at(solid));
    text += " 3";
    auto nodes = mesh.triangles[t];
    if (turned) std::swap(nodes[1], nodes[2]);
    for (const std::int32_t v : nodes) text += ' ' + std::to_string(corners.number[static_cast<std::size_t>(v)]);
    text += '\n';
  }
  text += "\nvolumeelements\n0\n\nedgesegmentsgi2\n0\n\npoints\n" + std::to_string(corners.vertices.size()) + '\n';
  for (const std::size_t v : corners.vertices) {
    for (int k = 0; k < 3; ++k) append_number(text, mesh.vertices[v][k]), text += k < 2 ? ' ' : '\n';
  }
  text += "\nmaterials\n" + std::to_string(solids.size() - 1) + '\n';
  for (const auto& [solid, number] : solids) {
    if (solid == 0) continue;
    const auto name = mesh.names.solids.find(solid);
    std::string word = name == mesh.names.solids.end() || name->second.empty() ? "solid_" + std::to_string(solid) : plain_name(name->second);
    std::ranges::replace(word, ' ', '_');
    text += std::to_string(number) + ' ' + word + '\n';
  }
  text += "\nbcnames\n" + std::to_string(faces.size()) + '\n';
  for (const auto& [key, number] : faces) {
    std::string word = name_of_face(mesh, key[0], "face_");
    std::ranges::replace(word, ' ', '_');
    text += std::to_string(number) + ' ' + word + '\n';
  }
  return text + "\nendmesh\n";
}

}  // namespace carreau
