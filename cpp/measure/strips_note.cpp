// SPDX-License-Identifier: BSD-3-Clause
#include "measure/strips_note.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "mesh/quality.h"
#include "support/short_number.h"

namespace carreau {
namespace {

/// Q2. Triangles of a strip have less than this in the mean when their edges are six widths long.
constexpr double min_mean_quality = 0.4;
/// Share of the vertices of a layer.
constexpr double max_inside = 0.05;
constexpr std::size_t max_named = 5;

Vec3 place_of(const SurfaceMesh& mesh, const FaceMesh& face, std::int32_t vertex) {
  return mesh.vertices[face.vertex[vertex]];
}

double mean_quality(const SurfaceMesh& mesh, const FaceMesh& face) {
  double sum = 0;
  for (const auto& t : face.triangles)
    sum += quality_q2(place_of(mesh, face, t[0]), place_of(mesh, face, t[1]), place_of(mesh, face, t[2]));
  return sum / static_cast<double>(face.triangles.size());
}

/// Area over half the perimeter; 0 when vertices inside the face are more than a few: it is no layer of triangles then.
double width_of_layer(const SurfaceMesh& mesh, const FaceMesh& face) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  double area = 0, perimeter = 0;
  for (const auto& t : face.triangles) {
    for (int i = 0; i < 3; ++i) ++uses[std::minmax(t[i], t[(i + 1) % 3])];
    const Vec3 a = place_of(mesh, face, t[0]);
    area += norm(cross(place_of(mesh, face, t[1]) - a, place_of(mesh, face, t[2]) - a)) / 2;
  }
  std::vector<char> on_boundary(face.vertex.size(), 0);
  for (const auto& [edge, count] : uses) {
    if (count > 1) continue;
    on_boundary[edge.first] = on_boundary[edge.second] = 1;
    perimeter += norm(place_of(mesh, face, edge.second) - place_of(mesh, face, edge.first));
  }
  const auto inside = static_cast<double>(std::count(on_boundary.begin(), on_boundary.end(), 0));
  const bool is_layer = inside <= max_inside * static_cast<double>(on_boundary.size());
  return is_layer && perimeter > 0 ? 2 * area / perimeter : 0;
}

}  // namespace

std::string describe_strips(const SurfaceMesh& mesh) {
  std::size_t count = 0;
  std::string named;
  for (const FaceMesh& face : mesh.faces) {
    if (face.triangles.empty() || !face.uv_face.empty()) continue;
    const double quality = mean_quality(mesh, face);
    if (quality >= min_mean_quality) continue;
    const double width = width_of_layer(mesh, face);
    if (!(width > 0)) continue;
    if (++count > max_named) continue;
    named += (count > 1 ? ", face " : "face ") + std::to_string(face.shown_ref()) + " (" + short_number(width) +
             " wide, mean Q2 " + short_number(quality) + ")";
  }
  if (count == 0) return {};
  return (count == 1 ? "a strip is so narrow that its" : std::to_string(count) + " strips are so narrow that their") +
         " triangles have no good shape: " + named + (count > max_named ? ", ..." : "") +
         "; smaller sizes, or narrow_faces = 'collapse' with a larger narrow_ratio, avoid that";
}

}  // namespace carreau
