// SPDX-License-Identifier: BSD-3-Clause
// A script for Gmsh that reads a surface in .msh and defines the volumes inside (reference manual, "Surface Loop", "Volume"):
// Gmsh fills no volume of a .msh file itself.
#include <map>
#include <set>

#include "io/mesh_writers.h"
#include "mesh/regions.h"
#include "support/error.h"

namespace carreau {

std::string geo_text(const FlatMesh& mesh, const std::string& surface) {
  const MeshRegions regions = find_regions(mesh);
  std::map<int, std::set<int>> faces;  // of solids
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const int ref = ref_of(mesh.triangle_refs, t);
    const auto [out_of, into] = regions.sides[t];
    if (ref <= 0)
      throw InvalidArgument("a mesh cannot be written: surfaces of Gmsh have positive numbers, and a face has reference " + std::to_string(ref));
    if (out_of == into) continue;
    for (const int solid : {out_of, into})
      if (solid > 0) faces[solid].insert(ref);
  }
  std::string text = "Merge \"" + surface + "\";\nDelete { Volume{:}; }\n";
  std::map<std::string, std::string> groups;
  for (const auto& [solid, bounds] : faces) {
    const std::string number = std::to_string(solid);
    text += "Surface Loop(" + number + ") = {";
    for (const int ref : bounds) text += (ref == *bounds.begin() ? "" : ", ") + std::to_string(ref);
    text += "};\nVolume(" + number + ") = {" + number + "};\n";
    const auto name = mesh.names.solids.find(solid);
    std::string& members = groups[name == mesh.names.solids.end() || name->second.empty() ? "solid_" + number : plain_name(name->second)];
    members += (members.empty() ? "" : ", ") + number;
  }
  for (const auto& [name, members] : groups) text += "Physical Volume(\"" + name + "\") = {" + members + "};\n";
  return text;
}

}  // namespace carreau
