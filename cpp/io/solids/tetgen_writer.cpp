// SPDX-License-Identifier: BSD-3-Clause
// TetGen's piecewise linear complexes (H. Si, TetGen user's manual, .smesh and .poly): facets with the references of faces,
// a point in each region with the number of its solid, holes.
#include <cmath>

#include "io/mesh_writers.h"
#include "io/solids/corner_numbers.h"
#include "mesh/regions.h"
#include "support/format.h"

namespace carreau {

namespace {

void add_point(const Vec3& p, std::string& text) {
  for (int k = 0; k < 3; ++k) text += ' ', append_number(text, p[k]);
}

/// Volume of a regular tetrahedron.
double regular_volume(double edge) noexcept { return edge * edge * edge / (6 * std::sqrt(2.0)); }

}  // namespace

std::string tetgen_text(const FlatMesh& mesh, bool poly) {
  const MeshRegions regions = find_regions(mesh);
  const CornerNumbers corners(mesh);
  std::string text = "# number of points, dimension, attributes, markers\n" + std::to_string(corners.vertices.size()) + " 3 0 1\n";
  for (std::size_t i = 0; i < corners.vertices.size(); ++i) {
    text += std::to_string(i + 1);
    add_point(mesh.vertices[corners.vertices[i]], text);
    text += ' ' + std::to_string(ref_of(mesh.vertex_refs, corners.vertices[i])) + '\n';
  }
  text += "# facets: markers are references of faces\n" + std::to_string(mesh.triangles.size()) + " 1\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::string marker = std::to_string(ref_of(mesh.triangle_refs, t));
    text += poly ? "1 0 " + marker + "\n3" : "3";
    for (const std::int32_t v : mesh.triangles[t]) text += ' ' + std::to_string(corners.number[static_cast<std::size_t>(v)]);
    text += poly ? "\n" : ' ' + marker + '\n';
  }
  text += "# holes\n" + std::to_string(regions.holes.size()) + '\n';
  for (std::size_t i = 0; i < regions.holes.size(); ++i) {
    text += std::to_string(i + 1);
    add_point(regions.holes[i].inside, text);
    text += '\n';
  }
  text += "# regions: a point, the number of the solid, the largest volume\n" + std::to_string(regions.solids.size()) + '\n';
  for (std::size_t i = 0; i < regions.solids.size(); ++i) {
    const MeshRegion& region = regions.solids[i];
    text += std::to_string(i + 1);
    add_point(region.inside, text);
    text += ' ' + std::to_string(region.solid) + ' ';
    append_number(text, regular_volume(region.longest_edge));
    if (const auto name = mesh.names.solids.find(region.solid); name != mesh.names.solids.end())
      text += "  # " + plain_name(name->second);
    text += '\n';
  }
  return text;
}

}  // namespace carreau
