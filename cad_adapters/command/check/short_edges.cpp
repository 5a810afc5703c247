// SPDX-License-Identifier: BSD-3-Clause
#include "check/short_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "files/session_handle.h"

namespace command {
namespace {

double bound_of(carreau_session* session) {
  double bound = 0;
  for (const auto& [flag, name] : {std::pair{"hphy_flag", "hphymin"}, std::pair{"hgeo_flag", "hgeomin"}}) {
    std::int32_t active = 0;
    double value = 0;
    if (carreau_get_integer(session, flag, &active) != CARREAU_OK || active == 0) continue;
    if (carreau_get_real(session, name, &value) != CARREAU_OK) continue;
    bound = bound > 0 ? std::min(bound, value) : value;
  }
  return bound;
}

}  // namespace

ShortEdges find_short_edges(carreau_session* session, carreau_mesh* mesh, const carreau_quality& quality) {
  ShortEdges found;
  found.bound = bound_of(session);
  const double limit = found.bound / std::sqrt(2.0);
  constexpr double beyond_rounding = 1.001;
  if (quality.edge_min > beyond_rounding * limit) return found;  // the mesh need not be looked at
  std::int64_t n = 0, t = 0, k = 0, f = 0;
  require(mesh, carreau_mesh_count(mesh, &n, &t, &k, &f));
  if (t == 0 || !(limit > 0)) return found;
  std::vector<std::array<double, 3>> xyz(static_cast<std::size_t>(n));
  std::vector<std::array<std::int32_t, 3>> triangles(static_cast<std::size_t>(t));
  std::vector<std::int32_t> refs(triangles.size());
  require(mesh, carreau_mesh_vertices(mesh, n, xyz.front().data()));
  require(mesh, carreau_mesh_triangles(mesh, t, triangles.front().data()));
  require(mesh, carreau_mesh_triangle_refs(mesh, t, refs.data()));
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  std::set<std::int32_t> faces;
  found.shortest = limit;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::pair<std::int32_t, std::int32_t> edge = std::minmax(triangles[i][c], triangles[i][(c + 1) % 3]);
      const auto& p = xyz[static_cast<std::size_t>(edge.first)];
      const auto& q = xyz[static_cast<std::size_t>(edge.second)];
      // Beyond doubt, which most are: a distance that cannot overflow costs ten times as much.
      const double dx = q[0] - p[0], dy = q[1] - p[1], dz = q[2] - p[2];
      if (dx * dx + dy * dy + dz * dz > beyond_rounding * limit * limit) continue;
      const double length = std::hypot(dx, dy, dz);
      if (length >= limit) continue;
      edges.push_back(edge);
      faces.insert(refs[i]);
      found.shortest = std::min(found.shortest, length);
    }
  std::sort(edges.begin(), edges.end());
  found.count = std::unique(edges.begin(), edges.end()) - edges.begin();
  if (found.count == 0) found.shortest = 0;
  found.faces.assign(faces.begin(), faces.end());
  return found;
}

}  // namespace command
